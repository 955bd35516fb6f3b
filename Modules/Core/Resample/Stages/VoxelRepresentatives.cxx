#include "Core/Resample/Stages/VoxelRepresentatives.h"

#include "Core/Resample/Kernel/Fetch.h"
#include "Core/Resample/VoxelSlices.h"

#include <algorithm>
#include <cmath>
#include <cstring>

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

/// Coordinates of the type that is asked for.
AttributeView coordinatesFor(const VoxelRequest& request)
{
  return { nullptr, request.singlePrecision ? ScalarType::Float : ScalarType::Double, 3 };
}

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

VoxelRepresentatives::VoxelRepresentatives(const VoxelRequest& request)
  : request_(&request)
  , isIdentity_(request.transform.isIdentity())
  , exponent_(exponentOf(
      std::max({ request.lattice.spacing.x, request.lattice.spacing.y, request.lattice.spacing.z })))
  , unit_(std::ldexp(1.0, exponent_))
  , scale_(scaleOf(kQuantumBits))
  , medians_(coordinatesFor(request), AttributeStatistic::Median)
{
}

void VoxelRepresentatives::prepare(
  const std::int64_t* counts, std::int64_t voxels, const NearestRecords* known)
{
  known_ = known;
  if (request_->representative == Representative::Median)
  {
    medians_.prepare(counts, voxels, 0, Executor());
    return;
  }
  ends_.assign(counts, counts + voxels);
  for (std::size_t v = 0; known && v < ends_.size(); ++v)
  {
    const std::int64_t point = known->point(v);
    fetch(addressOf(std::max<std::int64_t>(point, 0))); // For write().
    ends_[v] = point == NearestRecords::kUnknown ? ends_[v] : 0;
  }
  const std::int64_t points = countsToPlaces(ends_);
  members_.reserve(std::size_t(points), Pages::Huge);
  needsPoints_ = points > 0;
}

template <typename Real>
void VoxelRepresentatives::addMedians(const std::int64_t* points, const std::int64_t* voxels, int count)
{
  Real places[3 * kBlockRecords];
  std::int64_t numbers[kBlockRecords];
  for (int i = 0; i < count; ++i)
  {
    const Vec3 place = placeOf(points[i]);
    std::transform(&place.x, &place.x + 3, places + 3 * i, [](double x) { return Real(x); });
    numbers[i] = i;
  }
  AttributeView view = coordinatesFor(*request_);
  view.values = places;
  medians_.add(view, numbers, voxels, count);
}

void VoxelRepresentatives::add(const std::int64_t* points, const std::int64_t* voxels, int count)
{
  if (request_->representative == Representative::Median)
  {
    request_->singlePrecision ? addMedians<float>(points, voxels, count)
                              : addMedians<double>(points, voxels, count);
    return;
  }
  for (int i = 0; i < count; ++i)
  {
    const auto voxel = std::size_t(voxels[i]);
    if (!known_ || known_->point(voxel) == NearestRecords::kUnknown)
    {
      members_[std::size_t(ends_[voxel]++)] = { placeOf(points[i]), points[i] };
    }
  }
}

VoxelRepresentatives::Scale VoxelRepresentatives::scaleOf(int bits) const
{
  return { { std::ldexp(1.0, -exponent_ / 2), std::ldexp(1.0, bits - exponent_ + exponent_ / 2) },
    std::ldexp(1.0, bits + 3) };
}

inline VoxelRepresentatives::Offset VoxelRepresentatives::quantized(
  const Vec3& place, const Vec3& pivot, const Scale& scale)
{
  Offset offset;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double quanta = (place[axis] - pivot[axis]) * scale.factors[0] * scale.factors[1];
    offset.quanta[axis] = std::int64_t(rounded(std::min(std::max(quanta, -scale.most), scale.most)));
  }
  return offset;
}

VoxelRepresentatives::Middle VoxelRepresentatives::middleOf(const MeanArena& arena, std::size_t voxel) const
{
  Middle middle{ arena.point(voxel), {} };
  if (request_->representative == Representative::NearestToCenter)
  {
    const Lattice& lattice = request_->lattice;
    const auto index = lattice.indexOf(arena.keys()[voxel]);
    for (int axis = 0; axis < 3; ++axis)
    {
      middle.center[axis] =
        lattice.origin[axis] + (double(index[std::size_t(axis)]) + 0.5) * lattice.spacing[axis];
    }
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    middle.pivot[axis] = rounded(middle.center[axis] / unit_) * unit_;
  }
  return middle;
}

