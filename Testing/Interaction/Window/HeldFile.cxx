// Loaded into the program by LD_PRELOAD: the file that HELD_FILE names is read no further until the file that
// HELD_UNTIL names exists. So a small file takes as long as a test wants, on every machine.
#include <dlfcn.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

namespace
{

constexpr useconds_t kLookPeriod = 5000; // microseconds

bool endsWith(const std::string& text, const std::string& end)
{
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

bool isHeld(int file)
{
  const char* held = std::getenv("HELD_FILE");
  if (!held)
  {
    return false;
  }
  const std::string link = "/proc/self/fd/" + std::to_string(file);
  char target[4096];
  const ssize_t size = readlink(link.c_str(), target, sizeof(target));
  return size > 0 && endsWith(std::string(target, std::size_t(size)), std::string("/") + held);
}

void waitUntilReleased(int file)
{
  const char* release = std::getenv("HELD_UNTIL");
  while (release && isHeld(file) && access(release, F_OK) != 0)
  {
    usleep(kLookPeriod);
  }
}

template <typename Function>
Function next(const char* name)
{
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

} // namespace

extern "C" ssize_t read(int file, void* to, std::size_t size)
{
  static const auto real = next<ssize_t (*)(int, void*, std::size_t)>("read");
  waitUntilReleased(file);
  return real(file, to, size);
}
