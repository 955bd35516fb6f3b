#include "Core/Resample/Stages/CoarseVoxels.h"

#include "Core/Base/RadixSort.h"

#include <algorithm>

namespace pointhaptics
{
namespace simd
{
namespace
{

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
  std::size_t voxel;
};

struct Scratch
{
  std::vector<Entry> entries;
  std::vector<Entry> other;
};

/// Moves the offsets of a fine voxel into the coarse one: they grow by half a coarse voxel where the index is
/// odd. No branch here depends on the voxel: it would be unpredictable.
WideSums moved(const WideSums& voxel, std::uint64_t coarseKey, int fractionBits, SecondMoments* moments)
{
  constexpr int kRows[6] = { 0, 1, 2, 0, 1, 0 };
  constexpr int kColumns[6] = { 0, 1, 2, 1, 2, 2 };
  VoxelSums sums = voxel.whole();
  // All bits, or none.
  const Int128 odd[3] = { -Int128(coarseKey & 1), -Int128(coarseKey >> 1 & 1), -Int128(coarseKey >> 2 & 1) };
  const Int128 half = Int128(sums.count) << fractionBits;
  const auto movedSum = [&](int axis) { return UInt128(sums.sums[axis]) << fractionBits; };
  for (int m = 0; moments && m < 6; ++m)
  {
    const int a = kRows[m];
    const int b = kColumns[m];
    moments->lanes[m] += (UInt128(odd[a]) & movedSum(b)) + (UInt128(odd[b]) & movedSum(a)) +
      (UInt128(odd[a] & odd[b]) & (UInt128(half) << fractionBits));
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    sums.sums[axis] += odd[axis] & half;
  }
  sums.key = coarseKey >> 3;
  return WideSums::of(sums);
}

/// Fine voxels that one thread takes at once, about, and how many such pieces there are between two reports.
constexpr std::size_t kPieceVoxels = 1 << 14;
constexpr std::size_t kPiecesPerReport = kPointsPerReport / kPieceVoxels;

/// The coarse voxels of fine ones, all of theirs. @p parents: counted from the first coarse one.
VoxelRun sumPiece(const VoxelRun& fine, std::size_t first, std::size_t last, const Lattice& lattice,
  int fractionBits, std::vector<std::int64_t>& parents, Scratch& scratch)
{
  CoarseKeys coarse(lattice);
  scratch.entries.clear();
  for (std::size_t v = first; v < last; ++v)
  {
    scratch.entries.push_back({ coarse.of(fine.voxels[v].key), v });
  }
  scratch.other.resize(std::max(last - first, scratch.other.size()));
  radixSort(scratch.entries, scratch.other, last - first, [](const Entry& entry) { return entry.key; });
  VoxelRun sums;
  sums.reserve(last - first, fine.hasMoments());
  for (std::size_t i = 0; i < last - first; ++i)
  {
    const Entry& entry = scratch.entries[i];
    SecondMoments moments = fine.hasMoments() ? fine.secondMoments[entry.voxel] : SecondMoments{};
    SecondMoments* const wanted = fine.hasMoments() ? &moments : nullptr;
    const WideSums voxel = moved(fine.voxels[entry.voxel], entry.key, fractionBits, wanted);
    if (i > 0 && sums.voxels.back().key == voxel.key)
    {
      sums.addToLast(voxel, wanted);
      static_cast<void>(sums.addTalliesToLast(fine, entry.voxel)); // Sums of points are right.
    }
    else
    {
      sums.push(voxel, wanted);
      sums.appendTallies(fine, entry.voxel, entry.voxel + 1);
    }
    parents[entry.voxel] = std::int64_t(sums.size()) - 1;
  }
  return sums;
}

}

bool sumCoarseVoxels(const VoxelRun& fine, const Lattice& lattice, int fractionBits, VoxelRun& coarse,
  std::vector<std::int64_t>& parents, const Executor& executor, ProgressObserver* observer)
{
  const std::size_t size = fine.size();
  const std::uint64_t twoLayers = 2 * lattice.key(0, 0, 1);
  const std::size_t pieces = size / kPieceVoxels + 1;
  std::vector<std::size_t> firsts(pieces + 1, size); // Pieces are whole coarse layers.
  for (std::size_t p = 0; p < pieces && size > 0; ++p)
  {
    firsts[p] = fine.find(fine.voxels[size * p / pieces].key / twoLayers * twoLayers);
  }
  parents.resize(size);
  std::vector<VoxelRun> runs(pieces);
  PointProgress progress(observer, std::int64_t(pieces), 1);
  for (std::size_t first = 0; first < pieces; first += kPiecesPerReport)
  {
    const std::size_t count = std::min(kPiecesPerReport, pieces - first);
    forEachItem<Scratch>(executor, count,
      [&](std::size_t i, Scratch& scratch)
      {
        const std::size_t p = first + i;
        runs[p] = sumPiece(fine, firsts[p], firsts[p + 1], lattice, fractionBits, parents, scratch);
      });
    if (!progress.add(std::int64_t(count)))
    {
      return false;
    }
  }
  std::int64_t before = 0;
  for (std::size_t p = 0; p < pieces; ++p)
  {
    std::for_each(parents.begin() + std::ptrdiff_t(firsts[p]),
      parents.begin() + std::ptrdiff_t(firsts[p + 1]), [=](std::int64_t& parent) { parent += before; });
    before += std::int64_t(runs[p].size());
  }
  coarse = concatenated(runs);
  return true;
}

} // namespace simd
} // namespace pointhaptics
