/// The program pointhaptics: loads the library of its commands. Were that linked, each name of the libraries
/// of the view would be looked up in the program's 60 first, which takes 3 ms of a start.
#include <cstdio>

#include <dlfcn.h>

int main(int argc, char* argv[])
{
  void* const library = dlopen(POINTHAPTICS_PROGRAM_LIBRARY, RTLD_LAZY);
  void* const run = library ? dlsym(library, "runPointHaptics") : nullptr;
  if (!run)
  {
    std::fprintf(stderr, "pointhaptics: %s; install the program again\n", dlerror());
    return 1;
  }
  return reinterpret_cast<int (*)(int, char**)>(run)(argc, argv);
}
