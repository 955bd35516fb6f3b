/// @file
/// Frame of long work that a host asked for.
#pragma once

#include "Core/Base/Host/InterpreterLock.h"
#include "Core/Base/Host/OutOfMemory.h"
#include "Core/Base/Status.h"

#include <cstddef>
#include <exception>
#include <functional>
#include <utility>

namespace pointhaptics
{

/// Address space that long work begins with at least: VTK ends the process where an object finds no memory in
/// its constructor.
constexpr std::size_t kRoomOfWork = std::size_t(16) << 20;

/// Calls @p work without the interpreter's lock, at whose end @p stop ends the work. @return OutOfMemory
/// where memory ran out in it, else Ok. Other exceptions pass.
template <typename Work>
Status guardedWork(Work&& work, std::function<void()> stop = {})
{
  prepareForExceptions();
  if (!hasAddressSpace(kRoomOfWork))
  {
    return Status::OutOfMemory;
  }
  const WithoutInterpreterLock unlocked(std::move(stop));
  try
  {
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
