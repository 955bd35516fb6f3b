/// @file
/// A rival: the proxy sphere of Ryden and Chizeck that moves in small steps among points.
/// F. Ryden, H. J. Chizeck: A proxy method for real-time 3-DOF haptic rendering of streaming point cloud
/// data, IEEE Transactions on Haptics 6(3), 2013.
#pragma once

#include "Benchmark/Touch/Methods/TouchMethod.h"

#include <cstdint>
#include <unordered_map>

namespace pointhaptics
{
namespace bench
{
namespace touch
{

/// Three radii about the proxy: entrenched where a point is within r1, in contact where one is within r2,
/// free otherwise; the points within r3 give the normal. A step of constant length goes out along the normal,
/// along the tangent plane, or straight to the HIP; a tick takes a bounded number of them. The points are the
/// occupied voxels' means. The force is that of the sphere's point nearest the HIP, so that the surface stays
/// where it is. Radii follow the voxel size: 3, 3.1 and 5 voxels; steps of 0.05.
class OccupancyProxy : public TouchMethod
{
public:
  explicit OccupancyProxy(double stiffness)
    : stiffness_(stiffness)
  {
  }
  void reset(const TouchScene& scene) override;
  ProxyState step(const Vec3& hip, double dt) override;

private:
  struct Surroundings
  {
    double nearest = 0.0; ///< Distance of the nearest point, at most r3.
    Vec3 normal;          ///< Mean direction from the points within r3; zero where there are none.
  };
  Surroundings look(const Vec3& center) const;
  void move(const Vec3& hip);

  double stiffness_;
  const void* scene_ = nullptr; ///< The one that the grid below is of.
  double voxel_ = 0.0;
  std::unordered_map<std::uint64_t, std::vector<Vec3>> grid_; ///< Buckets of edge r3.
  Vec3 center_;
  Vec3 normal_{ 0.0, 0.0, 1.0 };
  bool placed_ = false;
};

} // namespace touch
} // namespace bench
} // namespace pointhaptics
