#include "Core/Resample/Stages/VoxelRuns.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace pointhaptics
{
namespace simd
{
namespace
{

/// A run that is more than so many times as large as the one after it waits for more: all runs together are
/// at most a third larger than the largest, and no voxel is copied more than a few times.
constexpr std::size_t kRunRatio = 4;

VoxelRun merged(const VoxelRun& a, const VoxelRun& b)
{
  const bool withSecondMoments = !a.secondMoments.empty() || !b.secondMoments.empty();
  VoxelRun both;
  both.voxels.reserve(a.voxels.size() + b.voxels.size());
  both.secondMoments.reserve(withSecondMoments ? a.voxels.size() + b.voxels.size() : 0);
  const auto append = [&](const VoxelRun& from, std::size_t begin, std::size_t end)
  {
    both.voxels.insert(both.voxels.end(), from.voxels.data() + begin, from.voxels.data() + end);
    if (withSecondMoments)
    {
      both.secondMoments.insert(
        both.secondMoments.end(), from.secondMoments.data() + begin, from.secondMoments.data() + end);
    }
  };
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.voxels.size() && j < b.voxels.size())
  {
    const std::uint64_t ours = a.voxels[i].key;
    const std::uint64_t theirs = b.voxels[j].key;
    if (theirs < ours)
    {
      append(b, j, j + 1);
      ++j;
      continue;
    }
    append(a, i, i + 1);
    ++i;
    if (ours == theirs)
    {
      both.voxels.back().add(b.voxels[j]);
      for (int m = 0; withSecondMoments && m < 6; ++m)
      {
        both.secondMoments.back().lanes[m] += b.secondMoments[j].lanes[m];
      }
      ++j;
    }
  }
  append(a, i, a.voxels.size());
  append(b, j, b.voxels.size());
  both.trim();
  return both;
}

}

void VoxelRun::append(const Lattice& lattice, const MomentBatch<std::int64_t>& batch)
{
  for (int i = 0; i < batch.size; ++i)
  {
    voxels.push_back(
      { lattice.key(batch.indices[0][i], batch.indices[1][i], batch.indices[2][i]), batch.counts[i],
        { std::uint64_t(batch.sums[0][i]), std::uint64_t(batch.sums[1][i]), std::uint64_t(batch.sums[2][i]) },
        0 });
  }
  if (batch.secondMoments)
  {
    secondMoments.insert(secondMoments.end(), batch.secondMoments, batch.secondMoments + batch.size);
  }
}

void VoxelRun::trim()
{
  if (voxels.capacity() > voxels.size() + voxels.size() / 32)
  {
    voxels.shrink_to_fit();
    secondMoments.shrink_to_fit();
  }
}

void VoxelRuns::reset(std::size_t ranges, int fractionBits)
{
  runs_.clear();
  runs_.resize(ranges);
  fractionBits_ = fractionBits;
}

void VoxelRuns::add(std::size_t range, VoxelRun run)
{
  if (run.voxels.empty())
  {
    return;
  }
  run.trim();
  std::vector<VoxelRun>& runs = runs_[range];
  runs.push_back(std::move(run));
  while (
    runs.size() > 1 && runs[runs.size() - 2].voxels.size() <= kRunRatio * runs[runs.size() - 1].voxels.size())
  {
    joinLast(range);
  }
}

void VoxelRuns::join(std::size_t range)
{
  while (runs_[range].size() > 1)
  {
    joinLast(range);
  }
}

void VoxelRuns::joinLast(std::size_t range)
{
  std::vector<VoxelRun>& runs = runs_[range];
  VoxelRun both = merged(runs[runs.size() - 2], runs[runs.size() - 1]);
  runs.pop_back();
  runs.back() = std::move(both);
}

void VoxelRuns::write(std::size_t range, const Kernels& kernels, const Lattice& lattice, bool plain,
  MeanArena& arena, std::size_t offset) const
{
  if (size(range) == 0)
  {
    return;
  }
  const VoxelRun& run = this->run(range);
  const bool withSecondMoments = !run.secondMoments.empty();
  const auto batch = std::make_unique<MomentBatch<std::int64_t>>();
  std::vector<SecondMoments> secondMoments(withSecondMoments ? kBatch : 0);
  batch->secondMoments = withSecondMoments ? secondMoments.data() : nullptr;
  const auto fits = [&](const WideSums& voxel)
  { return !plain && voxel.high == 0 && (voxel.low[0] | voxel.low[1] | voxel.low[2]) >> 62 == 0; };
  for (std::size_t first = 0; first < run.voxels.size(); first += kBatch)
  {
    const WideSums* voxels = run.voxels.data() + first;
    batch->size = int(std::min<std::size_t>(run.voxels.size() - first, kBatch));
    for (int i = 0; i < batch->size; ++i)
    {
      const auto index = lattice.indexOf(voxels[i].key);
      batch->counts[i] = voxels[i].count;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        batch->indices[axis][i] = std::int32_t(index[axis]);
        batch->sums[axis][i] = fits(voxels[i]) ? std::int64_t(voxels[i].low[axis]) : 0;
      }
    }
    if (withSecondMoments)
    {
      std::copy(run.secondMoments.data() + first, run.secondMoments.data() + first + batch->size,
        secondMoments.data());
    }
    arena.write(kernels, offset + first, *batch);
    for (int i = 0; i < batch->size; ++i)
    {
      if (!fits(voxels[i]))
      {
        arena.write(offset + first + std::size_t(i), voxels[i].whole(),
          withSecondMoments ? &secondMoments[std::size_t(i)] : nullptr);
      }
    }
  }
}

std::size_t VoxelRuns::bytes() const
{
  std::size_t sum = runs_.capacity() * sizeof(std::vector<VoxelRun>);
  for (const std::vector<VoxelRun>& runs : runs_)
  {
    for (const VoxelRun& run : runs)
    {
      sum += run.voxels.capacity() * sizeof(WideSums) + run.secondMoments.capacity() * sizeof(SecondMoments);
    }
  }
  return sum;
}

} // namespace simd
} // namespace pointhaptics
