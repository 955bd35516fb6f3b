/// @file
/// The seam between Core's loops and whatever runs them in parallel (vtkSMPTools in the VTK filters).
#pragma once

#include <cstdint>
#include <type_traits>
#include <utility>

namespace pointhaptics
{

/// Runs a loop body over [0, count). The base class runs it in the calling thread.
/// Core's results never depend on how the range is cut or in which order the pieces run.
class Executor
{
public:
  using Body = void (*)(void* context, std::int64_t begin, std::int64_t end);

  virtual ~Executor() = default;
  /// Most bodies that run at once.
  virtual int concurrency() const { return 1; }
  /// Pieces have at least @p grain elements where there are as many; the body is not called for none.
  virtual void run(std::int64_t count, std::int64_t grain, void* context, Body body) const
  {
    static_cast<void>(grain);
    if (count > 0)
    {
      body(context, 0, count);
    }
  }
};

/// Elements of a loop worth a piece of their own where each is a few arithmetic operations.
constexpr std::int64_t kSmallestPiece = 1024;

/// Calls function(begin, end) over pieces of [0, count) on @p executor.
template <typename Function>
void forRange(const Executor& executor, std::int64_t count, std::int64_t grain, Function&& function)
{
  executor.run(count, grain, &function,
    [](void* context, std::int64_t begin, std::int64_t end)
    { (*static_cast<std::remove_reference_t<Function>*>(context))(begin, end); });
}
template <typename Function>
void forRange(const Executor& executor, std::int64_t count, Function&& function)
{
  forRange(executor, count, kSmallestPiece, std::forward<Function>(function));
}

} // namespace pointhaptics
