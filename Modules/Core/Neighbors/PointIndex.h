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

#include <cstdint>
#include <vector>

namespace pointhaptics
{

/// A copy of the finite points of a cloud, sorted into bricks with bounds.
/// Memory: the coordinates again and 4 bytes a point (16 for floats). Immutable after build(); any number of
/// threads may read it.
class PointIndex
{
public:
  /// Most points of an index; for more it is not built.
  static constexpr std::int64_t kMostPoints = (std::int64_t(1) << 32) - 1;

  /// @return InvalidParameter for more than kMostPoints; Empty when no point is finite; Aborted where
  /// @p observer aborted the work: the index is then empty.
  Status build(const PointView& points, const Executor& executor = {}, ProgressObserver* observer = nullptr);

  /// Ranges of points() that hold every point which @p transform moves into @p lattice, and few others.
  std::vector<PointRange> rangesInside(
    const AffineTransform& transform, const Lattice& lattice, const Executor& executor = {}) const;

  /// The finite points, brick by brick.
  PointView points() const;
  /// The index in the cloud of each point of points().
  const std::uint32_t* originals() const { return originals_.data(); }
  std::int64_t cloudSize() const { return cloudSize_; }
  std::int64_t invalidPoints() const { return cloudSize_ - size_; }
  std::size_t bytes() const;

private:
  bool staysFinite(const AffineTransform& transform) const;
  // The steps of build(); false: aborted.
  Status sort(const PointView& points, const Executor& executor, PointProgress& progress);
  /// Turns the counts, slice after slice in @p places, into the place of each slice's first point of a cell.
  void assignPlaces(std::vector<std::uint32_t>& places, std::size_t cellCount);
  template <typename Real>
  bool fill(const PointView& points, const std::vector<std::uint32_t>& bricks,
    std::vector<std::uint32_t>& places, Buffer<Real>& copy, const Executor& executor,
    PointProgress& progress);
  bool bound(const Executor& executor, PointProgress& progress);

  std::int64_t cloudSize_ = 0;
  std::int64_t size_ = 0;
  bool single_ = false;
  Buffer<float> floats_;
  Buffer<double> doubles_;
  Buffer<std::uint32_t> originals_;
  /// Bounds: their middle and half their extent.
  struct Box
  {
    double middle[3];
    double half[3];
  };
  class BoxTest;
  void appendRanges(const BoxTest& test, std::size_t group, std::vector<PointRange>& ranges) const;

  // Begin of each brick with points (and an end), and its bounds.
  std::vector<std::int64_t> begins_;
  std::vector<Box> boxes_;
  std::vector<Box> groups_; ///< The bounds of so many bricks each that follow each other.
  double farthest_[3] = {}; ///< Largest absolute coordinates.
};

} // namespace pointhaptics
