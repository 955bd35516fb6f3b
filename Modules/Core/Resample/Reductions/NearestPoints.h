/// @file
/// Finds in each voxel the point nearest to the mean, or to the voxel's centre.
#pragma once

#include "Core/Base/Buffer.h"
#include "Core/Base/Vector3.h"
#include "Core/Resample/Stages/VoxelWriter.h"
#include "Core/Resample/VoxelResampler.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace pointhaptics::simd
{

/// Compares the distances of quantized positions: see Representative.
class NearestPoints
{
public:
  /// @p request must outlive this. Offsets in voxels have @p fractionBits bits.
  NearestPoints(const VoxelRequest& request, int fractionBits);

  /// Forgets all points. @p voxels: have count(voxel) and sums(voxel).
  template <typename Voxels>
  void prepare(const Voxels& voxels)
  {
    size_ = voxels.size();
    nearest_.reserve(size_, Pages::Huge);
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
  /// Compares the points of a block, which has points[i], voxels[i] and offset(i), with others of their
  /// voxels.
  template <typename Block>
  void add(const Block& block)
  {
    Nearest* const nearest = nearest_.data(); // A copy, which no store can change.
    for (int i = 0; i < block.count; ++i)
    {
      Nearest& to = nearest[block.voxels[i]];
      const double square = squareOf(block.offset(i), to);
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
  double squareOf(const std::array<double, 3>& offset, const Nearest& to) const
  {
    const double x = (offset[0] * to.times - to.sums[0]) * scale_.x;
    const double y = (offset[1] * to.times - to.sums[1]) * scale_.y;
    const double z = (offset[2] * to.times - to.sums[2]) * scale_.z;
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

} // namespace pointhaptics::simd
