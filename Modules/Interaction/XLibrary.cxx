#include "XLibrary.h"

#include "vtkRenderWindow.h"

#ifdef POINTHAPTICS_USES_X
#include <X11/Xlib.h>
#endif

namespace pointhaptics
{

void* xDisplayOf(vtkRenderWindow* window)
{
  return window->IsA("vtkXOpenGLRenderWindow") ? window->GetGenericDisplayId() : nullptr;
}

const char* desktopResources([[maybe_unused]] vtkRenderWindow* window)
{
#ifdef POINTHAPTICS_USES_X
  if (auto* display = static_cast<Display*>(xDisplayOf(window)))
  {
    return XResourceManagerString(display);
  }
#endif
  return nullptr;
}

void movePointer(vtkRenderWindow* window, int x, int y)
{
#ifdef POINTHAPTICS_USES_X
  auto* display = static_cast<Display*>(xDisplayOf(window));
  const auto place = reinterpret_cast<Window>(window->GetGenericWindowId());
  if (display && place && !window->GetOffScreenRendering())
  {
    XWarpPointer(display, None, place, 0, 0, 0, 0, x, window->GetSize()[1] - 1 - y);
    XFlush(display);
    return;
  }
#endif
  window->SetCursorPosition(x, y);
}

} // namespace pointhaptics
