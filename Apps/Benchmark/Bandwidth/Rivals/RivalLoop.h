/// @file
/// Common part of the loops over other libraries' searches: from neighbours to bandwidth and radius as
/// vtkKernelBandwidthFilter defines them, and the loop itself.
#pragma once

#include "Benchmark/Bandwidth/Rivals/Rival.h"

#include "Core/Base/Vector3.h"

#include <vtkSMPTools.h>
#include <vtkType.h>

#include <algorithm>
#include <cmath>

namespace pointhaptics::bench::bandwidth
{

/// The neighbourhood of one point, the point itself among it.
class NeighborhoodSums
{
public:
  /// @param offset from the point to the neighbour.
  void add(const Vec3& offset, double squaredDistance)
  {
    offsets_ += offset;
    squares_ += squaredDistance;
    farthest_ = std::max(farthest_, squaredDistance);
  }
  void write(int count, std::size_t i, BandwidthAnswer& answer) const
  {
    const double n = double(count);
    const double scatter = std::max(0.0, squares_ - norm2(offsets_) / n);
    const double s = std::sqrt(scatter / (n - 1.0) / 2.0);
    const double spacing = std::sqrt(farthest_ * 3.14159265358979323846 / (n - 1.0));
    answer.bandwidths[i] = 1.06 * s * std::pow(n, -0.2);
    answer.radii[i] = std::max(kRadiusScale * answer.bandwidths[i], kSmallestRadiusInSpacings * spacing);
  }

private:
  Vec3 offsets_;
  double squares_ = 0.0;
  double farthest_ = 0.0;
};

/// Calls piece(begin, end) over all points; @p piece has memory of its own.
template <typename Piece>
void loopOver(std::int64_t count, bool parallel, Piece&& piece)
{
  if (parallel)
  {
    vtkSMPTools::For(0, vtkIdType(count), [&](vtkIdType begin, vtkIdType end) { piece(begin, end); });
  }
  else
  {
    piece(0, vtkIdType(count));
  }
}

} // namespace pointhaptics::bench::bandwidth
