/// @file
/// A spatial index of a cloud, built once: a view of a part then costs in proportion to the part.
#pragma once

#include "Core/Base/AffineTransform.h"
#include "Core/Base/Buffer.h"
#include "Core/Base/Executor.h"
#include "Core/Base/Lattice.h"
#include "Core/Base/PointBlocks.h"
#include "Core/Base/PointView.h"
#include "Core/Base/ProgressObserver.h"
#include "Core/Base/Status.h"
#include "Core/Neighbors/SpatialOrder.h"

#include <cstdint>
#include <vector>

namespace pointhaptics
{

/// A copy of the finite points of a cloud in spatial order, in bricks with bounds.
/// Memory: the coordinates again and 4 bytes a point (16 for floats). Immutable after build(); any number of
/// threads may read it.
class PointIndex
{
public:
  /// Most points of an index; for more it is not built.
  static constexpr std::int64_t kMostPoints = kMostOrderedPoints;

  /// @return InvalidParameter for more than kMostPoints; Empty when no point is finite; Aborted where
  /// @p observer aborted the work: the index is then empty.
  Status build(const PointView& points, const Executor& executor = {}, ProgressObserver* observer = nullptr);

  /// Ranges of points() that hold every point which @p transform moves into @p lattice, and few others.
  std::vector<PointRange> rangesInside(
    const AffineTransform& transform, const Lattice& lattice, const Executor& executor = {}) const;

  /// The finite points in the order of SpatialOrder.h.
  PointView points() const;
  /// The index in the cloud of each point of points().
  const std::uint32_t* originals() const { return originals_.data(); }
  std::int64_t cloudSize() const { return cloudSize_; }
  std::int64_t invalidPoints() const { return cloudSize_ - size_; }

private:
  bool staysFinite(const AffineTransform& transform) const;
  /// Copies the points and bounds the bricks. @return false: aborted.
  template <typename Real>
  bool fill(const PointView& points, Buffer<Real>& copy, const Executor& executor, PointProgress& progress);
  /// Points of a brick.
  PointRange pointsOf(std::size_t brick) const;

  std::int64_t cloudSize_ = 0;
  std::int64_t size_ = 0;
  bool single_ = false;
  Buffer<float> floats_;
  Buffer<double> doubles_;
  std::vector<std::uint32_t> originals_;
  std::vector<Bounds> bricks_;
  double farthest_[3] = {}; ///< Largest absolute coordinates.
};

} // namespace pointhaptics
