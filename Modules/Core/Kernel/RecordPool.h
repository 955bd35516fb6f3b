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

  /// Calls visit(records, indices, count, next) for each block of a partition; indices is null without. next
  /// is where the block begins that will be visited then, if all goes by partitions: fetch it while at work
  /// on this.
  template <typename Visit>
  void forBlocks(std::uint32_t partition, Visit&& visit) const
  {
    for (std::size_t w = 0; w < writers_.size(); ++w)
    {
      const Writer& writer = *writers_[w];
      std::uint32_t block = writer.lastBlocks[partition];
      if (block == kNone)
      {
        continue;
      }
      auto end = std::size_t(writer.cursors[partition] - records_.data());
      while (block != kNone)
      {
        const std::uint32_t before = previous_[block];
        const std::uint32_t next = before == kNone ? firstBlock(partition, w + 1) : before;
        const std::size_t first =
          std::size_t(block) * blockRecords_ + (before == kNone ? stagger(partition) : 0);
        visit(records_.data() + first, indices_ ? indices_ + first : nullptr, int(end - first),
          records_.data() + std::size_t(next) * blockRecords_);
        block = before;
        end = (std::size_t(block) + 1) * blockRecords_;
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
  std::size_t stagger(std::uint32_t partition) const
  {
    return kLineRecords * (partition % std::uint32_t(blockRecords_ / kLineRecords));
  }

  struct alignas(kApart) Writer : RecordWriter
  {
    RecordPool* pool = nullptr;
    std::vector<Record*> cursorStorage;
    std::vector<std::uint32_t> lastBlocks;
    std::uint32_t nextBlock = 0; ///< Of those it took in advance.
    std::uint32_t endBlock = 0;
    bool taken = false;
  };
  static Record* refill(RecordWriter& writer, std::uint32_t partition);
  /// The first block in the order of visits of a partition from writer @p writer on, or of the partition
  /// that the same thread will take next if all take them in turn; any block where there is none.
  std::uint32_t firstBlock(std::uint32_t partition, std::size_t writer) const;

  std::size_t blockRecords_ = kBlockRecords;
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
