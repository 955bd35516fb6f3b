// Sums of an accumulator as bytes: little-endian, whatever the machine.
#include "Core/Resample/VoxelAccumulatorSums.h"
#include "Core/Resample/VoxelResamplerImplementation.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace pointhaptics
{

using namespace simd;

namespace
{

constexpr char kMagic[8] = { 'P', 'H', 'V', 'o', 'x', 'e', 'l', '2' };

/// Writes a number as a word of 64 bits or two, the lowest byte first on every machine. @return its end.
template <typename Number>
char* put(char* to, const Number& number)
{
  static_assert(sizeof(Number) % sizeof(std::uint64_t) == 0, "whole words");
  if constexpr (sizeof(Number) > sizeof(std::uint64_t))
  {
    return put(put(to, std::uint64_t(number)), std::uint64_t(UInt128(number) >> 64));
  }
  else
  {
    std::uint64_t word;
    std::memcpy(&word, &number, sizeof word);
    for (std::size_t i = 0; i < sizeof word; ++i)
    {
      *to++ = char(word >> (8 * i) & 255);
    }
    return to;
  }
}

/// Reads what put() wrote.
template <typename Number>
const char* take(const char* from, Number& number)
{
  if constexpr (sizeof(Number) > sizeof(std::uint64_t))
  {
    std::uint64_t words[2];
    from = take(take(from, words[0]), words[1]);
    number = Number(UInt128(words[1]) << 64 | words[0]);
  }
  else
  {
    std::uint64_t word = 0;
    for (std::size_t i = 0; i < sizeof word; ++i)
    {
      word |= std::uint64_t(static_cast<unsigned char>(*from++)) << (8 * i);
    }
    std::memcpy(&number, &word, sizeof word);
  }
  return from;
}

struct Header
{
  Lattice lattice;
  std::uint64_t covariances = 0;
  std::int64_t fractionBits = 0;
  std::int64_t points = 0;
  std::int64_t clipped = 0;
  std::int64_t invalid = 0;
  std::uint64_t voxels = 0;
};

constexpr std::size_t kHeaderBytes = sizeof kMagic + (12 + 6) * sizeof(std::uint64_t);

/// Calls each(number) for the numbers of a header, in their order.
template <typename SomeHeader, typename Each>
void forNumbers(SomeHeader& header, const Each& each)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    each(header.lattice.origin[axis]);
    each(header.lattice.spacing[axis]);
    each(header.lattice.dimensions[std::size_t(axis)]);
    each(header.lattice.end[axis]);
  }
  each(header.covariances);
  each(header.fractionBits);
  each(header.points);
  each(header.clipped);
  each(header.invalid);
  each(header.voxels);
}

/// The same of a voxel.
template <typename Sums, typename Moments, typename Each>
void forNumbers(Sums& voxel, Moments* moments, const Each& each)
{
  each(voxel.key);
  each(voxel.count);
  std::for_each(voxel.sums, voxel.sums + 3, each);
  if (moments)
  {
    std::for_each(moments->lanes, moments->lanes + 6, each);
  }
}

std::size_t bytesOfVoxel(const Header& header)
{
  return sizeof(VoxelSums) + (header.covariances ? sizeof(SecondMoments) : 0);
}

bool isCount(std::int64_t n)
{
  return n >= 0 && n <= VoxelAccumulator::kMostPoints;
}

/// @return false for what no accumulator writes, fewer bytes than its voxels take included.
bool readHeader(std::string_view bytes, Header& header)
{
  if (bytes.size() < kHeaderBytes || std::memcmp(bytes.data(), kMagic, sizeof kMagic) != 0)
  {
    return false;
  }
  const char* from = bytes.data() + sizeof kMagic;
  forNumbers(header, [&](auto& number) { from = take(from, number); });
  const Lattice& lattice = header.lattice;
  const std::size_t left = bytes.size() - kHeaderBytes;
  return header.covariances <= 1 && header.voxels <= left / bytesOfVoxel(header) && isCount(header.points) &&
    isCount(header.clipped) && isCount(header.invalid) && lattice.check() == Status::Ok &&
    !std::isnan(lattice.end.x) && !std::isnan(lattice.end.y) && !std::isnan(lattice.end.z);
}

