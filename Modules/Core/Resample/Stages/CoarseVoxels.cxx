#include "Core/Resample/Stages/CoarseVoxels.h"

#include "Core/Base/RadixSort.h"
#include "Core/Resample/Stages/VoxelRuns.h"

#include <algorithm>

namespace pointhaptics
{
namespace simd
{
namespace
{

/// A fine voxel on its way into a coarse one, whose key is followed by three bits: whether the indices z, y,
/// x of the fine one are odd.
struct Entry
{
  std::uint64_t key;
  std::size_t voxel;
};

struct Scratch
{
  std::vector<Entry> entries;
  std::vector<Entry> other;
};

/// Moves the offsets of a fine voxel into the coarse one: they grow by half a coarse voxel where the index is
/// odd. No branch here depends on the voxel: it would be unpredictable.
WideSums moved(WideSums voxel, std::uint64_t entryKey, int fractionBits)
{
  const UInt128 half = UInt128(voxel.count) << fractionBits;
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::uint64_t odd = -(entryKey >> axis & 1); // All bits, or none.
    voxel.add(axis, std::uint64_t(half) & odd, std::uint64_t(half >> 64) & odd);
  }
  voxel.key = entryKey >> 3;
  return voxel;
}

/// The same of products of offsets.
SecondMoments movedMoments(
  SecondMoments moments, const WideSums& voxel, std::uint64_t entryKey, int fractionBits)
{
  constexpr int kRows[6] = { 0, 1, 2, 0, 1, 0 };
  constexpr int kColumns[6] = { 0, 1, 2, 1, 2, 2 };
  const auto masked = [&](int axis, UInt128 value)
  { return entryKey >> axis & 1 ? value << fractionBits : UInt128(0); };
  for (int m = 0; m < 6; ++m)
  {
    const int a = kRows[m];
    const int b = kColumns[m];
    moments.lanes[m] += masked(a, UInt128(voxel.sum(b))) + masked(b, UInt128(voxel.sum(a))) +
      masked(a, masked(b, UInt128(voxel.count)));
  }
  return moments;
}

/// Fine voxels that one thread takes at once, about, and how many such pieces there are between two reports.
constexpr std::size_t kPieceVoxels = 1 << 14;
constexpr std::size_t kPiecesPerReport = kPointsPerReport / kPieceVoxels;

/// The coarse voxels of fine ones, all of theirs.
VoxelRun sumPiece(const VoxelRun& fine, std::size_t first, std::size_t last, const Lattice& lattice,
  int fractionBits, Scratch& scratch)
{
  RowIndices indices(lattice);
  const Lattice coarse = coarserLattice(lattice);
  scratch.entries.clear();
  for (std::size_t v = first; v < last; ++v)
  {
    const auto i = indices.of(fine.voxels[v].key);
    const std::uint64_t odd =
      std::uint64_t(i[2] % 2) << 2 | std::uint64_t(i[1] % 2) << 1 | std::uint64_t(i[0] % 2);
    scratch.entries.push_back({ coarse.key(i[0] / 2, i[1] / 2, i[2] / 2) << 3 | odd, v });
  }
  scratch.other.resize(std::max(last - first, scratch.other.size()));
  radixSort(scratch.entries, scratch.other, last - first, [](const Entry& entry) { return entry.key; });
  VoxelRun sums;
  sums.reserve(last - first, fine.hasMoments());
  VoxelGroups groups;
  for (std::size_t i = 0; i < last - first; ++i)
  {
    const Entry& entry = scratch.entries[i];
    const WideSums& from = fine.voxels[entry.voxel];
    const WideSums voxel = moved(from, entry.key, fractionBits);
    const SecondMoments moments = fine.hasMoments()
      ? movedMoments(fine.secondMoments[entry.voxel], from, entry.key, fractionBits)
      : SecondMoments{};
    const SecondMoments* const wanted = fine.hasMoments() ? &moments : nullptr;
    if (i > 0 && sums.voxels.back().key == voxel.key)
    {
      sums.addToLast(voxel, wanted);
      ++groups.ends.back();
    }
    else
    {
      sums.push(voxel, wanted);
      groups.ends.push_back(i + 1);
    }
    groups.voxels.push_back({ 0, entry.voxel });
  }
  bool isRight = true; // No count is below 0.
  sums.gatherTallies(fine, VoxelRun(), groups, isRight);
  return sums;
}

}

bool sumCoarseVoxels(const VoxelRun& fine, const Lattice& lattice, int fractionBits, VoxelRun& coarse,
  const Executor& executor, ProgressObserver* observer)
{
  const std::size_t size = fine.size();
  const std::uint64_t twoLayers = 2 * lattice.key(0, 0, 1);
  const std::size_t pieces = size / kPieceVoxels + 1;
  std::vector<std::size_t> firsts(pieces + 1, size); // Pieces are whole coarse layers.
  for (std::size_t p = 0; p < pieces && size > 0; ++p)
  {
    firsts[p] = fine.find(fine.voxels[size * p / pieces].key / twoLayers * twoLayers);
  }
  std::vector<VoxelRun> runs(pieces);
  PointProgress progress(observer, std::int64_t(pieces), 1);
  for (std::size_t first = 0; first < pieces; first += kPiecesPerReport)
  {
    const std::size_t count = std::min(kPiecesPerReport, pieces - first);
    forEachItem<Scratch>(executor, count,
      [&](std::size_t i, Scratch& scratch)
      {
        const std::size_t p = first + i;
        runs[p] = sumPiece(fine, firsts[p], firsts[p + 1], lattice, fractionBits, scratch);
      });
    if (!progress.add(std::int64_t(count)))
    {
      return false;
    }
  }
  coarse = concatenated(runs, executor);
  return true;
}

} // namespace simd
} // namespace pointhaptics
