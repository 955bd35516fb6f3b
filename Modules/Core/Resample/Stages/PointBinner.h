/// @file
/// Quantizes points and bins their records into the partitions of a lattice.
#pragma once

#include "Core/Base/Buffer.h"
#include "Core/Base/Executor.h"
#include "Core/Base/Lattice.h"
#include "Core/Base/PointView.h"
#include "Core/Neighbors/PointIndex.h"
#include "Core/Resample/Kernel/Loops.h"
#include "Core/Resample/Kernel/VoxelKernel.h"
#include "Core/Resample/VoxelResampler.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace pointhaptics::simd
{

/// Points of a piece: enough to make the cost of scheduling it negligible.
constexpr std::int64_t kPieceSize = 1 << 12;
/// Chunks whose points are summed together. The sums of further chunks are merged into theirs.
constexpr std::size_t kHeldChunks = 4;

/// Points between two reports; threads take the pieces of a chunk one by one. There is at least one, which
/// may be empty.
class Chunks
{
public:
  Chunks(const VoxelRequest& request, const Executor& executor)
  {
    const std::int64_t chunkPoints =
      request.chunkPoints > 0 ? std::min(request.chunkPoints, kChunkPoints) : kChunkPoints;
    if (request.index)
    {
      points_ = request.index->points();
      originals_ = request.index->originals();
      const Lattice& lattice = request.part ? *request.part : request.lattice;
      for (const PointRange& range : request.index->rangesInside(request.transform, lattice, executor))
      {
        append(range, chunkPoints);
      }
    }
    else
    {
      points_ = request.points;
      append({ 0, points_.size() }, chunkPoints);
    }
    if (chunks_.empty())
    {
      chunks_.push_back(0);
    }
    chunks_.push_back(pieces_.size());
  }
  const PointView& points() const { return points_; }
  /// The numbers of these in the cloud; null: they are those.
  const std::uint32_t* originals() const { return originals_; }
  std::size_t count() const { return chunks_.size() - 1; }
  const PointRange* pieces(std::size_t chunk) const { return pieces_.data() + chunks_[chunk]; }
  std::int64_t pieceCount(std::size_t chunk) const
  {
    return std::int64_t(chunks_[chunk + 1] - chunks_[chunk]);
  }
  std::int64_t pointCount(std::size_t chunk) const
  {
    std::int64_t sum = 0;
    for (std::size_t i = chunks_[chunk]; i < chunks_[chunk + 1]; ++i)
    {
      sum += pieces_[i].end - pieces_[i].begin;
    }
    return sum;
  }

private:
  void append(PointRange range, std::int64_t chunkPoints)
  {
    while (range.begin < range.end)
    {
      if (chunks_.empty() || inChunk_ == chunkPoints)
      {
        chunks_.push_back(pieces_.size());
        inChunk_ = 0;
      }
      const std::int64_t size = std::min({ range.end - range.begin, kPieceSize, chunkPoints - inChunk_ });
      pieces_.push_back({ range.begin, range.begin + size });
      range.begin += size;
      inChunk_ += size;
    }
  }

  PointView points_;
  const std::uint32_t* originals_ = nullptr;
  std::vector<PointRange> pieces_;
  std::vector<std::size_t> chunks_; ///< First pieces, and an end.
  std::int64_t inChunk_ = 0;
};

/// How the voxels of a lattice are divided into partitions: blocks of rows (voxels along x) of a layer, or
/// blocks of layers. Keys ascend from partition to partition.
struct PartitionPlan
{
  std::uint32_t columns = 1;
  std::uint32_t rowsPerLayer = 1;
  /// Rows in the half of the lattice that the bit of z left out of records stands for; 0: it is never set.
  std::uint32_t upperRows = 0;
  int fractionBits = 0;
  std::uint32_t blocksPerLayer = 1;
  int rowShift = 0;   ///< Rows of a block, as a power of two.
  int layerShift = 0; ///< Layers of a block, likewise; above 0 only with one block per layer.
  std::uint32_t partitions = 1;
  bool isFine = false; ///< Records have the index of a voxel alone.

  std::uint32_t firstRow(std::uint32_t partition) const
  {
    return ((partition / blocksPerLayer) << layerShift) * rowsPerLayer +
      ((partition % blocksPerLayer) << rowShift);
  }
  CellMap cellMap(std::uint32_t partition) const
  {
    const std::uint32_t first = firstRow(partition);
    return { fractionBits, columns, rowsPerLayer, first, upperRows > 0 ? first % upperRows : first };
  }
  std::uint64_t firstKey(std::uint32_t partition) const
  {
    return std::uint64_t(firstRow(partition)) * columns;
  }
  /// Cells of the largest partition.
  std::size_t cells() const
  {
    const std::size_t rows =
      blocksPerLayer > 1 ? std::size_t(1) << rowShift : std::size_t(rowsPerLayer) << layerShift;
    return columns * rows;
  }
};

/// The first two stages. Records lie in blocks of one piece of memory: the writer of a thread takes a block
/// for each partition it has a point for, and a new one when that is full; the blocks of a writer and
/// partition form a list.
class PointBinner
{
public:
  /// For the lattice and the transform of @p request. @p arrays: to go with the records, as many as have
  /// room; @p numbered: with the numbers of their points.
  void prepare(const VoxelRequest& request, const Chunks& chunks, const std::vector<AttributeView>& arrays,
    bool numbered);
  /// Makes room for chunks @p first to before @p last, and forgets those before.
  void start(const Chunks& chunks, std::size_t first, std::size_t last, const Executor& executor);
  /// Quantizes and bins one of them.
  void add(const VoxelRequest& request, const Chunks& chunks, std::size_t chunk, const Executor& executor);

  const PartitionPlan& plan() const { return plan_; }
  const PointQuantizer& quantizer() const { return quantizer_; }
  /// Layout of a record's payload.
  const PayloadLayout& payloadLayout() const { return payloadLayout_; }
  /// Records of a partition.
  std::size_t count(std::uint32_t partition) const;
  /// The partition with records that a thread takes next after @p partition, if all take them in turn; the
  /// number of partitions if there is none.
  std::uint32_t following(std::uint32_t partition) const;
  /// Points that were counted, PointRecordWriter::inside or invalid.
  std::int64_t total(std::int64_t PointRecordWriter::*count) const;

  /// Walks over the blocks of a partition, from the last of each writer to its first.
  class Walk
  {
  public:
    Walk(const PointBinner& binner, std::uint32_t partition)
      : binner_(binner)
      , partition_(partition)
    {
    }
    /// Goes to the next block, at first to the first. @return whether there is one.
    bool next();
    const PointRecord* records() const { return binner_.records_.data() + first_; }
    /// Records to prefetch while this block is processed: those of the next block, or of this one again.
    const PointRecord* recordsAhead() const
    {
      Walk ahead = *this;
      return ahead.next() ? ahead.records() : records();
    }
    /// Payloads of the records.
    const std::uint32_t* payloads() const
    {
      return binner_.payloads_.data() + std::size_t(binner_.payloadLayout_.words) * first_;
    }
    /// The numbers of the points, if they were kept.
    void copyNumbers(std::int64_t* numbers) const
    {
      const int words = binner_.payloadLayout_.words;
      for (int i = 0; binner_.payloadLayout_.numbered && i < count(); ++i)
      {
        numbers[i] = binner_.firstNumber_ + payloads()[words * i];
      }
    }
    void fetchPayloads() const
    {
      for (int i = 0; i < binner_.payloadLayout_.words * count(); i += kLineNumbers)
      {
        fetch(payloads() + i);
      }
    }
    int count() const { return int(end_ - first_); }

  private:
    const PointBinner& binner_;
    std::uint32_t partition_;
    std::size_t writer_ = 0; ///< The one whose blocks come next.
    std::uint32_t previousBlock_ = kNoBlock;
    std::size_t first_ = 0;
    std::size_t end_ = 0;
  };

private:
  struct alignas(kApart) Writer : PointRecordWriter
  {
    std::vector<PointRecord*> cursorStorage;
    std::vector<std::uint32_t> lastStorage;
  };

  alignas(kApart) PartitionPlan plan_;
  alignas(kApart) PointQuantizer quantizer_{};
  PayloadLayout payloadLayout_;
  std::int64_t firstNumber_ = 0; ///< Others are counted from this in records: they fit four bytes.
  std::size_t blockRecords_ = kBlockRecords;
  Buffer<PointRecord> records_;
  Buffer<std::uint32_t> payloads_;
  Buffer<std::uint32_t> previous_;
  alignas(kApart) std::uint32_t takenBlocks_ = 0;
  std::vector<std::unique_ptr<Writer>> writers_;
};

inline bool PointBinner::Walk::next()
{
  std::uint32_t block = previousBlock_;
  if (block != kNoBlock)
  {
    end_ = (std::size_t(block) + 1) * binner_.blockRecords_;
  }
  while (block == kNoBlock && partition_ < binner_.plan_.partitions && writer_ < binner_.writers_.size())
  {
    const Writer& writer = *binner_.writers_[writer_++];
    block = writer.lastBlocks[partition_];
    if (block != kNoBlock)
    {
      end_ = std::size_t(writer.cursors[partition_] - binner_.records_.data());
    }
  }
  if (block == kNoBlock)
  {
    return false;
  }
  previousBlock_ = binner_.previous_[block];
  first_ = std::size_t(block) * binner_.blockRecords_ +
    (previousBlock_ == kNoBlock ? firstRecord(partition_, binner_.blockRecords_) : 0);
  return true;
}

} // namespace pointhaptics::simd
