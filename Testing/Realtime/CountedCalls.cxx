#include "CountedCalls.h"

#include <cerrno>
#include <cstddef>

#include <dlfcn.h>
#include <pthread.h>
#include <unistd.h>

namespace
{
thread_local int watches = 0;
thread_local long calls = 0;
thread_local const char* first = nullptr;

void note(const char* function)
{
  if (watches > 0)
  {
    first = first ? first : function;
    ++calls;
  }
}

template <typename Function>
Function next(const char* name)
{
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

/// Looked up before main, so that no look-up happens under a watch.
const auto realLock = next<int (*)(pthread_mutex_t*)>("pthread_mutex_lock");
const auto realWait = next<int (*)(pthread_cond_t*, pthread_mutex_t*)>("pthread_cond_wait");
const auto realWrite = next<ssize_t (*)(int, const void*, std::size_t)>("write");
}

namespace countedcalls
{
Watch::Watch()
{
  ++watches;
}
Watch::~Watch()
{
  --watches;
}
Pause::Pause()
  : watches_(watches)
{
  watches = 0;
}
Pause::~Pause()
{
  watches = watches_;
}
long count()
{
  return calls;
}
const char* firstFunction()
{
  return first;
}
}

// The program's own definitions come before the C library's, for every library it loads.
extern "C"
{
  void* __libc_malloc(std::size_t);
  void* __libc_calloc(std::size_t, std::size_t);
  void* __libc_realloc(void*, std::size_t);
  void* __libc_memalign(std::size_t, std::size_t);
  void __libc_free(void*);

  void* malloc(std::size_t size)
  {
    note("malloc");
    return __libc_malloc(size);
  }
  void* calloc(std::size_t number, std::size_t size)
  {
    note("calloc");
    return __libc_calloc(number, size);
  }
  void* realloc(void* memory, std::size_t size)
  {
    note("realloc");
    return __libc_realloc(memory, size);
  }
  void* aligned_alloc(std::size_t alignment, std::size_t size)
  {
    note("aligned_alloc");
    return __libc_memalign(alignment, size);
  }
  int posix_memalign(void** memory, std::size_t alignment, std::size_t size)
  {
    note("posix_memalign");
    *memory = __libc_memalign(alignment, size);
    return *memory ? 0 : ENOMEM;
  }
  void free(void* memory)
  {
    note("free");
    __libc_free(memory);
  }
  int pthread_mutex_lock(pthread_mutex_t* mutex)
  {
    note("pthread_mutex_lock");
    // Libraries loaded first may lock before this file's variables are set.
    const auto lock = realLock ? realLock : next<int (*)(pthread_mutex_t*)>("pthread_mutex_lock");
    return lock(mutex);
  }
  int pthread_cond_wait(pthread_cond_t* condition, pthread_mutex_t* mutex)
  {
    note("pthread_cond_wait");
    const auto wait =
      realWait ? realWait : next<int (*)(pthread_cond_t*, pthread_mutex_t*)>("pthread_cond_wait");
    return wait(condition, mutex);
  }
  ssize_t write(int file, const void* bytes, std::size_t size)
  {
    note("write");
    const auto out = realWrite ? realWrite : next<ssize_t (*)(int, const void*, std::size_t)>("write");
    return out(file, bytes, size);
  }
}
