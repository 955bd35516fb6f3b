#include "Core/Resample/VoxelAccumulator.h"

#include "Core/Resample/VoxelResamplerImplementation.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <utility>

namespace pointhaptics
{

using namespace simd;

/// Sums of the points of some calls.
class VoxelAccumulator::Sums
{
public:
  Sums() { runs.reset(1, 0); }

  VoxelRuns runs; ///< One range.
  int fractionBits = 0;
  std::int64_t points = 0;
  std::int64_t clipped = 0;
  std::int64_t invalid = 0;

  /// @pre all runs are joined.
  const VoxelRun& run()
  {
    static const VoxelRun none;
    runs.join(0);
    return runs.size(0) > 0 ? runs.run(0) : none;
  }
  /// Leaves none.
  VoxelRun takeRun()
  {
    runs.join(0);
    return runs.take(0);
  }
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

/// Collects words and appends them at once.
class WordWriter
{
public:
  template <typename T>
  void put(T value)
  {
    // Byte by byte: the order does not depend on the machine.
    static_assert(sizeof(T) == 8, "words of 64 bits");
    std::uint64_t word;
    std::memcpy(&word, &value, sizeof word);
    for (std::size_t i = 0; i < sizeof word; ++i)
    {
      words_[size_++] = char(word >> (8 * i) & 255);
    }
  }
  void appendTo(std::string& bytes)
  {
    bytes.append(words_, size_);
    size_ = 0;
  }

private:
  char words_[32 * sizeof(std::uint64_t)];
  std::size_t size_ = 0;
};

void putVoxel(WordWriter& words, const VoxelSums& sums, const SecondMoments* moments)
{
  words.put(sums.key);
  words.put(sums.count);
  for (const Int128 sum : sums.sums)
  {
    words.put(std::uint64_t(sum));
    words.put(std::uint64_t(sum >> 64));
  }
  for (int m = 0; moments && m < 6; ++m)
  {
    words.put(std::uint64_t(moments->lanes[m]));
    words.put(std::uint64_t(moments->lanes[m] >> 64));
  }
}

/// Takes words off the front of bytes that are as many as were asked for.
class WordReader
{
public:
  explicit WordReader(std::string_view bytes)
    : bytes_(bytes)
  {
  }
  template <typename T = std::uint64_t>
  T take()
  {
    std::uint64_t word = 0;
    for (int shift = 0; shift < 64; shift += 8)
    {
      word |= std::uint64_t(static_cast<unsigned char>(bytes_.front())) << shift;
      bytes_.remove_prefix(1);
    }
    T value;
    std::memcpy(&value, &word, sizeof value);
    return value;
  }

private:
  std::string_view bytes_;
};

constexpr std::size_t kHeaderWords = 12 + 6;
constexpr std::size_t kVoxelWords = 2 + 6;
constexpr std::size_t kMomentWords = 12;
constexpr std::size_t kHeaderBytes = sizeof kMagic + kHeaderWords * sizeof(std::uint64_t);

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
  WordReader reader(bytes.substr(sizeof kMagic));
  Lattice& lattice = header.lattice;
  for (int axis = 0; axis < 3; ++axis)
  {
    lattice.origin[axis] = reader.take<double>();
    lattice.spacing[axis] = reader.take<double>();
    lattice.dimensions[std::size_t(axis)] = reader.take<std::int64_t>();
    lattice.end[axis] = reader.take<double>();
  }
  header.covariances = reader.take();
  header.fractionBits = reader.take<std::int64_t>();
  header.points = reader.take<std::int64_t>();
  header.clipped = reader.take<std::int64_t>();
  header.invalid = reader.take<std::int64_t>();
  header.voxels = reader.take();
  const std::size_t stride = sizeof(std::uint64_t) * (kVoxelWords + (header.covariances ? kMomentWords : 0));
  const std::size_t left = bytes.size() - kHeaderBytes;
  return header.covariances <= 1 && header.voxels == left / stride && left % stride == 0 &&
    isCount(header.points) && isCount(header.clipped) && isCount(header.invalid) &&
    lattice.check() == Status::Ok && !std::isnan(lattice.end.x) && !std::isnan(lattice.end.y) &&
    !std::isnan(lattice.end.z);
}

/// @return false where a mean would not lie in its voxel.
bool readSums(WordReader& reader, std::int64_t fractionBits, VoxelSums& voxel)
{
  bool fits = isCount(voxel.count) && voxel.count > 0;
  for (Int128& sum : voxel.sums)
  {
    const std::uint64_t low = reader.take();
    const std::uint64_t high = reader.take();
    fits = fits && high >> WideSums::kHighBits == 0;
    sum = Int128(UInt128(high) << 64 | low);
    fits = fits && sum < Int128(voxel.count) << fractionBits;
  }
  return fits;
}

/// @param keys above all of the lattice. @pre the bytes are as many as the header says.
bool readVoxels(std::string_view bytes, const Header& header, std::uint64_t keys, VoxelRun& run)
{
  WordReader reader(bytes);
  std::int64_t points = header.clipped + header.invalid;
  run.voxels.reserve(header.voxels);
  run.secondMoments.reserve(header.covariances ? header.voxels : 0);
  for (std::uint64_t v = 0; v < header.voxels; ++v)
  {
    VoxelSums voxel{ reader.take(), reader.take<std::int64_t>(), {} };
    if (!readSums(reader, header.fractionBits, voxel) || voxel.key >= keys ||
      (v > 0 && voxel.key <= run.voxels.back().key) || voxel.count > header.points - points)
    {
      return false;
    }
    points += voxel.count;
    SecondMoments moments{};
    for (int m = 0; header.covariances && m < 6; ++m)
    {
      const std::uint64_t low = reader.take();
      moments.lanes[m] = UInt128(reader.take()) << 64 | low;
    }
    run.push(WideSums::of(voxel), header.covariances ? &moments : nullptr);
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
  const Status status = engine.sum(request, run, sums.fractionBits, executor, observer);
  if (status != Status::Ok)
  {
    return status;
  }
  sums.points += points.size();
  sums.clipped += engine.clipped;
  sums.invalid += engine.invalid;
  sums.runs.add(0, std::move(run));
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
    to.fractionBits = std::max(to.fractionBits, from.fractionBits);
    to.runs.add(0, from.takeRun());
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
    !subtractRun(added_->run(), subtracted_->run(), difference))
  {
    return false;
  }
  auto left = std::make_unique<Sums>();
  left->fractionBits = added_->fractionBits;
  left->points = this->points();
  left->clipped = this->clippedPoints();
  left->invalid = this->invalidPoints();
  left->runs.add(0, std::move(difference));
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
  const Status status = engine.finishSums(request, added_->run(), added_->fractionBits, executor, observer);
  if (status == Status::Ok)
  {
    engine.clipped = added_->clipped;
    engine.invalid = added_->invalid;
  }
  return status;
}

std::string VoxelAccumulator::serialize()
{
  return this->serialize(0, std::numeric_limits<std::uint64_t>::max());
}

std::string VoxelAccumulator::serialize(std::uint64_t first, std::uint64_t end)
{
  std::string bytes;
  if (!this->settle())
  {
    return bytes;
  }
  const VoxelRun& run = added_->run();
  const auto place = [&run](std::uint64_t key)
  {
    return std::size_t(std::lower_bound(run.voxels.begin(), run.voxels.end(), key,
                         [](const WideSums& voxel, std::uint64_t k) { return voxel.key < k; }) -
      run.voxels.begin());
  };
  const std::size_t begin = place(first);
  const std::size_t last = std::max(begin, place(end));
  const bool isFirst = first == 0 && end > 0;
  const std::int64_t clipped = isFirst ? added_->clipped : 0;
  const std::int64_t invalid = isFirst ? added_->invalid : 0;
  const std::int64_t points =
    std::accumulate(run.voxels.begin() + std::ptrdiff_t(begin), run.voxels.begin() + std::ptrdiff_t(last),
      clipped + invalid, [](std::int64_t sum, const WideSums& voxel) { return sum + voxel.count; });
  const std::size_t words = kHeaderWords + (last - begin) * (kVoxelWords + (covariances_ ? kMomentWords : 0));
  bytes.reserve(sizeof kMagic + words * sizeof(std::uint64_t));
  bytes.append(kMagic, sizeof kMagic);
  WordWriter writer;
  for (int axis = 0; axis < 3; ++axis)
  {
    writer.put(lattice_.origin[axis]);
    writer.put(lattice_.spacing[axis]);
    writer.put(lattice_.dimensions[std::size_t(axis)]);
    writer.put(lattice_.end[axis]);
  }
  for (const std::int64_t number : { std::int64_t(covariances_), std::int64_t(added_->fractionBits), points,
         clipped, invalid, std::int64_t(last - begin) })
  {
    writer.put(number);
  }
  writer.appendTo(bytes);
  for (std::size_t v = begin; v < last; ++v)
  {
    putVoxel(writer, run.voxels[v].whole(), run.momentsOf(v));
    writer.appendTo(bytes);
  }
  return bytes;
}

std::vector<std::uint64_t> VoxelAccumulator::keys(std::int64_t step)
{
  std::vector<std::uint64_t> keys;
  if (!this->settle())
  {
    return keys;
  }
  const std::vector<WideSums>& voxels = added_->run().voxels;
  for (std::size_t v = 0; v < voxels.size(); v += std::size_t(step))
  {
    keys.push_back(voxels[v].key);
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
  const int indexBits = indexBitsOf(header.lattice);
  const int fractionBits = positionBitsFor(indexBits) - indexBits;
  const std::uint64_t keys = header.lattice.key(0, 0, header.lattice.dimensions[2]);
  VoxelRun run;
  if ((header.fractionBits != fractionBits && (header.voxels > 0 || header.fractionBits != 0)) ||
    !readVoxels(bytes.substr(kHeaderBytes), header, keys, run))
  {
    return Status::InvalidParameter;
  }
  VoxelAccumulator read(header.lattice, header.covariances == 1);
  read.added_->points = header.points;
  read.added_->clipped = header.clipped;
  read.added_->invalid = header.invalid;
  read.added_->fractionBits = int(header.fractionBits);
  read.added_->runs.add(0, std::move(run));
  result = std::move(read);
  return Status::Ok;
}

} // namespace pointhaptics
