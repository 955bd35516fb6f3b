/// @file
/// How much memory a piece of work needs beyond what was there before: measured in a child process of its
/// own, as the kernel counts it.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace pointhaptics
{
namespace bench
{

struct PeakMemory
{
  std::int64_t peakBytes = 0; ///< Highest resident memory during the work, less that before it.
  std::int64_t keptBytes = 0; ///< Resident memory after the work, less that before it.
  std::int64_t result = 0;    ///< What the work returned.
  double seconds = 0.0;       ///< Of the work: the first call in a fresh process.
};

/// Forks, runs @p work once in the child, and reads the high-water mark of resident memory (VmHWM, reset by
/// /proc/self/clear_refs before the work). Pages are counted when touched, in whole pages, those of malloc's
/// free lists included, those of programs and libraries not; memory reserved but never
/// touched is not; the kernel is exact to some 0.3 MB. Call
/// it while this process has one thread: a forked child has no others, and a thread pool that was up would be
/// waited for in vain. False: it has more, or the system has no such counters, or the child ended early; @p
/// message says which.
bool measurePeakMemory(const std::function<std::int64_t()>& work, PeakMemory& result, std::string& message);

} // namespace bench
} // namespace pointhaptics
