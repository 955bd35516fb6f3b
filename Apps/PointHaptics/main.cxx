/// The program pointhaptics: loads the library of its commands. Were that linked, each name of the libraries
/// of the view would be looked up in the program's 60 first, which takes 3 ms of a start.
#include "Terminal/LargePages.h"

#include <cstdio>
#include <cstring>

#include <dlfcn.h>

int main(int argc, char* argv[])
{
  if (argc > 1 && std::strcmp(argv[1], "view") == 0)
  {
    pointhaptics::app::beginWithLargePages(argv);
  }
  void* const library = dlopen(POINTHAPTICS_PROGRAM_LIBRARY, RTLD_LAZY);
  void* const run = library ? dlsym(library, "runPointHaptics") : nullptr;
  if (!run)
  {
    const char* const why = dlerror();
    const bool isShort = std::strstr(why, "failed to map") || std::strstr(why, "annot allocate memory");
    if (isShort)
    {
      std::fprintf(stderr, "pointhaptics %s: memory is short: %s\n", argc > 1 ? argv[1] : "", why);
      return 1;
    }
    std::fprintf(stderr, "pointhaptics: %s; install the program again\n", why);
    return 1;
  }
  return reinterpret_cast<int (*)(int, char**)>(run)(argc, argv);
}
