/// @file
/// Memory in large pages for a program that fills much of it at once.
#pragma once

#include <cstdlib>

#ifdef __GLIBC__
#include <sys/auxv.h>
#include <unistd.h>
#endif

namespace pointhaptics::app
{

/// Memory for a picture or a scene comes in large pages, where the system has them, from one heap that is
/// used again: a tenth of the page faults, a quarter of the processor time. malloc reads this when a program
/// begins, so this one begins again. ViewScene::returnMemory() gives back what is free. Where GLIBC_TUNABLES
/// is set, or the C library is another, nothing is done.
inline void beginWithLargePages([[maybe_unused]] char* argv[])
{
#ifdef __GLIBC__
  if (!std::getenv("GLIBC_TUNABLES") && ::getauxval(AT_SECURE) == 0)
  {
    ::setenv("GLIBC_TUNABLES",
      "glibc.malloc.hugetlb=1:glibc.malloc.arena_max=1:glibc.malloc.mmap_threshold=67108864"
      ":glibc.malloc.trim_threshold=1073741824",
      0);
    ::execv(reinterpret_cast<const char*>(::getauxval(AT_EXECFN)), argv);
  }
#endif
}

} // namespace pointhaptics::app