bool VoxelRepresentatives::goesBefore(const Member& a, const Member& b) const
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

/// Of voxel @p v here, @p voxel of the arena: the nearest in double; where another is about as near, exactly.
const VoxelRepresentatives::Member& VoxelRepresentatives::chosenOf(
  std::int64_t v, const MeanArena& arena, std::size_t voxel) const
{
  const Member* const first = members_.data() + (v == 0 ? 0 : ends_[std::size_t(v - 1)]);
  const Member* const last = members_.data() + ends_[std::size_t(v)];
  const std::int64_t count = last - first;
  const bool toMean = request_->representative == Representative::NearestToMean;
  if (count == 1 || (count == 2 && toMean))
  {
    return count == 2 && goesBefore(first[1], first[0]) ? first[1] : first[0];
  }
  const Middle middle = middleOf(arena, voxel);
  Vec3 target;
  for (const Member* member = first; toMean && member != last; ++member)
  {
    target += member->place - middle.pivot;
  }
  target = toMean ? target / double(count) : middle.center - middle.pivot;
  const Member* best = first;
  double least = INFINITY;
  double second = INFINITY;
  double farthest = unit_ * unit_;
  for (const Member* member = first; member != last; ++member)
  {
    const double distance = norm2((member->place - middle.pivot) - target);
    second = std::min(second, std::max(distance, least));
    best = distance < least ? member : best;
    least = std::min(distance, least);
    farthest = std::max(distance, farthest);
  }
  // Above what quanta, and rounding in any order of the points, can change.
  const double margin = (0x1p-36 + 0x1p-48 * double(count)) * farthest;
  return second - least > margin ? *best : exactlyChosenOf(first, last, middle);
}

/// Compares distances times the number of points: |n q - sum of all q| for the mean, |q - center| for the
/// centre.
const VoxelRepresentatives::Member& VoxelRepresentatives::exactlyChosenOf(
  const Member* first, const Member* last, const Middle& middle) const
{
  const std::int64_t count = last - first;
  const bool toMean = request_->representative == Representative::NearestToMean;
  const Vec3& pivot = middle.pivot;
  const Scale scale = count < kFewPoints ? scale_ : scaleOf(56 - exponentOf(double(count)));
  Int128 target[3] = {};
  for (const Member* member = first; toMean && member != last; ++member)
  {
    const Offset offset = quantized(member->place, pivot, scale);
    for (int axis = 0; axis < 3; ++axis)
    {
      target[axis] += offset.quanta[axis];
    }
  }
  const Offset ofCenter = quantized(middle.center, pivot, scale);
  const std::int64_t factor = toMean ? count : 1;
  const Member* best = nullptr;
  UInt128 least = 0;
  for (const Member* member = first; member != last; ++member)
  {
    const Offset offset = quantized(member->place, pivot, scale);
    UInt128 distance = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const Int128 to = toMean ? target[axis] : Int128(ofCenter.quanta[axis]);
      const auto difference = std::int64_t(Int128(factor) * offset.quanta[axis] - to);
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

bool VoxelRepresentatives::write(
  std::size_t firstVoxel, MeanArena& arena, const Executor& executor, ProgressObserver* observer) const
{
  if (request_->representative == Representative::Median)
  {
    return medians_.write(nullptr, arena.pointsFrom(firstVoxel), executor, observer);
  }
  return forVoxelSlices(ends_, executor, observer,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t v = begin; v < end; ++v)
      {
        const std::size_t voxel = firstVoxel + std::size_t(v);
        const std::int64_t known = known_ ? known_->point(std::size_t(v)) : NearestRecords::kUnknown;
        const Member member =
          known == NearestRecords::kUnknown ? chosenOf(v, arena, voxel) : Member{ placeOf(known), known };
        arena.setPoint(voxel, member.place);
        arena.chosen()[voxel] = member.number;
      }
    });
}

} // namespace simd
} // namespace pointhaptics
