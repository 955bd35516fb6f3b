#include "XLibrary.h"

#include "vtkRenderWindow.h"

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

} // namespace pointhaptics
