/// @file
/// The clock of the interaction.
#pragma once

#include <chrono>

namespace pointhaptics
{

/// Seconds of a steady clock.
inline double steadySeconds()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

} // namespace pointhaptics
