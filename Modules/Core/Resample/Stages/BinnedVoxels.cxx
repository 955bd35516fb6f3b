#include "Core/Resample/Stages/BinnedVoxels.h"

#include "Core/Resample/Kernel/Loops.h"

namespace pointhaptics::simd
{
namespace
{

/// Number of 64-bit words that hold an occupancy bit for each cell of a partition.
std::size_t occupancyWords(const PartitionPlan& plan)
{
  return (plan.cells() - 1) / 64 + 1;
}

/// A partition with less than one record for so many occupancy words is sparse: to visit the words in use
/// takes less time than to count and clear all.
constexpr std::size_t kWordsPerSparseRecord = 3;

}

void BinnedVoxels::prepare(const VoxelRequest& request, const PointBinner& binner)
{
  binner_ = &binner;
  kernels_ = &kernelsFor(request.instructions);
  covariances_ = request.covariances;
}

/// Grows the tables to the cells of a partition, with all bits 0. The thread that sums does this and not
/// prepare(), since whoever writes to a page first gets it near its own core.
void BinnedVoxels::makeTables()
{
  const std::size_t words = occupancyWords(plan());
  if (occupancy_.reserve(words))
  {
    std::fill(occupancy_.data(), occupancy_.data() + words, 0);
  }
  const std::size_t touchedWords = (words + 63) / 64; // a bit for each occupancy word
  if (touched_.reserve(touchedWords))
  {
    std::fill(touched_.data(), touched_.data() + touchedWords, 0);
  }
  rankTable_.reserve(words);
}

CellRanks BinnedVoxels::ranks() const
{
  return { occupancy_.data(), rankTable_.data(), occupancyWords(plan()) };
}

/// Builds the rank table for the occupied cells, which are those of the records.
void BinnedVoxels::rankOccupied()
{
  isSparse_ = kWordsPerSparseRecord * records_ < occupancyWords(plan());
  std::uint64_t* const touched = touched_.data(); // which no store can change
  const std::uint32_t* const cells = recordCells_.data();
  if (isSparse_)
  {
    fromFourParts(
      records_, [=](std::size_t i) { touched[cells[i] / 4096] |= std::uint64_t(1) << (cells[i] / 64 % 64); });
  }
  voxels_.size = kernels_->rankWords(ranks(), isSparse_ ? touched : nullptr);
}

std::size_t BinnedVoxels::find(std::uint32_t partition)
{
  partition_ = partition;
  voxels_ = { plan().cellMap(partition), plan().firstKey(partition), nullptr, nullptr, nullptr, 0 };
  records_ = binner_->pool().count(partition);
  isWide_ = records_ > kMostPackedPoints;
  if (records_ == 0)
  {
    return 0;
  }
  makeTables();
  recordCells_.reserve(records_);
  forBlocks([&](const PointRecordPool::Walk& block, std::uint32_t* cells)
    { kernels_->cells(voxels_.map, block.records(), block.count(), block.recordsAhead(), cells); });
  // All blocks go in one call: records of one block of a scan share words and would wait for each other.
  kernels_->setOccupied(recordCells_.data(), records_, occupancy_.data());
  rankOccupied();
  return voxels_.size;
}

/// Clears the occupancy bits, by the cells of the records or of the voxels.
void BinnedVoxels::drop()
{
  if (voxels_.size == 0)
  {
    return;
  }
  const std::size_t words = occupancyWords(plan());
  if (!isSparse_)
  {
    std::fill(occupancy_.data(), occupancy_.data() + words, 0);
    return;
  }
  const std::uint32_t* const cells = voxels_.cells ? voxels_.cells : recordCells_.data();
  const std::size_t count = voxels_.cells ? voxels_.size : records_;
  for (std::size_t i = 0; i < count; ++i)
  {
    occupancy_[cells[i] / 64] = 0;
  }
  std::fill(touched_.data(), touched_.data() + (words + 63) / 64, 0);
}

void BinnedVoxels::sum()
{
  if (voxels_.size == 0)
  {
    wide_.start(0, false);
    return;
  }
  // With what kernels read, but do not use, beyond the end.
  cells_.resize(std::max(cells_.size(), voxels_.size + kWidest));
  isWide_ ? sumWide() : sumPacked();
  voxels_.cells = cells_.data();
  drop();
}

void BinnedVoxels::sumPacked()
{
  const std::size_t room = voxels_.size + kWidest;
  packed_.resize(std::max(packed_.size(), room));
  std::fill_n(packed_.data(), voxels_.size, PackedSums{});
  voxels_.sums = packed_.data();
  if (covariances_)
  {
    secondMoments_.resize(std::max(secondMoments_.size(), room));
    std::fill_n(secondMoments_.data(), voxels_.size, SecondMoments{});
    voxels_.secondMoments = secondMoments_.data();
  }
  const CellSums sums = { cells_.data(), packed_.data(), covariances_ ? secondMoments_.data() : nullptr };
  PointRecordPool::Walk following(binner_->pool(), binner_->pool().following(partition_));
  forBlocks(
    [&](const PointRecordPool::Walk& block, std::uint32_t* cells)
    {
      const PointRecord* const next = following.next() ? following.records() : block.records();
      block.fetchPayloads(); // for visit()
      kernels_->accumulate(voxels_.map, ranks(), block.records(), cells, block.count(), next, sums);
    });
}

void BinnedVoxels::sumWide()
{
  wide_.start(voxels_.size, covariances_);
  const std::uint64_t mask = (std::uint64_t(1) << plan().fractionBits) - 1;
  forBlocks(
    [&](const PointRecordPool::Walk& block, std::uint32_t* cells)
    {
      for (int i = 0; i < block.count(); ++i)
      {
        const std::uint32_t cell = cells[i];
        const std::uint64_t below = occupancy_[cell / 64] & ((std::uint64_t(1) << (cell % 64)) - 1);
        cells[i] = rankTable_[cell / 64] + std::uint32_t(__builtin_popcountll(below));
        cells_[cells[i]] = cell;
        wide_.voxels[cells[i]].key = voxels_.firstKey + cell;
        const PointRecord& r = block.records()[i];
        wide_.addPoint(cells[i], { xFraction(r, mask), yFraction(r, mask), zFraction(r, mask) });
      }
    });
}

VoxelRun BinnedVoxels::wide() const
{
  if (isWide_)
  {
    return wide_;
  }
  VoxelRun run;
  run.voxels.resize(voxels_.size);
  for (std::size_t i = 0; i < voxels_.size; ++i)
  {
    run.voxels[i] = WideSums::of(voxels_.firstKey + voxels_.cells[i], voxels_.sums[i]);
  }
  run.secondMoments.assign(
    secondMoments_.begin(), secondMoments_.begin() + std::ptrdiff_t(covariances_ ? voxels_.size : 0));
  return run;
}

void BinnedVoxels::write(const Kernels& kernels, VoxelWriter& writer, std::size_t offset) const
{
  isWide_ ? writer.write(offset, wide_, 0, voxels_.size) : writer.write(kernels, offset, voxels_);
}

std::size_t BinnedVoxels::bytes() const
{
  return occupancy_.bytes() + touched_.bytes() + rankTable_.bytes() + recordCells_.bytes() +
    cells_.capacity() * sizeof(std::uint32_t) + packed_.capacity() * sizeof(PackedSums) +
    secondMoments_.capacity() * sizeof(SecondMoments) + wide_.bytes();
}

} // namespace pointhaptics::simd
