#include "Core/Resample/Stages/PointRecordPool.h"

#include <algorithm>
#include <numeric>

namespace pointhaptics::simd
{

namespace
{

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

}

void PointRecordPool::prepare(std::int64_t points, std::uint32_t partitions, int writers,
  const PayloadLayout& layout, std::int64_t firstNumber)
{
  const std::size_t writerCount = std::size_t(std::max(writers, 1));
  blockRecords_ = blockRecordsFor(writerCount);
  const std::size_t blocks =
    std::size_t(points) / blockRecords_ + writerCount * (2 * partitions + kTakenBlocks);
  records_.reserve(blocks * blockRecords_, Pages::Huge);
  previous_.reserve(blocks);
  firstNumber_ = firstNumber;
  payloadWords_ = std::size_t(layout.words);
  numbered_ = layout.numbered;
  payloads_.reserve(payloadWords_ * blocks * blockRecords_, Pages::Huge);
  takenBlocks_ = 0;
  while (writers_.size() < writerCount)
  {
    writers_.push_back(std::make_unique<Writer>());
  }
  writers_.resize(writerCount);
  for (const std::unique_ptr<Writer>& writer : writers_)
  {
    writer->cursorStorage.assign(partitions, nullptr);
    writer->lastStorage.assign(partitions, kNoBlock);
    writer->cursors = writer->cursorStorage.data();
    writer->blockMask = blockRecords_ * sizeof(PointRecord) - 1;
    writer->records = records_.data();
    writer->lastBlocks = writer->lastStorage.data();
    writer->previous = previous_.data();
    writer->taken = &takenBlocks_;
    writer->nextBlock = writer->endBlock = 0;
    writer->payloads = payloads_.data();
    writer->layout = layout;
    writer->inside = 0;
    writer->invalid = 0;
  }
}

std::uint32_t PointRecordPool::following(std::uint32_t partition) const
{
  do
  {
    partition += std::uint32_t(writers_.size());
  } while (partition < partitions() && !Walk(*this, partition).next());
  return std::min(partition, partitions());
}

std::size_t PointRecordPool::count(std::uint32_t partition) const
{
  std::size_t sum = 0;
  for (Walk walk(*this, partition); walk.next();)
  {
    sum += std::size_t(walk.count());
  }
  return sum;
}

std::int64_t PointRecordPool::total(std::int64_t PointRecordWriter::*count) const
{
  return std::accumulate(writers_.begin(), writers_.end(), std::int64_t(0),
    [=](std::int64_t sum, const std::unique_ptr<Writer>& writer) { return sum + (*writer).*count; });
}

std::size_t PointRecordPool::bytes() const
{
  std::size_t sum = records_.bytes() + payloads_.bytes() + previous_.bytes();
  for (const std::unique_ptr<Writer>& writer : writers_)
  {
    sum += writer->cursorStorage.capacity() * sizeof(PointRecord*) +
      writer->lastStorage.capacity() * sizeof(kNoBlock);
  }
  return sum;
}

} // namespace pointhaptics::simd
