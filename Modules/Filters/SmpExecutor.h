/// @file
/// Core's loops on VTK's threads.
#pragma once

#include "Core/Base/Executor.h"

#include "vtkSMPTools.h"

#include <algorithm>

namespace pointhaptics
{

/// Runs each range on vtkSMPTools, in pieces of the given grain or a 64th of the range.
class SmpExecutor : public Executor
{
public:
  int concurrency() const override { return vtkSMPTools::GetEstimatedNumberOfThreads(); }
  void run(std::int64_t count, std::int64_t grain, void* context, Body body) const override
  {
    if (count < 2 * grain || this->concurrency() == 1)
    {
      Executor::run(count, grain, context, body);
      return;
    }
    vtkSMPTools::For(0, vtkIdType(count), vtkIdType(std::max(grain, count / 64)),
      [&](vtkIdType begin, vtkIdType end) { body(context, begin, end); });
  }
};

} // namespace pointhaptics
