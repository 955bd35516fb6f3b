/// @file
/// Durations counted into logarithmic bins: constant memory, no allocation, written by one thread, read by
/// any.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace pointhaptics
{

/// Bins grow by 2^(1/4) from 10 ns to 144 s. A quantile is the upper edge of the bin that holds it, at most
/// 19 % above the true value and never above the maximum; the maximum is exact. record() is wait-free, for
/// one writer; summary() may run in any thread beside it and sees every record that was finished before it
/// began.
class LatencyHistogram
{
public:
  /// Seconds; zeros before the first record.
  struct Summary
  {
    double p50 = 0.0;
    double p99 = 0.0;
    double p999 = 0.0;
    double maximum = 0.0;
    std::uint64_t count = 0;
  };

  /// @param seconds below 10 ns, negative and NaN count in the first bin; above 144 s in the last one.
  void record(double seconds) noexcept;
  Summary summary() const noexcept;
  /// Not beside record().
  void clear() noexcept;

private:
  static constexpr int kBins = 136;
  std::array<std::atomic<std::uint64_t>, kBins> counts_{};
  std::atomic<double> maximum_{ 0.0 };
};

} // namespace pointhaptics
