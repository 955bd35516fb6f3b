/// @file
/// The cloud's points near the proxy's ball, gathered once and used while the ball stays near.
#pragma once

#include "Core/Surface/CellPyramid.h"
#include "Core/Surface/FitKernel.h"

#include <cstdint>

namespace pointhaptics
{

/// Points near a center, each coordinate in an array of its own; all lengths in metres of the lattice frame,
/// coordinates relative to the center. 12 kB, plain state, one thread. No member function allocates or
/// throws.
class BallCells
{
public:
  static constexpr int kCapacity = 512;

  /// @param wanted the instructions to use, as far as this machine has them; the results are the same.
  explicit BallCells(InstructionSet wanted = InstructionSet::Automatic)
    : kernels_(&simd::fitKernels(wanted))
  {
  }

  /// Everything gathered is dropped. Must be called before a pyramid at an address used before.
  void invalidate() noexcept { pyramid_ = nullptr; }

  /// Makes sure that all points within @p radius of @p center are here. Where there are more than kCapacity,
  /// one point of each finest voxel, or means of coarser voxels, of at most @p coarsest metres. False: points
  /// are left out.
  bool gather(const CellPyramid& pyramid, const Vec3& center, double radius, double coarsest) noexcept;

  /// Whether all points of @p pyramid within @p radius of @p p are here.
  bool holds(const CellPyramid& pyramid, const Vec3& p, double radius) const noexcept
  {
    return pyramid_ == &pyramid && complete_ && norm(p - center_) + radius <= reach_;
  }

  /// How often the pyramid was visited so far: what costs time.
  int passes() const noexcept { return passes_; }

  int size() const noexcept { return size_; }
  Vec3 point(int i) const noexcept { return center_ + Vec3(x_[i], y_[i], z_[i]); }

  /// The point nearest to @p p; -1: there is none. @p distance2 receives the squared distance.
  int nearest(const Vec3& p, double& distance2) const noexcept;

  /// The same among those nearer than @p radius.
  int nearestWithin(const Vec3& p, double radius) const noexcept;

  /// How far a ball of @p radius at @p from can go along the unit vector @p direction before it would cover a
  /// point: exact, 0 to @p length. Points that it covers already, or that it leaves, do not count unless it
  /// goes deeper. @pre all points within radius + length of @p from are here.
  double sweep(const Vec3& from, const Vec3& direction, double length, double radius) const noexcept;

  /// Calls visit(offset from the point to @p p, squared distance) for the points nearer to @p p than @p
  /// radius.
  template <typename Visitor>
  void visitBall(const Vec3& p, double radius, Visitor&& visit) const noexcept
  {
    const Vec3 local = p - center_;
    int indices[kCapacity];
    const int count = kernels_->pointsWithin(points(), local, radius * radius, indices, kCapacity);
    for (int k = 0; k < count; ++k)
    {
      const int i = indices[k];
      const Vec3 offset(local.x - x_[i], local.y - y_[i], local.z - z_[i]);
      visit(offset, norm2(offset));
    }
  }

private:
  simd::BallPoints points() const noexcept
  {
    return { x_, y_, z_, (size_ + simd::kFitLanes - 1) / simd::kFitLanes * simd::kFitLanes };
  }
  bool add(const Vec3& p) noexcept;
  bool gatherFrom(const CellPyramid& pyramid, int level, bool onePerVoxel) noexcept;

  alignas(64) double x_[kCapacity + 8];
  alignas(64) double y_[kCapacity + 8];
  alignas(64) double z_[kCapacity + 8];
  int size_ = 0;
  Vec3 center_;
  double reach_ = 0.0;
  bool complete_ = true; ///< All points of the cloud, not some or means of them.
  double askedRadius_ = 0.0;
  int passes_ = 0;
  const simd::FitKernels* kernels_;
  const CellPyramid* pyramid_ = nullptr;
};

} // namespace pointhaptics
