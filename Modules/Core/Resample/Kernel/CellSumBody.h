/// @file
/// Part of VoxelKernelBody.h: finds the occupied cells of a partition, ranks them and sums the records of
/// each.
#pragma once

#include "Core/Resample/Kernel/Fetch.h"
#include "Core/Resample/Kernel/InFours.h"
#include "Core/Resample/Kernel/VoxelKernel.h"

namespace pointhaptics
{
namespace simd
{
namespace
{

/// Makes the number of a byte in memory from that of a byte of a word.
constexpr std::uint32_t kByteOrder = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__ ? 7 : 0;

/// @tparam inLayer: the partition is in one layer, see CellMap::firstInLayer.
template <bool inLayer>
inline std::uint32_t cellOf(const CellMap& map, const PointRecord& r)
{
  const auto x = std::uint32_t(r.first >> (kLowBits + map.fractionBits));
  const auto y = std::uint32_t(r.second >> (kLowBits + map.fractionBits));
  if (inLayer)
  {
    return x + map.columns * (y - map.firstInLayer);
  }
  const auto z = std::uint32_t((r.second & kLowMask) >> (map.fractionBits - kLowBits));
  const std::uint32_t row = y + map.rowsPerLayer * z;
  return x + map.columns * ((row < map.firstRow ? row + map.upperRows : row) - map.firstRow);
}

inline void fetchRecords(const PointRecord* records, int count)
{
  for (int i = 0; i < count; i += kLineRecords)
  {
    fetchToWrite(records + i);
  }
}

template <class V>
void cellsOf(
  const CellMap& map, const PointRecord* records, int count, const PointRecord* next, std::uint32_t* cells)
{
  constexpr int kStep = 64;
  for (int first = 0; first < count; first += kStep)
  {
    const int size = count - first < kStep ? count - first : kStep;
    fetchRecords(next + first, size);
    map.firstInLayer == CellMap::kSeveralLayers
      ? V::template cells<false>(map, records + first, size, cells + first)
      : V::template cells<true>(map, records + first, size, cells + first);
  }
}

inline void setOccupied(const std::uint32_t* cells, int count, std::uint64_t* occupancy)
{
  fromFourParts(count, [=](int i) { occupancy[cells[i] / 64] |= std::uint64_t(1) << (cells[i] % 64); });
}

/// Where no instruction counts the ones of a word: those of each byte and of the bytes below it.
inline std::uint64_t onesUpToBytes(std::uint64_t bits)
{
  bits -= (bits >> 1) & 0x5555555555555555u;
  bits = (bits & 0x3333333333333333u) + ((bits >> 2) & 0x3333333333333333u);
  bits = (bits + (bits >> 4)) & 0x0F0F0F0F0F0F0F0Fu;
  // What a multiplication by 0x0101010101010101 gives, which vectors do not have.
  bits += bits << 8;
  bits += bits << 16;
  return bits + (bits << 32);
}

/// And of each byte those below each of its bits.
struct OnesBelow
{
  unsigned char counts[8][256] = {};

  constexpr OnesBelow()
  {
    for (unsigned bit = 0; bit < 8; ++bit)
    {
      for (unsigned byte = 0; byte < 256; ++byte)
      {
        for (unsigned lower = 0; lower < bit; ++lower)
        {
          counts[bit][byte] = static_cast<unsigned char>(counts[bit][byte] + (byte >> lower) % 2);
        }
      }
    }
  }
};

/// Writes the rank table of a word with @p sum occupied cells before it. @return how many there are after it.
template <class V>
inline std::uint32_t rankWord(const CellRanks& ranks, std::size_t word, std::uint32_t sum)
{
  ranks.rankTable[word] = sum;
  if constexpr (V::countsOnes)
  {
    return sum + V::ones(ranks.occupancy[word]);
  }
  else
  {
    const std::uint64_t upToBytes = onesUpToBytes(ranks.occupancy[word]);
    ranks.byteRankTable[word] = upToBytes << 8;
    return sum + std::uint32_t(upToBytes >> 56);
  }
}

template <class V>
std::uint32_t rankTouchedWords(const CellRanks& ranks, const std::uint64_t* touched)
{
  std::uint32_t sum = 0;
  for (std::size_t first = 0; first < ranks.words; first += 64)
  {
    for (std::uint64_t left = touched[first / 64]; left != 0; left &= left - 1)
    {
      sum = rankWord<V>(ranks, first + std::size_t(__builtin_ctzll(left)), sum);
    }
  }
  return sum;
}

template <class V>
inline std::uint32_t rankOf(const CellRanks& ranks, std::uint32_t cell)
{
  if constexpr (V::countsOnes)
  {
    const std::uint64_t below = (std::uint64_t(1) << (cell % 64)) - 1;
    return ranks.rankTable[cell / 64] + V::ones(ranks.occupancy[cell / 64] & below);
  }
  else
  {
    static constexpr OnesBelow kOnesBelow;
    const std::uint32_t byteIndex = (cell / 8) ^ kByteOrder;
    const unsigned byte = reinterpret_cast<const unsigned char*>(ranks.occupancy)[byteIndex];
    const unsigned beforeByte = reinterpret_cast<const unsigned char*>(ranks.byteRankTable)[byteIndex];
    return ranks.rankTable[cell / 64] + beforeByte + kOnesBelow.counts[cell % 8][byte];
  }
}

template <class V>
void rank(const CellRanks& given, std::uint32_t* cells, int count)
{
  const CellRanks ranks = given; // A copy, which no store can change.
  for (int i = 0; i < count; ++i)
  {
    cells[i] = rankOf<V>(ranks, cells[i]);
  }
}

template <class V>
void accumulate(const CellMap& map, const CellRanks& givenRanks, const PointRecord* records,
  const std::uint32_t* cells, int count, const PointRecord* next, const CellSums& given)
{
  // Copies, which no store can change.
  const CellRanks ranks = givenRanks;
  const CellSums to = given;
  const typename V::Adder adder(map.fractionBits);
  // From several parts: neighbours in a scan are in one voxel, and each would wait for the one before.
  constexpr int kParts = 8;
  constexpr int kPart = 16;
  for (int first = 0; first < count; first += kParts * kPart)
  {
    const auto add = [=](int i)
    {
      const std::uint32_t cell = cells[first + i];
      const std::uint32_t rank = rankOf<V>(ranks, cell);
      to.cells[rank] = cell;
      adder.add(to.sums[rank], records[first + i]);
    };
    const int left = count - first;
    if (left < kParts * kPart)
    {
      fetchRecords(next + first, left);
      inFours(left, add);
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
    const typename V::ProductAdder productAdder(map.fractionBits);
    fromFourParts(
      count, [=](int i) { productAdder.add(to.secondMoments[rankOf<V>(ranks, cells[i])], records[i]); });
  }
}

}
} // namespace simd
} // namespace pointhaptics
