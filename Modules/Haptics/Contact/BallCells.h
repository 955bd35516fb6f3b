/// @file
/// The cloud's points near the proxy's ball, gathered once and used while the ball stays near.
#pragma once

#include "Core/Surface/FitKernel.h"
#include "Haptics/ContactField.h"

#include <cstdint>

namespace pointhaptics
{

/// Points near a center, each with the radius by which it keeps the ball away. Every quantity has an array of
/// its own; lengths are metres of the lattice frame, coordinates relative to the center. A scale of the
/// radii, 0 to 1, stands for a smaller ball. 140 kB, plain state, one thread. No member function allocates or
/// throws.
class BallCells
{
public:
  static constexpr int kCapacity = 2048;

  /// @param wanted the instructions to use, as far as this machine has them; the results are the same.
  explicit BallCells(InstructionSet wanted = InstructionSet::Automatic)
    : kernels_(&simd::fitKernels(wanted))
  {
  }

  /// Drops all points. Call it before a pyramid at an address that another one had.
  void invalidate() noexcept { pyramid_ = nullptr; }

  /// Gathers all points nearer to @p center than their radius plus @p way, so that a ball there can go by @p
  /// way metres. Where these are more than kCapacity, it takes one point of each finest voxel, or means of
  /// coarser voxels, whose edge is at most half of @p ball. False: points are left out. @param ball typical
  /// radius there, metres.
  bool gather(const ContactField& field, const Vec3& center, double way, double ball) noexcept;

  /// Announces that the next queries are within @p way of @p center. The answers are the same, and cost less
  /// where more points were gathered.
  void focus(const Vec3& center, double way) noexcept;

  /// Longest way from @p p, metres, for which the gathered points are valid: all points, or their
  /// representatives where isComplete() is false. Below 0: none.
  double reachAbout(const Vec3& p) const noexcept { return reach_ - norm(p - center_); }

  /// Number of visits of the pyramid so far, which is what costs time.
  int passes() const noexcept { return passes_; }
  /// Number of points of the pyramid that were looked at so far.
  std::uint64_t pointsExamined() const noexcept { return pointsExamined_; }

  int size() const noexcept { return size_; }
  Vec3 point(int i) const noexcept { return center_ + Vec3(x_[i], y_[i], z_[i]); }

  /// The radius of point @p i.
  double radius(int i) const noexcept { return radius_[i]; }

  /// The point that a ball at @p p with radii scaled by @p scale is deepest in; -1: it covers none.
  int deepest(const Vec3& p, double scale) const noexcept;
  /// The largest scale, at most 1, with which a ball at @p p covers no point.
  double roomAt(const Vec3& p) const noexcept;

  /// Length that a ball at @p from can go along the unit vector @p direction before it would cover a point:
  /// exact, 0 to @p length. A point that it covers already, or that it leaves, counts only if the ball goes
  /// deeper. @pre all points for a way of @p length are here.
  double sweep(const Vec3& from, const Vec3& direction, double length, double scale) const noexcept;

  /// Calls visit(offset from the point to @p p, its radius times @p scale) for the points nearer than that.
  template <typename Visitor>
  void visitTouched(const Vec3& p, double scale, Visitor&& visit) const noexcept
  {
    const Vec3 local = p - center_;
    int indices[kCapacity];
    const Part part = partAbout(p, 0.0);
    const int count = kernels_->ballsWithin(points(part), local, scale, 0.0, indices, kCapacity);
    for (int k = 0; k < count; ++k)
    {
      const int i = part.first + indices[k];
      visit(Vec3(local.x - x_[i], local.y - y_[i], local.z - z_[i]), scale * radius_[i]);
    }
  }

  /// Calls visit(offset from the point to @p p, squared distance) for the points nearer to @p p than @p
  /// radius.
  template <typename Visitor>
  void visitBall(const Vec3& p, double radius, Visitor&& visit) const noexcept
  {
    const Vec3 local = p - center_;
    int indices[kCapacity];
    const Part part = partAbout(p, radius);
    const int count = kernels_->pointsWithin(points(part), local, radius * radius, indices, kCapacity);
    for (int k = 0; k < count; ++k)
    {
      const int i = part.first + indices[k];
      const Vec3 offset(local.x - x_[i], local.y - y_[i], local.z - z_[i]);
      visit(offset, norm2(offset));
    }
  }

private:
  /// The points near the focus stand behind all others.
  static constexpr int kNear = kCapacity + simd::kFitLanes;
  struct Part
  {
    int first;
    int size;
  };

  bool servesNear(const Vec3& p, double radius) const noexcept
  {
    const double left = nearReach_ - radius;
    return left >= 0.0 && norm2(p - nearCenter_) <= left * left;
  }
  /// The smaller of the two parts that holds all points within @p radius of @p p.
  Part partAbout(const Vec3& p, double radius) const noexcept
  {
    return servesNear(p, radius) ? Part{ kNear, nearSize_ } : Part{ 0, size_ };
  }
  simd::BallPoints points(const Part& part) const noexcept
  {
    return { x_ + part.first, y_ + part.first, z_ + part.first, radius_ + part.first,
      (part.size + simd::kFitLanes - 1) / simd::kFitLanes * simd::kFitLanes };
  }
  void pad(int end) noexcept;
  template <typename IndexAt>
  bool add(const ContactField& field, int level, std::uint32_t count, const IndexAt& indexAt) noexcept;
  bool shrink() noexcept;
  bool gatherFrom(const ContactField& field, int level, bool onePerVoxel) noexcept;
  /// The reach for a way of @p way metres and a margin over way plus typical radius.
  double reachOf(double way, double margin) const noexcept { return way + margin * (way + typicalRadius_); }

  alignas(64) double x_[2 * kNear];
  alignas(64) double y_[2 * kNear];
  alignas(64) double z_[2 * kNear];
  alignas(64) double radius_[2 * kNear];
  int size_ = 0;
  int nearSize_ = 0;
  Vec3 nearCenter_;
  double nearReach_ = -1.0;
  Vec3 center_;
  double reach_ = 0.0;
  std::size_t margin_ = 0; ///< Which of the margins, from large to small, reach_ has.
  bool complete_ = true;   ///< All points of the cloud, not some or means of them.
  double requestedWay_ = 0.0;
  double typicalRadius_ = 0.0;
  int passes_ = 0;
  std::uint64_t pointsExamined_ = 0;
  const simd::FitKernels* kernels_;
  const CellPyramid* pyramid_ = nullptr;
};

} // namespace pointhaptics
