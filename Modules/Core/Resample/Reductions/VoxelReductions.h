/// @file
/// Results of the points of voxels beside their sums.
#pragma once

#include "Core/Base/Buffer.h"
#include "Core/Base/Vector3.h"
#include "Core/Resample/AttributeView.h"
#include "Core/Resample/Kernel/VoxelKernel.h"
#include "Core/Resample/Stages/BinnedVoxels.h"
#include "Core/Resample/Stages/VoxelTally.h"
#include "Core/Resample/Stages/VoxelWriter.h"
#include "Core/Resample/VoxelResampler.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace pointhaptics::simd
{

/// Keeps the tuples of the points of each voxel, and finds the mode or the median of each component. Of
/// floating-point numbers all NaNs are one value, the largest, and both zeros are one, which is written as
/// +0; nothing depends on the order of the points.
///
/// Memory: the tuples themselves, and 8 bytes a voxel.
class AttributeTuples
{
public:
  /// Drops all tuples and makes room for those of voxels with @p counts points. @pre the statistic of the
  /// array is Mode or Median.
  void prepare(const AccumulatedArray& kind, const std::vector<std::int64_t>& counts);
  /// Adds tuple numbers[i] to voxels[i].
  void add(const Tuples& tuples, const std::int64_t* numbers, const std::uint32_t* voxels, int count);
  /// @pre each voxel has as many tuples as it was said to get.
  TallyValues tally() const;
  void write(const Kernels& kernels, void* to) const;

private:
  /// Calls visit(keys, count) for each component of each voxel. @pre all tuples have been added.
  template <typename Key, typename Visit>
  void forLists(const Visit& visit) const
  {
    for (std::size_t v = 0; v < ends_.size(); ++v)
    {
      const std::int64_t begin = v == 0 ? 0 : ends_[v - 1];
      for (std::size_t c = 0; c < std::size_t(kind_.components); ++c)
      {
        visit(reinterpret_cast<Key*>(keys_.data() + c * componentBytes_) + begin, ends_[v] - begin);
      }
    }
  }

  AccumulatedArray kind_;
  Buffer<char> keys_; ///< Of the values; those of a component together, and of these those of a voxel.
  std::size_t componentBytes_ = 0;
  std::vector<std::int64_t> ends_; ///< Where the next tuple of each voxel goes.
};

/// Compares the distances of quantized positions: see Representative.
class NearestPoints
{
public:
  /// @p request must outlive this. Offsets in voxels have @p fractionBits bits.
  NearestPoints(const VoxelRequest& request, int fractionBits);

  /// Forgets all points.
  void prepare(const BinnedVoxels& voxels)
  {
    size_ = voxels.size();
    nearest_.reserve(size_);
    for (std::size_t v = 0; v < size_; ++v)
    {
      const std::int64_t count = toMean_ ? voxels.count(v) : 1;
      // Two points are equally near to their mean: the one with the smaller x is chosen.
      const bool byX = count == 2;
      const std::array<double, 3> sums = byX ? std::array<double, 3>{}
        : toMean_                            ? voxels.sums(v)
                                             : std::array<double, 3>{ middle_, middle_, middle_ };
      nearest_[v] = { sums, double(count), byX ? 0.0 : 1.0, INFINITY, -1 };
    }
  }
  /// Compares the points of a block, which has their offsets, with others of their voxels.
  void add(const PointBlock& block)
  {
    Nearest* const nearest = nearest_.data(); // A copy, which no store can change.
    for (int i = 0; i < block.count; ++i)
    {
      Nearest& to = nearest[block.voxels[i]];
      const double square = squareOf(block.offsets[i], to);
      if (__builtin_expect(square == to.least, false))
      {
        to.point = goesBefore(block.points[i], to.point) ? block.points[i] : to.point;
      }
      // Without branches, which would be unpredictable.
      const std::int64_t isLess = -std::int64_t(square < to.least);
      to.point ^= (to.point ^ block.points[i]) & isLess;
      to.least = square < to.least ? square : to.least;
    }
  }
  /// Replaces the means of the voxels from @p first on in @p writer by the nearest points, and writes the
  /// numbers of these.
  void write(VoxelWriter& writer, std::size_t first) const;

private:
  struct alignas(64) Nearest
  {
    std::array<double, 3> sums; ///< So many times the target, in quanta from the voxel's lower corner.
    double times;
    double yz;          ///< 0: distances are by x alone; else 1.
    double least;       ///< The square of the least distance so far, times as often.
    std::int64_t point; ///< That has it.
  };

  /// Always the same operations: where two distances are equal, or which is less, depends on the points
  /// alone. Not by the quotient of the sums: distances of few digits are exact.
  double squareOf(const std::array<std::uint64_t, 3>& offset, const Nearest& to) const
  {
    const double x = (double(std::int64_t(offset[0])) * to.times - to.sums[0]) * scale_.x;
    const double y = (double(std::int64_t(offset[1])) * to.times - to.sums[1]) * scale_.y;
    const double z = (double(std::int64_t(offset[2])) * to.times - to.sums[2]) * scale_.z;
    return x * x + to.yz * (y * y + z * z);
  }
  Vec3 placeOf(std::int64_t point) const;
  bool goesBefore(std::int64_t a, std::int64_t b) const;

  const VoxelRequest* request_;
  bool toMean_;
  bool isIdentity_;
  double middle_; ///< Middle of a voxel.
  Vec3 scale_;    ///< Edges of a voxel by the longest.
  std::size_t size_ = 0;
  Buffer<Nearest> nearest_;
};

/// Columns that turn normals: the products of a normal's components with these are added.
std::array<Vec3, 3> normalColumns(const AffineTransform& transform);

/// Reduces the points of the voxels of one partition at a time, in one visit: their arrays, the point that
/// stands for each, and where each point went. For one thread at a time.
class VoxelReductions
{
public:
  /// @p request must outlive this. @p arrays: its attributes, and what else is reduced like them; their
  /// ranges are known. @p voxelIndex: of each point; null unless asked for.
  VoxelReductions(const VoxelRequest& request, const std::vector<AttributeRequest>& arrays,
    const PayloadLayout& payloads, int fractionBits, std::int64_t* voxelIndex);

  /// @p voxels: summed; @p first of all voxels there is their first.
  void reduce(const BinnedVoxels& voxels, std::size_t first);
  /// Writes what became of the voxels, whose counts are there, from @p first on in @p writer.
  void write(VoxelWriter& writer, std::size_t first) const;
  /// Takes the tallies of the arrays in the voxels, one for each array.
  std::vector<VoxelTally> takeTallies();

private:
  struct Array
  {
    AttributeView view;
    AccumulatedArray kind;
    AttributeRange range;
    TallySums sums;
    AttributeTuples tuples; ///< Where they are not summed.
  };
  void addTuples(const PointBlock& block);

  PayloadLayout payloads_;
  std::int64_t* voxelIndex_;
  const Kernels& kernels_;
  std::array<Vec3, 3> columns_;
  std::vector<Array> arrays_;
  std::optional<NearestPoints> nearest_;
  std::vector<std::int64_t> counts_; ///< Number of points of each voxel.
};

} // namespace pointhaptics::simd
