// CloseWindow WINDOW: closes an X window as the close button of a window manager does. One that listens for
// WM_DELETE_WINDOW is asked; of another the connection is cut, which ends its program. Exit code 0: it was
// asked; 1: its connection was cut; 2: usage, or there is no display.
#include <X11/Xlib.h>

#include <algorithm>
#include <cstdio>

namespace
{

bool listensForDelete(Display* display, Window window, Atom deleteWindow)
{
  Atom* protocols = nullptr;
  int count = 0;
  if (XGetWMProtocols(display, window, &protocols, &count) == 0)
  {
    return false;
  }
  const bool listens = std::find(protocols, protocols + count, deleteWindow) != protocols + count;
  XFree(protocols);
  return listens;
}

} // namespace

int main(int argc, char** argv)
{
  Display* display = argc == 2 ? XOpenDisplay(nullptr) : nullptr;
  if (!display)
  {
    std::fprintf(stderr, "usage: CloseWindow WINDOW, with a display\n");
    return 2;
  }
  const Window window = std::strtoul(argv[1], nullptr, 0);
  const Atom deleteWindow = XInternAtom(display, "WM_DELETE_WINDOW", False);
  const bool asks = listensForDelete(display, window, deleteWindow);
  if (asks)
  {
    XEvent event = {};
    event.xclient.type = ClientMessage;
    event.xclient.window = window;
    event.xclient.message_type = XInternAtom(display, "WM_PROTOCOLS", False);
    event.xclient.format = 32;
    event.xclient.data.l[0] = long(deleteWindow);
    event.xclient.data.l[1] = CurrentTime;
    XSendEvent(display, window, False, NoEventMask, &event);
  }
  else
  {
    XKillClient(display, window);
  }
  XSync(display, False);
  XCloseDisplay(display);
  return asks ? 0 : 1;
}
