/// @file
/// Waiting for another thread in a test.
#pragma once

#include <chrono>
#include <functional>
#include <thread>

namespace pointhaptics
{
namespace trial
{

/// Waits for a condition, not for a time: a busy machine only makes the test slower. @return false where it
/// does not come within @p seconds.
inline bool eventually(const std::function<bool()>& condition, double seconds = 60.0)
{
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!condition())
  {
    if (std::chrono::steady_clock::now() > end)
    {
      return false;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

} // namespace trial
} // namespace pointhaptics
