/// @file
/// Records of a chunk of points, sorted into partitions while they are written.
#pragma once

#include "Core/Buffer.h"
#include "Core/Kernel/VoxelKernel.h"

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace pointhaptics
{
namespace kernel
{

/// Blocks of records in one piece of memory. A writer takes a block for each partition it has a point for and
/// a new one when that is full; the blocks of a writer and partition are a list. Writers run at the same
/// time.
class RecordPool
{
public:
  /// Room for @p points records of @p partitions partitions, written by at most @p writers writers at once;
  /// @p indexed: with the index of its point beside each. Empties the pool.
  void prepare(std::int64_t points, std::uint32_t partitions, int writers, bool indexed);

  /// A writer nobody else uses, for as long as this lives. Waits while all are taken.
  class Lease
  {
  public:
    explicit Lease(RecordPool& pool);
    ~Lease();
    Lease(const Lease&) = delete;
    Lease& operator=(const Lease&) = delete;
    RecordWriter& writer() const;

  private:
    RecordPool& pool_;
    std::size_t slot_;
  };

  /// Calls visit(records, indices, count) for each block of a partition; indices is null without.
  template <typename Visit>
  void forBlocks(std::uint32_t partition, Visit&& visit) const
  {
    for (const std::unique_ptr<Writer>& writer : writers_)
    {
      std::uint32_t block = writer->lastBlocks[partition];
      if (block == kNone)
      {
        continue;
      }
      auto end = std::size_t(writer->cursors[partition] - records_.data());
      while (block != kNone)
      {
        const std::uint32_t next = previous_[block];
        prefetch(next);
        const std::size_t first =
          std::size_t(block) * kBlockRecords + (next == kNone ? stagger(partition) : 0);
        visit(records_.data() + first, indices_ ? indices_ + first : nullptr, int(end - first));
        block = next;
        end = (std::size_t(block) + 1) * kBlockRecords;
      }
    }
  }
  /// Fetches where forBlocks() will begin.
  void prefetchFirst(std::uint32_t partition) const
  {
    for (const std::unique_ptr<Writer>& writer : writers_)
    {
      if (partition < writer->lastBlocks.size())
      {
        prefetch(writer->lastBlocks[partition]);
      }
    }
  }
  std::size_t count(std::uint32_t partition) const;
  std::int64_t inside() const;
  std::int64_t invalid() const;
  std::size_t bytes() const;

private:
  static constexpr std::uint32_t kNone = ~std::uint32_t(0);
  /// Blocks a writer takes at once: an atomic operation waits for all stores before it.
  static constexpr std::uint32_t kTakenBlocks = 32;

  /// Where a partition's first block begins to be filled. All cursors advance at about the same pace: without
  /// this they would crowd the same few sets of the first-level cache.
  static std::size_t stagger(std::uint32_t partition)
  {
    constexpr std::uint32_t kLine = 64 / sizeof(Record);
    return kLine * (partition % std::uint32_t(kBlockRecords / kLine));
  }

  struct Writer : RecordWriter
  {
    RecordPool* pool = nullptr;
    std::vector<Record*> cursorStorage;
    std::vector<std::uint32_t> lastBlocks;
    std::uint32_t nextBlock = 0; ///< Of those it took in advance.
    std::uint32_t endBlock = 0;
    bool taken = false;
  };
  static Record* refill(RecordWriter& writer, std::uint32_t partition);
  void prefetch(std::uint32_t block) const
  {
    if (block != kNone)
    {
      const Record* records = records_.data() + std::size_t(block) * kBlockRecords;
      // The rest comes by itself once the first lines are read.
      for (std::size_t i = 0; i < kBlockRecords / 4; i += 64 / sizeof(Record))
      {
        __builtin_prefetch(records + i);
      }
    }
  }

  Buffer<Record> records_;
  Buffer<std::uint32_t> indexStorage_;
  std::uint32_t* indices_ = nullptr;
  Buffer<std::uint32_t> previous_;
  std::atomic<std::uint32_t> nextBlock_{ 0 };
  std::vector<std::unique_ptr<Writer>> writers_;
  std::mutex mutex_;
  std::condition_variable returned_;
};

} // namespace kernel
} // namespace pointhaptics
