/// @file
/// Appends point records to partitions: the part of PointRecordPool that is inside the loops. Internal
/// linkage: sources of several instruction sets include it.
#pragma once

#include "Core/Resample/Kernel/VoxelKernel.h"

#include <cstddef>
#include <cstdint>

namespace pointhaptics::simd
{

constexpr std::uint32_t kNoBlock = ~std::uint32_t(0);

/// An array whose tuples go with the records of their points.
struct PayloadArray
{
  const char* values; ///< Address of the first number.
  std::int64_t step;  ///< Bytes from one tuple to the next.
  int bytes;          ///< Bytes of a tuple.
  int offset;         ///< In bytes, of a tuple in a payload.
};

/// Layout of a record's payload: its first word is the number of the point, if that is of use; tuples follow.
struct PayloadLayout
{
  static constexpr int kMostWords = 9;
  static constexpr int kMostArrays = 8;

  int words = 0; ///< Number of 32-bit words; 0: no payload.
  bool numbered = false;
  int count = 0;
  PayloadArray arrays[kMostArrays] = {};
};

/// The write position of one thread in each partition.
struct PointRecordWriter
{
  PointRecord** cursors;
  std::uintptr_t blockMask;  ///< Bytes of a block, less one.
  PointRecord* records;      ///< Start of the pool.
  std::uint32_t* lastBlocks; ///< Last block of each partition, or kNoBlock.
  std::uint32_t* previous;   ///< For each block of the pool, the block before it in its partition, or
                             ///< kNoBlock.
  std::uint32_t* taken;      ///< Blocks that the pool's writers have taken: they share it.
  std::uint32_t nextBlock;   ///< Next of the blocks that were taken in advance.
  std::uint32_t endBlock;
  std::uint32_t* payloads;        ///< Payload of each record.
  PayloadLayout layout;           ///< Layout of a payload.
  const std::uint32_t* originals; ///< Numbers from the first range's begin on; or null: they ascend.
  std::uint32_t firstNumber;      ///< Number of the first range's begin, where originals is null.
  std::int64_t inside;
  std::int64_t invalid;
};

/// Blocks a writer takes at once: an atomic operation waits for all stores before it.
constexpr std::uint32_t kTakenBlocks = 32;

/// Where a partition's first block begins to be filled. All cursors advance at about the same pace: without
/// this stagger they would compete for the same few sets of the first-level cache. @pre blockRecords: a power
/// of two.
static inline std::size_t firstRecord(std::uint32_t partition, std::size_t blockRecords)
{
  return kLineRecords * (partition & (blockRecords / kLineRecords - 1));
}

/// The cursor of a partition: at first, and where it stands at the end of its block, in a new block. Always
/// inline: a call would take what loops keep in vector registers out of them.
__attribute__((always_inline)) static inline PointRecord* cursorOf(
  PointRecordWriter& writer, PointRecord* const* cursors, std::uintptr_t blockMask, std::uint64_t partition)
{
  PointRecord* const cursor = cursors[partition];
  if (__builtin_expect((reinterpret_cast<std::uintptr_t>(cursor) & blockMask) != 0, true))
  {
    return cursor;
  }
  if (writer.nextBlock == writer.endBlock)
  {
    writer.nextBlock = __atomic_fetch_add(writer.taken, kTakenBlocks, __ATOMIC_RELAXED);
    writer.endBlock = writer.nextBlock + kTakenBlocks;
  }
  const std::uint32_t block = writer.nextBlock++;
  const std::uint32_t last = writer.lastBlocks[partition];
  writer.previous[block] = last;
  writer.lastBlocks[partition] = block;
  const std::size_t blockRecords = (blockMask + 1) / sizeof(PointRecord);
  return writer.records + block * blockRecords +
    (last == kNoBlock ? firstRecord(std::uint32_t(partition), blockRecords) : 0);
}

} // namespace pointhaptics::simd
