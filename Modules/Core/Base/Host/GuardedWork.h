/// @file
/// Frame of long work that a host asked for.
#pragma once

#include "Core/Base/Host/InterpreterLock.h"
#include "Core/Base/Host/OutOfMemory.h"
#include "Core/Base/Status.h"

#include <exception>
#include <utility>

namespace pointhaptics
{

/// Calls @p work without the interpreter's lock. @return OutOfMemory where memory ran out in it, else Ok.
/// Other exceptions pass.
template <typename Work>
Status guardedWork(Work&& work)
{
  const WithoutInterpreterLock unlocked;
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
