#include "Core/Resample/Stages/VoxelRun.h"

#include <algorithm>
#include <new>
#include <utility>

namespace pointhaptics::simd
{
namespace
{

/// A run that is more than so many times as large as the one after it waits for more: all runs together are
/// at most a third larger than the largest, and no voxel is copied more than a few times.
constexpr std::size_t kRunRatio = 4;

}

void VoxelRun::append(const VoxelRun* a, std::size_t i, const VoxelRun* b, std::size_t j)
{
  const VoxelRun& either = a ? *a : *b;
  WideSums sums = a ? a->voxels[i] : b->voxels[j];
  a&& b ? sums.add(b->voxels[j]) : void();
  voxels.push_back(sums);
  if (either.hasMoments())
  {
    SecondMoments moments = a ? a->secondMoments[i] : b->secondMoments[j];
    for (int m = 0; a && b && m < 6; ++m)
    {
      moments.lanes[m] += b->secondMoments[j].lanes[m];
    }
    secondMoments.push_back(moments);
  }
  tallies.resize(either.tallies.size());
  for (std::size_t array = 0; array < tallies.size(); ++array)
  {
    tallies[array].append(a ? &a->tallies[array] : nullptr, i, b ? &b->tallies[array] : nullptr, j);
  }
}

void VoxelRun::append(const VoxelRun& run, std::size_t first, std::size_t last)
{
  const auto at = [](const auto& of, std::size_t i) { return of.begin() + std::ptrdiff_t(i); };
  voxels.insert(voxels.end(), at(run.voxels, first), at(run.voxels, last));
  if (run.hasMoments())
  {
    secondMoments.insert(secondMoments.end(), at(run.secondMoments, first), at(run.secondMoments, last));
  }
  tallies.resize(std::max(tallies.size(), run.tallies.size()));
  for (std::size_t array = 0; array < run.tallies.size(); ++array)
  {
    for (std::size_t voxel = first; voxel < last; ++voxel)
    {
      tallies[array].append(&run.tallies[array], voxel, nullptr, 0);
    }
  }
}

namespace
{

/// The sums of two runs.
VoxelRun merged(const VoxelRun& a, const VoxelRun& b)
{
  VoxelRun all;
  all.voxels.reserve(a.size() + b.size());
  all.secondMoments.reserve(a.secondMoments.size() + b.secondMoments.size());
  for (std::size_t i = 0, j = 0; i < a.size() || j < b.size();)
  {
    const bool isIn = i < a.size() && (j == b.size() || a.voxels[i].key <= b.voxels[j].key);
    const bool isInOther = j < b.size() && (!isIn || b.voxels[j].key == a.voxels[i].key);
    all.append(isIn ? &a : nullptr, i, isInOther ? &b : nullptr, j);
    i += isIn;
    j += isInOther;
  }
  return all;
}

}

void VoxelRuns::add(VoxelRun&& run)
{
  if (run.size() == 0)
  {
    return;
  }
  runs_.push_back(std::move(run));
  try
  {
    while (runs_.size() > 1 && runs_[runs_.size() - 2].size() <= kRunRatio * runs_.back().size())
    {
      mergeLast();
    }
  }
  catch (const std::bad_alloc&)
  {
    // The run is added; the next add() or whole() merges it.
  }
}

VoxelRun& VoxelRuns::whole()
{
  while (runs_.size() > 1)
  {
    mergeLast();
  }
  runs_.resize(1);
  return runs_[0];
}

void VoxelRuns::mergeLast()
{
  VoxelRun both = merged(runs_[runs_.size() - 2], runs_.back());
  runs_.pop_back();
  runs_.back() = std::move(both);
}

} // namespace pointhaptics::simd
