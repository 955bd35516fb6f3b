#include "XLibrary.h"

#include "vtkRenderWindow.h"

#include <cstdint>

#if defined(__unix__) && !defined(__APPLE__)
#include <dlfcn.h>
#endif

namespace pointhaptics
{

void* findXFunction(const char* name)
{
#if defined(__unix__) && !defined(__APPLE__)
  static void* const library = dlopen("libX11.so.6", RTLD_LAZY | RTLD_LOCAL);
  return library ? dlsym(library, name) : nullptr;
#else
  static_cast<void>(name);
  return nullptr;
#endif
}

void* xDisplayOf(vtkRenderWindow* window)
{
  return window->IsA("vtkXOpenGLRenderWindow") ? window->GetGenericDisplayId() : nullptr;
}

void movePointer(vtkRenderWindow* window, int x, int y)
{
  void* display = window->GetOffScreenRendering() ? nullptr : xDisplayOf(window);
  if (!display)
  {
    window->SetCursorPosition(x, y);
    return;
  }
  using WarpPointer =
    int (*)(void*, unsigned long, unsigned long, int, int, unsigned int, unsigned int, int, int);
  const auto warp = xFunction<WarpPointer>("XWarpPointer");
  const auto flush = xFunction<int (*)(void*)>("XFlush");
  const auto place =
    static_cast<unsigned long>(reinterpret_cast<std::uintptr_t>(window->GetGenericWindowId()));
  if (warp && flush && place)
  {
    warp(display, 0, place, 0, 0, 0, 0, x, window->GetSize()[1] - 1 - y);
    flush(display);
  }
}

} // namespace pointhaptics
