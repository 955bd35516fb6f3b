#include "Core/Resample/Stages/PartitionSums.h"

#include "Core/Resample/Kernel/Fetch.h"
#include "Core/Resample/Kernel/InFours.h"
#include "Core/Resample/Stages/VoxelRuns.h"

#include <algorithm>

namespace pointhaptics
{
namespace simd
{
namespace
{

/// Words with an occupancy bit for each cell.
std::size_t occupancyWords(const PartitionPlan& plan)
{
  return (plan.cells() - 1) / 64 + 1;
}

/// A partition is sparse where it has fewer cells in use than one for so many occupancy words: visiting the
/// words in use then takes less time than counting and clearing all.
constexpr std::size_t kWordsPerSparseCell = 3;

/// A cell with so many points is overfull: its sums are moved out of the packed ones.
constexpr std::int64_t kPackedCounts = std::int64_t(1) << 19;
static_assert(kPackedCounts + kChunkPoints < std::int64_t(kMostPackedPoints),
  "a packed sum must hold a chunk in one voxel and the accumulated points");

}

void PartitionWorker::prepare(
  const VoxelRequest& request, const PointBinner& binner, bool reduces, std::int64_t* voxelIndex)
{
  request_ = &request;
  binner_ = &binner;
  kernels_ = &kernelsFor(request.instructions);
  covariances_ = request.covariances;
  reduces_ = reduces;
  voxelIndex_ = request.voxelIndex ? voxelIndex : nullptr;
  reductions_ = reduces ? VoxelReductions(request) : VoxelReductions();
  nearest_.reset();
  if (reduces && keepsPoints(request.representative))
  {
    nearest_.emplace(request, binner.quantizer());
  }
}

/// Memory that grows with the plan is touched by a thread that works.
void PartitionWorker::makeTables()
{
  const std::size_t words = occupancyWords(plan());
  if (occupancy_.reserve(words))
  {
    std::fill(occupancy_.data(), occupancy_.data() + words, 0);
  }
  const std::size_t touchedWords = (words + 63) / 64;
  if (touched_.reserve(touchedWords))
  {
    std::fill(touched_.data(), touched_.data() + touchedWords, 0);
  }
  rankTable_.reserve(words);
}

CellRanks PartitionWorker::ranks() const
{
  return { occupancy_.data(), rankTable_.data(), occupancyWords(plan()) };
}

/// Builds the rank table for the occupied cells, which are those of one list or two.
std::size_t PartitionWorker::rankOccupied(CellList cells, CellList others)
{
  isSparse_ = kWordsPerSparseCell * (cells.count + others.count) < occupancyWords(plan());
  if (!isSparse_)
  {
    return kernels_->rankWords(ranks(), nullptr);
  }
  for (const CellList& list : { cells, others })
  {
    std::uint64_t* const touched = touched_.data(); // which no store can change
    const std::uint32_t* const marked = list.cells;
    fromFourParts(int(list.count),
      [=](int i) { touched[marked[i] / 4096] |= std::uint64_t(1) << (marked[i] / 64 % 64); });
  }
  return kernels_->rankWords(ranks(), touched_.data());
}

/// For the same cells, in any order.
void PartitionWorker::clearOccupancy(CellList cells)
{
  const std::size_t words = occupancyWords(plan());
  if (!isSparse_)
  {
    std::fill(occupancy_.data(), occupancy_.data() + words, 0);
    return;
  }
  for (std::size_t i = 0; i < cells.count; ++i)
  {
    occupancy_[cells.cells[i] / 64] = 0;
  }
  std::fill(touched_.data(), touched_.data() + (words + 63) / 64, 0);
}

/// Sets the occupancy bits of the accumulated cells and of the records, and counts them.
void PartitionWorker::countOccupied()
{
  voxels_ = { plan().cellMap(partition_), plan().firstKey(partition_), nullptr, nullptr, nullptr, 0 };
  std::size_t records = 0;
  for (std::size_t pool = pools_.first; pool < pools_.last; ++pool)
  {
    records += binner_->pool(pool).count(partition_);
  }
  if (records == 0 && old_->cellCount == 0)
  {
    return;
  }
  makeTables();
  recordCells_.reserve(records);
  kernels_->setOccupied(old_->cells.data(), int(old_->cellCount), occupancy_.data());
  // The accumulated sums come next and are in no near cache: prefetch a part of them with each block.
  const auto* line = reinterpret_cast<const char*>(old_->packed.data());
  const std::size_t bytes = old_->cellCount * sizeof(PackedSums);
  const char* end = line + bytes;
  const std::size_t part = bytes * kBlockRecords / std::max<std::size_t>(records, 1);
  std::uint32_t* cells = recordCells_.data();
  forBlocks(
    [&](const PointRecordPool::Walk& block)
    {
      const char* partEnd = line + std::min(part, std::size_t(end - line));
      for (; line < partEnd; line += 64)
      {
        fetchToWrite(line);
      }
      kernels_->cells(voxels_.map, block.records(), block.count(), block.recordsAhead(), cells);
      cells += block.count();
    });
  // All blocks together: records of one block of a scan share words and would wait for each other.
  kernels_->setOccupied(recordCells_.data(), int(records), occupancy_.data());
  voxels_.size = rankOccupied({ recordCells_.data(), records }, { old_->cells.data(), old_->cellCount });
}

std::size_t PartitionWorker::countVoxels(std::uint32_t partition, AccumulatedPartition& old)
{
  const std::size_t records = binner_->count(partition);
  if (records > kMostPackedPoints)
  {
    return mostVoxels(plan(), records, old.cellCount);
  }
  partition_ = partition;
  old_ = &old;
  pools_ = { 0, binner_->pools() };
  countOccupied();
  if (voxels_.size > 0)
  {
    clearOccupancy({ recordCells_.data(), records });
    clearOccupancy({ old.cells.data(), old.cellCount });
  }
  return voxels_.size;
}

/// Adds the records to the sums at @p to, which become the voxels; these are complete where they are
/// reduced.
void PartitionWorker::sumRecords(AccumulatedPartition& to, bool reduces)
{
  if (voxels_.size == 0)
  {
    return;
  }
  if (&to == &own_)
  {
    own_.cellCount = 0;
  }
  places_.assign(to.cells.data(), to.cells.data() + to.cellCount);
  kernels_->rank(ranks(), places_.data(), int(places_.size()));
  makeRoom(to);
  const CellSums sums = { to.cells.data(), to.packed.data(),
    covariances_ ? to.splitSecondMoments.data() : nullptr, covariances_ || reduces };
  voxels_.cells = sums.cells;
  voxels_.sums = sums.sums;
  voxels_.secondMoments = sums.secondMoments;
  std::uint32_t* cells = recordCells_.data();
  for (std::size_t number = pools_.first; number < pools_.last; ++number)
  {
    const PointRecordPool& pool = binner_->pool(number);
    PointRecordPool::Walk following(pool, pool.following(partition_));
    for (PointRecordPool::Walk block(pool, partition_); block.next(); cells += block.count())
    {
      const PointRecord* const next = following.next() ? following.records() : block.records();
      if (reduces)
      {
        block.fetchPayloads(); // for reduce()
      }
      kernels_->accumulate(voxels_.map, ranks(), block.records(), cells, block.count(), next, sums);
    }
  }
  if (reduces)
  {
    reduce();
  }
  clearOccupancy({ voxels_.cells, voxels_.size });
}

/// The records' ranks, where the rank table is that of the partition.
void PartitionWorker::rankRecords()
{
  recordCells_.reserve(binner_->count(partition_));
  pools_ = { 0, binner_->pools() };
  std::uint32_t* cells = recordCells_.data();
  forBlocks(
    [&](const PointRecordPool::Walk& block)
    {
      block.fetchPayloads();
      kernels_->cells(
        plan().cellMap(partition_), block.records(), block.count(), block.recordsAhead(), cells);
      kernels_->rank(ranks(), cells, block.count());
      cells += block.count();
    });
}

/// Reduces the points of the voxels, whose sums are complete.
void PartitionWorker::reduce()
{
  if (pools_.last < binner_->pools())
  {
    rankRecords();
  }
  if (voxelIndex_)
  {
    visitRanked(firstVoxel_,
      [to = voxelIndex_](const RankedBlock& block, const RankedBlock& next)
      {
        for (int i = 0; i < next.count; ++i)
        {
          fetchToWrite(to + next.points[i]);
        }
        for (int i = 0; i < block.count; ++i)
        {
          to[block.points[i]] = block.voxels[i];
        }
      });
  }
  reduceVoxels();
}

/// Reduces what the points have and their places, if asked for.
void PartitionWorker::reduceVoxels()
{
  if (!nearest_ && !reductions_.needsPoints())
  {
    return;
  }
  const std::optional<VoxelRun> all =
    old_->overfull.voxels.empty() ? std::nullopt : std::make_optional(wide());
  counts_.resize(voxels_.size);
  for (std::size_t v = 0; v < voxels_.size; ++v)
  {
    counts_[v] = all ? all->voxels[v].count : packedCount(voxels_.sums[v]);
  }
  if (nearest_)
  {
    nearest_->prepare(voxels_.size,
      [&](std::size_t v)
      { return all ? MeanOffset::of(all->voxels[v].whole()) : MeanOffset::of(voxels_.sums[v]); });
    visitRanked(0,
      [&](const RankedBlock& block, const RankedBlock&)
      { nearest_->add(block.records, block.points, block.voxels, block.count); });
    nearest_->finish();
  }
  reductions_.prepare(counts_.data(), std::int64_t(voxels_.size),
    *std::max_element(counts_.begin(), counts_.end()), {}, nearest_ ? &*nearest_ : nullptr);
  if (reductions_.needsPoints())
  {
    const PayloadLayout& payloads = binner_->payloadLayout();
    visitRanked(0,
      [&](const RankedBlock& block, const RankedBlock& next)
      {
        reductions_.fetch(next.points, next.count, payloads.count);
        reductions_.addPayloads(payloads, block.payloads, block.points, block.voxels, block.count);
      });
  }
}

void PartitionWorker::write(const Kernels& kernels, MeanArena& arena, std::size_t offset) const
{
  old_->overfull.voxels.empty() ? arena.write(kernels, offset, voxels_)
                                : arena.write(offset, this->wide(), 0, voxels_.size);
  if (reduces_ && voxels_.size > 0)
  {
    static_cast<void>(reductions_.write(arena, offset)); // Nobody aborts it.
  }
}

/// Moves sums, which are in ascending order, to their places among all voxels, with zeros between.
void PartitionWorker::makeRoom(AccumulatedPartition& sums) const
{
  const std::size_t size = voxels_.size;
  if (sums.packed.size() < size + kWidest)
  {
    // Room for what another chunk adds, not for twice as much.
    const std::size_t room = size + size / 16 + kWidest;
    sums.cells.reserve(room);
    sums.packed.reserve(room);
    sums.cells.resize(size + kWidest);
    sums.packed.resize(size + kWidest);
  }
  if (covariances_ && sums.splitSecondMoments.size() < size + kWidest)
  {
    sums.splitSecondMoments.reserve(size + size / 16 + kWidest);
    sums.splitSecondMoments.resize(size + kWidest);
  }
  std::size_t end = size; // From here on all are where they belong.
  const auto clearFrom = [&](std::size_t first)
  {
    std::fill(sums.packed.data() + first, sums.packed.data() + end, PackedSums{});
    if (covariances_)
    {
      std::fill(
        sums.splitSecondMoments.data() + first, sums.splitSecondMoments.data() + end, SplitSecondMoments{});
    }
  };
  std::size_t i = sums.cellCount;
  for (; i > 0 && places_[i - 1] > i - 1; --i)
  {
    const std::size_t place = places_[i - 1];
    clearFrom(place + 1);
    sums.cells[place] = sums.cells[i - 1];
    sums.packed[place] = sums.packed[i - 1];
    if (covariances_)
    {
      sums.splitSecondMoments[place] = sums.splitSecondMoments[i - 1];
    }
    end = place;
  }
  clearFrom(i);
  sums.cellCount = size;
}

void PartitionWorker::accumulate(std::uint32_t partition, AccumulatedPartition& sums, std::size_t pool)
{
  partition_ = partition;
  old_ = &sums;
  pools_ = { pool, pool + 1 };
  countOccupied();
  sumRecords(sums, false);
  // No voxel has more points than all have together.
  sums.points += std::int64_t(binner_->pool(pool).count(partition));
  VoxelRun overfull;
  for (std::size_t i = 0; sums.points >= kPackedCounts && i < sums.cellCount; ++i)
  {
    if (packedCount(sums.packed[i]) >= kPackedCounts)
    {
      const SecondMoments moments =
        covariances_ ? whole(sums.splitSecondMoments[i], plan().fractionBits) : SecondMoments{};
      overfull.push(
        WideSums::of(voxels_.firstKey + sums.cells[i], sums.packed[i]), covariances_ ? &moments : nullptr);
      sums.packed[i] = PackedSums{};
      if (covariances_)
      {
        sums.splitSecondMoments[i] = SplitSecondMoments{};
      }
    }
  }
  if (!overfull.voxels.empty())
  {
    sums.overfull = merged(sums.overfull, overfull);
  }
}

VoxelRun PartitionWorker::wide() const
{
  VoxelRun run;
  run.resize(voxels_.size, covariances_);
  for (std::size_t i = 0; i < voxels_.size; ++i)
  {
    run.voxels[i] = WideSums::of(voxels_.firstKey + voxels_.cells[i], voxels_.sums[i]);
  }
  for (std::size_t i = 0; covariances_ && i < voxels_.size; ++i)
  {
    run.secondMoments[i] = whole(voxels_.secondMoments[i], plan().fractionBits);
  }
  return old_->overfull.voxels.empty() ? run : merged(run, old_->overfull);
}

std::size_t PartitionWorker::bytes() const
{
  return occupancy_.bytes() + touched_.bytes() + rankTable_.bytes() + recordCells_.bytes() + own_.bytes();
}

} // namespace simd
} // namespace pointhaptics
