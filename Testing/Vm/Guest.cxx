#include "Guest.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/mount.h>
#include <sys/reboot.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

namespace pointhaptics
{
namespace trial
{
namespace
{
void mountAt(const char* type, const char* folder)
{
  mkdir(folder, 0755);
  if (mount(type, folder, type, 0, nullptr) != 0)
  {
    std::printf("vm: %s cannot be mounted: %s\n", type, std::strerror(errno));
  }
}

/// The kernel gives its first process a console only where the node was there before it.
void openConsole()
{
  const int console = open("/dev/console", O_RDWR);
  for (int i = 0; console >= 0 && i < 3; ++i)
  {
    dup2(console, i);
  }
  setvbuf(stdout, nullptr, _IOLBF, 0);
}

void loadModules()
{
  std::vector<std::string> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/modules", error))
  {
    files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  for (const std::string& file : files)
  {
    const int module = open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (syscall(SYS_finit_module, module, "", 0) != 0 && errno != EEXIST)
    {
      std::printf("vm: %s cannot be loaded: %s\n", file.c_str(), std::strerror(errno));
    }
    close(module);
  }
}
}

bool isFirstProcess()
{
  return getpid() == 1;
}

void liveAsFirstProcess(const std::function<int()>& program)
{
  mountAt("devtmpfs", "/dev");
  openConsole();
  mountAt("proc", "/proc");
  mountAt("sysfs", "/sys");
  mkdir("/tmp", 01777);
  loadModules();
  const pid_t child = fork();
  if (child == 0)
  {
    const int code = program();
    std::fflush(nullptr);
    _exit(code);
  }
  int status = 0;
  waitpid(child, &status, 0);
  std::printf("vm: tests ended with %d\n", WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status));
  std::fflush(nullptr);
  tcdrain(1);
  reboot(RB_POWER_OFF);
  for (;;)
  {
    pause();
  }
}

} // namespace trial
} // namespace pointhaptics
