#include "Core/Kernel/PartitionSums.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace pointhaptics
{
namespace kernel
{
namespace
{

/// Most cells of a dense partition: what is touched of their sums should stay in the second-level cache.
constexpr std::size_t kDenseCells = std::size_t(1) << 17;
/// More partitions than this crowd the first-level cache while records are dealt out.
constexpr std::uint32_t kMostPartitions = 512;
/// Dense partitions may be more: not having to sort is worth it.
constexpr std::uint32_t kMostDensePartitions = 2048;
/// Fewer points than this in a partition on average are not worth its upkeep.
constexpr std::int64_t kPointsPerPartition = 128;

std::uint32_t blocks(std::uint32_t count, int shift)
{
  return ((count - 1) >> shift) + 1;
}

/// Words of a bit for each cell, and of a bit for each of these.
std::size_t markWords(const PartitionPlan& plan)
{
  return plan.cells() / 64 + 1;
}
std::size_t summaryWords(const PartitionPlan& plan)
{
  return markWords(plan) / 64 + 1;
}

/// So many points in one voxel are taken out of the packed sums, which hold less than 2^21.
constexpr std::uint64_t kPackedCounts = std::uint64_t(1) << 19;

template <typename T>
void reserveZeroed(Buffer<T>& buffer, std::size_t count)
{
  if (buffer.reserve(count, Pages::Huge))
  {
    std::memset(static_cast<void*>(buffer.data()), 0, count * sizeof(T));
  }
}

void addCarried(MomentBatch<std::int64_t>& batch, int i, const CarriedPartition& carried, std::size_t voxel)
{
  const CarriedSums& old = carried.voxels[voxel];
  batch.counts[i] += old.count;
  for (int axis = 0; axis < 3; ++axis)
  {
    batch.sums[axis][i] += old.sums[axis];
  }
  // Where seconds go with the cells they are in the batch already.
  for (int m = 0; carried.cells.empty() && batch.seconds && m < 6; ++m)
  {
    batch.seconds[i].lanes[m] += carried.seconds[voxel].lanes[m];
  }
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
  if (plan.dense)
  {
    reserveZeroed(slots_, plan.cells());
    reserveZeroed(marks_, markWords(plan));
    reserveZeroed(summary_, summaryWords(plan));
  }
}

/// Room for the sums of so many cells.
void PartitionWorker::prepareSums(std::size_t most)
{
  reserveZeroed(sums_, most);
  slotCells_.reserve(most + 1);
  cells_.reserve(most + 64);
  if (batch_->seconds)
  {
    reserveZeroed(seconds_, most);
  }
  cellSums_ = { slots_.data(), slotCells_.data(), sums_.data(), batch_->seconds ? seconds_.data() : nullptr,
    0 };
}

/// Sums of the carried voxels and the partition's records.
void PartitionWorker::sumDense(
  const Kernels& kernels, const RecordPool& pool, std::uint32_t partition, const CarriedPartition& old)
{
  const CellMap map = plan_.cellMap(partition);
  prepareSums(mostVoxels(plan_, pool.count(partition), old.size()));
  cellSums_.size = std::uint32_t(old.cells.size());
  std::copy(old.cells.begin(), old.cells.end(), slotCells_.data());
  std::copy(old.packed.begin(), old.packed.end(), sums_.data());
  if (cellSums_.seconds)
  {
    std::copy(old.seconds.begin(), old.seconds.end(), seconds_.data());
  }
  for (std::uint32_t i = 0; i < cellSums_.size; ++i)
  {
    slots_[old.cells[i]] = i + 1;
  }
  pool.prefetchFirst(partition + 1);
  pool.forBlocks(partition,
    [&](const Record* records, const std::uint32_t*, int count)
    { kernels.accumulate(map, records, count, cellSums_); });
}

/// Lists the cells in ascending order.
void PartitionWorker::listDense(const Kernels& kernels)
{
  for (std::uint32_t i = 0; i < cellSums_.size; ++i)
  {
    const std::uint32_t cell = slotCells_[i];
    marks_[cell / 64] |= std::uint64_t(1) << (cell % 64);
    summary_[cell / 4096] |= std::uint64_t(1) << (cell / 64 % 64);
  }
  listed_ = kernels.drain(marks_.data(), summary_.data(), summaryWords(plan_), cells_.data());
}

void PartitionWorker::clearDense()
{
  for (std::uint32_t i = 0; i < cellSums_.size; ++i)
  {
    slots_[slotCells_[i]] = 0;
  }
  std::fill(sums_.data(), sums_.data() + cellSums_.size, PackedSums{ { 0, 0, 0, 0 } });
  if (cellSums_.seconds)
  {
    std::fill(seconds_.data(), seconds_.data() + cellSums_.size, SecondSums{ { 0, 0, 0, 0, 0, 0 } });
  }
  cellSums_.size = 0;
}

void PartitionWorker::carryDense(
  const Kernels& kernels, const RecordPool& pool, std::uint32_t partition, CarriedPartition& carriedOver)
{
  sumDense(kernels, pool, partition, carriedOver);
  // Room for what another chunk adds, not for twice as much.
  const std::size_t size = cellSums_.size;
  if (carriedOver.cells.capacity() < size)
  {
    carriedOver.cells.reserve(size + size / 16);
    carriedOver.packed.reserve(size + size / 16);
  }
  carriedOver.cells.assign(slotCells_.data(), slotCells_.data() + size);
  carriedOver.packed.assign(sums_.data(), sums_.data() + size);
  if (cellSums_.seconds)
  {
    carriedOver.seconds.assign(seconds_.data(), seconds_.data() + size);
  }
  for (std::size_t i = 0; i < size; ++i)
  {
    if (carriedOver.packed[i].lanes[3] >> kCountShift >= kPackedCounts)
    {
      unpack(plan_.firstKey(partition) + carriedOver.cells[i], carriedOver.packed[i], carriedOver);
    }
  }
  clearDense();
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

void PartitionWorker::collectDense(const Kernels& kernels, std::uint32_t partition,
  const CarriedPartition& old, std::size_t& position, std::size_t& next)
{
  const int size = int(std::min<std::size_t>(listed_ - position, kBatch));
  const std::uint32_t* cells = cells_.data() + position;
  kernels.collect(plan_.cellMap(partition), cells, size, cellSums_, *batch_);
  const std::uint64_t firstKey = plan_.firstKey(partition);
  for (int i = 0; i < size && next < old.voxels.size(); ++i)
  {
    if (old.voxels[next].key == firstKey + cells[i])
    {
      addCarried(*batch_, i, old, next++);
    }
  }
  position += std::size_t(size);
}

std::size_t PartitionWorker::sortRecords(
  const Kernels& kernels, const RecordPool& pool, std::uint32_t partition)
{
  const std::size_t size = pool.count(partition);
  records_.reserve(size);
  entries_.reserve(size);
  otherEntries_.reserve(size);
  std::size_t filled = 0;
  const CellMap map = plan_.cellMap(partition);
  pool.forBlocks(partition,
    [&](const Record* records, const std::uint32_t*, int count)
    {
      std::uint32_t cells[kBlockRecords];
      kernels.cells(map, records, count, cells);
      for (int i = 0; i < count; ++i, ++filled)
      {
        records_[filled] = records[i];
        entries_[filled] = { cells[i], std::uint32_t(filled) };
      }
    });
  sortEntries(size);
  return size;
}

/// Least significant digit first, leaving out the digits in which no two differ.
void PartitionWorker::sortEntries(std::size_t size)
{
  constexpr int kDigitBits = 11;
  constexpr std::size_t kDigits = std::size_t(1) << kDigitBits;
  std::uint32_t differing = 0;
  for (std::size_t i = 1; i < size; ++i)
  {
    differing |= entries_[i].cell ^ entries_[0].cell;
  }
  for (int shift = 0; shift < 32 && differing >> shift != 0; shift += kDigitBits)
  {
    if ((differing >> shift & (kDigits - 1)) == 0)
    {
      continue;
    }
    std::array<std::uint32_t, kDigits> places{};
    for (std::size_t i = 0; i < size; ++i)
    {
      ++places[entries_[i].cell >> shift & (kDigits - 1)];
    }
    std::uint32_t sum = 0;
    for (std::uint32_t& place : places)
    {
      const std::uint32_t here = place;
      place = sum;
      sum += here;
    }
    for (std::size_t i = 0; i < size; ++i)
    {
      const Entry entry = entries_[i];
      otherEntries_[places[entry.cell >> shift & (kDigits - 1)]++] = entry;
    }
    std::swap(entries_, otherEntries_);
  }
}

void PartitionWorker::collectSorted(
  std::uint32_t partition, const CarriedPartition& old, std::size_t& position, std::size_t& next)
{
  const std::uint64_t firstKey = plan_.firstKey(partition);
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

/// Sets the ranks of a dense partition's cells, or forgets them.
void PartitionWorker::setRanks(
  std::uint32_t partition, const std::uint64_t* keys, std::size_t size, bool known)
{
  const std::uint64_t firstKey = plan_.firstKey(partition);
  for (std::size_t i = 0; plan_.dense && i < size; ++i)
  {
    slots_[keys[i] - firstKey] = known ? std::uint32_t(i) + 1 : 0;
  }
}

std::uint32_t PartitionWorker::rankOf(std::uint64_t key, const std::uint64_t* keys, std::size_t size)
{
  return std::uint32_t(std::lower_bound(keys, keys + size, key) - keys);
}

std::size_t PartitionWorker::bytes() const
{
  return slots_.bytes() + slotCells_.bytes() + sums_.bytes() + seconds_.bytes() + marks_.bytes() +
    summary_.bytes() + cells_.bytes() + records_.bytes() + entries_.bytes() + otherEntries_.bytes() +
    sizeof(MomentBatch<std::int64_t>) + carried.voxels.capacity() * sizeof(CarriedSums) +
    carried.seconds.capacity() * sizeof(SecondSums);
}

} // namespace kernel
} // namespace pointhaptics
