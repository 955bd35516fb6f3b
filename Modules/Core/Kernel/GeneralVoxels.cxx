#include "Core/Kernel/GeneralVoxels.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pointhaptics
{
namespace kernel
{
namespace
{

bool isOneVoxel(const Lattice& lattice)
{
  return lattice.dimensions == std::array<std::int64_t, 3>{ 1, 1, 1 };
}

}

Lattice coarserLattice(const Lattice& lattice)
{
  Lattice coarse = lattice;
  if (isOneVoxel(lattice))
  {
    return coarse;
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto a = std::size_t(axis);
    coarse.dimensions[a] = (lattice.dimensions[a] + 1) / 2;
    coarse.spacing[axis] = 2.0 * lattice.spacing[axis];
    // A last voxel that had no partner reaches out of the workspace.
    coarse.end[axis] = 0.5 * std::min(lattice.end[axis], double(lattice.dimensions[a]));
  }
  return coarse;
}

Lattice finerLattice(const Lattice& lattice, int halvings)
{
  Lattice fine = lattice;
  for (int axis = 0; axis < 3; ++axis)
  {
    fine.dimensions[std::size_t(axis)] = lattice.dimensions[std::size_t(axis)] << halvings;
    fine.spacing[axis] = std::ldexp(lattice.spacing[axis], -halvings);
    fine.end[axis] = std::ldexp(lattice.end[axis], halvings);
  }
  return fine;
}

namespace
{

/// Whether the index of a fine voxel is odd, on each axis.
using Parity = std::array<std::int64_t, 3>;

/// One fine voxel's share of its coarse one: places move by half a coarse voxel where the index is odd.
void addShare(VoxelSums& to, const VoxelSums& voxel, const Parity& odd, int fractionBits)
{
  to.count += voxel.count;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    to.sums[axis] += voxel.sums[axis] + ((Int128(voxel.count) * odd[axis]) << fractionBits);
  }
}

void addShareOfSeconds(
  SecondSums& to, const VoxelSums& voxel, const SecondSums& seconds, const Parity& odd, int fractionBits)
{
  const int rows[6] = { 0, 1, 2, 0, 1, 0 };
  const int columns[6] = { 0, 1, 2, 1, 2, 2 };
  for (int m = 0; m < 6; ++m)
  {
    const UInt128 a = UInt128(odd[std::size_t(rows[m])]) << fractionBits;
    const UInt128 b = UInt128(odd[std::size_t(columns[m])]) << fractionBits;
    to.lanes[m] += seconds.lanes[m] + a * UInt128(voxel.sums[columns[m]]) + b * UInt128(voxel.sums[rows[m]]) +
      a * b * UInt128(voxel.count);
  }
}

/// Makes coarse voxels of the fine ones of whole coarse layers, which follow each other.
class Coarsening
{
public:
  Coarsening(const VoxelSumList& fine, const Lattice& fineLattice, const Lattice& coarseLattice,
    std::vector<std::int64_t>& parents)
    : fine_(fine)
    , coarseLattice_(coarseLattice)
    , parents_(parents)
    , rowKeys_(std::uint64_t(fineLattice.dimensions[0]))
    , layerKeys_(rowKeys_ * std::uint64_t(fineLattice.dimensions[1]))
  {
  }
  /// The first fine voxel of the coarse layer that voxel @p v is in.
  std::size_t layerBegin(std::size_t v) const
  {
    return v < fine_.voxels.size() ? this->firstFrom((fine_.voxels[v].key / layerKeys_ / 2) * 2 * layerKeys_)
                                   : fine_.voxels.size();
  }
  /// Those of the fine voxels [begin, end), in ascending order. Their parents are numbered from 0 on.
  VoxelSumList coarse(std::size_t begin, std::size_t end) const
  {
    VoxelSumList coarse;
    // Pages that nothing is written to take no memory.
    coarse.voxels.reserve(end - begin);
    coarse.seconds.reserve(fine_.seconds.empty() ? 0 : end - begin);
    while (begin < end)
    {
      const std::uint64_t layer = fine_.voxels[begin].key / layerKeys_ / 2;
      const std::uint64_t firstKey = 2 * layer * layerKeys_;
      const std::size_t middle = this->firstFrom(firstKey + layerKeys_);
      const std::size_t next = this->firstFrom(firstKey + 2 * layerKeys_);
      this->appendLayer(layer, { begin, middle }, { middle, next }, coarse);
      begin = next;
    }
    return coarse;
  }

private:
  /// Fine voxels [at, end).
  struct Range
  {
    std::size_t at;
    std::size_t end;
  };
  /// Those of a fine row, whose voxel at x = 0 has this key.
  struct Row
  {
    Range range;
    std::uint64_t firstKey;
  };

  std::uint64_t key(std::size_t v) const { return fine_.voxels[v].key; }
  std::size_t firstFrom(std::uint64_t key) const
  {
    const auto first = std::lower_bound(fine_.voxels.begin(), fine_.voxels.end(), key,
      [](const VoxelSums& voxel, std::uint64_t wanted) { return voxel.key < wanted; });
    return std::size_t(first - fine_.voxels.begin());
  }
  /// The coarse voxels of two fine layers: row by row, each of four fine rows.
  void appendLayer(std::uint64_t layer, Range lower, Range upper, VoxelSumList& coarse) const
  {
    Range layers[2] = { lower, upper };
    const std::uint64_t firstKeys[2] = { 2 * layer * layerKeys_, (2 * layer + 1) * layerKeys_ };
    while (layers[0].at < layers[0].end || layers[1].at < layers[1].end)
    {
      std::uint64_t coarseRow = ~std::uint64_t(0);
      for (int z = 0; z < 2; ++z)
      {
        if (layers[z].at < layers[z].end)
        {
          coarseRow = std::min(coarseRow, (this->key(layers[z].at) - firstKeys[z]) / rowKeys_ / 2);
        }
      }
      Row rows[4];
      for (int z = 0; z < 2; ++z)
      {
        for (int y = 0; y < 2; ++y)
        {
          const std::uint64_t firstKey = firstKeys[z] + (2 * coarseRow + std::uint64_t(y)) * rowKeys_;
          const std::size_t begin = layers[z].at;
          while (layers[z].at < layers[z].end && this->key(layers[z].at) < firstKey + rowKeys_)
          {
            ++layers[z].at;
          }
          rows[2 * z + y] = { { begin, layers[z].at }, firstKey };
        }
      }
      this->appendRow(rows, coarseLattice_.key(0, std::int64_t(coarseRow), std::int64_t(layer)), coarse);
    }
  }
  /// Rows: even y and z, odd y, odd z, both odd.
  void appendRow(Row rows[4], std::uint64_t coarseKey, VoxelSumList& coarse) const
  {
    constexpr std::uint64_t kNone = ~std::uint64_t(0);
    const auto coarseX = [this](const Row& row)
    { return row.range.at < row.range.end ? (this->key(row.range.at) - row.firstKey) / 2 : kNone; };
    while (true)
    {
      const std::uint64_t x =
        std::min(std::min(coarseX(rows[0]), coarseX(rows[1])), std::min(coarseX(rows[2]), coarseX(rows[3])));
      if (x == kNone)
      {
        return;
      }
      coarse.voxels.push_back({ coarseKey + x, 0, { 0, 0, 0 } });
      if (!fine_.seconds.empty())
      {
        coarse.seconds.push_back(SecondSums{ { 0, 0, 0, 0, 0, 0 } });
      }
      for (int r = 0; r < 4; ++r)
      {
        for (std::size_t& v = rows[r].range.at; coarseX(rows[r]) == x; ++v)
        {
          const VoxelSums& voxel = fine_.voxels[v];
          const Parity odd = { std::int64_t((voxel.key - rows[r].firstKey) % 2), r % 2, r / 2 };
          addShare(coarse.voxels.back(), voxel, odd, fine_.fractionBits);
          if (!fine_.seconds.empty())
          {
            addShareOfSeconds(coarse.seconds.back(), voxel, fine_.seconds[v], odd, fine_.fractionBits);
          }
          parents_[v] = std::int64_t(coarse.voxels.size()) - 1;
        }
      }
    }
  }

  const VoxelSumList& fine_;
  const Lattice& coarseLattice_;
  std::vector<std::int64_t>& parents_;
  std::uint64_t rowKeys_;
  std::uint64_t layerKeys_;
};

}

bool coarserSums(const VoxelSumList& fine, const Lattice& fineLattice, const Lattice& coarseLattice,
  VoxelSumList& coarse, std::vector<std::int64_t>& parents, const Executor& executor, Watcher* watcher)
{
  if (isOneVoxel(fineLattice))
  {
    parents.assign(fine.voxels.size(), 0);
    coarse = fine;
    return true;
  }
  const std::size_t size = fine.voxels.size();
  parents.resize(size);
  const Coarsening coarsening(fine, fineLattice, coarseLattice, parents);
  // Rounds, after each of which the watcher hears, of pieces for the threads.
  const std::size_t rounds = size / std::size_t(kWatchedPoints) + 1;
  const auto piecesOfRound = std::size_t(16 * executor.concurrency());
  const std::size_t pieces = rounds * piecesOfRound;
  std::vector<std::size_t> begins(pieces + 1, size);
  for (std::size_t piece = 0; piece < pieces; ++piece)
  {
    begins[piece] = coarsening.layerBegin(size * piece / pieces);
  }
  WatchedPoints watched(watcher, std::int64_t(size), 2);
  const auto forPieces = [&](auto&& work)
  {
    for (std::size_t round = 0; round < rounds; ++round)
    {
      const std::size_t first = round * piecesOfRound;
      forEachItem(executor, piecesOfRound, [&](std::size_t i) { work(first + i); });
      if (!watched.add(std::int64_t(begins[first + piecesOfRound] - begins[first])))
      {
        return false;
      }
    }
    return true;
  };
  std::vector<VoxelSumList> lists(pieces);
  if (!forPieces(
        [&](std::size_t piece) { lists[piece] = coarsening.coarse(begins[piece], begins[piece + 1]); }))
  {
    return false;
  }
  std::vector<std::size_t> places(pieces + 1, 0);
  for (std::size_t piece = 0; piece < pieces; ++piece)
  {
    places[piece + 1] = places[piece] + lists[piece].voxels.size();
  }
  coarse.fractionBits = fine.fractionBits + 1;
  coarse.voxels.resize(places[pieces]);
  coarse.seconds.resize(fine.seconds.empty() ? 0 : places[pieces]);
  return forPieces(
    [&](std::size_t piece)
    {
      const auto place = std::ptrdiff_t(places[piece]);
      std::copy(lists[piece].voxels.begin(), lists[piece].voxels.end(), coarse.voxels.begin() + place);
      std::copy(lists[piece].seconds.begin(), lists[piece].seconds.end(), coarse.seconds.begin() + place);
      lists[piece] = VoxelSumList();
      for (std::size_t v = begins[piece]; v < begins[piece + 1]; ++v)
      {
        parents[v] += place;
      }
    });
}

} // namespace kernel
} // namespace pointhaptics
