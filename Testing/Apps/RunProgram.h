/// @file
/// Runs the program in a folder of its own and keeps what it says.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include <sys/types.h>

namespace pointhaptics
{
namespace apptest
{

constexpr const char* kIdolPath = POINTHAPTICS_DATA "/Paths/idol-touch.csv";

struct Outcome
{
  int exitCode = -1; ///< 128 + signal where a signal ended the program.
  std::string output;
  std::string errors;
};

/// Each test works in an empty folder that goes when it ends.
class CommandLine : public ::testing::Test
{
protected:
  CommandLine();
  ~CommandLine() override;

  /// Runs `pointhaptics arguments...` in the folder, without a shell.
  Outcome run(const std::vector<std::string>& arguments) const;
  /// The two halves of run(), for a test that does something in between; one program at a time.
  /// @p output: where stdout goes instead of into Outcome::output.
  pid_t start(const std::vector<std::string>& arguments, int output = -1) const;
  Outcome finish(pid_t child) const;
  /// Expects success and nothing on stderr. @return stdout.
  std::string succeed(const std::vector<std::string>& arguments) const;
  /// Expects @p exitCode, nothing on stdout and one line on stderr that begins `pointhaptics COMMAND: ` and
  /// contains each of @p parts.
  void refuse(
    int exitCode, const std::vector<std::string>& arguments, const std::vector<std::string>& parts) const;

  void write(const std::string& name, const std::string& content) const;
  std::string read(const std::string& name) const;
  bool exists(const std::string& name) const;
  /// Where a file of that name in the folder is.
  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  /// Names in the folder, sorted.
  std::vector<std::string> files() const;

private:
  std::string folder_;
};

/// While it lives, a file is the standard input of this program and those it starts.
class InputFrom
{
public:
  explicit InputFrom(const std::string& path);
  ~InputFrom();

private:
  int before_;
};

/// A CSV file with a header: column name to values.
using Table = std::map<std::string, std::vector<double>>;
Table parseTable(const std::string& text);

} // namespace apptest
} // namespace pointhaptics
