#include "Core/Base/Host/OutOfMemory.h"

#include <cerrno>
#include <cstring>
#include <new>
#include <stdexcept>
#include <system_error>

namespace pointhaptics
{

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
