#include "FullScreen.h"

#include "XLibrary.h"

#include <vtkRenderWindow.h>

#include <algorithm>
#include <cstdint>
#include <string>

namespace pointhaptics
{
namespace
{

using XId = unsigned long; // Window and Atom
constexpr int kClientMessage = 33;
constexpr long kSubstructureMasks = (1L << 20) | (1L << 19); // redirect, notify
constexpr XId kAnyType = 0;
constexpr long kMostAtoms = 64;

/// Xlib's XClientMessageEvent, in an XEvent.
union ClientMessage
{
  struct
  {
    int type;
    unsigned long serial;
    int sendEvent;
    void* display;
    XId window;
    XId messageType;
    int format;
    long data[5];
  } event;
  long room[24];
};

/// The window on its server. Nothing is open: no display.
struct Place
{
  void* display = nullptr;
  XId window = 0;
  XId root = 0;

  explicit Place(vtkRenderWindow* vtkWindow)
  {
    const auto rootOf = xFunction<XId (*)(void*)>("XDefaultRootWindow");
    void* found = vtkWindow->GetOffScreenRendering() ? nullptr : xDisplayOf(vtkWindow);
    window = found ? static_cast<XId>(reinterpret_cast<std::uintptr_t>(vtkWindow->GetGenericWindowId())) : 0;
    if (found && window && rootOf)
    {
      display = found;
      root = rootOf(display);
    }
  }
  XId atom(const char* name) const
  {
    const auto intern = xFunction<XId (*)(void*, const char*, int)>("XInternAtom");
    return intern ? intern(display, name, 0) : 0;
  }
};

/// True if the property @p name of @p owner has @p value; any value: 0.
bool hasValue(const Place& place, XId owner, const char* name, XId value)
{
  const auto get = xFunction<int (*)(void*, XId, XId, long, long, int, XId, XId*, int*, unsigned long*,
    unsigned long*, unsigned char**)>("XGetWindowProperty");
  const auto release = xFunction<int (*)(void*)>("XFree");
  XId type = 0;
  int format = 0;
  unsigned long count = 0;
  unsigned long left = 0;
  unsigned char* data = nullptr;
  if (!get || !release ||
    get(place.display, owner, place.atom(name), 0, kMostAtoms, 0, kAnyType, &type, &format, &count, &left,
      &data) != 0)
  {
    return false;
  }
  const auto* values = reinterpret_cast<const XId*>(data);
  const bool has =
    format == 32 && count > 0 && (value == 0 || std::find(values, values + count, value) != values + count);
  if (data)
  {
    release(data);
  }
  return has;
}

/// True if a window manager offers full screens. Properties that a former one left on the root do not count:
/// it no longer owns its selection.
bool hasManager(const Place& place)
{
  const auto ownerOf = xFunction<XId (*)(void*, XId)>("XGetSelectionOwner");
  const auto screenOf = xFunction<int (*)(void*)>("XDefaultScreen");
  return ownerOf && screenOf &&
    ownerOf(place.display, place.atom(("WM_S" + std::to_string(screenOf(place.display))).c_str())) != 0 &&
    hasValue(place, place.root, "_NET_SUPPORTING_WM_CHECK", 0);
}

/// Gets x, y, width and height; those of the root are the screen's.
bool geometryOf(const Place& place, XId window, int geometry[4])
{
  const auto get = xFunction<int (*)(void*, XId, XId*, int*, int*, unsigned int*, unsigned int*,
    unsigned int*, unsigned int*)>("XGetGeometry");
  XId root = 0;
  unsigned int size[4] = { 0, 0, 0, 0 }; // width, height, border, depth
  const bool isKnown = get &&
    get(place.display, window, &root, &geometry[0], &geometry[1], &size[0], &size[1], &size[2], &size[3]);
  geometry[2] = static_cast<int>(size[0]);
  geometry[3] = static_cast<int>(size[1]);
  return isKnown;
}

void flush(const Place& place)
{
  if (const auto send = xFunction<int (*)(void*)>("XFlush"))
  {
    send(place.display);
  }
}

} // namespace

bool FullScreen::isFull() const
{
  const Place place(window_);
  if (!place.display)
  {
    return false;
  }
  if (hasManager(place))
  {
    return hasValue(place, place.window, "_NET_WM_STATE", place.atom("_NET_WM_STATE_FULLSCREEN"));
  }
  int here[4];
  int screen[4];
  return geometryOf(place, place.window, here) && geometryOf(place, place.root, screen) &&
    std::equal(here, here + 4, screen);
}

bool FullScreen::set(bool full)
{
  const Place place(window_);
  if (!place.display)
  {
    return false;
  }
  if (!hasManager(place))
  {
    return this->setByHand(full);
  }
  const auto send = xFunction<int (*)(void*, XId, int, long, void*)>("XSendEvent");
  if (!send)
  {
    return false;
  }
  ClientMessage message = {};
  message.event.type = kClientMessage;
  message.event.display = place.display;
  message.event.window = place.window;
  message.event.messageType = place.atom("_NET_WM_STATE");
  message.event.format = 32;
  message.event.data[0] = full ? 1 : 0;
  message.event.data[1] = static_cast<long>(place.atom("_NET_WM_STATE_FULLSCREEN"));
  message.event.data[3] = 1; // a normal program asks
  send(place.display, place.root, 0, kSubstructureMasks, &message);
  flush(place);
  return true;
}

bool FullScreen::setByHand(bool full)
{
  const Place place(window_);
  const auto move = xFunction<int (*)(void*, XId, int, int, unsigned int, unsigned int)>("XMoveResizeWindow");
  const auto raise = xFunction<int (*)(void*, XId)>("XRaiseWindow");
  int wanted[4];
  std::copy(place_, place_ + 4, wanted);
  const bool isKnown =
    !full || (geometryOf(place, place.window, place_) && geometryOf(place, place.root, wanted));
  if (!move || !raise || !isKnown || wanted[2] <= 0 || wanted[3] <= 0)
  {
    return false;
  }
  move(place.display, place.window, wanted[0], wanted[1], static_cast<unsigned int>(wanted[2]),
    static_cast<unsigned int>(wanted[3]));
  raise(place.display, place.window);
  flush(place);
  return true;
}

} // namespace pointhaptics
