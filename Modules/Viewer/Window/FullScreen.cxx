#include "FullScreen.h"

#ifdef POINTHAPTICS_USES_X

#include "XLibrary.h"

#include <vtkRenderWindow.h>

#include <X11/Xlib.h>

#include <algorithm>
#include <string>

namespace pointhaptics
{
namespace
{

constexpr long kMostAtoms = 64;

/// The window on its server. Nothing is open: no display.
struct Place
{
  Display* display = nullptr;
  Window window = 0;
  Window root = 0;

  explicit Place(vtkRenderWindow* vtkWindow)
    : window(reinterpret_cast<Window>(vtkWindow->GetGenericWindowId()))
  {
    if (window && !vtkWindow->GetOffScreenRendering() && xDisplayOf(vtkWindow))
    {
      display = static_cast<Display*>(xDisplayOf(vtkWindow));
      root = DefaultRootWindow(display);
    }
  }
  Atom atom(const char* name) const { return XInternAtom(display, name, False); }
};

/// True if the property @p name of @p owner has @p value; any value: 0.
bool hasValue(const Place& place, Window owner, const char* name, Atom value)
{
  Atom type = 0;
  int format = 0;
  unsigned long count = 0;
  unsigned long left = 0;
  unsigned char* data = nullptr;
  if (XGetWindowProperty(place.display, owner, place.atom(name), 0, kMostAtoms, False, AnyPropertyType, &type,
        &format, &count, &left, &data) != Success)
  {
    return false;
  }
  const auto* values = reinterpret_cast<const Atom*>(data);
  const bool has =
    format == 32 && count > 0 && (value == 0 || std::find(values, values + count, value) != values + count);
  if (data)
  {
    XFree(data);
  }
  return has;
}

/// True if a window manager offers full screens. Properties that a former one left on the root do not count:
/// it no longer owns its selection.
bool hasManager(const Place& place)
{
  const std::string selection = "WM_S" + std::to_string(DefaultScreen(place.display));
  return XGetSelectionOwner(place.display, place.atom(selection.c_str())) != None &&
    hasValue(place, place.root, "_NET_SUPPORTING_WM_CHECK", 0);
}

/// Gets x, y, width and height; those of the root are the screen's.
bool geometryOf(const Place& place, Window window, int geometry[4])
{
  XWindowAttributes attributes = {};
  const bool isKnown = XGetWindowAttributes(place.display, window, &attributes) != 0;
  geometry[0] = attributes.x;
  geometry[1] = attributes.y;
  geometry[2] = attributes.width;
  geometry[3] = attributes.height;
  return isKnown;
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
  XEvent message = {};
  message.xclient.type = ClientMessage;
  message.xclient.display = place.display;
  message.xclient.window = place.window;
  message.xclient.message_type = place.atom("_NET_WM_STATE");
  message.xclient.format = 32;
  message.xclient.data.l[0] = full ? 1 : 0;
  message.xclient.data.l[1] = static_cast<long>(place.atom("_NET_WM_STATE_FULLSCREEN"));
  message.xclient.data.l[3] = 1; // a normal program asks
  XSendEvent(place.display, place.root, False, SubstructureRedirectMask | SubstructureNotifyMask, &message);
  XFlush(place.display);
  return true;
}

bool FullScreen::setByHand(bool full)
{
  const Place place(window_);
  int wanted[4];
  std::copy(place_, place_ + 4, wanted);
  const bool isKnown =
    !full || (geometryOf(place, place.window, place_) && geometryOf(place, place.root, wanted));
  if (!isKnown || wanted[2] <= 0 || wanted[3] <= 0)
  {
    return false;
  }
  XMoveResizeWindow(place.display, place.window, wanted[0], wanted[1], static_cast<unsigned int>(wanted[2]),
    static_cast<unsigned int>(wanted[3]));
  XRaiseWindow(place.display, place.window);
  XFlush(place.display);
  return true;
}

} // namespace pointhaptics

#else

bool pointhaptics::FullScreen::isFull() const
{
  return false;
}

bool pointhaptics::FullScreen::set(bool)
{
  return false;
}

#endif
