/// @file
/// Core's loops on VTK's threads.
#pragma once

#include "Core/Executor.h"

#include "vtkSMPTools.h"

#include <algorithm>

namespace pointhaptics
{

/// Runs each range on vtkSMPTools, in pieces of at least a thousand.
class SmpExecutor : public Executor
{
public:
  void run(std::int64_t count, void* context, Body body) const override
  {
    if (count < 2 * kSmallestPiece)
    {
      Executor::run(count, context, body);
      return;
    }
    const std::int64_t grain = std::max<std::int64_t>(kSmallestPiece, count / 64);
    vtkSMPTools::For(0, vtkIdType(count), vtkIdType(grain),
      [&](vtkIdType begin, vtkIdType end) { body(context, begin, end); });
  }

private:
  static constexpr std::int64_t kSmallestPiece = 1024;
};

} // namespace pointhaptics
