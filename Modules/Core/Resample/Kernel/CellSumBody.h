/// @file
/// Part of VoxelKernelBody.h: finds the occupied cells of a partition, ranks them and sums the records of
/// each.
#pragma once

#include "Core/Resample/Kernel/Loops.h"
#include "Core/Resample/Kernel/VoxelKernel.h"
#include "Core/Simd/Words.h"

namespace pointhaptics::simd
{
namespace
{

/// Which axes the six products of offsets are of.
constexpr int kFirstAxis[6] = { 0, 1, 2, 0, 1, 0 };
constexpr int kSecondAxis[6] = { 0, 1, 2, 1, 2, 2 };

inline void fetchRecords(const PointRecord* records, int count)
{
  for (int i = 0; i < count; i += kLineRecords)
  {
    fetchToWrite(records + i);
  }
}

void cellsOf(
  const CellMap& given, const PointRecord* records, int count, const PointRecord* next, std::uint32_t* cells)
{
  const CellMap map = given; // A copy, which no store can change.
  const int toIndex = kLowBits + map.fractionBits;
  const int toLayer = map.fractionBits - kLowBits;
  constexpr int kStep = 64;
  for (int first = 0; first < count; first += kStep)
  {
    const int last = count - first < kStep ? count : first + kStep;
    fetchRecords(next + first, last - first);
    for (int i = first; i < last; ++i)
    {
      const auto x = std::uint32_t(records[i].first >> toIndex);
      const auto y = std::uint32_t(records[i].second >> toIndex);
      const auto z = std::uint32_t((records[i].second & kLowMask) >> toLayer);
      cells[i] = x + map.columns * (y + map.rowsPerLayer * z - map.firstRecordRow);
    }
  }
}

void setOccupied(const std::uint32_t* cells, std::size_t count, std::uint64_t* occupancy)
{
  fromFourParts(
    count, [=](std::size_t i) { occupancy[cells[i] / 64] |= std::uint64_t(1) << (cells[i] % 64); });
}

std::uint32_t rankWords(const CellRanks& ranks, const std::uint64_t* touched)
{
  std::uint32_t sum = 0;
  const auto rankWord = [&](std::size_t word)
  {
    ranks.rankTable[word] = sum;
    sum += onesOf(ranks.occupancy[word]);
  };
  for (std::size_t word = 0; !touched && word < ranks.words; ++word)
  {
    rankWord(word);
  }
  for (std::size_t first = 0; touched && first < ranks.words; first += 64)
  {
    for (std::uint64_t left = touched[first / 64]; left != 0; left &= left - 1)
    {
      rankWord(first + std::size_t(__builtin_ctzll(left)));
    }
  }
  return sum;
}

inline std::uint32_t rankOf(const CellRanks& ranks, std::uint32_t cell)
{
  const std::uint64_t below = (std::uint64_t(1) << (cell % 64)) - 1;
  return ranks.rankTable[cell / 64] + onesOf(ranks.occupancy[cell / 64] & below);
}

/// Adds the offsets of a record to the four lanes of its cell's sums.
struct RecordAdder
{
  typedef std::uint64_t Two __attribute__((vector_size(16), may_alias));
  typedef std::uint64_t Four __attribute__((vector_size(32), may_alias));
  Four masks;

  explicit RecordAdder(int fractionBits)
  {
    const std::uint64_t fraction = (std::uint64_t(1) << fractionBits) - 1;
    masks = Four{ fraction, fraction, kLowMask, fraction >> kLowBits };
  }
  void add(PackedSums& sums, const PointRecord& r) const
  {
    const Two words = reinterpret_cast<const Two&>(r);
    const Four parts = __builtin_shufflevector(words >> kLowBits, words, 0, 1, 2, 3) & masks;
    reinterpret_cast<Four&>(sums.lanes) += parts + Four{ 0, 0, 0, std::uint64_t(1) << kCountShift };
  }
};

/// A function of its own: its vectors would take registers from the loop over the sums.
__attribute__((noinline)) void accumulateProducts(
  int fractionBits, const PointRecord* records, const std::uint32_t* ranks, int count, SecondMoments* to)
{
  const std::uint64_t mask = (std::uint64_t(1) << fractionBits) - 1;
  fromFourParts(count,
    [=](int i)
    {
      const PointRecord& r = records[i];
      addProducts(to[ranks[i]], xFraction(r, mask), yFraction(r, mask), zFraction(r, mask));
    });
}

void accumulate(const CellMap& map, const CellRanks& givenRanks, const PointRecord* records,
  std::uint32_t* cells, int count, const PointRecord* next, const CellSums& given)
{
  // Copies, which no store can change.
  const CellRanks ranks = givenRanks;
  const CellSums to = given;
  const RecordAdder adder(map.fractionBits);
  // From several parts: neighbours in a scan are in one voxel, and each would wait for the one before.
  constexpr int kParts = 8;
  constexpr int kPart = 16;
  for (int first = 0; first < count; first += kParts * kPart)
  {
    const auto add = [=](int i)
    {
      const std::uint32_t cell = cells[first + i];
      const std::uint32_t rank = rankOf(ranks, cell);
      to.cells[rank] = cell;
      cells[first + i] = rank;
      adder.add(to.sums[rank], records[first + i]);
    };
    const int left = count - first;
    if (left < kParts * kPart)
    {
      fetchRecords(next + first, left);
      for (int i = 0; i < left; ++i)
      {
        add(i);
      }
      break;
    }
    for (int i = 0; i < kPart; ++i)
    {
      fetchRecords(next + first + kParts * i, kParts);
      visitStrided<kPart, 0, kParts>(i, add);
    }
  }
  if (to.secondMoments)
  {
    accumulateProducts(map.fractionBits, records, cells, count, to.secondMoments);
  }
}

}
} // namespace pointhaptics::simd
