/// @file
/// The median of about the last five numbers, as LASzip defines it (M. Isenburg, 2013): a predictor that one
/// outlier does not disturb.
#pragma once

#include <array>
#include <cstdint>

namespace pointhaptics::io
{

/// Five numbers in order; each new one pushes out the largest or the smallest, in turns that depend on where
/// it falls.
class StreamingMedian
{
public:
  std::int32_t get() const { return sorted_[2]; }
  void add(std::int32_t value)
  {
    if (dropsLargest_)
    {
      dropsLargest_ = value < sorted_[2];
      std::size_t at = 4;
      for (const std::size_t least = dropsLargest_ ? 0 : 3; at > least && value < sorted_[at - 1]; --at)
      {
        sorted_[at] = sorted_[at - 1];
      }
      sorted_[at] = value;
    }
    else
    {
      dropsLargest_ = !(sorted_[2] < value);
      std::size_t at = 0;
      for (const std::size_t most = dropsLargest_ ? 1 : 4; at < most && sorted_[at + 1] < value; ++at)
      {
        sorted_[at] = sorted_[at + 1];
      }
      sorted_[at] = value;
    }
  }

private:
  std::array<std::int32_t, 5> sorted_{};
  bool dropsLargest_ = true;
};

} // namespace pointhaptics::io
