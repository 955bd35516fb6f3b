#include "Benchmark/Render/WholeProcess.h"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace pointhaptics::bench::render
{

ProcessRun runProcess(const std::vector<std::string>& words)
{
  std::vector<char*> arguments;
  for (const std::string& word : words)
  {
    arguments.push_back(const_cast<char*>(word.c_str()));
  }
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  ProcessRun run;
  pid_t child = 0;
  const auto begin = std::chrono::steady_clock::now();
  const bool started =
    ::posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ) == 0;
  ::posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  struct rusage usage = {};
  if (started && ::wait4(child, &status, 0, &usage) == child)
  {
    run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    run.peakBytes = std::int64_t(usage.ru_maxrss) * 1024;
    run.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  return run;
}

bool programExists(const std::string& name)
{
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
  {
    if (::access((std::filesystem::path(folder) / name).c_str(), X_OK) == 0)
    {
      return true;
    }
  }
  return false;
}

std::string viewerProgram()
{
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::filesystem::path beside = self.parent_path() / "pointhaptics";
  return !error && ::access(beside.c_str(), X_OK) == 0 ? beside.string() : "pointhaptics";
}

} // namespace pointhaptics::bench::render
