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
/// several means have takes the largest of theirs. Allocates 8 bytes a place where means repeat places, else
/// nothing. Any number of threads.
class NeighborCounts
{
public:
  /// @param counts in the order of the points, or empty: 1 each. Both are kept alive by the caller.
  NeighborCounts(const NeighborQuery& query, const std::vector<double>& counts)
    : query_(query)
    , counts_(counts)
  {
    if (!counts.empty() && query.finitePoints() > query.size())
    {
      places_.resize(std::size_t(query.size()));
      for (std::size_t slot = 0; slot < places_.size(); ++slot)
      {
        places_[slot] = atLeastOne(counts[std::size_t(query.index(std::int64_t(slot)))]);
      }
      query.visitRepeats(
        [&](std::int64_t repeated, std::int64_t slot)
        {
          double& place = places_[std::size_t(slot)];
          place = std::max(place, atLeastOne(counts[std::size_t(repeated)]));
        });
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
  double at(std::int64_t slot) const
  {
    return places_.empty() ? atLeastOne(counts_[std::size_t(query_.index(slot))])
                           : places_[std::size_t(slot)];
  }
  static double atLeastOne(double count) { return count > 1.0 ? count : 1.0; }
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

  const NeighborQuery& query_;
  const std::vector<double>& counts_;
  std::vector<double> places_; ///< By slot; empty where no mean repeats a place.
};

} // namespace pointhaptics
