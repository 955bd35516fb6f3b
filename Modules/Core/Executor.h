/// @file
/// The seam between Core's loops and whatever runs them in parallel (vtkSMPTools in the VTK filters).
#pragma once

#include <cstdint>
#include <type_traits>

namespace pointhaptics
{

/// Runs a loop body over [0, count). The base class runs it in the calling thread.
/// Core's results never depend on how the range is cut or in which order the pieces run.
class Executor
{
public:
  using Body = void (*)(void* context, std::int64_t begin, std::int64_t end);

  virtual ~Executor() = default;
  virtual void run(std::int64_t count, void* context, Body body) const
  {
    if (count > 0)
    {
      body(context, 0, count);
    }
  }
};

/// Calls function(begin, end) over pieces of [0, count) on @p executor.
template <typename Function>
void forRange(const Executor& executor, std::int64_t count, Function&& function)
{
  executor.run(count, &function,
    [](void* context, std::int64_t begin, std::int64_t end)
    { (*static_cast<std::remove_reference_t<Function>*>(context))(begin, end); });
}

} // namespace pointhaptics
