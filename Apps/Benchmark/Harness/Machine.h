/// @file
/// The machine a figure was measured on, as far as the figure depends on it. No names of hosts or users.
#pragma once

#include "Benchmark/Harness/Run.h"

#include <cstdint>
#include <functional>

namespace pointhaptics::bench
{

Json thisMachine();

/// The highest resident memory during @p work beyond that before it, bytes; pages count when they are
/// touched. Below 0: the kernel has no counters. Call it before anything large was freed: what malloc keeps
/// may hide.
std::int64_t peakBytesOf(const std::function<void()>& work);

} // namespace pointhaptics::bench
