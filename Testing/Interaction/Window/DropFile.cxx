// DropFile WINDOW X Y FILE...: drops files on a place of an X window as a file manager does, by the XDND
// protocol, version 5. Exit code 0: the window took them; 1: it did not, the last line says what happened; 2:
// usage.
#include <X11/Xatom.h>
#include <X11/Xlib.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

namespace
{

constexpr long kVersion = 5;
constexpr double kPatienceSeconds = 15.0;

struct Drag
{
  Display* display;
  Window target;
  Window source;

  Atom atom(const char* name) const { return XInternAtom(this->display, name, False); }
  void tell(const char* message, long second, long third, long fourth, long fifth) const
  {
    XEvent event = {};
    event.xclient.type = ClientMessage;
    event.xclient.display = this->display;
    event.xclient.window = this->target;
    event.xclient.message_type = this->atom(message);
    event.xclient.format = 32;
    const long data[5] = { long(this->source), second, third, fourth, fifth };
    for (int i = 0; i < 5; ++i)
    {
      event.xclient.data.l[i] = data[i];
    }
    XSendEvent(this->display, this->target, False, NoEventMask, &event);
    XFlush(this->display);
  }
  /// The names of the files, for whoever asks for them.
  void answer(const XSelectionRequestEvent& request, const std::string& names) const
  {
    XChangeProperty(this->display, request.requestor, request.property, request.target, 8, PropModeReplace,
      reinterpret_cast<const unsigned char*>(names.data()), int(names.size()));
    XEvent event = {};
    event.xselection.type = SelectionNotify;
    event.xselection.display = this->display;
    event.xselection.requestor = request.requestor;
    event.xselection.selection = request.selection;
    event.xselection.target = request.target;
    event.xselection.property = request.property;
    event.xselection.time = request.time;
    XSendEvent(this->display, request.requestor, False, NoEventMask, &event);
    XFlush(this->display);
  }
  /// Answers requests until @p message comes. False: it never did.
  bool wait(const char* message, const std::string& names, XEvent& event) const
  {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(kPatienceSeconds);
    while (std::chrono::steady_clock::now() < end)
    {
      while (XPending(this->display) > 0)
      {
        XNextEvent(this->display, &event);
        if (event.type == SelectionRequest)
        {
          this->answer(event.xselectionrequest, names);
        }
        else if (event.type == ClientMessage && event.xclient.message_type == this->atom(message))
        {
          return true;
        }
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return false;
  }
};

int fail(const char* words)
{
  std::printf("%s\n", words);
  return 1;
}

} // namespace

int main(int argc, char** argv)
{
  if (argc < 5)
  {
    std::fprintf(stderr, "usage: DropFile WINDOW X Y FILE...\n");
    return 2;
  }
  Drag drag = { XOpenDisplay(nullptr), Window(std::strtoul(argv[1], nullptr, 0)), 0 };
  if (!drag.display)
  {
    return fail("no display");
  }
  const Window root = DefaultRootWindow(drag.display);
  drag.source = XCreateSimpleWindow(drag.display, root, 0, 0, 1, 1, 0, 0, 0);
  std::string names;
  for (int i = 4; i < argc; ++i)
  {
    names += "file://" + std::string(argv[i]) + "\r\n";
  }
  Atom type = None;
  int format = 0;
  unsigned long count = 0;
  unsigned long rest = 0;
  unsigned char* aware = nullptr;
  XGetWindowProperty(drag.display, drag.target, drag.atom("XdndAware"), 0, 1, False, XA_ATOM, &type, &format,
    &count, &rest, &aware);
  if (count != 1)
  {
    return fail("the window takes no drops (it has no XdndAware)");
  }
  XSetSelectionOwner(drag.display, drag.atom("XdndSelection"), drag.source, CurrentTime);
  int x = 0;
  int y = 0;
  Window child = 0;
  XTranslateCoordinates(
    drag.display, drag.target, root, std::atoi(argv[2]), std::atoi(argv[3]), &x, &y, &child);
  XEvent event;
  drag.tell("XdndEnter", kVersion << 24, long(drag.atom("text/uri-list")), None, None);
  drag.tell("XdndPosition", 0, (long(x) << 16) | y, CurrentTime, long(drag.atom("XdndActionCopy")));
  if (!drag.wait("XdndStatus", names, event))
  {
    return fail("the window does not answer");
  }
  if ((event.xclient.data.l[1] & 1) == 0)
  {
    return fail("the window does not want the files");
  }
  drag.tell("XdndDrop", 0, CurrentTime, 0, 0);
  if (!drag.wait("XdndFinished", names, event))
  {
    return fail("the window never finished");
  }
  std::printf("dropped\n");
  XCloseDisplay(drag.display);
  return 0;
}
