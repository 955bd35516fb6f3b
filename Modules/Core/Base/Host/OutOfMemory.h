/// @file
/// Tells exceptions that memory ran out from others.
#pragma once

#include <cstddef>
#include <exception>

namespace pointhaptics
{

/// vtkErrorCode::UserError + ENOMEM: the error code of filters, readers and writers that ran out of memory.
constexpr unsigned long kOutOfMemoryCode = 40000 + 12;

/// True for std::bad_alloc, for lengths that no memory holds, and for threads that cannot be started: all of
/// them are message(Status::OutOfMemory).
bool isOutOfMemory(const std::exception& error) noexcept;

/// True where the process may have so much more address space. Asked before libraries that crash without it.
bool hasAddressSpace(std::size_t bytes) noexcept;

/// To be called by a thread before what may throw. The C++ library takes the variables of a thread's first
/// exception from the heap and ends the process where there is no memory for them; here they are taken, from
/// address space that is kept for it. Costs nothing the second time.
void prepareForExceptions() noexcept;

} // namespace pointhaptics
