#include "Core/Resample/Stages/BinnedVoxels.h"

#include "Core/Base/RadixSort.h"
#include "Core/Resample/Kernel/Loops.h"

#include <algorithm>

namespace pointhaptics::simd
{
namespace
{

/// Where a partition has less than one record for so many words of occupancy bits, to sort the records takes
/// less time than to visit all words.
constexpr std::size_t kWordsPerSparseRecord = 3;

}

void BinnedVoxels::prepare(const VoxelRequest& request, const Chunks& chunks, const PointBinner& binner)
{
  request_ = &request;
  chunks_ = &chunks;
  binner_ = &binner;
  kernels_ = &kernelsFor(request.instructions);
}

std::size_t BinnedVoxels::find(std::uint32_t partition)
{
  partition_ = partition;
  voxels_ = { plan().cellMap(partition), plan().firstKey(partition), nullptr, nullptr, nullptr, 0 };
  records_ = binner_->count(partition);
  isWide_ = plan().isFine || records_ > kMostPackedPoints;
  if (records_ == 0)
  {
    return 0;
  }
  ranks_.reserve(records_);
  const std::size_t words = (plan().cells() - 1) / 64 + 1;
  const bool isSparse = kWordsPerSparseRecord * records_ < words;
  // With what kernels read, but do not use, beyond the end.
  cells_.reserve(records_ + kWidest);
  plan().isFine ? void() : findCells();
  if (plan().isFine || isSparse)
  {
    sortKeys();
    return voxels_.size;
  }
  // By the thread that sums, not by prepare(): whoever writes to a page first gets it near its own core.
  if (occupancy_.reserve(words))
  {
    std::fill_n(occupancy_.data(), words, 0);
  }
  rankTable_.reserve(words);
  const CellTables tables = { occupancy_.data(), rankTable_.data(), words };
  voxels_.size = kernels_->rank(tables, ranks_.data(), records_, cells_.data());
  return voxels_.size;
}

/// The cells of the records.
void BinnedVoxels::findCells()
{
  std::uint32_t* cells = ranks_.data();
  for (PointBinner::Walk block(*binner_, partition_); block.next(); cells += block.count())
  {
    kernels_->cells(voxels_.map, block.records(), block.count(), block.recordsAhead(), cells);
  }
}

/// Ranks the voxels of the records by sorting these.
void BinnedVoxels::sortKeys()
{
  keys_.reserve(records_);
  otherKeys_.reserve(records_);
  std::uint32_t record = 0;
  for (PointBinner::Walk block(*binner_, partition_); block.next();)
  {
    for (int i = 0; i < block.count(); ++i, ++record)
    {
      keys_[record] = { plan().isFine ? block.records()[i].first : ranks_[record], record };
    }
  }
  radixSort(keys_, otherKeys_, records_, [](const Key& key) { return key.voxel; });
  for (std::size_t i = 0; i < records_; ++i)
  {
    voxels_.size += i == 0 || keys_[i].voxel != keys_[voxels_.size - 1].voxel;
    const std::size_t rank = voxels_.size - 1;
    keys_[rank].voxel = keys_[i].voxel;
    cells_[rank] = std::uint32_t(keys_[i].voxel);
    ranks_[keys_[i].record] = std::uint32_t(rank);
  }
}

void BinnedVoxels::sum()
{
  voxels_.cells = cells_.data();
  isWide_ ? sumWide() : sumPacked();
}

void BinnedVoxels::sumPacked()
{
  const std::size_t room = voxels_.size + kWidest;
  packed_.resize(std::max(packed_.size(), room));
  std::fill_n(packed_.data(), voxels_.size, PackedSums{});
  voxels_.sums = packed_.data();
  if (request_->covariances)
  {
    secondMoments_.resize(std::max(secondMoments_.size(), room));
    std::fill_n(secondMoments_.data(), voxels_.size, SecondMoments{});
    voxels_.secondMoments = secondMoments_.data();
  }
  PointBinner::Walk following(*binner_, binner_->following(partition_));
  const std::uint32_t* ranks = ranks_.data();
  for (PointBinner::Walk block(*binner_, partition_); block.next(); ranks += block.count())
  {
    const PointRecord* const next = following.next() ? following.records() : block.records();
    block.fetchPayloads(); // for visit()
    kernels_->accumulate(plan().fractionBits, block.records(), ranks, block.count(), next, packed_.data(),
      request_->covariances ? secondMoments_.data() : nullptr);
  }
}

void BinnedVoxels::sumWide()
{
  wide_.voxels.assign(voxels_.size, WideSums{});
  wide_.secondMoments.assign(request_->covariances ? voxels_.size : 0, SecondMoments{});
  constexpr std::uint64_t kMask = (std::uint64_t(1) << kFineBits) - 1;
  for (std::size_t v = 0; v < voxels_.size; ++v)
  {
    const auto index = [&](int axis) { return std::int64_t(keys_[v].voxel >> axis * kFineBits & kMask); };
    wide_.voxels[v].key =
      plan().isFine ? request_->lattice.key(index(0), index(1), index(2)) : voxels_.firstKey + cells_[v];
  }
  visit(true,
    [&](const PointBlock& block)
    {
      for (int i = 0; i < block.count; ++i)
      {
        const std::uint32_t voxel = block.voxels[i];
        const std::array<std::uint64_t, 3>& offset = block.offsets[i];
        ++wide_.voxels[voxel].count;
        for (int axis = 0; axis < 3; ++axis)
        {
          wide_.voxels[voxel].add(axis, offset[std::size_t(axis)]);
        }
        if (request_->covariances)
        {
          addProducts(wide_.secondMoments[voxel], offset[0], offset[1], offset[2]);
        }
      }
    });
}

/// Fills the offsets of the block's points. @pre on fine lattices the block has the numbers of its points.
void BinnedVoxels::copyOffsets(const PointBinner::Walk& from, PointBlock& block) const
{
  if (plan().isFine)
  {
    Vec3 points[kBlockRecords + kWidest];
    std::transform(block.points, block.points + block.count, points,
      [&](std::int64_t point) { return chunks_->points()[point]; });
    kernels_->fineOffsets(binner_->quantizer(), &points[0].x, block.count, block.offsets[0].data());
    return;
  }
  const std::uint64_t mask = (std::uint64_t(1) << plan().fractionBits) - 1;
  for (int i = 0; i < block.count; ++i)
  {
    const PointRecord& r = from.records()[i];
    block.offsets[i] = { xFraction(r, mask), yFraction(r, mask), zFraction(r, mask) };
  }
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
  run.secondMoments.assign(secondMoments_.begin(),
    secondMoments_.begin() + std::ptrdiff_t(request_->covariances ? voxels_.size : 0));
  return run;
}

void BinnedVoxels::write(const Kernels& kernels, VoxelWriter& writer, std::size_t offset) const
{
  isWide_ ? writer.write(offset, wide_, 0, voxels_.size) : writer.write(kernels, offset, voxels_);
}

} // namespace pointhaptics::simd
