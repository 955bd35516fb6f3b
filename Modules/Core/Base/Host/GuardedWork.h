/// @file
/// Frame of long work that a host asked for.
#pragma once

#include "Core/Base/Host/InterpreterLock.h"
#include "Core/Base/Host/OutOfMemory.h"
#include "Core/Base/Status.h"

#include <cstddef>
#include <exception>
#include <functional>
#include <new>
#include <utility>

namespace pointhaptics
{

/// Address space that long work begins with at least: VTK ends the process where an object finds no memory in
/// its constructor, and TBB's first allocation waits for ever.
constexpr std::size_t kRoomOfWork = std::size_t(16) << 20;

/// @throws std::bad_alloc where long work would have less.
inline void requireRoomOfWork()
{
  prepareForExceptions();
  if (!hasAddressSpace(kRoomOfWork))
  {
    throw std::bad_alloc();
  }
}

/// Calls @p work without the interpreter's lock, at whose end @p stop ends the work. @return OutOfMemory
/// where memory ran out in it, else Ok. Other exceptions pass.
template <typename Work>
Status guardedWork(Work&& work, std::function<void()> stop = {})
{
  const WithoutInterpreterLock unlocked(std::move(stop));
  try
  {
    requireRoomOfWork();
    std::forward<Work>(work)();
    return Status::Ok;
  }
  catch (const std::exception& error)
  {
    if (!isOutOfMemory(error))
    {
      throw;
    }
    return Status::OutOfMemory;
  }
}

} // namespace pointhaptics
