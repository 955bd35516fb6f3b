#include "Core/Resample/Stages/VoxelTally.h"
#include "Core/Resample/Kernel/OrderedKey.h"

#include <algorithm>
#include <limits>
#include <type_traits>

namespace pointhaptics::simd
{

void VoxelGroups::add(int run, std::size_t first, std::size_t last)
{
  for (; first < last; ++first)
  {
    voxels.push_back({ run, first });
    ends.push_back(voxels.size());
  }
}

std::int64_t TallyValues::List::mostFrequent() const
{
  return std::max_element(
    first, last, [](const TallyValue& a, const TallyValue& b) { return a.points < b.points; })
    ->key;
}

std::int64_t TallyValues::List::middle(std::int64_t count) const
{
  std::int64_t left = (count - 1) / 2;
  const TallyValue* value = first;
  for (; left >= value->points; ++value)
  {
    left -= value->points;
  }
  return value->key;
}

TallyValues TallyValues::gathered(
  const std::vector<const TallyValues*>& runs, const VoxelGroups& groups, bool& isRight)
{
  TallyValues all;
  std::size_t most = 0;
  for (const TallyValues* run : runs)
  {
    all.components = std::max(all.components, run->components);
    most += run->values.size();
  }
  const auto width = std::size_t(all.components);
  all.ends.reserve(groups.size() * width);
  all.values.reserve(most);
  const auto isLess = [](const TallyValue& a, const TallyValue& b) { return a.key < b.key; };
  std::vector<TallyValue> found;
  for (std::size_t list = 0; list < groups.size() * width; ++list)
  {
    found.clear();
    for (std::size_t i = groups.beginOf(list / width); i < groups.ends[list / width]; ++i)
    {
      const VoxelGroups::Voxel& voxel = groups.voxels[i];
      const auto before = std::ptrdiff_t(found.size());
      for (const TallyValue& value : (*runs[std::size_t(voxel.run)])[voxel.number * width + list % width])
      {
        found.push_back({ value.key, groups.signOf(voxel) * value.points });
      }
      std::inplace_merge(found.begin(), found.begin() + before, found.end(), isLess);
    }
    for (std::size_t i = 0; i < found.size();)
    {
      TallyValue value = found[i++];
      for (; i < found.size() && found[i].key == value.key; ++i)
      {
        value.points += found[i].points;
      }
      isRight = isRight && value.points >= 0;
      if (value.points != 0)
      {
        all.values.push_back(value);
      }
    }
    all.ends.push_back(all.values.size());
  }
  return all;
}

VoxelTally VoxelTally::gathered(
  const std::vector<const VoxelTally*>& runs, const VoxelGroups& groups, bool& isRight)
{
  std::vector<const TallySums*> sums;
  std::vector<const TallyValues*> values;
  for (const VoxelTally* run : runs)
  {
    sums.push_back(&run->sums);
    values.push_back(&run->values);
  }
  return { TallySums::gathered(sums, groups, isRight), TallyValues::gathered(values, groups, isRight) };
}

namespace
{

bool isOf(const NonFiniteCount& seen, std::int64_t count)
{
  return seen.nans >= 0 && seen.plus >= 0 && seen.minus >= 0 && seen.nans <= count &&
    seen.plus <= count - seen.nans && seen.minus <= count - seen.nans - seen.plus;
}

/// True if @p count integers can have the sum.
template <typename T>
bool isSumOf(const TallySums& sums, std::size_t sum, std::int64_t count)
{
  constexpr int kMostBits = 34 + 64; // Bits of the count and of each integer.
  if (std::is_floating_point_v<T>)
  {
    return true;
  }
  if (sums.unit < 0 || sums.unit > kMostBits || sums.words > 2)
  {
    return false;
  }
  const Int128 units = sums.inUnits(sum);
  const Int128 least = Int128(std::numeric_limits<T>::lowest()) * count;
  const Int128 most = Int128(std::numeric_limits<T>::max()) * count;
  return units >= -(-least >> sums.unit) && units <= most >> sums.unit;
}

template <typename T>
bool areValuesOf(TallyValues::List list, std::int64_t count)
{
  using Key = decltype(orderedKey(T()));
  const auto ascends = [](const TallyValue& a, const TallyValue& b) { return a.key >= b.key; };
  std::int64_t left = count;
  for (const TallyValue& value : list)
  {
    if (value.points < 1 || value.points > left || value.key != std::int64_t(Key(value.key)))
    {
      return false;
    }
    left -= value.points;
  }
  return left == 0 && std::adjacent_find(list.first, list.last, ascends) == list.last;
}

}

void VoxelTally::write(const AccumulatedArray& kind, std::size_t first, std::size_t last,
  const std::int64_t* counts, const std::array<Vec3, 3>& columns, void* tuples) const
{
  if (isSum(kind.statistic))
  {
    sums.write(kind, first, last, counts, columns, tuples);
    return;
  }
  withType(kind.type,
    [&](auto example)
    {
      using T = decltype(example);
      T* to = static_cast<T*>(tuples);
      const auto components = std::size_t(kind.components);
      for (std::size_t list = first * components; list < last * components; ++list)
      {
        const std::int64_t count = counts[list / components - first];
        *to++ = valueOfKey<T>(kind.statistic == AttributeStatistic::Mode ? values[list].mostFrequent()
                                                                         : values[list].middle(count));
      }
    });
}

bool VoxelTally::isOf(const AccumulatedArray& kind, std::size_t voxel, std::int64_t count) const
{
  bool isRight = true;
  withType(kind.type,
    [&](auto example)
    {
      using T = decltype(example);
      for (int c = 0; isRight && c < kind.components; ++c)
      {
        const std::size_t i = voxel * std::size_t(kind.components) + std::size_t(c);
        isRight = isSum(kind.statistic)
          ? isSumOf<T>(sums, i, count) && (sums.nonFinite.empty() || simd::isOf(sums.nonFinite[i], count))
          : areValuesOf<T>(values[i], count);
      }
    });
  return isRight;
}

void VoxelTally::trim()
{
  sums.trim();
  values.ends.shrink_to_fit();
  values.values.shrink_to_fit();
}

std::size_t VoxelTally::bytes() const
{
  return sums.values.capacity() * sizeof(std::uint64_t) + sums.nonFinite.capacity() * sizeof(NonFiniteCount) +
    values.ends.capacity() * sizeof(std::size_t) + values.values.capacity() * sizeof(TallyValue);
}

} // namespace pointhaptics::simd
