#include "Core/Resample/Reductions/VoxelReductions.h"

#include "Core/Resample/Kernel/Loops.h"
#include "Core/Resample/Kernel/OrderedKey.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <utility>

namespace pointhaptics::simd
{

namespace
{

/// The statistic of a list of any length, which this sorts.
template <typename Key>
Key statisticOfMany(bool isMedian, Key* keys, std::int64_t count)
{
  if (isMedian)
  {
    std::nth_element(keys, keys + (count - 1) / 2, keys + count);
    return keys[(count - 1) / 2];
  }
  std::sort(keys, keys + count);
  Key mode = keys[0];
  std::int64_t most = 0;
  for (std::int64_t i = 0, equal = 0; i < count; ++i)
  {
    equal = i > 0 && keys[i] == keys[i - 1] ? equal + 1 : 1;
    mode = equal > most ? keys[i] : mode;
    most = std::max(most, equal);
  }
  return mode;
}

}

void AttributeTuples::prepare(const AccumulatedArray& kind, const std::vector<std::int64_t>& counts)
{
  kind_ = kind;
  ends_ = counts;
  std::int64_t tuples = 0;
  for (std::int64_t& end : ends_)
  {
    tuples += std::exchange(end, tuples);
  }
  const std::size_t bytes = std::size_t(tuples * bytesOf(kind_.type)) + kListVector;
  componentBytes_ = (bytes + 63) / 64 * 64;
  keys_.reserve(componentBytes_ * std::size_t(kind_.components));
}

void AttributeTuples::add(
  const Tuples& tuples, const std::int64_t* numbers, const std::uint32_t* voxels, int count)
{
  withType(kind_.type,
    [&](auto example)
    {
      using T = decltype(example);
      // Copies, which no store can change.
      char* const to = keys_.data();
      std::int64_t* const ends = ends_.data();
      const std::size_t apart = componentBytes_;
      const Tuples from = tuples;
      const auto components = std::size_t(kind_.components);
      for (int i = 0; i < count; ++i)
      {
        const char* const tuple = from.first + from.step * numbers[i];
        char* const first = to + sizeof(T) * std::size_t(ends[voxels[i]]++);
        for (std::size_t c = 0; c < components; ++c)
        {
          T value;
          std::memcpy(&value, tuple + c * sizeof(T), sizeof(T));
          const auto key = orderedKey(value);
          std::memcpy(first + apart * c, &key, sizeof(T));
        }
      }
    });
}

void AttributeTuples::write(const Kernels& kernels, void* all) const
{
  const bool isMedian = kind_.statistic == AttributeStatistic::Median;
  const auto select = (isMedian ? kernels.medians : kernels.modes)[std::size_t(kind_.type)];
  withType(kind_.type,
    [&](auto example)
    {
      using T = decltype(example);
      T* to = static_cast<T*>(all);
      forLists<decltype(orderedKey(T()))>(
        [&](auto* keys, std::int64_t count)
        {
          auto key = std::min(keys[0], keys[count - 1]); // Of one or two it is mode and median.
          if (count > 2)
          {
            count <= kFewValues ? select(keys, int(count), &key)
                                : void(key = statisticOfMany(isMedian, keys, count));
          }
          *to++ = valueOfKey<T>(key);
        });
    });
}

TallyValues AttributeTuples::tally() const
{
  TallyValues tally;
  tally.components = kind_.components;
  withType(kind_.type,
    [&](auto example)
    {
      forLists<decltype(orderedKey(example))>(
        [&](auto* keys, std::int64_t count)
        {
          std::sort(keys, keys + count);
          for (std::int64_t k = 0; k < count; ++k)
          {
            if (k == 0 || keys[k] != keys[k - 1])
            {
              tally.values.push_back({ std::int64_t(keys[k]), 0 });
            }
            ++tally.values.back().points;
          }
          tally.ends.push_back(tally.values.size());
        });
    });
  return tally;
}

namespace
{

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

const void* addressOf(const PointView& points, std::int64_t i)
{
  return points.floats() ? static_cast<const void*>(points.floats() + points.stride() * i)
                         : points.doubles() + points.stride() * i;
}

}

NearestPoints::NearestPoints(const VoxelRequest& request, int fractionBits)
  : request_(&request)
  , toMean_(request.representative == Representative::NearestToMean)
  , isIdentity_(request.transform.isIdentity())
  , middle_(std::ldexp(0.5, fractionBits))
{
  const Vec3& spacing = request.lattice.spacing;
  scale_ = spacing / std::max({ spacing.x, spacing.y, spacing.z });
}

inline Vec3 NearestPoints::placeOf(std::int64_t point) const
{
  const Vec3 p = request_->points[point];
  return isIdentity_ ? p : request_->transform.apply(p);
}

bool NearestPoints::goesBefore(std::int64_t a, std::int64_t b) const
{
  const Vec3 ofA = placeOf(a);
  const Vec3 ofB = placeOf(b);
  for (int axis = 0; axis < 3; ++axis)
  {
    if (ofA[axis] != ofB[axis])
    {
      return ofA[axis] < ofB[axis];
    }
  }
  for (const AttributeView& values : request_->tieBreakers)
  {
    const int order = compareValues(values, a, b);
    if (order != 0)
    {
      return order < 0;
    }
  }
  return a < b;
}

void NearestPoints::write(VoxelWriter& writer, std::size_t first) const
{
  constexpr std::size_t kAhead = 32;
  for (std::size_t v = 0; v < size_; ++v)
  {
    fetch(addressOf(request_->points, nearest_[std::min(v + kAhead, size_ - 1)].point));
    writer.setPoint(first + v, placeOf(nearest_[v].point));
    writer.chosen()[first + v] = nearest_[v].point;
  }
}

std::array<Vec3, 3> normalColumns(const AffineTransform& transform)
{
  return { transform.applyToNormal({ 1, 0, 0 }), transform.applyToNormal({ 0, 1, 0 }),
    transform.applyToNormal({ 0, 0, 1 }) };
}

VoxelReductions::VoxelReductions(const VoxelRequest& request, const std::vector<AttributeRequest>& arrays,
  const PayloadLayout& payloads, int fractionBits, std::int64_t* voxelIndex)
  : payloads_(payloads)
  , voxelIndex_(voxelIndex)
  , kernels_(kernelsFor(request.instructions))
  , columns_(normalColumns(request.transform))
{
  for (const AttributeRequest& array : arrays)
  {
    const AttributeView& view = array.view;
    arrays_.push_back({ view, { view.type, view.components, array.statistic },
      array.range.value_or(AttributeRange()), {}, {} });
  }
  if (keepsPoints(request.representative))
  {
    nearest_.emplace(request, fractionBits);
  }
}

void VoxelReductions::reduce(const BinnedVoxels& voxels, std::size_t first)
{
  counts_.resize(voxels.size());
  for (std::size_t v = 0; v < counts_.size(); ++v)
  {
    counts_[v] = voxels.count(v);
  }
  for (Array& array : arrays_)
  {
    isSum(array.kind.statistic) ? array.sums.prepare(array.kind, array.range, counts_)
                                : array.tuples.prepare(array.kind, counts_);
  }
  if (nearest_)
  {
    nearest_->prepare(voxels);
  }
  voxels.visit(nearest_.has_value(),
    [&](const PointBlock& block)
    {
      for (int i = 0; voxelIndex_ && i < block.count; ++i)
      {
        voxelIndex_[block.points[i]] = std::int64_t(first + block.voxels[i]);
      }
      addTuples(block);
      nearest_ ? nearest_->add(block) : void();
    });
}

/// Tuples that are in payloads are taken from there.
void VoxelReductions::addTuples(const PointBlock& block)
{
  std::int64_t places[kBlockRecords];
  std::iota(places, places + (payloads_.count > 0 ? block.count : 0), 0);
  for (std::size_t i = 0; i < arrays_.size(); ++i)
  {
    Array& array = arrays_[i];
    const bool isPayload = i < std::size_t(payloads_.count);
    Tuples tuples = { static_cast<const char*>(array.view.values), array.view.step() };
    if (isPayload)
    {
      tuples = { reinterpret_cast<const char*>(block.payloads) + payloads_.arrays[i].offset,
        std::int64_t(sizeof(std::uint32_t)) * payloads_.words };
    }
    const std::int64_t* const numbers = isPayload ? places : block.points;
    isSum(array.kind.statistic) ? array.sums.add(array.kind.type, tuples, numbers, block.voxels, block.count)
                                : array.tuples.add(tuples, numbers, block.voxels, block.count);
  }
}

void VoxelReductions::write(VoxelWriter& writer, std::size_t first) const
{
  for (std::size_t i = 0; i < arrays_.size(); ++i)
  {
    const Array& array = arrays_[i];
    void* const to = i < writer.attributes() ? writer.attribute(i, first) : writer.pointsFrom(first);
    isSum(array.kind.statistic)
      ? array.sums.write(array.kind, 0, counts_.size(), writer.counts() + first, columns_, to)
      : array.tuples.write(kernels_, to);
  }
  if (nearest_)
  {
    nearest_->write(writer, first);
  }
}

std::vector<VoxelTally> VoxelReductions::takeTallies()
{
  std::vector<VoxelTally> tallies;
  for (Array& array : arrays_)
  {
    isSum(array.kind.statistic) ? tallies.push_back({ std::move(array.sums), {} })
                                : tallies.push_back({ {}, array.tuples.tally() });
  }
  return tallies;
}

} // namespace pointhaptics::simd
