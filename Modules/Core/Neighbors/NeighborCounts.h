/// @file
/// Number of points that the voxel means of a neighbourhood represent.
#pragma once

#include "Core/Neighbors/NeighborSweep.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace pointhaptics
{

/// Cap on a count, as a multiple of the mean count of the nearest neighbours.
constexpr double kLargestCountJump = 4.0;

/// Counts of the means that a NeighborQuery was built on. What is below 1 or NaN counts as 1; a place that
/// several means have takes the largest of theirs. 8 bytes a place. Any number of threads.
class NeighborCounts
{
public:
  /// @param counts in the order of the points, or empty: 1 each.
  NeighborCounts(const NeighborQuery& query, const std::vector<double>& counts)
  {
    if (!counts.empty())
    {
      counts_ = query.valuesOfPlaces([&](std::int64_t index)
        { return counts[std::size_t(index)] > 1.0 ? counts[std::size_t(index)] : 1.0; },
        [](double a, double b) { return std::max(a, b); });
    }
  }
  bool empty() const { return counts_.empty(); }

  /// The points of a whole neighbourhood; exact where all counts are 1.
  double sum(const NeighborList& list) const
  {
    double result = 0.0;
    for (int i = 0; i < list.count; ++i)
    {
      result += at(list.slots[i]);
    }
    return result;
  }

  /// Points of a voxel near the first of @p list: the mean with weights 1 - (d / d_k)^2, d_k the distance of
  /// the last, no count taken for more than kLargestCountJump times the mean with the fourth power of these
  /// weights. 1, without rounding, where all counts are 1. NaN where all are at one position.
  double mean(const NeighborList& list) const
  {
    return weightedMean(list, kLargestCountJump * weightedMean(list, INFINITY, true), false);
  }

private:
  double at(std::int64_t slot) const { return counts_[std::size_t(slot)]; }
  double weightedMean(const NeighborList& list, double largest, bool narrow) const
  {
    const double reach = list.squaredDistances[list.count - 1];
    double sum = 0.0;
    double weights = 0.0;
    for (int i = 0; i < list.count; ++i)
    {
      const double w = 1.0 - list.squaredDistances[i] / reach;
      const double weight = narrow ? (w * w) * (w * w) : w;
      sum += weight * std::min(at(list.slots[i]), largest);
      weights += weight;
    }
    return sum / weights;
  }

  std::vector<double> counts_; ///< By slot.
};

} // namespace pointhaptics
