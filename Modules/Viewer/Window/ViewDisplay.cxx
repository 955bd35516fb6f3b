#include "ViewDisplay.h"

#include <chrono>
#include <cstdlib>
#include <thread>

#if defined(__unix__) && !defined(__APPLE__)
#include <dlfcn.h>
#endif

namespace pointhaptics
{

#if defined(__unix__) && !defined(__APPLE__)
bool displayIsAvailable(std::string& message)
{
  const char* const cure = "run it on a desktop, under `xvfb-run`, or try `./setup.sh demo`";
  const char* name = std::getenv("DISPLAY");
  if (!name || !*name)
  {
    message = std::string("no display: the environment variable DISPLAY is not set; ") + cure;
    return false;
  }
  // VTK brings the library in; asking for it by name here saves a dependency of our own.
  void* library = dlopen("libX11.so.6", RTLD_LAZY | RTLD_LOCAL);
  using OpenDisplay = void* (*)(const char*);
  const auto openDisplay = library ? reinterpret_cast<OpenDisplay>(dlsym(library, "XOpenDisplay")) : nullptr;
  if (!openDisplay)
  {
    message = "no display: libX11.so.6 cannot be loaded; install libx11-6";
    return false;
  }
  // Kept until the program ends: a server whose last client goes may begin anew, as that of xvfb-run does,
  // and cuts the connection that VTK opens meanwhile.
  static void* display = nullptr;
  // Such a server refuses who comes while it begins anew: a moment later it does not.
  constexpr int kMostTries = 5;
  for (int i = 0; !display && i < kMostTries; ++i)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(i == 0 ? 0 : 50));
    display = openDisplay(nullptr);
  }
  if (!display)
  {
    message = std::string("no display: the X server \"") + name + "\" (DISPLAY) cannot be reached; " + cure;
    return false;
  }
  return true;
}
#else
bool displayIsAvailable(std::string& message)
{
  message.clear();
  return true;
}
#endif

} // namespace pointhaptics
