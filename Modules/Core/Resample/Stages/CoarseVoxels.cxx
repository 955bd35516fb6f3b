#include "Core/Resample/Stages/CoarseVoxels.h"

#include "Core/Base/RadixSort.h"

#include <algorithm>

namespace pointhaptics
{
namespace simd
{
namespace
{

constexpr std::uint64_t kNoKey = ~std::uint64_t(0);

/// The coarse voxels of fine ones that come in ascending order: only a new row takes divisions.
class CoarseKeys
{
public:
  explicit CoarseKeys(const Lattice& fine)
    : fine_(fine)
    , coarse_(coarserLattice(fine))
  {
  }
  /// The coarse voxel's key, then three bits: whether the indices z, y, x of the fine one are odd.
  std::uint64_t of(std::uint64_t key)
  {
    if (key < rowBegin_ || key >= rowEnd_)
    {
      const auto index = fine_.indexOf(key);
      rowBegin_ = key - std::uint64_t(index[0]);
      rowEnd_ = rowBegin_ + std::uint64_t(fine_.dimensions[0]);
      coarseRow_ = coarse_.key(0, index[1] / 2, index[2] / 2);
      oddRow_ = std::uint64_t(index[2] % 2) << 2 | std::uint64_t(index[1] % 2) << 1;
    }
    const std::uint64_t x = key - rowBegin_;
    return (coarseRow_ + x / 2) << 3 | oddRow_ | x % 2;
  }

private:
  Lattice fine_;
  Lattice coarse_;
  std::uint64_t rowBegin_ = 0;
  std::uint64_t rowEnd_ = 0;
  std::uint64_t coarseRow_ = 0;
  std::uint64_t oddRow_ = 0;
};

/// A fine voxel on its way into a coarse one.
struct Entry
{
  std::uint64_t key; ///< See CoarseKeys.
  const VoxelRun* run;
  std::size_t voxel;
};

struct Scratch
{
  std::vector<Entry> entries;
  std::vector<Entry> other;
};

/// Adds a fine voxel. Offsets grow by half a coarse voxel where the index is odd. No branch here depends on
/// the voxel: it would be unpredictable.
void addFine(const Entry& entry, int fractionBits, VoxelSums& to, SecondMoments* moments)
{
  constexpr int kRows[6] = { 0, 1, 2, 0, 1, 0 };
  constexpr int kColumns[6] = { 0, 1, 2, 1, 2, 2 };
  const VoxelSums fine = entry.run->voxels[entry.voxel].whole();
  // All bits, or none.
  const Int128 odd[3] = { -Int128(entry.key & 1), -Int128(entry.key >> 1 & 1), -Int128(entry.key >> 2 & 1) };
  const Int128 moved = Int128(fine.count) << fractionBits;
  to.count += fine.count;
  for (int axis = 0; axis < 3; ++axis)
  {
    to.sums[axis] += fine.sums[axis] + (odd[axis] & moved);
  }
  if (!moments)
  {
    return;
  }
  add(*moments, *entry.run->momentsOf(entry.voxel));
  const auto movedSum = [&](int axis) { return UInt128(fine.sums[axis]) << fractionBits; };
  for (int m = 0; m < 6; ++m)
  {
    const int a = kRows[m];
    const int b = kColumns[m];
    moments->lanes[m] += (UInt128(odd[a]) & movedSum(b)) + (UInt128(odd[b]) & movedSum(a)) +
      (UInt128(odd[a] & odd[b]) & (UInt128(moved) << fractionBits));
  }
}

/// The coarse voxels of the fine ones with keys from @p first to before @p end.
VoxelRun sumPiece(const std::vector<const VoxelRun*>& runs, const Lattice& lattice, int fractionBits,
  std::uint64_t first, std::uint64_t end, Scratch& scratch)
{
  const auto place = [](const VoxelRun& run, std::uint64_t key)
  {
    return std::size_t(std::lower_bound(run.voxels.begin(), run.voxels.end(), key,
                         [](const WideSums& voxel, std::uint64_t k) { return voxel.key < k; }) -
      run.voxels.begin());
  };
  CoarseKeys coarse(lattice);
  std::vector<Entry>& entries = scratch.entries;
  entries.clear();
  auto run = std::lower_bound(runs.begin(), runs.end(), first,
    [](const VoxelRun* r, std::uint64_t key) { return r->voxels.back().key < key; });
  for (; run != runs.end() && (*run)->voxels.front().key < end; ++run)
  {
    const std::size_t last = place(**run, end);
    for (std::size_t v = place(**run, first); v < last; ++v)
    {
      entries.push_back({ coarse.of((*run)->voxels[v].key), *run, v });
    }
  }
  const std::size_t size = entries.size();
  scratch.other.resize(std::max(size, scratch.other.size()));
  radixSort(entries, scratch.other, size, [](const Entry& entry) { return entry.key; });
  const bool withMoments = size > 0 && entries[0].run->momentsOf(0);
  VoxelRun sums;
  sums.voxels.reserve(size);
  sums.secondMoments.reserve(withMoments ? size : 0);
  for (std::size_t i = 0; i < size;)
  {
    VoxelSums sum{ entries[i].key >> 3, 0, { 0, 0, 0 } };
    if (withMoments)
    {
      sums.secondMoments.push_back(SecondMoments{});
    }
    for (; i < size && entries[i].key >> 3 == sum.key; ++i)
    {
      addFine(entries[i], fractionBits, sum, withMoments ? &sums.secondMoments.back() : nullptr);
    }
    sums.voxels.push_back(WideSums::of(sum));
  }
  return sums;
}

}

bool sumCoarseVoxels(const VoxelRuns& fine, const Lattice& lattice, VoxelRuns& coarse,
  const Executor& executor, ProgressObserver* observer)
{
  if (coarserLattice(lattice).dimensions == lattice.dimensions)
  {
    coarse = fine;
    return true;
  }
  std::vector<const VoxelRun*> runs;
  std::vector<std::size_t> offsets = { 0 };
  for (std::size_t range = 0; range < fine.ranges(); ++range)
  {
    if (fine.size(range) > 0)
    {
      runs.push_back(&fine.run(range));
      offsets.push_back(offsets.back() + fine.size(range));
    }
  }
  const std::size_t size = offsets.back();
  // Rounds of pieces for the threads, with a report after each round. Pieces are whole coarse layers.
  const std::uint64_t twoLayers = 2 * lattice.key(0, 0, 1);
  const std::size_t rounds = size / std::size_t(kPointsPerReport) + 1;
  const auto piecesOfRound = std::size_t(16 * executor.concurrency());
  const std::size_t pieces = rounds * piecesOfRound;
  std::vector<std::uint64_t> firsts(pieces + 1, kNoKey);
  for (std::size_t piece = 0; piece < pieces && size > 0; ++piece)
  {
    const std::size_t voxel = size * piece / pieces;
    const auto run =
      std::size_t(std::upper_bound(offsets.begin(), offsets.end(), voxel) - offsets.begin()) - 1;
    firsts[piece] = runs[run]->voxels[voxel - offsets[run]].key / twoLayers * twoLayers;
  }
  PointProgress progress(observer, std::int64_t(size), 1);
  coarse.reset(pieces, fine.fractionBits() + 1);
  for (std::size_t first = 0; first < pieces; first += piecesOfRound)
  {
    forEachItem<Scratch>(executor, piecesOfRound,
      [&](std::size_t i, Scratch& scratch)
      {
        const std::size_t piece = first + i;
        coarse.add(
          piece, sumPiece(runs, lattice, fine.fractionBits(), firsts[piece], firsts[piece + 1], scratch));
      });
    if (!progress.add(std::int64_t(size * (first + piecesOfRound) / pieces - size * first / pieces)))
    {
      return false;
    }
  }
  return true;
}

bool findParents(const std::uint64_t* fineKeys, std::int64_t fineVoxels, const Lattice& fine,
  const std::uint64_t* coarseKeys, std::int64_t coarseVoxels, std::vector<std::int64_t>& parents,
  const Executor& executor, ProgressObserver* observer)
{
  parents.resize(std::size_t(fineVoxels));
  const auto find = [&](std::int64_t begin, std::int64_t end)
  {
    CoarseKeys coarse(fine);
    const std::uint64_t* parent = coarseKeys;
    for (std::int64_t v = begin; v < end; ++v)
    {
      const std::uint64_t key = coarse.of(fineKeys[v]) >> 3;
      if (*parent > key || v == begin)
      {
        parent = std::lower_bound(coarseKeys, coarseKeys + coarseVoxels, key);
      }
      while (*parent < key)
      {
        ++parent;
      }
      parents[std::size_t(v)] = parent - coarseKeys;
    }
  };
  PointProgress progress(observer, fineVoxels, 1);
  return forReportedSlices(fineVoxels, progress,
    [&](std::int64_t first, std::int64_t last)
    {
      forRange(executor, last - first,
        [&](std::int64_t begin, std::int64_t end) { find(first + begin, first + end); });
    });
}

} // namespace simd
} // namespace pointhaptics
