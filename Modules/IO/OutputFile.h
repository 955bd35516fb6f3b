/// @file
/// A file that appears under its name only when it is complete.
#pragma once

#include <cstddef>
#include <cstdio>
#include <string>

namespace pointhaptics::io
{

/// A name in the folder of the target for the unfinished file; removed unless commit() was reached.
class TemporaryFile
{
public:
  /// @throws FileProblem when @p target exists and is not a regular file, or its folder does not exist.
  explicit TemporaryFile(const std::string& target);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string& path() const { return path_; }
  /// Renames the finished file to its target. @throws FileProblem.
  void commit();

private:
  std::string target_;
  std::string path_;
  bool committed_ = false;
};

/// Buffered output. Each function @throws FileProblem with the system's reason.
class OutputStream
{
public:
  explicit OutputStream(const std::string& path);
  ~OutputStream();
  OutputStream(const OutputStream&) = delete;
  OutputStream& operator=(const OutputStream&) = delete;

  void write(const char* data, std::size_t size);
  void write(const std::string& text) { write(text.data(), text.size()); }
  /// Flushes and closes: a full disk may show only here.
  void close();

private:
  std::FILE* file_;
};

} // namespace pointhaptics::io
