#include "Core/Resample/Stages/VoxelRun.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace pointhaptics::simd
{
namespace
{

/// A run that is more than so many times as large as the one after it waits for more: all runs together are
/// at most a third larger than the largest, and no voxel is copied more than a few times.
constexpr std::size_t kRunRatio = 4;

/// Sums of the voxels of a group. @return false where less than nothing is left.
bool sumGroup(
  const std::vector<const VoxelRun*>& runs, const VoxelGroups& groups, std::size_t group, VoxelRun& to)
{
  bool isRight = true;
  for (std::size_t i = groups.beginOf(group); i < groups.ends[group]; ++i)
  {
    const VoxelGroups::Voxel& voxel = groups.voxels[i];
    const VoxelRun& run = *runs[std::size_t(voxel.run)];
    const int sign = groups.signOf(voxel);
    WideSums& sums = to.voxels[group];
    sums.key = run.voxels[voxel.number].key;
    if (sign > 0)
    {
      sums.add(run.voxels[voxel.number]);
    }
    else
    {
      isRight = sums.subtract(run.voxels[voxel.number]) && isRight;
    }
    if (run.hasMoments())
    {
      add(to.secondMoments[group], run.secondMoments[voxel.number], sign);
    }
  }
  return isRight;
}

}

VoxelRun VoxelRun::gathered(
  const std::vector<const VoxelRun*>& runs, const VoxelGroups& groups, bool& isRight)
{
  VoxelRun all;
  all.start(groups.size(),
    std::any_of(runs.begin(), runs.end(), [](const VoxelRun* run) { return run->hasMoments(); }));
  for (std::size_t group = 0; group < groups.size(); ++group)
  {
    isRight = sumGroup(runs, groups, group, all) && isRight;
  }
  std::size_t arrays = 0;
  for (const VoxelRun* run : runs)
  {
    arrays = std::max(arrays, run->tallies.size());
  }
  const VoxelTally none; // A run without voxels has none.
  for (std::size_t array = 0; array < arrays; ++array)
  {
    std::vector<const VoxelTally*> tallies;
    for (const VoxelRun* run : runs)
    {
      tallies.push_back(run->tallies.empty() ? &none : &run->tallies[array]);
    }
    all.tallies.push_back(VoxelTally::gathered(tallies, groups, isRight));
  }
  return all;
}

VoxelRun VoxelRun::concatenated(const std::vector<const VoxelRun*>& runs)
{
  VoxelGroups groups;
  for (std::size_t run = 0; run < runs.size(); ++run)
  {
    groups.add(int(run), 0, runs[run]->size());
  }
  bool isRight = true; // Sums of points are.
  return gathered(runs, groups, isRight);
}

VoxelRun VoxelRun::part(std::size_t first, std::size_t last) const
{
  VoxelGroups groups;
  groups.add(0, first, last);
  bool isRight = true;
  return gathered({ this }, groups, isRight);
}

std::size_t VoxelRun::bytes() const
{
  return std::accumulate(tallies.begin(), tallies.end(),
    voxels.capacity() * sizeof(WideSums) + secondMoments.capacity() * sizeof(SecondMoments),
    [](std::size_t sum, const VoxelTally& tally) { return sum + tally.bytes(); });
}

VoxelRun merged(const VoxelRun& a, const VoxelRun& b, int sign, bool& isRight)
{
  VoxelGroups groups;
  groups.sign = sign;
  groups.voxels.reserve(a.size() + b.size());
  groups.ends.reserve(a.size() + b.size());
  for (std::size_t i = 0, j = 0; i < a.size() || j < b.size();)
  {
    const bool isIn = i < a.size() && (j == b.size() || a.voxels[i].key <= b.voxels[j].key);
    const bool isInOther = j < b.size() && (!isIn || b.voxels[j].key == a.voxels[i].key);
    const bool isEmpty = sign < 0 && isIn && isInOther && a.voxels[i].count == b.voxels[j].count;
    if (isEmpty) // has no sums either
    {
      isRight = WideSums(a.voxels[i]).subtract(b.voxels[j]) && isRight;
    }
    else
    {
      isIn ? groups.voxels.push_back({ 0, i }) : void();
      isInOther ? groups.voxels.push_back({ 1, j }) : void();
      groups.ends.push_back(groups.voxels.size());
    }
    i += isIn;
    j += isInOther;
  }
  return VoxelRun::gathered({ &a, &b }, groups, isRight);
}

void VoxelRuns::add(VoxelRun run)
{
  if (run.size() == 0)
  {
    return;
  }
  runs_.push_back(std::move(run));
  while (runs_.size() > 1 && runs_[runs_.size() - 2].size() <= kRunRatio * runs_.back().size())
  {
    mergeLast();
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
  bool isRight = true;
  VoxelRun both = merged(runs_[runs_.size() - 2], runs_.back(), 1, isRight);
  runs_.pop_back();
  runs_.back() = std::move(both);
}

} // namespace pointhaptics::simd
