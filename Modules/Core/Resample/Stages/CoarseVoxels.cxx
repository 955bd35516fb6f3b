#include "Core/Resample/Stages/CoarseVoxels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace pointhaptics
{
namespace simd
{
namespace
{

constexpr std::uint64_t kNoKey = ~std::uint64_t(0);
/// Sums of so many coarse voxels side by side stay in the second-level cache.
constexpr std::size_t kMostSummedColumns = 2048;
constexpr SecondMoments kNoSecondMoments = { { 0, 0, 0, 0, 0, 0 } };

}

Lattice finerLattice(const Lattice& lattice, int halvings)
{
  Lattice fine = lattice;
  for (int axis = 0; axis < 3; ++axis)
  {
    fine.dimensions[std::size_t(axis)] = lattice.dimensions[std::size_t(axis)] << halvings;
    fine.spacing[axis] = std::ldexp(lattice.spacing[axis], -halvings);
    fine.end[axis] = std::ldexp(lattice.end[axis], halvings);
  }
  return fine;
}

void CoarseRow::prepare(std::int64_t fineColumns, int fractionBits, bool withSecondMoments)
{
  const auto columns = std::size_t(fineColumns + 1) / 2;
  fractionBits_ = fractionBits;
  withSecondMoments_ = withSecondMoments;
  isListed_ = columns > kMostSummedColumns;
  if (!isListed_)
  {
    occupancy_.resize(std::max(occupancy_.size(), (columns + 63) / 64));
    sums_.resize(std::max(sums_.size(), columns));
    secondMoments_.resize(
      withSecondMoments ? std::max(secondMoments_.size(), columns) : secondMoments_.size());
  }
}

/// Offsets grow by half a coarse voxel where the index is odd. No branch here depends on the voxel: it would
/// be unpredictable.
template <typename Sum>
inline void CoarseRow::add(std::uint64_t x, Parity parity, std::int64_t count, const Sum (&sums)[3],
  const SecondMoments* secondMoments)
{
  auto column = std::size_t(x / 2);
  if (isListed_)
  {
    sums_.push_back({ column, 0, { 0, 0, 0 } });
    secondMoments_.resize(withSecondMoments_ ? sums_.size() : 0, kNoSecondMoments);
    column = sums_.size() - 1;
  }
  else
  {
    occupancy_[column / 64] |= std::uint64_t(1) << (column % 64);
  }
  // All bits, or none. What moves is of the size of the sums.
  const Sum odd[3] = { -Sum(x % 2), -Sum(parity.y), -Sum(parity.z) };
  const Sum moved = Sum(count) << fractionBits_;
  VoxelSums& to = sums_[column];
  to.count += count;
  for (int axis = 0; axis < 3; ++axis)
  {
    to.sums[axis] += sums[axis] + (odd[axis] & moved);
  }
  if (!withSecondMoments_)
  {
    return;
  }
  constexpr int kRows[6] = { 0, 1, 2, 0, 1, 0 };
  constexpr int kColumns[6] = { 0, 1, 2, 1, 2, 2 };
  const UInt128 movedSums[3] = { UInt128(sums[0]) << fractionBits_, UInt128(sums[1]) << fractionBits_,
    UInt128(sums[2]) << fractionBits_ };
  const UInt128 twice = UInt128(moved) << fractionBits_;
  for (int m = 0; m < 6; ++m)
  {
    const int a = kRows[m];
    const int b = kColumns[m];
    secondMoments_[column].lanes[m] += (secondMoments ? secondMoments->lanes[m] : 0) +
      (UInt128(odd[a]) & movedSums[b]) + (UInt128(odd[b]) & movedSums[a]) +
      (UInt128(odd[a] & odd[b]) & twice);
  }
}

void CoarseRow::append(
  const VoxelSums& sums, const SecondMoments* secondMoments, std::uint64_t firstKey, VoxelRun& run) const
{
  run.voxels.push_back(WideSums::of(sums));
  run.voxels.back().key += firstKey;
  if (withSecondMoments_)
  {
    run.secondMoments.push_back(*secondMoments);
  }
}

void CoarseRow::flush(std::uint64_t firstKey, VoxelRun& run)
{
  if (isListed_)
  {
    flushListed(firstKey, run);
    return;
  }
  for (std::size_t word = 0; word < occupancy_.size(); ++word)
  {
    for (std::uint64_t left = occupancy_[word]; left != 0; left &= left - 1)
    {
      const std::size_t column = 64 * word + std::size_t(__builtin_ctzll(left));
      append(sums_[column], secondMoments_.data() + column, firstKey + column, run);
      sums_[column] = VoxelSums{ 0, 0, { 0, 0, 0 } };
      if (withSecondMoments_)
      {
        secondMoments_[column] = kNoSecondMoments;
      }
    }
    occupancy_[word] = 0;
  }
}

void CoarseRow::flushListed(std::uint64_t firstKey, VoxelRun& run)
{
  order_.resize(sums_.size());
  std::iota(order_.begin(), order_.end(), 0u);
  std::sort(order_.begin(), order_.end(),
    [this](std::uint32_t a, std::uint32_t b) { return sums_[a].key < sums_[b].key; });
  for (std::size_t i = 0; i < order_.size();)
  {
    VoxelSums sum = sums_[order_[i]];
    SecondMoments second = withSecondMoments_ ? secondMoments_[order_[i]] : kNoSecondMoments;
    for (++i; i < order_.size() && sums_[order_[i]].key == sum.key; ++i)
    {
      sum.count += sums_[order_[i]].count;
      for (int axis = 0; axis < 3; ++axis)
      {
        sum.sums[axis] += sums_[order_[i]].sums[axis];
      }
      for (int m = 0; withSecondMoments_ && m < 6; ++m)
      {
        second.lanes[m] += secondMoments_[order_[i]].lanes[m];
      }
    }
    append(sum, &second, firstKey, run);
  }
  sums_.clear();
  secondMoments_.clear();
}

/// A walk through fine voxels in ascending order of their keys.
class CoarseVoxels::FineVoxels
{
public:
  virtual ~FineVoxels() = default;
  /// Goes on to the first voxel with @p begin or more, and ends before @p end.
  virtual void seek(std::uint64_t begin, std::uint64_t end) = 0;
  /// Of the next voxel; kNoKey at the end.
  virtual std::uint64_t key() const = 0;
  /// Adds the voxels of a row, whose first possible one has @p firstKey, and passes them.
  virtual void addRow(
    std::uint64_t firstKey, std::uint64_t size, CoarseRow::Parity parity, CoarseRow& row) = 0;
};

/// Cells of a partition.
struct CoarseVoxels::PackedSpan
{
  std::uint64_t firstKey;
  const AccumulatedPartition* partition;
  int fractionBits;
  bool withSecondMoments;

  std::size_t size() const { return partition->cellCount; }
  std::uint64_t key(std::size_t i) const { return firstKey + partition->cells[i]; }
  void add(std::size_t i, std::uint64_t x, CoarseRow::Parity parity, CoarseRow& row) const
  {
    const PackedSums& packed = partition->packed[i];
    const std::int64_t sums[3] = { std::int64_t(packed.lanes[0]), std::int64_t(packed.lanes[1]),
      packedZ(packed) };
    if (!withSecondMoments)
    {
      row.add(x, parity, packedCount(packed), sums, nullptr);
      return;
    }
    const SecondMoments secondMoments = whole(partition->splitSecondMoments[i], fractionBits);
    row.add(x, parity, packedCount(packed), sums, &secondMoments);
  }
};

/// What a partition's cells could not hold.
struct CoarseVoxels::AccumulatedSpan
{
  const AccumulatedPartition* partition;

  std::size_t size() const { return partition->voxels.size(); }
  std::uint64_t key(std::size_t i) const { return partition->voxels[i].key; }
  void add(std::size_t i, std::uint64_t x, CoarseRow::Parity parity, CoarseRow& row) const
  {
    row.add(x, parity, partition->voxels[i].count, partition->voxels[i].sums, nullptr);
  }
};

struct CoarseVoxels::WideSpan
{
  const VoxelRun* run;

  std::size_t size() const { return run->voxels.size(); }
  std::uint64_t key(std::size_t i) const { return run->voxels[i].key; }
  void add(std::size_t i, std::uint64_t x, CoarseRow::Parity parity, CoarseRow& row) const
  {
    const VoxelSums voxel = run->voxels[i].whole();
    row.add(
      x, parity, voxel.count, voxel.sums, run->secondMoments.empty() ? nullptr : &run->secondMoments[i]);
  }
};

/// Through spans, one after the other.
template <class Span>
class CoarseVoxels::Chain : public FineVoxels
{
public:
  explicit Chain(const std::vector<Span>& spans)
    : spans_(spans)
  {
  }
  void seek(std::uint64_t begin, std::uint64_t end) override
  {
    end_ = end;
    const auto endsBefore = [&](const Span& span)
    { return span.size() == 0 || span.key(span.size() - 1) < begin; };
    while (span_ < spans_.size() && endsBefore(spans_[span_]))
    {
      ++span_;
      at_ = 0;
    }
    if (span_ == spans_.size())
    {
      return;
    }
    const Span& span = spans_[span_];
    std::size_t last = span.size();
    while (at_ < last)
    {
      const std::size_t middle = at_ + (last - at_) / 2;
      span.key(middle) < begin ? at_ = middle + 1 : last = middle;
    }
  }
  std::uint64_t key() const override
  {
    const std::uint64_t next = span_ < spans_.size() ? spans_[span_].key(at_) : kNoKey;
    return next < end_ ? next : kNoKey;
  }
  void addRow(std::uint64_t firstKey, std::uint64_t size, CoarseRow::Parity parity, CoarseRow& row) override
  {
    // A row may go on in the next span; a layer may end with the first of two rows.
    const std::uint64_t end = std::min(firstKey + size, end_);
    while (span_ < spans_.size())
    {
      const Span& span = spans_[span_];
      for (; at_ < span.size(); ++at_)
      {
        const std::uint64_t key = span.key(at_);
        if (key >= end)
        {
          return;
        }
        span.add(at_, key - firstKey, parity, row);
      }
      do
      {
        ++span_;
      } while (span_ < spans_.size() && spans_[span_].size() == 0);
      at_ = 0;
    }
  }

private:
  const std::vector<Span>& spans_;
  std::size_t span_ = 0;
  std::size_t at_ = 0;
  std::uint64_t end_ = kNoKey;
};

CoarseVoxels::CoarseVoxels(const Lattice& fine, int fractionBits, bool withSecondMoments)
  : fine_(fine)
  , coarse_(coarserLattice(fine))
  , fractionBits_(fractionBits)
  , withSecondMoments_(withSecondMoments)
  , rowKeys_(std::uint64_t(fine.dimensions[0]))
  , layerKeys_(rowKeys_ * std::uint64_t(fine.dimensions[1]))
{
}

VoxelRun CoarseVoxels::ofPartitions(const PartitionPlan& plan,
  const std::vector<AccumulatedPartition>& partitions, std::uint32_t first, std::uint32_t last,
  Scratch& scratch) const
{
  std::vector<PackedSpan> packed;
  std::vector<AccumulatedSpan> accumulated;
  for (std::uint32_t p = first; p < last; ++p)
  {
    packed.push_back({ plan.firstKey(p), &partitions[p], fractionBits_, withSecondMoments_ });
    accumulated.push_back({ &partitions[p] });
  }
  Chain<PackedSpan> packedVoxels[2] = { Chain<PackedSpan>(packed), Chain<PackedSpan>(packed) };
  Chain<AccumulatedSpan> accumulatedVoxels[2] = { Chain<AccumulatedSpan>(accumulated),
    Chain<AccumulatedSpan>(accumulated) };
  const Sources sources = { { &packedVoxels[0], &accumulatedVoxels[0] },
    { &packedVoxels[1], &accumulatedVoxels[1] } };
  return sumLayers(sources, coarseLayerOf(plan.firstKey(first)), kNoKey, scratch);
}

bool CoarseVoxels::ofRuns(
  const VoxelRuns& fine, VoxelRuns& coarse, const Executor& executor, ProgressObserver* observer) const
{
  if (coarse_.dimensions == fine_.dimensions)
  {
    coarse = fine;
    return true;
  }
  std::vector<WideSpan> spans;
  std::vector<std::size_t> offsets = { 0 };
  for (std::size_t range = 0; range < fine.ranges(); ++range)
  {
    if (fine.size(range) > 0)
    {
      spans.push_back({ &fine.run(range) });
      offsets.push_back(offsets.back() + fine.size(range));
    }
  }
  const std::size_t size = offsets.back();
  // Rounds of pieces for the threads, with a report after each round.
  const std::size_t rounds = size / std::size_t(kPointsPerReport) + 1;
  const auto piecesOfRound = std::size_t(16 * executor.concurrency());
  const std::size_t pieces = rounds * piecesOfRound;
  std::vector<std::uint64_t> firstLayers(pieces + 1, kNoKey);
  for (std::size_t piece = 0; piece < pieces && size > 0; ++piece)
  {
    const std::size_t voxel = size * piece / pieces;
    const auto span =
      std::size_t(std::upper_bound(offsets.begin(), offsets.end(), voxel) - offsets.begin()) - 1;
    firstLayers[piece] = coarseLayerOf(spans[span].key(voxel - offsets[span]));
  }
  PointProgress progress(observer, std::int64_t(size), 1);
  coarse.reset(pieces, fractionBits_ + 1);
  for (std::size_t round = 0; round < rounds; ++round)
  {
    const std::size_t first = round * piecesOfRound;
    forEachItem<Scratch>(executor, piecesOfRound,
      [&](std::size_t i, Scratch& scratch)
      {
        const std::size_t piece = first + i;
        Chain<WideSpan> voxels[2] = { Chain<WideSpan>(spans), Chain<WideSpan>(spans) };
        const Sources sources = { { &voxels[0] }, { &voxels[1] } };
        coarse.add(piece, sumLayers(sources, firstLayers[piece], firstLayers[piece + 1], scratch));
      });
    if (!progress.add(std::int64_t(size * (first + piecesOfRound) / pieces - size * first / pieces)))
    {
      return false;
    }
  }
  return true;
}

VoxelRun CoarseVoxels::sumLayers(
  const Sources& sources, std::uint64_t firstLayer, std::uint64_t lastLayer, Scratch& scratch) const
{
  scratch.row.prepare(fine_.dimensions[0], fractionBits_, withSecondMoments_);
  scratch.run.voxels.clear();
  scratch.run.secondMoments.clear();
  for (std::uint64_t layer = firstLayer; layer < lastLayer; ++layer)
  {
    std::uint64_t next = kNoKey;
    for (FineVoxels* voxels : sources[0])
    {
      voxels->seek(2 * layer * layerKeys_, kNoKey);
      next = std::min(next, voxels->key());
    }
    if (next == kNoKey || coarseLayerOf(next) >= lastLayer)
    {
      break;
    }
    layer = coarseLayerOf(next);
    sumLayer(sources, layer, scratch);
  }
  // A copy: exactly as large as it need be.
  return VoxelRun(scratch.run);
}

void CoarseVoxels::sumLayer(const Sources& sources, std::uint64_t layer, Scratch& scratch) const
{
  const std::uint64_t firstKeys[2] = { 2 * layer * layerKeys_, (2 * layer + 1) * layerKeys_ };
  for (int z = 0; z < 2; ++z)
  {
    for (FineVoxels* voxels : sources[z])
    {
      voxels->seek(firstKeys[z], firstKeys[z] + layerKeys_);
    }
  }
  while (true)
  {
    std::uint64_t coarseRow = kNoKey;
    for (int z = 0; z < 2; ++z)
    {
      for (const FineVoxels* voxels : sources[z])
      {
        const std::uint64_t next = voxels->key();
        coarseRow = next == kNoKey ? coarseRow : std::min(coarseRow, (next - firstKeys[z]) / rowKeys_ / 2);
      }
    }
    if (coarseRow == kNoKey)
    {
      return;
    }
    for (int z = 0; z < 2; ++z)
    {
      const std::uint64_t firstKey = firstKeys[z] + 2 * coarseRow * rowKeys_;
      for (FineVoxels* voxels : sources[z])
      {
        voxels->addRow(firstKey, rowKeys_, { false, z == 1 }, scratch.row);
        voxels->addRow(firstKey + rowKeys_, rowKeys_, { true, z == 1 }, scratch.row);
      }
    }
    scratch.row.flush(coarse_.key(0, std::int64_t(coarseRow), std::int64_t(layer)), scratch.run);
  }
}

bool findParents(const std::uint64_t* fineKeys, std::int64_t fineVoxels, const Lattice& fine,
  const std::uint64_t* coarseKeys, std::int64_t coarseVoxels, const Lattice& coarse,
  std::vector<std::int64_t>& parents, const Executor& executor, ProgressObserver* observer)
{
  parents.resize(std::size_t(fineVoxels));
  const auto columns = std::uint64_t(fine.dimensions[0]);
  const auto find = [&](std::int64_t begin, std::int64_t end)
  {
    std::uint64_t rowBegin = 0;
    std::uint64_t rowEnd = 0;
    std::uint64_t coarseRow = 0;
    const std::uint64_t* parent = coarseKeys;
    for (std::int64_t v = begin; v < end; ++v)
    {
      const std::uint64_t key = fineKeys[v];
      if (key >= rowEnd)
      {
        const auto index = fine.indexOf(key);
        rowBegin = key - std::uint64_t(index[0]);
        rowEnd = rowBegin + columns;
        coarseRow = coarse.key(0, index[1] / 2, index[2] / 2);
        parent = std::lower_bound(coarseKeys, coarseKeys + coarseVoxels, coarseRow);
      }
      while (*parent < coarseRow + (key - rowBegin) / 2)
      {
        ++parent;
      }
      parents[std::size_t(v)] = parent - coarseKeys;
    }
  };
  PointProgress progress(observer, fineVoxels, 1);
  return forReportedSlices(fineVoxels, progress,
    [&](std::int64_t first, std::int64_t last)
    {
      forRange(executor, last - first,
        [&](std::int64_t begin, std::int64_t end) { find(first + begin, first + end); });
    });
}

} // namespace simd
} // namespace pointhaptics
