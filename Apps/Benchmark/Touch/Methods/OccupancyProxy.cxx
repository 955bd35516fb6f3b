#include "Benchmark/Touch/Methods/OccupancyProxy.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace bench
{
namespace touch
{
namespace
{

/// In voxels.
constexpr double kInner = 3.0;
constexpr double kContact = 3.1;
constexpr double kOuter = 5.0;
constexpr double kStep = 0.05;
constexpr int kMostSteps = 64;
constexpr double kVoxelsAtRest = 1e-3;

std::uint64_t bucketKey(std::int64_t x, std::int64_t y, std::int64_t z)
{
  constexpr std::int64_t kOffset = 1 << 20;
  return (std::uint64_t(x + kOffset) << 42) | (std::uint64_t(y + kOffset) << 21) | std::uint64_t(z + kOffset);
}

std::int64_t bucketOf(double coordinate, double edge)
{
  return std::int64_t(std::floor(coordinate / edge));
}

} // namespace

void OccupancyProxy::reset(const TouchScene& scene)
{
  placed_ = false;
  if (scene_ == scene.scene.get())
  {
    return;
  }
  scene_ = scene.scene.get();
  voxel_ = scene.scene->cellSize();
  grid_.clear();
  const double edge = kOuter * voxel_;
  for (const Cell& cell : scene.scene->pyramid().level(0).cells)
  {
    const Vec3& p = cell.mean;
    grid_[bucketKey(bucketOf(p.x, edge), bucketOf(p.y, edge), bucketOf(p.z, edge))].push_back(p);
  }
}

OccupancyProxy::Surroundings OccupancyProxy::look(const Vec3& center) const
{
  const double outer = kOuter * voxel_;
  Surroundings found;
  found.nearest = outer;
  for (std::int64_t x = bucketOf(center.x - outer, outer); x <= bucketOf(center.x + outer, outer); ++x)
  {
    for (std::int64_t y = bucketOf(center.y - outer, outer); y <= bucketOf(center.y + outer, outer); ++y)
    {
      for (std::int64_t z = bucketOf(center.z - outer, outer); z <= bucketOf(center.z + outer, outer); ++z)
      {
        const auto bucket = grid_.find(bucketKey(x, y, z));
        if (bucket == grid_.end())
        {
          continue;
        }
        for (const Vec3& p : bucket->second)
        {
          const Vec3 away = center - p;
          const double distance = norm(away);
          if (distance < outer && distance > 0.0)
          {
            found.nearest = std::min(found.nearest, distance);
            found.normal += away / distance;
          }
        }
      }
    }
  }
  return found;
}

/// One step: out of an entrenchment, along the tangent plane, or straight to the HIP.
void OccupancyProxy::move(const Vec3& hip)
{
  const Surroundings around = look(center_);
  const Vec3 pull = hip - center_;
  const double stride = kStep * voxel_;
  if (norm2(around.normal) > 0.0)
  {
    normal_ = normalized(around.normal, normal_);
  }
  if (around.nearest < kInner * voxel_)
  {
    center_ += stride * normal_;
    return;
  }
  const bool isFree = around.nearest >= kContact * voxel_ || dot(pull, normal_) > 0.0;
  const Vec3 way = isFree ? pull : pull - dot(pull, normal_) * normal_;
  const double free = around.nearest - kContact * voxel_;
  const double length = std::min(norm(way), isFree ? std::max(stride, free) : stride);
  center_ += length * normalized(way, Vec3());
}

ProxyState OccupancyProxy::step(const Vec3& hip, double)
{
  center_ = placed_ ? center_ : hip;
  placed_ = true;
  // A step in and the step out of it again are no motion: two steps are looked at together.
  for (int i = 0; i < kMostSteps; i += 2)
  {
    const Vec3 before = center_;
    move(hip);
    move(hip);
    if (norm(center_ - before) < kVoxelsAtRest * voxel_)
    {
      break;
    }
  }
  ProxyState state;
  state.hip = hip;
  state.proxy = hip;
  state.normal = normal_;
  state.sphereCenter = center_;
  state.radius = kInner * voxel_;
  const Vec3 out = center_ - hip;
  const double depth = norm(out) - state.radius;
  if (depth > 0.0)
  {
    state.contact = true;
    state.normal = normalized(out);
    state.proxy = hip + depth * state.normal;
    state.force = stiffness_ * depth * state.normal;
  }
  return state;
}

} // namespace touch
} // namespace bench
} // namespace pointhaptics
