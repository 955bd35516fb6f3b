#include "ViewDisplay.h"

#include "Core/Base/Host/OutOfMemory.h"
#include "Core/Base/Status.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <thread>

#ifdef POINTHAPTICS_USES_X
#include <X11/Xlib.h>
#undef Status
#endif

namespace pointhaptics
{
namespace
{

///@{
/// Bytes of address space that Mesa's drivers, their compiler and their threads take; they crash without.
constexpr std::size_t kRoomOfDriver = std::size_t(768) << 20;
constexpr std::size_t kRoomOfCore = std::size_t(96) << 20;
constexpr std::size_t kRoomOfPoint = 100;
///@}

/// True where there is room to draw @p points. The driver keeps the room that it once had.
bool hasRoomFor(std::int64_t points)
{
  static std::int64_t most = -1;
  const std::size_t driver = most < 0 ? kRoomOfDriver + kRoomOfCore * std::thread::hardware_concurrency() : 0;
  const std::int64_t more = points - std::max<std::int64_t>(most, 0);
  const bool hasRoom = points <= most || hasAddressSpace(driver + kRoomOfPoint * std::size_t(more) + 1);
  most = hasRoom ? std::max(most, points) : most;
  return hasRoom;
}

#ifdef POINTHAPTICS_USES_X
/// Connection that is kept until the program ends. A server whose last client goes may reset, as that of
/// xvfb-run does, and cut the connection that VTK opens meanwhile.
Display* keptDisplay = nullptr;
#endif

} // namespace

bool displayIsAvailable(std::string& message, std::int64_t points)
{
  if (!hasRoomFor(points))
  {
    message = pointhaptics::message(Status::OutOfMemory);
    return false;
  }
#ifdef POINTHAPTICS_USES_X
  const char* const cure = "run it on a desktop, under `xvfb-run`, or try `./setup.sh demo`";
  const char* name = std::getenv("DISPLAY");
  if (!name || !*name)
  {
    message = std::string("no display: the environment variable DISPLAY is not set; ") + cure;
    return false;
  }
  // A server that resets refuses connections for a moment.
  constexpr int kMostTries = 5;
  for (int i = 0; !keptDisplay && i < kMostTries; ++i)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(i == 0 ? 0 : 50));
    keptDisplay = XOpenDisplay(nullptr);
  }
  if (!keptDisplay)
  {
    message = std::string("no display: the X server \"") + name + "\" (DISPLAY) cannot be reached; " + cure;
    return false;
  }
#endif
  return true;
}

std::array<int, 2> screenSize()
{
#ifdef POINTHAPTICS_USES_X
  if (keptDisplay)
  {
    const int screen = DefaultScreen(keptDisplay);
    return { DisplayWidth(keptDisplay, screen), DisplayHeight(keptDisplay, screen) };
  }
#endif
  return {};
}

} // namespace pointhaptics
