/// @file
/// Standard input and output as files: readers look at a file more than once, and writers go back in it.
#pragma once

#include <filesystem>
#include <string>

namespace pointhaptics::app
{

/// A folder in that of temporary files (TMPDIR), removed at the end with all in it.
class TemporaryFolder
{
public:
  /// @throws Failure where none can be made.
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

private:
  std::filesystem::path folder_;
};

/// Reads a pipe, or standard input where @p from is empty, to its end into a new file. @throws Failure, also
/// where a signal (StopSignals.h) ends it.
void copyInput(const std::string& from, const std::string& path);
/// Writes the content of a file to standard output. @throws Failure
void copyToStandardOutput(const std::string& path);

} // namespace pointhaptics::app