/// @return false where a mean would not lie in its voxel.
bool liesInVoxel(const VoxelSums& voxel, std::int64_t fractionBits)
{
  return isCount(voxel.count) && voxel.count > 0 &&
    std::all_of(voxel.sums, voxel.sums + 3,
      [&](Int128 sum) {
        return UInt128(sum) >> (64 + WideSums::kHighBits) == 0 && sum < Int128(voxel.count) << fractionBits;
      });
}

/// @param keys above all of the lattice. @pre the bytes are as many as the header says.
bool readVoxels(const char* from, const Header& header, std::uint64_t keys, VoxelRun& run)
{
  std::int64_t points = header.clipped + header.invalid;
  run.reserve(header.voxels, header.covariances == 1);
  for (std::uint64_t v = 0; v < header.voxels; ++v)
  {
    VoxelSums voxel;
    SecondMoments moments;
    SecondMoments* const wanted = header.covariances ? &moments : nullptr;
    forNumbers(voxel, wanted, [&](auto& number) { from = take(from, number); });
    if (!liesInVoxel(voxel, header.fractionBits) || voxel.key >= keys ||
      (v > 0 && voxel.key <= run.voxels.back().key) || voxel.count > header.points - points)
    {
      return false;
    }
    points += voxel.count;
    run.push(WideSums::of(voxel), wanted);
  }
  return points == header.points;
}

/// What follows the voxels: the arrays, the common transform, what the arrays have in the voxels.
struct Arrays
{
  std::vector<VoxelAccumulator::Array> kinds;
  std::optional<AffineTransform> common;
};

/// Words, as long as there are any.
class WordReader
{
public:
  explicit WordReader(std::string_view bytes)
    : left_(bytes)
  {
  }
  /// The next word, or 0 and an end before its time.
  template <typename Number = std::uint64_t>
  Number next()
  {
    Number number{};
    if (left_.size() < sizeof number)
    {
      isWhole_ = false;
      left_ = {};
      return number;
    }
    take(left_.data(), number);
    left_.remove_prefix(sizeof number);
    return number;
  }
  std::size_t words() const { return left_.size() / sizeof(std::uint64_t); }
  bool isWhole() const { return isWhole_; }
  bool isAtEnd() const { return isWhole_ && left_.empty(); }

private:
  std::string_view left_;
  bool isWhole_ = true;
};

constexpr std::uint64_t kWordsOfArray = 3;
constexpr std::uint64_t kWordsOfEntry = 2;
constexpr std::uint64_t kMostComponents = std::uint64_t(1) << 20;

void putArrays(std::string& bytes, const Arrays& arrays, const VoxelRun& run)
{
  const auto put64 = [&](const auto& number)
  {
    char word[sizeof number];
    put(word, number);
    bytes.append(word, sizeof word);
  };
  std::size_t words = 2 + kWordsOfArray * arrays.kinds.size() + 12;
  for (const VoxelTally& tally : run.tallies)
  {
    words += run.size() * std::size_t(tally.kind().components) + kWordsOfEntry * tally.entries();
  }
  bytes.reserve(bytes.size() + words * sizeof(std::uint64_t));
  put64(std::uint64_t(arrays.kinds.size()));
  for (const VoxelAccumulator::Array& kind : arrays.kinds)
  {
    put64(std::uint64_t(kind.type));
    put64(std::uint64_t(kind.components));
    put64(std::uint64_t(kind.statistic));
  }
  put64(std::uint64_t(arrays.common.has_value()));
  if (arrays.common)
  {
    std::for_each(&arrays.common->m[0][0], &arrays.common->m[0][0] + 12, put64);
  }
  for (const VoxelTally& tally : run.tallies)
  {
    for (std::size_t i = 0; i < run.size() * std::size_t(tally.kind().components); ++i)
    {
      const auto components = std::size_t(tally.kind().components);
      const VoxelTally::List list = tally.list(i / components, int(i % components));
      put64(std::uint64_t(list.last - list.first));
      for (const TallyEntry& entry : list)
      {
        put64(entry.key);
        put64(entry.amount);
      }
    }
  }
}

