#include "MousePointer.h"

#include "XLibrary.h"

#include "vtkRenderWindow.h"

#include <cstdint>

namespace pointhaptics
{

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
