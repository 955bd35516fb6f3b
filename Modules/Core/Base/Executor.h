/// @file
/// The interface between Core's loops and what runs them in parallel (vtkSMPTools in the VTK filters).
#pragma once

#include <atomic>
#include <cstddef>
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
  /// Largest number of bodies that run concurrently.
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

/// Least elements of a piece where each is a few arithmetic operations.
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

/// Calls visit(i) for all i below @p count.
template <typename Visit>
void forEachIndex(const Executor& executor, std::int64_t count, Visit&& visit)
{
  forRange(executor, count,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t i = begin; i < end; ++i)
      {
        visit(i);
      }
    });
}

/// Calls work(item, own) for all items below @p count: each thread takes the next one, and has begin(number)
/// as its own. No two threads at a time have the same number, which is below the concurrency.
template <typename Begin, typename Work>
void forEachItemWith(const Executor& executor, std::size_t count, Begin&& begin, Work&& work)
{
  std::atomic<std::size_t> next{ 0 };
  forRange(executor, executor.concurrency(), 1,
    [&](std::int64_t number, std::int64_t)
    {
      auto&& own = begin(std::size_t(number));
      for (std::size_t item = next++; item < count; item = next++)
      {
        work(item, own);
      }
    });
}
/// Calls work(item, scratch) for each item, with a Scratch that each thread makes.
template <typename Scratch, typename Work>
void forEachItem(const Executor& executor, std::size_t count, Work&& work)
{
  forEachItemWith(
    executor, count, [](std::size_t) { return Scratch(); }, std::forward<Work>(work));
}
/// Calls work(item) for each item.
template <typename Work>
void forEachItem(const Executor& executor, std::size_t count, Work&& work)
{
  struct None
  {
  };
  forEachItem<None>(executor, count, [&](std::size_t item, None&) { work(item); });
}

} // namespace pointhaptics
