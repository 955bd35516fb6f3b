#include "Core/Resample/Stages/VoxelRuns.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace pointhaptics
{
namespace kernel
{
namespace
{

/// A run that is more than so many times as large as the one after it waits for more: all runs together are
/// at most a third larger than the largest, and no voxel is copied more than a few times.
constexpr std::size_t kRunRatio = 4;

VoxelRun merged(const VoxelRun& a, const VoxelRun& b)
{
  const bool withSeconds = !a.seconds.empty() || !b.seconds.empty();
  VoxelRun both;
  both.voxels.reserve(a.voxels.size() + b.voxels.size());
  both.seconds.reserve(withSeconds ? a.voxels.size() + b.voxels.size() : 0);
  const auto append = [&](const VoxelRun& from, std::size_t begin, std::size_t end)
  {
    both.voxels.insert(both.voxels.end(), from.voxels.data() + begin, from.voxels.data() + end);
    if (withSeconds)
    {
      both.seconds.insert(both.seconds.end(), from.seconds.data() + begin, from.seconds.data() + end);
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
      for (int m = 0; withSeconds && m < 6; ++m)
      {
        both.seconds.back().lanes[m] += b.seconds[j].lanes[m];
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
  if (batch.seconds)
  {
    seconds.insert(seconds.end(), batch.seconds, batch.seconds + batch.size);
  }
}

void VoxelRun::trim()
{
  if (voxels.capacity() > voxels.size() + voxels.size() / 32)
  {
    voxels.shrink_to_fit();
    seconds.shrink_to_fit();
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
  MeanArena& arena, std::size_t place) const
{
  if (size(range) == 0)
  {
    return;
  }
  const VoxelRun& run = this->run(range);
  const bool withSeconds = !run.seconds.empty();
  const auto batch = std::make_unique<MomentBatch<std::int64_t>>();
  std::vector<SecondSums> seconds(withSeconds ? kBatch : 0);
  batch->seconds = withSeconds ? seconds.data() : nullptr;
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
    if (withSeconds)
    {
      std::copy(run.seconds.data() + first, run.seconds.data() + first + batch->size, seconds.data());
    }
    arena.write(kernels, place + first, *batch);
    for (int i = 0; i < batch->size; ++i)
    {
      if (!fits(voxels[i]))
      {
        arena.write(place + first + std::size_t(i), voxels[i].whole(),
          withSeconds ? &seconds[std::size_t(i)] : nullptr);
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
      sum += run.voxels.capacity() * sizeof(WideSums) + run.seconds.capacity() * sizeof(SecondSums);
    }
  }
  return sum;
}

} // namespace kernel
} // namespace pointhaptics
