#include "Core/Resample/Stages/PointBinner.h"

#include "Core/Base/PointBlocks.h"
#include "Core/Resample/Stages/PointQuantizer.h"

#include <algorithm>
#include <numeric>
#include <type_traits>

namespace pointhaptics::simd
{
namespace
{

/// While records are binned, the cursors of more partitions than this do not fit the first-level cache.
constexpr std::uint32_t kMostPartitions = 512;
/// Cells of a partition whose numbers vectors convert.
constexpr std::size_t kMostCells = std::size_t(1) << 31;
/// Fewer points than this in a partition on average do not pay its overhead: a dozen loops, each with a
/// mispredicted end.
constexpr std::int64_t kPointsPerPartition = 1024;

/// The payload of records: the tuples that have room there, and which are so read once, in the order of their
/// memory; the number of the point where that, or others, are of use.
PayloadLayout payloadLayoutOf(const std::vector<AttributeView>& arrays, bool numbered)
{
  PayloadLayout layout;
  constexpr int kWord = sizeof(std::uint32_t);
  int bytes = kWord; // With a number.
  for (const AttributeView& array : arrays)
  {
    if (layout.count == PayloadLayout::kMostArrays ||
      bytes + array.tupleBytes() > PayloadLayout::kMostWords * kWord)
    {
      break;
    }
    layout.arrays[layout.count++] = { static_cast<const char*>(array.values), array.step(),
      int(array.tupleBytes()), bytes };
    bytes += int(array.tupleBytes());
  }
  layout.numbered = numbered || std::size_t(layout.count) < arrays.size();
  const int unused = layout.numbered ? 0 : kWord;
  std::for_each(
    layout.arrays, layout.arrays + layout.count, [=](PayloadArray& array) { array.offset -= unused; });
  layout.words = (bytes - unused + kWord - 1) / kWord;
  return layout;
}

std::uint32_t blocks(std::uint32_t count, int shift)
{
  return ((count - 1) >> shift) + 1;
}

/// A writer leaves the first and the last block of a partition partly empty: many writers get small ones.
std::size_t blockRecordsFor(std::size_t writers)
{
  constexpr std::size_t kFewWriters = 4;
  constexpr std::size_t kLeastRecords = kBlockRecords / 8;
  std::size_t records = kBlockRecords;
  for (std::size_t few = kFewWriters; few < writers && records > kLeastRecords; few *= 2)
  {
    records /= 2;
  }
  return records;
}

/// A plan for @p points points at a time.
PartitionPlan makePlan(const Lattice& lattice, std::int64_t points)
{
  const int indexBits = indexBitsOf(lattice);
  PartitionPlan plan;
  plan.columns = std::uint32_t(lattice.dimensions[0]);
  plan.rowsPerLayer = std::uint32_t(lattice.dimensions[1]);
  const auto layers = std::uint32_t(lattice.dimensions[2]);
  plan.fractionBits = fractionBitsOf(lattice);
  plan.isFine = indexBits > kMaximumIndexBits;
  const std::uint32_t half = std::uint32_t(1) << (indexBits - 1);
  plan.upperRows = layers > half ? plan.rowsPerLayer * half : 0;

  const auto wanted = std::uint32_t(
    std::min<std::int64_t>(std::max<std::int64_t>(points / kPointsPerPartition, 1), kMostPartitions));
  // No partition may span more than half the layers.
  while (blocks(layers, plan.layerShift) > wanted && plan.layerShift < indexBits - 1 &&
    (plan.isFine || 2 * plan.cells() <= kMostCells))
  {
    ++plan.layerShift;
  }
  plan.rowShift = indexBits;
  while (plan.layerShift == 0 && plan.rowShift > 0 && 2 * layers * plan.blocksPerLayer <= wanted)
  {
    --plan.rowShift;
    plan.blocksPerLayer = blocks(plan.rowsPerLayer, plan.rowShift);
  }
  plan.partitions = blocks(layers, plan.layerShift) * plan.blocksPerLayer;
  return plan;
}

/// Bins ranges of points: all at once, or block by block where other fields lie between points.
void binRanges(const Kernels& kernels, const PointQuantizer& quantizer, const Chunks& chunks,
  const PointRange* ranges, std::int64_t count, std::int64_t firstNumber, PointRecordWriter& writer)
{
  const PointView& points = chunks.points();
  const auto numberFrom = [&](std::int64_t point)
  {
    writer.originals = chunks.originals() ? chunks.originals() + point : nullptr;
    writer.firstNumber = std::uint32_t(point - firstNumber);
  };
  const auto binAll = [&](const auto* xyz)
  {
    const auto bin = kernels.of<std::decay_t<decltype(*xyz)>>().partition;
    if (points.stride() == 3)
    {
      numberFrom(ranges[0].begin);
      bin(quantizer, xyz, ranges, count, writer);
      return;
    }
    for (std::int64_t r = 0; r < count; ++r)
    {
      std::int64_t first = ranges[r].begin;
      forPointBlocks(xyz, points, first, ranges[r].end,
        [&](const auto* block, std::int64_t size)
        {
          const PointRange all = { 0, size };
          numberFrom(first);
          bin(quantizer, block, &all, 1, writer);
          first += size;
        });
    }
  };
  points.floats() ? binAll(points.floats()) : binAll(points.doubles());
}

}

void PointBinner::prepare(
  const VoxelRequest& request, const Chunks& chunks, const std::vector<AttributeView>& arrays, bool numbered)
{
  plan_ = makePlan(request.lattice, chunks.pointCount(0));
  quantizer_ = makeQuantizer(request.transform, request.lattice);
  quantizer_.blocksPerLayer = plan_.blocksPerLayer;
  quantizer_.rowShift = plan_.rowShift;
  quantizer_.layerShift = plan_.layerShift;
  // Points of fine lattices are quantized again: their numbers are all that goes with them.
  payloadLayout_ = plan_.isFine ? payloadLayoutOf({}, true) : payloadLayoutOf(arrays, numbered);
}

void PointBinner::start(const Chunks& chunks, std::size_t first, std::size_t last, const Executor& executor)
{
  // Numbers that an index gives are counted from 0.
  firstNumber_ = chunks.originals() || chunks.pieceCount(first) == 0 ? 0 : chunks.pieces(first)->begin;
  PayloadLayout layout = payloadLayout_;
  for (int i = 0; i < layout.count; ++i)
  {
    layout.arrays[i].values += layout.arrays[i].step * firstNumber_;
  }
  std::int64_t points = 0;
  for (std::size_t chunk = first; chunk < last; ++chunk)
  {
    points += chunks.pointCount(chunk);
  }
  writers_.resize(std::size_t(std::max(executor.concurrency(), 1)));
  blockRecords_ = blockRecordsFor(writers_.size());
  const std::size_t blocks =
    std::size_t(points) / blockRecords_ + writers_.size() * (2 * plan_.partitions + kTakenBlocks);
  records_.reserve(blocks * blockRecords_);
  previous_.reserve(blocks);
  payloads_.reserve(std::size_t(layout.words) * blocks * blockRecords_);
  takenBlocks_ = 0;
  for (std::unique_ptr<Writer>& writer : writers_)
  {
    writer = writer ? std::move(writer) : std::make_unique<Writer>();
    writer->cursorStorage.assign(plan_.partitions, nullptr);
    writer->lastStorage.assign(plan_.partitions, kNoBlock);
    static_cast<PointRecordWriter&>(*writer) = { writer->cursorStorage.data(),
      blockRecords_ * sizeof(PointRecord) - 1, records_.data(), writer->lastStorage.data(), previous_.data(),
      &takenBlocks_, 0, 0, payloads_.data(), layout, nullptr, 0, 0, 0 };
  }
}

void PointBinner::add(
  const VoxelRequest& request, const Chunks& chunks, std::size_t chunk, const Executor& executor)
{
  const std::int64_t pieces = chunks.pieceCount(chunk);
  const std::int64_t grain = std::max<std::int64_t>(1, pieces / (16 * executor.concurrency()));
  forEachItemWith(
    executor, std::size_t((pieces + grain - 1) / grain),
    [&](std::size_t thread) -> PointRecordWriter& { return *writers_[thread]; },
    [&](std::size_t item, PointRecordWriter& writer)
    {
      const std::int64_t first = std::int64_t(item) * grain;
      binRanges(kernelsFor(request.instructions), quantizer_, chunks, chunks.pieces(chunk) + first,
        std::min(grain, pieces - first), firstNumber_, writer);
    });
}

std::uint32_t PointBinner::following(std::uint32_t partition) const
{
  do
  {
    partition += std::uint32_t(writers_.size());
  } while (partition < plan_.partitions && !Walk(*this, partition).next());
  return std::min(partition, plan_.partitions);
}

std::size_t PointBinner::count(std::uint32_t partition) const
{
  std::size_t sum = 0;
  for (Walk walk(*this, partition); walk.next();)
  {
    sum += std::size_t(walk.count());
  }
  return sum;
}

std::int64_t PointBinner::total(std::int64_t PointRecordWriter::*count) const
{
  return std::accumulate(writers_.begin(), writers_.end(), std::int64_t(0),
    [=](std::int64_t sum, const std::unique_ptr<Writer>& writer) { return sum + (*writer).*count; });
}

} // namespace pointhaptics::simd
