#include "Commands/Commands.h"

#include "Terminal/Messages.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <vector>

#include <unistd.h>

namespace pointhaptics::app
{
namespace
{

constexpr const char* kBenchProgram = "pointhaptics-bench";

std::string benchProgram()
{
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::filesystem::path beside = self.parent_path() / kBenchProgram;
  return !error && ::access(beside.c_str(), X_OK) == 0 ? beside.string() : kBenchProgram;
}

struct BenchCommand : Command
{
  CLI::App* command = nullptr;

  void addTo(CLI::App& added) override
  {
    this->command = &added;
    added.prefix_command();
    added.set_help_flag();
  }

  /// Replaces this process by the other program. @return kFailed where there is none.
  int run(Files&) override
  {
    const std::string program = benchProgram();
    std::vector<std::string> texts = this->command->remaining();
    texts.insert(texts.begin(), program);
    std::vector<char*> arguments;
    for (std::string& text : texts)
    {
      arguments.push_back(text.data());
    }
    arguments.push_back(nullptr);
    ::execvp(program.c_str(), arguments.data());
    const int why = errno;
    return fail(why == ENOENT
        ? fmt::format("{0} is not installed: the benchmarks are a program of their own; install it from the "
                      "build folder by cmake --install FOLDER --component Benchmarks",
            kBenchProgram)
        : fmt::format("{} does not start: {}", program, std::strerror(why)));
  }
};

} // namespace

Command* benchCommand()
{
  return new BenchCommand;
}

} // namespace pointhaptics::app
