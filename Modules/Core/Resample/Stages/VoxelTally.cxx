#include "Core/Resample/Stages/VoxelTally.h"

#include "Core/Resample/AttributeTuples.h"
#include "Core/Resample/Kernel/AttributeRounding.h"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <utility>

namespace pointhaptics
{
namespace simd
{
namespace
{

constexpr int kDigitBits = 32;
constexpr std::int64_t kHalfDigit = std::int64_t(1) << (kDigitBits - 1);
/// The exponent of the digit with key 0: below the last bit of a double.
constexpr int kLeastExponent = -1216;
/// Beyond the largest sum of doubles.
constexpr std::uint64_t kDigits = 76;
/// Numbers that are not finite.
constexpr std::uint64_t kNaNs = kDigits + 0;
constexpr std::uint64_t kPlus = kDigits + 1;
constexpr std::uint64_t kMinus = kDigits + 2;

int exponentOf(std::uint64_t key)
{
  return kDigitBits * int(key) + kLeastExponent;
}

/// What is over when a digit is as small as it may be.
std::int64_t carryOf(std::int64_t digit)
{
  return (digit + kHalfDigit) >> kDigitBits;
}

/// An integer sum. @pre its digits are those of integers.
Int128 integerOf(VoxelTally::List digits)
{
  Int128 sum = 0;
  for (const TallyEntry& digit : digits)
  {
    sum += Int128(digit.amount) * (Int128(1) << exponentOf(digit.key));
  }
  return sum;
}

/// A sum, rounded once: times 2^exponent it is that of the digits.
double roundedSum(VoxelTally::List digits, int& exponent)
{
  exponent = 0;
  if (digits.first == digits.last)
  {
    return 0.0;
  }
  // The first three have more bits than a double; of the others the sign is enough.
  const std::uint64_t top = digits.last[-1].key;
  const std::uint64_t least = top < 2 ? 0 : top - 2;
  Int128 whole = 0;
  const TallyEntry* entry = digits.last;
  for (; entry != digits.first && entry[-1].key >= least; --entry)
  {
    whole += Int128(entry[-1].amount) * (Int128(1) << (kDigitBits * int(entry[-1].key - least)));
  }
  const int rest = entry == digits.first ? 0 : entry[-1].amount > 0 ? 1 : -1;
  exponent = exponentOf(least) - 2;
  return double(4 * whole + rest);
}

double meanOf(VoxelTally::List list, std::int64_t count)
{
  const auto isFiniteDigit = [](const TallyEntry& entry) { return entry.key < kDigits; };
  const TallyEntry* const nonFinite = std::partition_point(list.first, list.last, isFiniteDigit);
  if (nonFinite != list.last)
  {
    const auto saw = [&](std::uint64_t key)
    { return std::any_of(nonFinite, list.last, [=](const TallyEntry& entry) { return entry.key == key; }); };
    return meanWithNonFinite(saw(kNaNs), saw(kPlus), saw(kMinus));
  }
  int exponent;
  const double sum = roundedSum(list, exponent);
  return scaledMean(sum, exponent, count);
}

/// Of several the first.
std::uint64_t mostFrequentKey(VoxelTally::List list)
{
  return std::max_element(
    list.first, list.last, [](const TallyEntry& a, const TallyEntry& b) { return a.amount < b.amount; })
    ->key;
}

std::uint64_t middleKey(VoxelTally::List list, std::int64_t count)
{
  std::int64_t before = 0;
  const auto isMiddle = [&](const TallyEntry& entry)
  {
    before += entry.amount;
    return before > (count - 1) / 2;
  };
  return std::find_if(list.first, list.last, isMiddle)->key;
}

/// Appends a + @p sign b. @p digits: keys below it are those of digits. @return false where there are fewer
/// than no points with a value.
bool join(
  VoxelTally::List a, VoxelTally::List b, int sign, std::uint64_t digits, std::vector<TallyEntry>& list)
{
  bool isRight = true;
  std::int64_t carry = 0;
  std::uint64_t next = 0; // The key that the carry belongs to.
  while (a.first != a.last || b.first != b.last || carry != 0)
  {
    const std::uint64_t ofA = a.first != a.last ? a.first->key : ~std::uint64_t(0);
    const std::uint64_t ofB = b.first != b.last ? b.first->key : ~std::uint64_t(0);
    const std::uint64_t key = carry != 0 ? next : std::min(ofA, ofB);
    std::int64_t amount = std::exchange(carry, 0);
    amount += a.first != a.last && ofA == key ? (a.first++)->amount : 0;
    amount += b.first != b.last && ofB == key ? sign * (b.first++)->amount : 0;
    if (key < digits)
    {
      carry = carryOf(amount);
      amount -= carry * (std::int64_t(1) << kDigitBits);
      next = key + 1;
    }
    isRight = isRight && (key < digits || amount >= 0);
    if (amount != 0)
    {
      list.push_back({ key, amount });
    }
  }
  return isRight;
}

}

void TallySum::add(std::int64_t value, int exponent)
{
  const int above = exponent - kLeastExponent;
  Int128 left = Int128(value) * (Int128(1) << (above % kDigitBits));
  more_.clear();
  for (auto key = std::uint64_t(above / kDigitBits); left != 0; ++key)
  {
    const auto digit = std::int64_t(std::int32_t(std::uint32_t(left)));
    if (digit != 0)
    {
      more_.push_back({ key, digit });
    }
    left = (left - digit) >> kDigitBits;
  }
  both_.clear();
  static_cast<void>(join({ list_.data(), list_.data() + list_.size() },
    { more_.data(), more_.data() + more_.size() }, 1, kDigits, both_)); // Digits may be of either sign.
  list_.swap(both_);
}

void TallySum::addNonFinite(std::int64_t nans, std::int64_t plus, std::int64_t minus)
{
  for (const TallyEntry& entry : { TallyEntry{ kNaNs, nans }, { kPlus, plus }, { kMinus, minus } })
  {
    if (entry.amount != 0)
    {
      list_.push_back(entry);
    }
  }
}

void TallySum::moveTo(VoxelTally& tally)
{
  tally.push(list_);
  list_.clear();
}

VoxelTally::List VoxelTally::list(std::size_t voxel, int component) const
{
  const std::size_t i = voxel * std::size_t(kind_.components) + std::size_t(component);
  return { entries_.data() + (i == 0 ? 0 : ends_[i - 1]), entries_.data() + ends_[i] };
}

void VoxelTally::push(const std::vector<TallyEntry>& list)
{
  entries_.insert(entries_.end(), list.begin(), list.end());
  ends_.push_back(entries_.size());
}

void VoxelTally::append(const VoxelTally& from, std::size_t first, std::size_t last)
{
  const auto width = std::size_t(kind_.components);
  const auto startOf = [&](std::size_t voxel) { return voxel == 0 ? 0 : from.ends_[voxel * width - 1]; };
  const std::size_t begin = startOf(first);
  const std::size_t before = entries_.size();
  entries_.insert(entries_.end(), from.entries_.begin() + std::ptrdiff_t(begin),
    from.entries_.begin() + std::ptrdiff_t(startOf(last)));
  std::transform(from.ends_.begin() + std::ptrdiff_t(first * width),
    from.ends_.begin() + std::ptrdiff_t(last * width), std::back_inserter(ends_),
    [=](std::size_t end) { return before + (end - begin); });
}

bool VoxelTally::addToLast(const VoxelTally& from, std::size_t voxel, int sign)
{
  const std::size_t last = voxels() - 1;
  const auto first = std::size_t(list(last, 0).first - entries_.data());
  bool isRight = true;
  const TallyEntry* begin = entries_.data() + first;
  joined_.clear();
  for (int c = 0; c < kind_.components; ++c)
  {
    const List own = { begin, list(last, c).last };
    begin = own.last; // The end of this list becomes that of the joined one.
    isRight = join(own, from.list(voxel, c), sign, isSum(kind_.statistic) ? kDigits : 0, joined_) && isRight;
    ends_[ends_.size() - std::size_t(kind_.components - c)] = first + joined_.size();
  }
  entries_.resize(first);
  entries_.insert(entries_.end(), joined_.begin(), joined_.end());
  return isRight;
}

template <typename T>
void VoxelTally::writeTuple(
  std::size_t voxel, std::int64_t count, const std::array<Vec3, 3>& columns, T* to) const
{
  using Key = decltype(orderedKey(T()));
  if (kind_.statistic == AttributeStatistic::Normal)
  {
    Vec3 mean;
    for (int c = 0; c < 3; ++c)
    {
      mean[c] = meanOf(list(voxel, c), count);
    }
    mean = turnedMean<T>(mean, columns);
    std::transform(&mean.x, &mean.x + 3, to, [](double x) { return T(x); });
    return;
  }
  for (int c = 0; c < kind_.components; ++c)
  {
    const List values = list(voxel, c);
    if (kind_.statistic == AttributeStatistic::Mean)
    {
      if constexpr (std::is_floating_point_v<T>)
      {
        to[c] = T(meanOf(values, count));
      }
      else
      {
        to[c] = roundedMean<T>(integerOf(values), count);
      }
      continue;
    }
    const std::uint64_t key =
      kind_.statistic == AttributeStatistic::Mode ? mostFrequentKey(values) : middleKey(values, count);
    to[c] = valueOfKey<T>(orderedOfTallyKey<Key>(key));
  }
}

void VoxelTally::write(std::size_t first, std::size_t last, const std::int64_t* counts,
  const std::array<Vec3, 3>& columns, void* tuples) const
{
  withType(kind_.type,
    [&](auto example)
    {
      using T = decltype(example);
      T* to = static_cast<T*>(tuples);
      for (std::size_t v = first; v < last; ++v, to += kind_.components)
      {
        writeTuple<T>(v, *counts++, columns, to);
      }
    });
}

template <typename T>
bool VoxelTally::isListOf(List list, std::int64_t count) const
{
  const auto ascends = [](const TallyEntry& a, const TallyEntry& b) { return a.key >= b.key; };
  if (std::adjacent_find(list.first, list.last, ascends) != list.last ||
    std::any_of(list.first, list.last, [](const TallyEntry& entry) { return entry.amount == 0; }))
  {
    return false;
  }
  if (!isSum(kind_.statistic))
  {
    using Key = decltype(orderedKey(T()));
    std::int64_t left = count;
    for (const TallyEntry& value : list)
    {
      if (value.amount < 1 || value.amount > left ||
        tallyKeyOf(orderedOfTallyKey<Key>(value.key)) != value.key)
      {
        return false;
      }
      left -= value.amount;
    }
    return left == 0;
  }
  const bool areDigits = std::all_of(list.first, list.last,
    [&](const TallyEntry& entry)
    {
      return entry.key < kDigits
        ? carryOf(entry.amount) == 0 && entry.amount >= -kHalfDigit
        : std::is_floating_point_v<T> && entry.key <= kMinus && entry.amount > 0 && entry.amount <= count;
    });
  if constexpr (std::is_floating_point_v<T>)
  {
    return areDigits;
  }
  else
  {
    constexpr std::uint64_t kZero = -kLeastExponent / kDigitBits;
    constexpr std::uint64_t kTop = kZero + 3; // 34 bits of points and 64 of each: two bits are in this one.
    constexpr std::int64_t kMostOfTop = 4;
    return areDigits &&
      (list.first == list.last ||
        (list.first->key >= kZero && list.last[-1].key <= kTop &&
          (list.last[-1].key < kTop || std::abs(list.last[-1].amount) <= kMostOfTop) &&
          integerOf(list) >= Int128(std::numeric_limits<T>::min()) * count &&
          integerOf(list) <= Int128(std::numeric_limits<T>::max()) * count));
  }
}

bool VoxelTally::isOf(std::size_t voxel, std::int64_t count) const
{
  bool isRight = true;
  withType(kind_.type,
    [&](auto example)
    {
      for (int c = 0; isRight && c < kind_.components; ++c)
      {
        isRight = isListOf<decltype(example)>(list(voxel, c), count);
      }
    });
  return isRight;
}

} // namespace simd
} // namespace pointhaptics
