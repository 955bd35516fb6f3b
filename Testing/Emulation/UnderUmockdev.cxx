#include "UnderUmockdev.h"

#include <cstdio>
#include <cstdlib>
#include <string>

#include <dlfcn.h>
#include <sys/prctl.h>
#include <unistd.h>

namespace pointhaptics
{
namespace trial
{
namespace
{
constexpr const char* kPreload = "libumockdev-preload.so.0";
constexpr const char* kMark = "POINTHAPTICS_TEST_PRELOADED";
}

bool underUmockdev()
{
  const char* const preload = std::getenv("LD_PRELOAD");
  return preload && std::string(preload).find(kPreload) != std::string::npos;
}

bool startUnderUmockdev(char* argv[])
{
  if (!underUmockdev())
  {
    if (std::getenv(kMark))
    {
      std::fprintf(stderr, "umockdev's library cannot be loaded first\n");
      return false;
    }
    setenv(kMark, "1", 1);
    // A sanitizer wants to be the very first.
    void* const sanitizer = dlopen("libasan.so.8", RTLD_NOLOAD | RTLD_LAZY);
    setenv("LD_PRELOAD", sanitizer ? (std::string("libasan.so.8:") + kPreload).c_str() : kPreload, 1);
    execv("/proc/self/exe", argv);
    std::perror("execv");
    return false;
  }
  prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
  return true;
}

} // namespace trial
} // namespace pointhaptics
