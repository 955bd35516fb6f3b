#include "Core/Resample/Stages/VoxelRuns.h"

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

/// How many voxels two runs have together.
std::size_t sizeOfBoth(const VoxelRun& a, const VoxelRun& b)
{
  std::size_t inBoth = 0;
  std::size_t j = 0;
  for (const WideSums& voxel : a.voxels)
  {
    while (j < b.voxels.size() && b.voxels[j].key < voxel.key)
    {
      ++j;
    }
    inBoth += j < b.voxels.size() && b.voxels[j].key == voxel.key;
  }
  return a.voxels.size() + b.voxels.size() - inBoth;
}

}

VoxelRun merged(const VoxelRun& a, const VoxelRun& b)
{
  const bool withSecondMoments = !a.secondMoments.empty() || !b.secondMoments.empty();
  VoxelRun both;
  const std::size_t voxels = sizeOfBoth(a, b);
  both.voxels.reserve(voxels);
  both.secondMoments.reserve(withSecondMoments ? voxels : 0);
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.voxels.size() || j < b.voxels.size())
  {
    const bool isTheirs = i == a.voxels.size() || (j < b.voxels.size() && b.voxels[j].key < a.voxels[i].key);
    const VoxelRun& from = isTheirs ? b : a;
    std::size_t& at = isTheirs ? j : i;
    const bool isInBoth = !isTheirs && j < b.voxels.size() && b.voxels[j].key == a.voxels[i].key;
    both.push(from.voxels[at], from.momentsOf(at));
    ++at;
    if (isInBoth)
    {
      both.addToLast(b.voxels[j], b.momentsOf(j));
      ++j;
    }
  }
  return both;
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

VoxelRun VoxelRuns::take(std::size_t range)
{
  VoxelRun run = runs_[range].empty() ? VoxelRun() : std::move(runs_[range][0]);
  this->release(range);
  return run;
}

void VoxelRuns::joinLast(std::size_t range)
{
  std::vector<VoxelRun>& runs = runs_[range];
  VoxelRun both = merged(runs[runs.size() - 2], runs[runs.size() - 1]);
  runs.pop_back();
  runs.back() = std::move(both);
}

std::size_t VoxelRuns::bytes() const
{
  std::size_t sum = runs_.capacity() * sizeof(std::vector<VoxelRun>);
  for (const std::vector<VoxelRun>& runs : runs_)
  {
    for (const VoxelRun& run : runs)
    {
      sum += run.bytes();
    }
  }
  return sum;
}

} // namespace simd
} // namespace pointhaptics
