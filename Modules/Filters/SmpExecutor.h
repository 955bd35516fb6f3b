/// @file
/// Core's loops on VTK's threads.
#pragma once

#include "Core/Base/Executor.h"
#include "Core/Base/Host/OutOfMemory.h"

#include "vtkSMPTools.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <thread>

namespace pointhaptics
{

/// Runs each range on vtkSMPTools, in pieces of the given grain or a 64th of the range.
class SmpExecutor : public Executor
{
public:
  /// @param most threads, of those vtkSMPTools has; 0: all. vtkSMPTools::LocalScope would end and start its
  /// threads at each call, and VTK 9.1 counts no more than these for the rest of the program.
  explicit SmpExecutor(unsigned most = 0)
    // Made at each step of a hand: the system, which takes microseconds, is asked where it matters.
    : most_(most == 0 ? 0 : int(std::min(most, std::max(1u, std::thread::hardware_concurrency()))))
  {
  }
  int concurrency() const override { return most_ > 0 ? most_ : vtkSMPTools::GetEstimatedNumberOfThreads(); }
  void run(std::int64_t count, std::int64_t grain, void* context, Body body) const override
  {
    const int threads = this->concurrency();
    if (count < 2 * grain || threads == 1)
    {
      Executor::run(count, grain, context, body);
      return;
    }
    const std::int64_t piece = std::max(grain, count / 64);
    const auto work = [&](vtkIdType begin, vtkIdType end)
    {
      prepareForExceptions();
      body(context, begin, end);
    };
    if (most_ == 0)
    {
      vtkSMPTools::For(0, vtkIdType(count), vtkIdType(piece), work);
      return;
    }
    // One call a thread; each takes the next piece until none is left.
    std::atomic<std::int64_t> next{ 0 };
    vtkSMPTools::For(0, threads, 1,
      [&](vtkIdType, vtkIdType)
      {
        for (std::int64_t begin = next.fetch_add(piece); begin < count; begin = next.fetch_add(piece))
        {
          work(begin, std::min(begin + piece, count));
        }
      });
  }

private:
  int most_;
};

} // namespace pointhaptics