/// @return false for arrays that there are not.
bool readKinds(WordReader& words, Arrays& arrays)
{
  const auto count = words.next();
  bool isRight = count <= words.words() / kWordsOfArray;
  for (std::uint64_t i = 0; isRight && i < count; ++i)
  {
    const auto type = words.next();
    const auto components = words.next();
    const auto statistic = words.next();
    isRight = type <= std::uint64_t(ScalarType::Double) && components > 0 && components <= kMostComponents &&
      statistic <= std::uint64_t(AttributeStatistic::Median) &&
      (AttributeStatistic(statistic) != AttributeStatistic::Normal || components == 3);
    arrays.kinds.push_back({ ScalarType(type), int(components), AttributeStatistic(statistic) });
  }
  const auto hasCommon = words.next();
  if (isRight && hasCommon == 1)
  {
    arrays.common.emplace();
    std::generate_n(&arrays.common->m[0][0], 12, [&] { return words.next<double>(); });
  }
  return isRight && words.isWhole() && hasCommon <= 1 &&
    (!arrays.common || arrays.common->check() == Status::Ok);
}

/// @return false for lists that no tuples make.
bool readTallies(WordReader& words, const Arrays& arrays, VoxelRun& run)
{
  std::vector<TallyEntry> list;
  for (std::size_t i = 0; run.size() > 0 && i < arrays.kinds.size(); ++i)
  {
    VoxelTally& tally = run.tallies.emplace_back(arrays.kinds[i]);
    for (std::size_t v = 0; v < run.size(); ++v)
    {
      for (int c = 0; c < arrays.kinds[i].components; ++c)
      {
        const auto size = words.next();
        if (!words.isWhole() || size > words.words() / kWordsOfEntry)
        {
          return false;
        }
        list.clear();
        for (std::uint64_t entry = 0; entry < size; ++entry)
        {
          const auto key = words.next();
          list.push_back({ key, words.next<std::int64_t>() });
        }
        tally.push(list);
      }
      if (!tally.isOf(v, run.voxels[v].count))
      {
        return false;
      }
    }
  }
  return words.isAtEnd();
}

}

std::string VoxelAccumulator::serialize()
{
  std::string bytes;
  if (!this->settle())
  {
    return bytes;
  }
  const VoxelRun& run = added_->runs.whole();
  Header header = { lattice_, covariances_, VoxelResampler::Implementation::fractionBitsOf(lattice_),
    added_->points, added_->clipped, added_->invalid, run.size() };
  bytes.assign(kMagic, sizeof kMagic);
  bytes.resize(kHeaderBytes + run.size() * bytesOfVoxel(header));
  char* to = bytes.data() + sizeof kMagic;
  const auto putNext = [&](const auto& number) { to = put(to, number); };
  forNumbers(header, putNext);
  for (std::size_t v = 0; v < run.size(); ++v)
  {
    const VoxelSums voxel = run.voxels[v].whole();
    forNumbers(voxel, run.momentsOf(v), putNext);
  }
  putArrays(bytes, { arrays_, common_ }, run);
  return bytes;
}

Status VoxelAccumulator::deserialize(std::string_view bytes, VoxelAccumulator& result)
{
  Header header;
  if (!readHeader(bytes, header))
  {
    return Status::InvalidParameter;
  }
  const int fractionBits = VoxelResampler::Implementation::fractionBitsOf(header.lattice);
  const std::uint64_t keys = header.lattice.key(0, 0, header.lattice.dimensions[2]);
  VoxelRun run;
  Arrays arrays;
  const std::size_t ofVoxels = std::size_t(header.voxels) * bytesOfVoxel(header);
  WordReader words(bytes.substr(kHeaderBytes + ofVoxels));
  if ((header.fractionBits != fractionBits && (header.voxels > 0 || header.fractionBits != 0)) ||
    !readVoxels(bytes.data() + kHeaderBytes, header, keys, run) || !readKinds(words, arrays) ||
    !readTallies(words, arrays, run))
  {
    return Status::InvalidParameter;
  }
  VoxelAccumulator read(header.lattice, header.covariances == 1, arrays.kinds, arrays.common);
  read.added_->points = header.points;
  read.added_->clipped = header.clipped;
  read.added_->invalid = header.invalid;
  read.added_->runs.add(std::move(run));
  result = std::move(read);
  return Status::Ok;
}

} // namespace pointhaptics
