#include "Core/Resample/Stages/PartitionSums.h"

#include "Core/Base/RadixSort.h"
#include "Core/Resample/Kernel/Fetch.h"
#include "Core/Resample/Kernel/InFours.h"

#include <algorithm>
#include <cstring>

namespace pointhaptics
{
namespace kernel
{
namespace
{

/// Most cells of a dense partition: their marks should stay in the second-level cache. (Of their sums, which
/// are those of the few thousand records of a chunk, that is so anyway.)
constexpr std::size_t kDenseCells = std::size_t(1) << 22;
/// More partitions than this crowd the first-level cache while records are dealt out.
constexpr std::uint32_t kMostPartitions = 512;
/// Dense partitions may be more: not having to sort is worth it.
constexpr std::uint32_t kMostDensePartitions = 2048;
/// Fewer points than this in a partition on average are not worth its upkeep: each is a dozen loops that end
/// where the processor does not expect it.
constexpr std::int64_t kPointsPerPartition = 1024;

std::uint32_t blocks(std::uint32_t count, int shift)
{
  return ((count - 1) >> shift) + 1;
}

/// Words of a bit for each cell.
std::size_t markWords(const PartitionPlan& plan)
{
  constexpr std::size_t kGroupCells = 64 * kMarkGroup;
  return ((plan.cells() - 1) / kGroupCells + 1) * kMarkGroup;
}

/// Fewer cells than one for so many words are marked: going from mark to mark takes less than counting and
/// clearing all words.
constexpr std::size_t kWordsPerFew = 3;

/// So many points in one voxel are taken out of the packed sums, which hold less than 2^21.
constexpr std::uint64_t kPackedCounts = std::uint64_t(1) << 19;
static_assert(kPackedCounts + std::uint64_t(kChunkPoints) < (std::uint64_t(1) << 21),
  "a packed sum must hold a chunk in one voxel and what was carried of it");

void addCarried(MomentBatch<std::int64_t>& batch, int i, const CarriedPartition& carried, std::size_t voxel)
{
  const CarriedSums& old = carried.voxels[voxel];
  batch.counts[i] += old.count;
  for (int axis = 0; axis < 3; ++axis)
  {
    batch.sums[axis][i] += old.sums[axis];
  }
  // Where seconds go with the cells they are in the batch already.
  for (int m = 0; carried.cellCount == 0 && batch.seconds && m < 6; ++m)
  {
    batch.seconds[i].lanes[m] += carried.seconds[voxel].lanes[m];
  }
}

/// Moves the elements from @p first to @p last up to @p place.
template <typename T>
void moveUp(std::vector<T>& all, std::size_t first, std::size_t last, std::size_t place)
{
  std::memmove(all.data() + place, all.data() + first, (last - first) * sizeof(T));
}

/// Blocks of layers, as many as may be: how many cells they have does not matter.
void planForSorting(PartitionPlan& plan, std::uint32_t layers)
{
  plan.layerShift = 0;
  while (blocks(layers, plan.layerShift) > kMostPartitions)
  {
    ++plan.layerShift;
  }
  plan.blocksPerLayer = 1;
  plan.rowShift = kPositionBits - plan.fractionBits;
  plan.partitions = blocks(layers, plan.layerShift);
}

}

PartitionPlan makePlan(const Lattice& lattice, int indexBits, std::int64_t points)
{
  PartitionPlan plan;
  plan.columns = std::uint32_t(lattice.dimensions[0]);
  plan.rowsPerLayer = std::uint32_t(lattice.dimensions[1]);
  const auto layers = std::uint32_t(lattice.dimensions[2]);
  plan.fractionBits = kPositionBits - indexBits;
  const std::uint32_t half = std::uint32_t(1) << (indexBits - 1);
  plan.upperRows = layers > half ? plan.rowsPerLayer * half : 0;

  const auto wanted = std::uint32_t(
    std::min<std::int64_t>(std::max<std::int64_t>(points / kPointsPerPartition, 1), kMostPartitions));
  // No partition may span more than half the layers.
  while (blocks(layers, plan.layerShift) > wanted && plan.layerShift < indexBits - 1)
  {
    ++plan.layerShift;
  }
  while (plan.layerShift > 0 && plan.cells() > kDenseCells)
  {
    --plan.layerShift;
  }
  plan.rowShift = indexBits;
  while (plan.layerShift == 0 && plan.rowShift > 0 &&
    (plan.cells() > kDenseCells || 2 * layers * plan.blocksPerLayer <= wanted))
  {
    --plan.rowShift;
    plan.blocksPerLayer = blocks(plan.rowsPerLayer, plan.rowShift);
  }
  plan.partitions = blocks(layers, plan.layerShift) * plan.blocksPerLayer;
  plan.dense = plan.cells() <= kDenseCells && plan.partitions <= kMostDensePartitions;
  if (!plan.dense)
  {
    planForSorting(plan, layers);
  }
  return plan;
}

std::size_t mostVoxels(const PartitionPlan& plan, std::size_t records, std::size_t carried)
{
  return std::min(records + carried, plan.cells());
}

PartitionWorker::PartitionWorker()
  : batch_(std::make_unique<MomentBatch<std::int64_t>>())
{
}

PartitionWorker::~PartitionWorker() = default;

void PartitionWorker::prepare(const PartitionPlan& plan, bool covariances)
{
  plan_ = plan;
  batchSeconds_.resize(covariances ? kBatch : 0);
  batch_->seconds = covariances ? batchSeconds_.data() : nullptr;
  const std::size_t words = plan.dense ? markWords(plan) : 0;
  if (marks_.reserve(words))
  {
    std::fill(marks_.data(), marks_.data() + words, 0);
  }
  const std::size_t touchedWords = (words + 63) / 64;
  if (touched_.reserve(touchedWords))
  {
    std::fill(touched_.data(), touched_.data() + touchedWords, 0);
  }
  before_.reserve(words);
  beforeBytes_.reserve(words);
}

CellRanks PartitionWorker::ranks() const
{
  return { marks_.data(), before_.data(), beforeBytes_.data(), markWords(plan_) };
}

/// Numbers the marked cells: those of one list or two.
std::size_t PartitionWorker::numberMarks(const Kernels& kernels, CellList cells, CellList others)
{
  few_ = kWordsPerFew * (cells.count + others.count) < markWords(plan_);
  if (!few_)
  {
    return kernels.number(ranks());
  }
  for (const CellList& list : { cells, others })
  {
    std::uint64_t* const touched = touched_.data(); // which no store can change
    const std::uint32_t* const marked = list.cells;
    fromFourPlaces(int(list.count),
      [=](int i) { touched[marked[i] / 4096] |= std::uint64_t(1) << (marked[i] / 64 % 64); });
  }
  return kernels.numberTouched(ranks(), touched_.data());
}

/// Of the same cells, in any order.
void PartitionWorker::clearMarks(CellList cells)
{
  const std::size_t words = markWords(plan_);
  if (!few_)
  {
    std::fill(marks_.data(), marks_.data() + words, 0);
    return;
  }
  for (std::size_t i = 0; i < cells.count; ++i)
  {
    marks_[cells.cells[i] / 64] = 0;
  }
  std::fill(touched_.data(), touched_.data() + (words + 63) / 64, 0);
}

/// Marks the cells of what is carried and of the records, and counts them.
void PartitionWorker::markDense(const Kernels& kernels, const RecordPool& pool)
{
  voxels_ = { plan_.cellMap(partition_), plan_.firstKey(partition_), nullptr, nullptr, nullptr, 0 };
  const std::size_t records = pool.count(partition_);
  if (records == 0 && old_->cellCount == 0)
  {
    return;
  }
  recordCells_.reserve(records);
  kernels.markCells(old_->cells.data(), int(old_->cellCount), marks_.data());
  // The carried sums come next and are far away: fetch a part of them with each block.
  const auto* line = reinterpret_cast<const char*>(old_->packed.data());
  const std::size_t bytes = old_->cellCount * sizeof(PackedSums);
  const char* end = line + bytes;
  const std::size_t part = bytes * kBlockRecords / std::max<std::size_t>(records, 1);
  std::uint32_t* cells = recordCells_.data();
  for (RecordPool::Walk block(pool, partition_); block.next(); cells += block.count())
  {
    const char* partEnd = line + std::min(part, std::size_t(end - line));
    for (; line < partEnd; line += 64)
    {
      fetchToWrite(line);
    }
    kernels.cells(voxels_.map, block.records(), block.count(), block.recordsAhead(), cells);
  }
  // All of them together: those of one block of a scan are so near that they would wait for each other.
  kernels.markCells(recordCells_.data(), int(records), marks_.data());
  voxels_.size =
    numberMarks(kernels, { recordCells_.data(), records }, { old_->cells.data(), old_->cellCount });
}

/// Adds the records to the sums at @p to, which become the voxels.
void PartitionWorker::sumDense(const Kernels& kernels, const RecordPool& pool, CarriedPartition& to)
{
  if (voxels_.size == 0)
  {
    return;
  }
  if (&to == &own_)
  {
    own_.cellCount = 0;
  }
  makeRoom(kernels, to);
  const CellSums sums = { to.cells.data(), to.packed.data(),
    batch_->seconds ? to.splitSeconds.data() : nullptr };
  voxels_.cells = sums.cells;
  voxels_.sums = sums.sums;
  voxels_.seconds = sums.seconds;
  const std::uint32_t* cells = recordCells_.data();
  RecordPool::Walk following(pool, pool.following(partition_));
  for (RecordPool::Walk block(pool, partition_); block.next(); cells += block.count())
  {
    const Record* const next = following.next() ? following.records() : block.records();
    kernels.accumulate(voxels_.map, ranks(), block.records(), cells, block.count(), next, sums);
  }
  clearMarks({ voxels_.cells, voxels_.size });
}

/// Moves sums, which are in ascending order, to the places of their cells among all voxels: zeros between.
void PartitionWorker::makeRoom(const Kernels& kernels, CarriedPartition& sums) const
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
  if (batch_->seconds && sums.splitSeconds.size() < size)
  {
    sums.splitSeconds.reserve(size + size / 16);
    sums.splitSeconds.resize(size);
  }
  std::size_t end = size; // From here on all are at their places.
  const auto clearTo = [&](std::size_t place)
  {
    if (end <= place)
    {
      return;
    }
    std::memset(sums.packed.data() + place, 0, (end - place) * sizeof(PackedSums));
    if (batch_->seconds)
    {
      std::memset(sums.splitSeconds.data() + place, 0, (end - place) * sizeof(SplitSeconds));
    }
    end = place;
  };
  std::uint32_t places[kBatch];
  std::size_t left = sums.cellCount;
  sums.cellCount = size;
  while (left > 0 && left < end)
  {
    const std::size_t begin = left - std::min<std::size_t>(left, kBatch);
    std::copy(sums.cells.data() + begin, sums.cells.data() + left, places);
    kernels.rank(ranks(), places, int(left - begin));
    while (left > begin && left < end)
    {
      // Those that stay neighbours move together.
      std::size_t first = left - 1;
      while (first > begin && places[first - 1 - begin] + 1 == places[first - begin])
      {
        --first;
      }
      const std::size_t place = places[first - begin];
      clearTo(place + left - first);
      moveUp(sums.cells, first, left, place);
      moveUp(sums.packed, first, left, place);
      if (batch_->seconds)
      {
        moveUp(sums.splitSeconds, first, left, place);
      }
      left = first;
      end = place;
    }
  }
  clearTo(left);
}

void PartitionWorker::carryDense(
  const Kernels& kernels, const RecordPool& pool, std::uint32_t partition, CarriedPartition& carriedOver)
{
  partition_ = partition;
  old_ = &carriedOver;
  markDense(kernels, pool);
  sumDense(kernels, pool, carriedOver);
  // No voxel has more points than all have together.
  carriedOver.points += std::int64_t(pool.count(partition));
  const std::uint64_t firstKey = plan_.firstKey(partition);
  for (std::size_t i = 0; carriedOver.points >= std::int64_t(kPackedCounts) && i < carriedOver.cellCount; ++i)
  {
    if (carriedOver.packed[i].lanes[3] >> kCountShift >= kPackedCounts)
    {
      unpack(firstKey + carriedOver.cells[i], carriedOver.packed[i], carriedOver);
    }
  }
}

/// Moves packed sums that are nearly full to sums of 64 bits each.
void PartitionWorker::unpack(std::uint64_t key, PackedSums& packed, CarriedPartition& carriedOver)
{
  const auto place = std::lower_bound(carriedOver.voxels.begin(), carriedOver.voxels.end(), key,
    [](const CarriedSums& voxel, std::uint64_t wanted) { return voxel.key < wanted; });
  const bool isNew = place == carriedOver.voxels.end() || place->key != key;
  CarriedSums& voxel = isNew ? *carriedOver.voxels.insert(place, { key, 0, { 0, 0, 0 } }) : *place;
  voxel.count += packedCount(packed);
  voxel.sums[0] += std::int64_t(packed.lanes[0]);
  voxel.sums[1] += std::int64_t(packed.lanes[1]);
  voxel.sums[2] += packedZ(packed);
  packed = PackedSums{ { 0, 0, 0, 0 } };
}

void PartitionWorker::collectDense(std::size_t& position, std::size_t& next)
{
  MomentBatch<std::int64_t>& batch = *batch_;
  batch.size = int(std::min<std::size_t>(voxels_.size - position, kBatch));
  for (int i = 0; i < batch.size; ++i, ++position)
  {
    const PackedSums& sums = voxels_.sums[position];
    const std::uint32_t cell = voxels_.cells[position];
    const std::uint32_t row = cell / plan_.columns + voxels_.map.firstRow;
    batch.indices[0][i] = std::int32_t(cell % plan_.columns);
    batch.indices[1][i] = std::int32_t(row % plan_.rowsPerLayer);
    batch.indices[2][i] = std::int32_t(row / plan_.rowsPerLayer);
    batch.counts[i] = packedCount(sums);
    batch.sums[0][i] = std::int64_t(sums.lanes[0]);
    batch.sums[1][i] = std::int64_t(sums.lanes[1]);
    batch.sums[2][i] = packedZ(sums);
    if (batch.seconds)
    {
      batch.seconds[i] = whole(voxels_.seconds[position], plan_.fractionBits);
    }
    if (next < old_->voxels.size() && old_->voxels[next].key == voxels_.firstKey + cell)
    {
      addCarried(batch, i, *old_, next++);
    }
  }
}

void PartitionWorker::sortRecords(const Kernels& kernels, const RecordPool& pool)
{
  listed_ = pool.count(partition_);
  records_.reserve(listed_);
  entries_.reserve(listed_);
  otherEntries_.reserve(listed_);
  std::size_t filled = 0;
  const CellMap map = plan_.cellMap(partition_);
  for (RecordPool::Walk block(pool, partition_); block.next();)
  {
    std::uint32_t cells[kBlockRecords];
    kernels.cells(map, block.records(), block.count(), block.recordsAhead(), cells);
    for (int i = 0; i < block.count(); ++i, ++filled)
    {
      records_[filled] = block.records()[i];
      entries_[filled] = { cells[i], std::uint32_t(filled) };
    }
  }
  radixSort(entries_, otherEntries_, listed_, [](const Entry& entry) { return entry.cell; });
}

/// Voxels of the sorted records and of what is carried.
std::size_t PartitionWorker::countSorted() const
{
  const std::uint64_t firstKey = plan_.firstKey(partition_);
  std::size_t count = old_->voxels.size();
  std::size_t next = 0;
  for (std::size_t i = 0; i < listed_; ++i)
  {
    if (i > 0 && entries_[i].cell == entries_[i - 1].cell)
    {
      continue;
    }
    const std::uint64_t key = firstKey + entries_[i].cell;
    while (next < old_->voxels.size() && old_->voxels[next].key < key)
    {
      ++next;
    }
    count += next == old_->voxels.size() || old_->voxels[next].key != key;
  }
  return count;
}

void PartitionWorker::collectSorted(std::size_t& position, std::size_t& next)
{
  const CarriedPartition& old = *old_;
  const std::uint64_t firstKey = plan_.firstKey(partition_);
  const std::uint64_t fractionMask = (std::uint64_t(1) << plan_.fractionBits) - 1;
  MomentBatch<std::int64_t>& batch = *batch_;
  int size = 0;
  for (; size < kBatch && (position < listed_ || next < old.voxels.size()); ++size)
  {
    const std::uint64_t ours = position < listed_ ? firstKey + entries_[position].cell : ~std::uint64_t(0);
    const std::uint64_t theirs = next < old.voxels.size() ? old.voxels[next].key : ~std::uint64_t(0);
    const std::uint64_t key = std::min(ours, theirs);
    const std::uint64_t row = key / plan_.columns;
    batch.indices[0][size] = std::int32_t(key % plan_.columns);
    batch.indices[1][size] = std::int32_t(row % plan_.rowsPerLayer);
    batch.indices[2][size] = std::int32_t(row / plan_.rowsPerLayer);
    batch.counts[size] = 0;
    batch.sums[0][size] = batch.sums[1][size] = batch.sums[2][size] = 0;
    if (batch.seconds)
    {
      batch.seconds[size] = SecondSums{ { 0, 0, 0, 0, 0, 0 } };
    }
    for (; position < listed_ && firstKey + entries_[position].cell == key; ++position)
    {
      const Record& r = records_[entries_[position].record];
      batch.counts[size] += 1;
      batch.sums[0][size] += std::int64_t(xPlace(r, fractionMask));
      batch.sums[1][size] += std::int64_t(yPlace(r, fractionMask));
      batch.sums[2][size] += std::int64_t(zPlace(r, fractionMask));
      if (batch.seconds)
      {
        addProducts(
          batch.seconds[size], xPlace(r, fractionMask), yPlace(r, fractionMask), zPlace(r, fractionMask));
      }
    }
    if (theirs == key)
    {
      addCarried(batch, size, old, next++);
    }
  }
  batch.size = size;
}

std::uint32_t PartitionWorker::rankOf(std::uint64_t key, const std::uint64_t* keys, std::size_t size)
{
  return std::uint32_t(std::lower_bound(keys, keys + size, key) - keys);
}

std::size_t PartitionWorker::bytes() const
{
  return marks_.bytes() + touched_.bytes() + before_.bytes() + beforeBytes_.bytes() + recordCells_.bytes() +
    own_.bytes() + records_.bytes() + entries_.bytes() + otherEntries_.bytes() +
    sizeof(MomentBatch<std::int64_t>) + carried.voxels.capacity() * sizeof(CarriedSums) +
    carried.seconds.capacity() * sizeof(SecondSums);
}

} // namespace kernel
} // namespace pointhaptics
