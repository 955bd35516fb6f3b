/// @file
/// The rival of the servo loop: a thread that keeps the same deadlines and does nothing at them. What it
/// misses, the machine took.
#pragma once

#include <atomic>
#include <cstdint>
#include <thread>

namespace pointhaptics::bench::servo
{

/// The last core of the machine is kept apart: threads that are started while this lives, by the thread that
/// made it, run on the others. Linux; elsewhere, and on a machine of one core, nothing happens.
class LastCoreApart
{
public:
  LastCoreApart();
  ~LastCoreApart();
  LastCoreApart(const LastCoreApart&) = delete;
  LastCoreApart& operator=(const LastCoreApart&) = delete;

private:
  bool apart_ = false;
};

/// Wakes early, spins and counts as the servo loop does, at its priority, on the last core, from construction
/// to stop().
class EmptyLoop
{
public:
  EmptyLoop(double rateHz, double wakeEarlySeconds);
  ~EmptyLoop();
  EmptyLoop(const EmptyLoop&) = delete;
  EmptyLoop& operator=(const EmptyLoop&) = delete;

  void stop();
  /// Deadlines already followed by the next one when the thread woke. After stop().
  std::uint64_t deadlineMisses() const { return missed_; }
  /// Seconds from a deadline to its answer. After stop().
  double largestJitter() const { return largest_; }

private:
  void run();

  const double period_; ///< Nanoseconds.
  const double early_;  ///< Nanoseconds.
  std::atomic<bool> done_{ false };
  std::uint64_t missed_ = 0;
  double largest_ = 0.0;
  std::thread thread_;
};

} // namespace pointhaptics::bench::servo
