// Loaded into the program by LD_PRELOAD: the file that HELD_FILE names is read no further until the file that
// HELD_UNTIL names exists. So a small file takes as long as a test wants, on every machine.
#include <dlfcn.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string>

namespace
{

constexpr useconds_t kLookPeriod = 5000; // microseconds

bool endsWith(const std::string& text, const std::string& end)
{
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

bool isHeld(std::FILE* stream)
{
  const char* held = std::getenv("HELD_FILE");
  if (!held)
  {
    return false;
  }
  const std::string link = "/proc/self/fd/" + std::to_string(fileno(stream));
  char target[4096];
  const ssize_t size = readlink(link.c_str(), target, sizeof(target));
  return size > 0 && endsWith(std::string(target, std::size_t(size)), std::string("/") + held);
}

void waitUntilReleased(std::FILE* stream)
{
  const char* release = std::getenv("HELD_UNTIL");
  while (release && isHeld(stream) && access(release, F_OK) != 0)
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

extern "C" std::size_t fread(void* to, std::size_t size, std::size_t count, std::FILE* stream)
{
  static const auto real = next<std::size_t (*)(void*, std::size_t, std::size_t, std::FILE*)>("fread");
  waitUntilReleased(stream);
  return real(to, size, count, stream);
}

/// Called in place of fread() by a build with _FORTIFY_SOURCE.
extern "C" std::size_t __fread_chk(
  void* to, std::size_t room, std::size_t size, std::size_t count, std::FILE* stream)
{
  using Read = std::size_t (*)(void*, std::size_t, std::size_t, std::size_t, std::FILE*);
  static const auto real = next<Read>("__fread_chk");
  waitUntilReleased(stream);
  return real(to, room, size, count, stream);
}
