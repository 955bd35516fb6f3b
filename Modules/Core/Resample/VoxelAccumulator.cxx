#include "Core/Resample/VoxelAccumulator.h"

#include "Core/Resample/Stages/VoxelRuns.h"
#include "Core/Resample/VoxelResamplerImplementation.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <utility>

namespace pointhaptics
{

using namespace simd;

/// Sums of the points of some calls.
class VoxelAccumulator::Sums
{
public:
  VoxelRuns runs;
  std::int64_t points = 0;
  std::int64_t clipped = 0;
  std::int64_t invalid = 0;
};

namespace
{

constexpr char kMagic[8] = { 'P', 'H', 'V', 'o', 'x', 'e', 'l', '1' };

/// a - b of what fits 85 bits. @return false where b is more.
bool subtractSums(const WideSums& a, const WideSums& b, WideSums& difference)
{
  VoxelSums sums = a.whole();
  const VoxelSums other = b.whole();
  sums.count -= other.count;
  bool isRight = sums.count >= 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    sums.sums[axis] -= other.sums[axis];
    isRight = isRight && sums.sums[axis] >= 0 && (sums.count > 0 || sums.sums[axis] == 0);
  }
  difference = WideSums::of(sums);
  return isRight;
}

/// @return false where @p b has more than @p a.
bool subtractRun(const VoxelRun& a, const VoxelRun& b, VoxelRun& difference)
{
  std::size_t j = 0;
  for (std::size_t i = 0; i < a.voxels.size(); ++i)
  {
    const bool isIn = j < b.voxels.size() && b.voxels[j].key == a.voxels[i].key;
    WideSums left = a.voxels[i];
    if (isIn && !subtractSums(a.voxels[i], b.voxels[j], left))
    {
      return false;
    }
    SecondMoments moments = a.momentsOf(i) ? *a.momentsOf(i) : SecondMoments{};
    for (int m = 0; isIn && b.momentsOf(j) && m < 6; ++m)
    {
      moments.lanes[m] -= b.momentsOf(j)->lanes[m];
    }
    if (left.count > 0)
    {
      difference.push(left, a.momentsOf(i) ? &moments : nullptr);
    }
    j += isIn;
  }
  return j == b.voxels.size();
}

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

bool sameLattice(const Lattice& a, const Lattice& b)
{
  return a.origin == b.origin && a.spacing == b.spacing && a.dimensions == b.dimensions && a.end == b.end;
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

/// @return false for what no accumulator writes, a number of bytes that are not its voxels included.
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
  return header.covariances <= 1 && header.voxels == left / bytesOfVoxel(header) &&
    left % bytesOfVoxel(header) == 0 && isCount(header.points) && isCount(header.clipped) &&
    isCount(header.invalid) && lattice.check() == Status::Ok && !std::isnan(lattice.end.x) &&
    !std::isnan(lattice.end.y) && !std::isnan(lattice.end.z);
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

}

VoxelAccumulator::VoxelAccumulator(const Lattice& lattice, bool covariances)
  : added_(std::make_unique<Sums>())
  , subtracted_(std::make_unique<Sums>())
  , lattice_(lattice)
  , covariances_(covariances)
{
}

VoxelAccumulator::~VoxelAccumulator() = default;
VoxelAccumulator::VoxelAccumulator(VoxelAccumulator&&) noexcept = default;
VoxelAccumulator& VoxelAccumulator::operator=(VoxelAccumulator&&) noexcept = default;

const Lattice& VoxelAccumulator::lattice() const
{
  return lattice_;
}

bool VoxelAccumulator::hasCovariances() const
{
  return covariances_;
}

std::int64_t VoxelAccumulator::points() const
{
  return added_->points - subtracted_->points;
}

std::int64_t VoxelAccumulator::clippedPoints() const
{
  return added_->clipped - subtracted_->clipped;
}

std::int64_t VoxelAccumulator::invalidPoints() const
{
  return added_->invalid - subtracted_->invalid;
}

Status VoxelAccumulator::change(Sums& sums, const PointView& points, const AffineTransform& transform,
  const Executor& executor, ProgressObserver* observer)
{
  if (points.size() > kMostPoints - sums.points)
  {
    return Status::InvalidParameter;
  }
  VoxelRequest request;
  request.points = points;
  request.transform = transform;
  request.lattice = lattice_;
  request.covariances = covariances_;
  VoxelRun run;
  VoxelResampler::Implementation& engine = *engine_.implementation_;
  const Status status = engine.sum(request, run, executor, observer);
  if (status != Status::Ok)
  {
    return status;
  }
  sums.points += points.size();
  sums.clipped += engine.clipped;
  sums.invalid += engine.invalid;
  sums.runs.add(std::move(run));
  return Status::Ok;
}

Status VoxelAccumulator::add(const PointView& points, const AffineTransform& transform,
  const Executor& executor, ProgressObserver* observer)
{
  return this->change(*added_, points, transform, executor, observer);
}

Status VoxelAccumulator::subtract(const PointView& points, const AffineTransform& transform,
  const Executor& executor, ProgressObserver* observer)
{
  return this->change(*subtracted_, points, transform, executor, observer);
}

Status VoxelAccumulator::merge(VoxelAccumulator&& other)
{
  const auto fits = [](const Sums& a, const Sums& b) { return b.points <= kMostPoints - a.points; };
  if (!sameLattice(lattice_, other.lattice_) || covariances_ != other.covariances_ ||
    !fits(*added_, *other.added_) || !fits(*subtracted_, *other.subtracted_))
  {
    return Status::InvalidParameter;
  }
  const auto mergeSums = [](Sums& to, Sums& from)
  {
    to.points += from.points;
    to.clipped += from.clipped;
    to.invalid += from.invalid;
    to.runs.add(std::move(from.runs.whole()));
  };
  mergeSums(*added_, *other.added_);
  mergeSums(*subtracted_, *other.subtracted_);
  other = VoxelAccumulator(lattice_, covariances_);
  return Status::Ok;
}

Status VoxelAccumulator::merge(const VoxelAccumulator& other)
{
  VoxelAccumulator copy(other.lattice_, other.covariances_);
  *copy.added_ = *other.added_;
  *copy.subtracted_ = *other.subtracted_;
  return this->merge(std::move(copy));
}

/// Takes what was subtracted out of what was added. @return false where that is not possible.
bool VoxelAccumulator::settle()
{
  if (subtracted_->points == 0)
  {
    return true;
  }
  VoxelRun difference;
  if (this->clippedPoints() < 0 || this->invalidPoints() < 0 ||
    !subtractRun(added_->runs.whole(), subtracted_->runs.whole(), difference))
  {
    return false;
  }
  auto left = std::make_unique<Sums>();
  left->points = this->points();
  left->clipped = this->clippedPoints();
  left->invalid = this->invalidPoints();
  left->runs.add(std::move(difference));
  added_ = std::move(left);
  subtracted_ = std::make_unique<Sums>();
  return true;
}

Status VoxelAccumulator::finish(
  const Request& wanted, VoxelResampler& result, const Executor& executor, ProgressObserver* observer)
{
  if (!this->settle())
  {
    return Status::InvalidParameter;
  }
  VoxelRequest request;
  request.lattice = lattice_;
  request.covariances = covariances_;
  request.singlePrecision = wanted.singlePrecision;
  request.keys = wanted.keys;
  request.levels = wanted.levels;
  request.instructions = wanted.instructions;
  request.allocator = wanted.allocator;
  VoxelResampler::Implementation& engine = *result.implementation_;
  const Status status = engine.finishSums(request, added_->runs.whole(), executor, observer);
  if (status == Status::Ok)
  {
    engine.clipped = added_->clipped;
    engine.invalid = added_->invalid;
  }
  return status;
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
  return bytes;
}

VoxelAccumulator VoxelAccumulator::part(std::uint64_t first, std::uint64_t end)
{
  VoxelAccumulator part(lattice_, covariances_);
  if (!this->settle())
  {
    return part;
  }
  const VoxelRun& run = added_->runs.whole();
  const std::size_t begin = run.find(first);
  VoxelRun copy;
  copy.append(run, begin, std::max(begin, run.find(end)));
  Sums& sums = *part.added_;
  if (first == 0 && end > 0)
  {
    sums.clipped = added_->clipped;
    sums.invalid = added_->invalid;
  }
  sums.points = std::accumulate(copy.voxels.begin(), copy.voxels.end(), sums.clipped + sums.invalid,
    [](std::int64_t sum, const WideSums& voxel) { return sum + voxel.count; });
  sums.runs.add(std::move(copy));
  return part;
}

std::vector<std::uint64_t> VoxelAccumulator::keys(std::int64_t step)
{
  std::vector<std::uint64_t> keys;
  if (this->settle())
  {
    const VoxelRun& run = added_->runs.whole();
    keys.reserve(run.size() / std::size_t(step) + 1);
    for (std::size_t v = 0; v < run.size(); v += std::size_t(step))
    {
      keys.push_back(run.voxels[v].key);
    }
  }
  return keys;
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
  if ((header.fractionBits != fractionBits && (header.voxels > 0 || header.fractionBits != 0)) ||
    !readVoxels(bytes.data() + kHeaderBytes, header, keys, run))
  {
    return Status::InvalidParameter;
  }
  VoxelAccumulator read(header.lattice, header.covariances == 1);
  read.added_->points = header.points;
  read.added_->clipped = header.clipped;
  read.added_->invalid = header.invalid;
  read.added_->runs.add(std::move(run));
  result = std::move(read);
  return Status::Ok;
}

} // namespace pointhaptics
