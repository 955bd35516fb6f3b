/// @file
/// Point records of a chunk, binned into partitions while they are written.
#pragma once

#include "Core/Base/Buffer.h"
#include "Core/Resample/Kernel/Loops.h"
#include "Core/Resample/Kernel/PointRecordWriter.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

namespace pointhaptics::simd
{

/// Blocks of point records in one piece of memory. A writer takes a block for each partition it has a point
/// for, and a new one when that is full; the blocks of a writer and partition form a list. Writers run
/// concurrently.
class PointRecordPool
{
public:
  /// Room for @p points records of @p partitions partitions, written by @p writers writers. Empties the pool.
  /// @p layout: of the payload of each; numbers of points are counted from @p firstNumber.
  void prepare(std::int64_t points, std::uint32_t partitions, int writers, const PayloadLayout& layout,
    std::int64_t firstNumber);

  /// For one thread at a time.
  PointRecordWriter& writer(std::size_t number) { return *writers_[number]; }

  /// Walks over the blocks of a partition, from the last of each writer to its first.
  class Walk
  {
  public:
    Walk(const PointRecordPool& pool, std::uint32_t partition)
      : pool_(pool)
      , partition_(partition)
    {
    }
    /// Goes to the next block, at first to the first. @return whether there is one.
    bool next();
    const PointRecord* records() const { return pool_.records_.data() + first_; }
    /// Records to prefetch while this block is processed: those of the next block, or of this one again.
    const PointRecord* recordsAhead() const
    {
      Walk ahead = *this;
      return ahead.next() ? ahead.records() : records();
    }
    /// Payloads of the records.
    const std::uint32_t* payloads() const { return pool_.payloads_.data() + pool_.payloadWords_ * first_; }
    /// The numbers of the points, if they were kept.
    void copyNumbers(std::int64_t* numbers) const
    {
      if (!pool_.numbered_)
      {
        return;
      }
      const std::uint32_t* const from = payloads();
      const std::size_t words = pool_.payloadWords_;
      const std::int64_t first = pool_.firstNumber_;
      for (int i = 0; i < count(); ++i)
      {
        numbers[i] = first + from[words * std::size_t(i)];
      }
    }
    void fetchPayloads() const
    {
      for (int i = 0; i < int(pool_.payloadWords_) * count(); i += kLineNumbers)
      {
        fetch(payloads() + i);
      }
    }
    int count() const { return int(end_ - first_); }

  private:
    const PointRecordPool& pool_;
    std::uint32_t partition_;
    std::size_t writer_ = 0; ///< The one whose blocks come next.
    std::uint32_t previousBlock_ = kNoBlock;
    std::size_t first_ = 0;
    std::size_t end_ = 0;
  };
  /// The partition with records that a thread takes next after @p partition, if all take them in turn; the
  /// number of partitions if there is none.
  std::uint32_t following(std::uint32_t partition) const;
  std::size_t count(std::uint32_t partition) const;
  /// Points that the writers counted.
  std::int64_t total(std::int64_t PointRecordWriter::*count) const;
  std::size_t bytes() const;

private:
  struct alignas(kApart) Writer : PointRecordWriter
  {
    std::vector<PointRecord*> cursorStorage;
    std::vector<std::uint32_t> lastStorage;
  };
  std::uint32_t partitions() const { return std::uint32_t(writers_[0]->lastStorage.size()); }

  std::size_t blockRecords_ = kBlockRecords;
  Buffer<PointRecord> records_;
  Buffer<std::uint32_t> payloads_;
  std::size_t payloadWords_ = 0;
  bool numbered_ = false;
  std::int64_t firstNumber_ = 0;
  Buffer<std::uint32_t> previous_;
  alignas(kApart) std::uint32_t takenBlocks_ = 0;
  std::vector<std::unique_ptr<Writer>> writers_;
};

inline bool PointRecordPool::Walk::next()
{
  std::uint32_t block = previousBlock_;
  if (block != kNoBlock)
  {
    end_ = (std::size_t(block) + 1) * pool_.blockRecords_;
  }
  while (block == kNoBlock && partition_ < pool_.partitions() && writer_ < pool_.writers_.size())
  {
    const Writer& writer = *pool_.writers_[writer_++];
    block = writer.lastBlocks[partition_];
    if (block != kNoBlock)
    {
      end_ = std::size_t(writer.cursors[partition_] - pool_.records_.data());
    }
  }
  if (block == kNoBlock)
  {
    return false;
  }
  previousBlock_ = pool_.previous_[block];
  first_ = std::size_t(block) * pool_.blockRecords_ +
    (previousBlock_ == kNoBlock ? firstRecord(partition_, pool_.blockRecords_) : 0);
  return true;
}

} // namespace pointhaptics::simd
