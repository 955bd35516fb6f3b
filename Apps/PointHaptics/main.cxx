/// The program pointhaptics: loads the library of its commands. Were that linked, each name of the libraries
/// of the view would be looked up in the program's 60 first, which takes 3 ms of a start.
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <dlfcn.h>
#include <unistd.h>

#ifdef __GLIBC__
#include <sys/auxv.h>
#endif

int main(int argc, char* argv[])
{
#ifdef __GLIBC__
  // Memory for a picture comes in large pages, where the system has them, from one heap that is used again:
  // a tenth of the page faults, a quarter of the processor time. malloc reads this when a program begins, so
  // this one begins again. ViewScene::returnMemory() gives back what is free.
  if (argc > 1 && std::strcmp(argv[1], "view") == 0 && !std::getenv("GLIBC_TUNABLES") &&
    ::getauxval(AT_SECURE) == 0)
  {
    ::setenv("GLIBC_TUNABLES",
      "glibc.malloc.hugetlb=1:glibc.malloc.arena_max=1:glibc.malloc.mmap_threshold=67108864"
      ":glibc.malloc.trim_threshold=1073741824",
      0);
    ::execv(reinterpret_cast<const char*>(::getauxval(AT_EXECFN)), argv);
  }
#endif
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
