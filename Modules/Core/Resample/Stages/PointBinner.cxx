#include "Core/Resample/Stages/PointBinner.h"

#include "Core/Base/PointBlocks.h"
#include "Core/Resample/Stages/PointQuantizer.h"

#include <algorithm>
#include <type_traits>
#include <vector>

namespace pointhaptics
{
namespace simd
{
namespace
{

/// Most cells of a partition: their occupancy bits should stay in the second-level cache. (The sums do
/// anyway: a chunk has a few thousand records in a partition.)
constexpr std::size_t kMostCells = std::size_t(1) << 22;
/// While records are binned, the cursors of more partitions than this do not fit the first-level cache.
constexpr std::uint32_t kMostPartitions = 512;
/// On large lattices they are more: points would be sorted otherwise.
constexpr std::uint32_t kMostLargePartitions = 2048;
/// Fewer points than this in a partition on average do not pay its overhead: a dozen loops, each with a
/// mispredicted end.
constexpr std::int64_t kPointsPerPartition = 1024;

std::uint32_t blocks(std::uint32_t count, int shift)
{
  return ((count - 1) >> shift) + 1;
}

/// Copies the rows of points beside their records.
struct RowCopier
{
  const RowLayout& layout;
  const PointIndex* index;
  char* rows;
  std::int64_t first; ///< Point that the writer counts from.

  static void copy(const void* context, const std::uint32_t* points, const std::uint32_t* slots, int count)
  {
    const auto& self = *static_cast<const RowCopier*>(context);
    std::int64_t numbers[kBlockRecords];
    std::transform(points, points + count, numbers,
      [&](std::uint32_t point)
      { return self.index ? self.index->original(self.first + point) : self.first + point; });
    self.layout.bin(numbers, slots, count, self.rows);
  }
};

/// Bins ranges of points: all at once, or, with rows or where other fields lie between points, one by one.
void binRanges(const Kernels& kernels, const PointQuantizer& quantizer, const PointView& points,
  const PointRange* ranges, std::int64_t count, RowCopier& rows, PointRecordWriter& writer)
{
  const auto binAll = [&](const auto* xyz)
  {
    const auto bin = kernels.of<std::decay_t<decltype(*xyz)>>().partition;
    const bool atOnce = points.stride() == 3 && !writer.binned;
    if (atOnce)
    {
      bin(quantizer, xyz, ranges, count, writer);
    }
    for (std::int64_t r = 0; !atOnce && r < count; ++r)
    {
      rows.first = ranges[r].begin;
      forPointBlocks(xyz, points, ranges[r].begin, ranges[r].end,
        [&](const auto* block, std::int64_t size)
        {
          const PointRange all = { 0, size };
          bin(quantizer, block, &all, 1, writer);
          rows.first += size;
        });
    }
  };
  points.floats() ? binAll(points.floats()) : binAll(points.doubles());
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
  while (plan.layerShift > 0 && plan.cells() > kMostCells)
  {
    --plan.layerShift;
  }
  plan.rowShift = indexBits;
  while (plan.layerShift == 0 && plan.rowShift > 0 &&
    (plan.cells() > kMostCells || 2 * layers * plan.blocksPerLayer <= wanted))
  {
    --plan.rowShift;
    plan.blocksPerLayer = blocks(plan.rowsPerLayer, plan.rowShift);
  }
  plan.partitions = blocks(layers, plan.layerShift) * plan.blocksPerLayer;
  return plan;
}

bool fitsPartitions(const Lattice& lattice, int indexBits)
{
  if (indexBits < kMinimumIndexBits || indexBits > kMaximumIndexBits)
  {
    return false;
  }
  const PartitionPlan plan = makePlan(lattice, indexBits, kChunkPoints);
  return plan.cells() <= kMostCells && plan.partitions <= kMostLargePartitions;
}

std::size_t mostVoxels(const PartitionPlan& plan, std::size_t records, std::size_t accumulated)
{
  return std::min(records + accumulated, plan.cells());
}

void PointBinner::prepare(const VoxelRequest& request, std::int64_t points)
{
  const int indexBits = indexBitsOf(request.lattice);
  plan_ = makePlan(request.lattice, indexBits, points);
  quantizer_ = makeQuantizer(request.transform, request.lattice, indexBits, kPositionBits);
  quantizer_.blocksPerLayer = plan_.blocksPerLayer;
  quantizer_.rowShift = plan_.rowShift;
  quantizer_.layerShift = plan_.layerShift;
}

void PointBinner::quantizeAndBin(const VoxelRequest& request, const Chunks& chunks, std::size_t chunk,
  bool withRows, const Executor& executor)
{
  if (withRows)
  {
    chooseRows(request);
  }
  pool_.prepare(
    chunks.pointCount(chunk), plan_.partitions, executor.concurrency(), withRows ? rows_.binnedBytes() : 0);
  const std::int64_t pieces = chunks.pieceCount(chunk);
  const std::int64_t grain = std::max<std::int64_t>(1, pieces / (16 * executor.concurrency()));
  forEachItemWith(
    executor, std::size_t((pieces + grain - 1) / grain),
    [&](std::size_t thread) -> PointRecordWriter& { return pool_.writer(thread); },
    [&](std::size_t item, PointRecordWriter& writer)
    {
      const std::int64_t first = std::int64_t(item) * grain;
      RowCopier rows = { rows_, request.index, pool_.rows(), 0 };
      writer.binned = withRows ? &RowCopier::copy : nullptr;
      writer.context = &rows;
      binRanges(kernelsFor(request.instructions), quantizer_, chunks.points(), chunks.pieces(chunk) + first,
        std::min(grain, pieces - first), rows, writer);
    });
}

} // namespace simd
} // namespace pointhaptics
