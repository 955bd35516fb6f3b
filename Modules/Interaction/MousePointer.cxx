#include "MousePointer.h"

#include "vtkRenderWindow.h"

#if defined(__unix__) && !defined(__APPLE__)
#include <dlfcn.h>
#endif

namespace pointhaptics
{

#if defined(__unix__) && !defined(__APPLE__)
void movePointer(vtkRenderWindow* window, int x, int y)
{
  if (!window->IsA("vtkXOpenGLRenderWindow") || window->GetOffScreenRendering())
  {
    window->SetCursorPosition(x, y);
    return;
  }
  // VTK has the library in the process; asking for it by name saves a dependency of our own.
  void* library = dlopen("libX11.so.6", RTLD_LAZY | RTLD_LOCAL);
  using WarpPointer =
    int (*)(void*, unsigned long, unsigned long, int, int, unsigned int, unsigned int, int, int);
  using Flush = int (*)(void*);
  const auto warp = library ? reinterpret_cast<WarpPointer>(dlsym(library, "XWarpPointer")) : nullptr;
  const auto flush = library ? reinterpret_cast<Flush>(dlsym(library, "XFlush")) : nullptr;
  void* display = window->GetGenericDisplayId();
  const auto place = reinterpret_cast<unsigned long>(window->GetGenericWindowId());
  if (warp && flush && display && place)
  {
    warp(display, 0, place, 0, 0, 0, 0, x, window->GetSize()[1] - 1 - y);
    flush(display);
  }
}
#else
void movePointer(vtkRenderWindow* window, int x, int y)
{
  window->SetCursorPosition(x, y);
}
#endif

} // namespace pointhaptics
