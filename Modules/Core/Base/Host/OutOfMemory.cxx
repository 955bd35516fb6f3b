#include "Core/Base/Host/OutOfMemory.h"

#include <cerrno>
#include <cstring>
#include <mutex>
#include <new>
#include <stdexcept>
#include <system_error>

#include <cxxabi.h>
#include <pthread.h>
#include <sys/mman.h>

namespace pointhaptics
{
namespace
{

/// A page for each of the allocations that a thread's first look at variables of its own makes.
constexpr std::size_t kReserve = 64 * 4096;

/// Address space without memory; MAP_FAILED: there is none.
void* reserved(std::size_t bytes) noexcept
{
  return ::mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
}

/// Address space that is given up while a thread takes its variables.
class Reserve
{
public:
  Reserve() noexcept
    : hasKey_(::pthread_key_create(&key_, nullptr) == 0)
  {
  }
  void prepare() noexcept
  {
    if (!hasKey_ || ::pthread_getspecific(key_))
    {
      return;
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    if (space_ != MAP_FAILED)
    {
      ::munmap(space_, kReserve);
    }
    const void* volatile variables = abi::__cxa_get_globals(); // it is declared to have no effect
    static_cast<void>(variables);
    space_ = reserved(kReserve);
    static_cast<void>(::pthread_setspecific(key_, this));
  }

private:
  std::mutex mutex_;
  ::pthread_key_t key_{};
  void* space_ = reserved(kReserve);
  bool hasKey_;
};

Reserve theReserve; // while the library is loaded

} // namespace

bool hasAddressSpace(std::size_t bytes) noexcept
{
  void* space = reserved(bytes);
  return space != MAP_FAILED && ::munmap(space, bytes) == 0;
}

void prepareForExceptions() noexcept
{
  theReserve.prepare();
}

bool isOutOfMemory(const std::exception& error) noexcept
{
  if (const auto* problem = dynamic_cast<const std::system_error*>(&error))
  {
    return problem->code().value() == EAGAIN || problem->code().value() == ENOMEM;
  }
  // Intel's TBB, on which vtkSMPTools stands, has no type for a thread that cannot be started.
  return dynamic_cast<const std::bad_alloc*>(&error) || dynamic_cast<const std::length_error*>(&error) ||
    std::strstr(error.what(), "pthread_create");
}

} // namespace pointhaptics
