#include "Haptics/Servo/LatencyHistogram.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace
{
constexpr double kSmallestSeconds = 1e-8;
constexpr double kBinsPerOctave = 4.0;

double upperEdge(int bin) noexcept
{
  return kSmallestSeconds * std::exp2(double(bin) / kBinsPerOctave);
}
}

void LatencyHistogram::record(double seconds) noexcept
{
  int bin = 0;
  if (seconds > kSmallestSeconds)
  {
    const double position = std::ceil(kBinsPerOctave * std::log2(seconds / kSmallestSeconds));
    bin = int(std::min(position, double(kBins - 1)));
  }
  // One writer: a load and a store are enough, no locked instruction is needed.
  std::atomic<std::uint64_t>& count = counts_[std::size_t(bin)];
  count.store(count.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  if (seconds > maximum_.load(std::memory_order_relaxed))
  {
    maximum_.store(seconds, std::memory_order_relaxed);
  }
}

LatencyHistogram::Summary LatencyHistogram::summary() const noexcept
{
  std::array<std::uint64_t, kBins> counts;
  Summary result;
  for (int bin = 0; bin < kBins; ++bin)
  {
    counts[std::size_t(bin)] = counts_[std::size_t(bin)].load(std::memory_order_relaxed);
    result.count += counts[std::size_t(bin)];
  }
  result.maximum = maximum_.load(std::memory_order_relaxed);
  const auto quantile = [&](double fraction)
  {
    const double rank = std::max(1.0, std::ceil(fraction * double(result.count)));
    std::uint64_t below = 0;
    for (int bin = 0; bin < kBins; ++bin)
    {
      below += counts[std::size_t(bin)];
      if (double(below) >= rank)
      {
        // The last bin has no upper edge: everything longer is in it.
        return bin == kBins - 1 ? result.maximum : std::min(upperEdge(bin), result.maximum);
      }
    }
    return 0.0;
  };
  result.p50 = quantile(0.5);
  result.p99 = quantile(0.99);
  result.p999 = quantile(0.999);
  return result;
}

void LatencyHistogram::clear() noexcept
{
  for (std::atomic<std::uint64_t>& count : counts_)
  {
    count.store(0, std::memory_order_relaxed);
  }
  maximum_.store(0.0, std::memory_order_relaxed);
}

} // namespace pointhaptics
