#include "Core/Resample/Reductions/NearestPoints.h"

#include "Core/Resample/Kernel/Fetch.h"
#include "Core/Resample/Reductions/AttributeTuples.h"
#include "Core/Resample/Reductions/VoxelSlices.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>

namespace pointhaptics
{
namespace simd
{
namespace
{

/// Bits of an offset from the pivot below the edge of a voxel, where differences of count times an offset
/// from the sum of all then fit 62 bits: up to so many points.
constexpr int kQuantumBits = 40;
constexpr std::int64_t kFewPoints = std::int64_t(1) << (56 - kQuantumBits);

/// The power of two that a length above 0 has in it.
int exponentOf(double length)
{
  int exponent;
  std::frexp(length, &exponent);
  return exponent - 1;
}

/// The nearest integer of a number below 2^51.
double rounded(double x)
{
  constexpr double kRound = 0x1.8p52;
  return (x + kRound) - kRound;
}

/// -1, 0 or 1 where point @p a has the smaller value, the same values, or the larger one.
int compareValues(const AttributeView& view, std::int64_t a, std::int64_t b)
{
  int order = 0;
  withType(view.type,
    [&](auto example)
    {
      using T = decltype(example);
      for (int c = 0; c < view.components && order == 0; ++c)
      {
        T ofA;
        T ofB;
        std::memcpy(&ofA, view.tuple(a) + c * std::int64_t(sizeof(T)), sizeof(T));
        std::memcpy(&ofB, view.tuple(b) + c * std::int64_t(sizeof(T)), sizeof(T));
        order = int(orderedKey(ofB) < orderedKey(ofA)) - int(orderedKey(ofA) < orderedKey(ofB));
      }
    });
  return order;
}

}

NearestPoints::NearestPoints(const VoxelRequest& request)
  : request_(&request)
  , toMean_(request.representative == Representative::NearestToMean)
  , isIdentity_(request.transform.isIdentity())
  , exponent_(exponentOf(
      std::max({ request.lattice.spacing.x, request.lattice.spacing.y, request.lattice.spacing.z })))
  , scale_(scaleOf(kQuantumBits))
{
}

const void* NearestPoints::addressOf(std::int64_t point) const
{
  const PointView& points = request_->points;
  return points.floats() ? static_cast<const void*>(points.floats() + points.stride() * point)
                         : points.doubles() + points.stride() * point;
}

inline NearestPoints::Member NearestPoints::memberOf(std::int64_t point) const
{
  const Vec3 p = request_->points[point];
  return { isIdentity_ ? p : request_->transform.apply(p), point };
}

void NearestPoints::prepare(const std::int64_t* counts, std::int64_t voxels, const NearestRecords* known)
{
  known_ = known;
  ends_.assign(counts, counts + voxels);
  for (std::size_t v = 0; known && v < ends_.size(); ++v)
  {
    if (isKnown(v))
    {
      fetch(addressOf(known->point(v))); // For write().
      ends_[v] = 0;
    }
  }
  const std::int64_t points = countsToPlaces(ends_);
  needsPoints_ = points > 0;
  members_.reserve(std::size_t(points), Pages::Huge);
}

void NearestPoints::add(const std::int64_t* points, const std::int64_t* voxels, int count)
{
  for (int i = 0; i < count; ++i)
  {
    const auto voxel = std::size_t(voxels[i]);
    if (!isKnown(voxel))
    {
      members_[std::size_t(ends_[voxel]++)] = memberOf(points[i]);
    }
  }
}

NearestPoints::Scale NearestPoints::scaleOf(int bits) const
{
  return { { std::ldexp(1.0, -exponent_ / 2), std::ldexp(1.0, bits - exponent_ + exponent_ / 2) },
    std::ldexp(1.0, bits + 3) };
}

inline NearestPoints::Offset NearestPoints::Scale::quantized(const Vec3& offset) const
{
  Offset quanta;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double exact = offset[axis] * factors[0] * factors[1];
    quanta[std::size_t(axis)] = std::int64_t(rounded(std::min(std::max(exact, -most), most)));
  }
  return quanta;
}

Vec3 NearestPoints::centerOf(std::uint64_t key) const
{
  const Lattice& lattice = request_->lattice;
  const auto index = lattice.indexOf(key);
  Vec3 center;
  for (int axis = 0; axis < 3; ++axis)
  {
    center[axis] = lattice.origin[axis] + (double(index[std::size_t(axis)]) + 0.5) * lattice.spacing[axis];
  }
  return center;
}

bool NearestPoints::goesBefore(const Member& a, const Member& b) const
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (a.place[axis] != b.place[axis])
    {
      return a.place[axis] < b.place[axis];
    }
  }
  for (const AttributeView& values : request_->tieBreakers)
  {
    const int order = compareValues(values, a.number, b.number);
    if (order != 0)
    {
      return order < 0;
    }
  }
  return a.number < b.number;
}

/// Compares distances times the number of points: |n q - sum of all q| for the mean, |q - center| for the
/// centre.
const NearestPoints::Member& NearestPoints::chosenOf(
  const Member* first, const Member* last, const MeanArena& arena, std::size_t voxel) const
{
  const std::int64_t count = last - first;
  const Vec3 middle = toMean_ ? arena.point(voxel) : centerOf(arena.keys()[voxel]);
  // A short number near the middle: differences of coordinates from this are exact.
  const double unit = std::ldexp(1.0, exponent_);
  const Vec3 pivot =
    unit * Vec3(rounded(middle.x / unit), rounded(middle.y / unit), rounded(middle.z / unit));
  const Scale scale = count < kFewPoints ? scale_ : scaleOf(56 - exponentOf(double(count)));
  const Offset ofMiddle = scale.quantized(middle - pivot);
  Int128 target[3] = { ofMiddle[0], ofMiddle[1], ofMiddle[2] };
  if (toMean_)
  {
    std::fill(target, target + 3, 0);
    for (const Member* member = first; member != last; ++member)
    {
      const Offset offset = scale.quantized(member->place - pivot);
      std::transform(target, target + 3, offset.begin(), target, std::plus<>());
    }
  }
  const std::int64_t factor = toMean_ ? count : 1;
  const Member* best = nullptr;
  UInt128 least = 0;
  for (const Member* member = first; member != last; ++member)
  {
    const Offset offset = scale.quantized(member->place - pivot);
    UInt128 distance = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const auto difference = std::int64_t(Int128(factor) * offset[axis] - target[axis]);
      distance += UInt128(Int128(difference) * difference);
    }
    if (!best || distance < least || (distance == least && goesBefore(*member, *best)))
    {
      best = member;
      least = distance;
    }
  }
  return *best;
}

bool NearestPoints::write(
  std::size_t firstVoxel, MeanArena& arena, const Executor& executor, ProgressObserver* observer) const
{
  return forVoxelSlices(ends_, executor, observer,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (auto v = std::size_t(begin); v < std::size_t(end); ++v)
      {
        const Member* const first = members_.data() + (v == 0 ? 0 : ends_[v - 1]);
        const Member* const last = members_.data() + ends_[v];
        const std::size_t voxel = firstVoxel + v;
        const Member member = isKnown(v) ? memberOf(known_->point(v)) : chosenOf(first, last, arena, voxel);
        arena.setPoint(voxel, member.place);
        arena.chosen()[voxel] = member.number;
      }
    });
}

} // namespace simd
} // namespace pointhaptics
