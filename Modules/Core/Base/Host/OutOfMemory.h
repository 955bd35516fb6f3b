/// @file
/// Tells exceptions that memory ran out from others.
#pragma once

#include <exception>

namespace pointhaptics
{

/// vtkErrorCode::UserError + ENOMEM: the error code of filters, readers and writers that ran out of memory.
constexpr unsigned long kOutOfMemoryCode = 40000 + 12;

/// True for std::bad_alloc, for lengths that no memory holds, and for threads that cannot be started: all of
/// them are message(Status::OutOfMemory).
bool isOutOfMemory(const std::exception& error) noexcept;

} // namespace pointhaptics
