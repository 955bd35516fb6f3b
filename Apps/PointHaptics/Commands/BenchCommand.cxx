#include "Commands/Commands.h"

#include "Terminal/Messages.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <vector>

#include <unistd.h>

namespace pointhaptics::app
{
namespace
{

constexpr const char* kBenchProgram = "pointhaptics-bench";

/// Finds the program beside this one, or on PATH.
std::string benchProgram()
{
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::filesystem::path beside = self.parent_path() / kBenchProgram;
  return !error && ::access(beside.c_str(), X_OK) == 0 ? beside.string() : kBenchProgram;
}

/// Replaces this process by the other program. @return kFailed where there is none.
int becomeBench(const std::vector<std::string>& words)
{
  std::string program = benchProgram();
  std::vector<std::string> texts{ program };
  texts.insert(texts.end(), words.begin(), words.end());
  std::vector<char*> arguments;
  for (std::string& text : texts)
  {
    arguments.push_back(text.data());
  }
  arguments.push_back(nullptr);
  ::execvp(program.c_str(), arguments.data());
  const int why = errno;
  return fail("bench",
    why == ENOENT
      ? fmt::format("{0} is not installed: the benchmarks are a program of their own; install it from the "
                    "build folder by cmake --install FOLDER --component Benchmarks",
          kBenchProgram)
      : fmt::format("{} does not start: {}", program, std::strerror(why)));
}

} // namespace

void addBenchCommand(CLI::App& program, int& exitCode)
{
  CLI::App* command =
    program.add_subcommand("bench", "Measure PointHaptics beside others (pointhaptics-bench)");
  command->prefix_command();
  command->set_help_flag();
  command->callback([command, &exitCode] { exitCode = becomeBench(command->remaining()); });
}

} // namespace pointhaptics::app
