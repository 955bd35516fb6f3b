#include "Core/Resample/Stages/VoxelRuns.h"

#include <algorithm>
#include <numeric>
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
}

VoxelRun merged(const VoxelRun& a, const VoxelRun& b, int sign, bool& isRight)
{
  const bool withMoments = a.hasMoments() || b.hasMoments();
  const bool withTallies = !a.tallies.empty() || !b.tallies.empty();
  VoxelRun both;
  both.reserve(std::max(a.size(), b.size()), withMoments);
  VoxelGroups groups;
  groups.sign = sign;
  for (std::size_t i = 0, j = 0; i < a.size() || j < b.size();)
  {
    const bool isIn = i < a.size() && (j == b.size() || a.voxels[i].key <= b.voxels[j].key);
    const bool isInOther = j < b.size() && (!isIn || b.voxels[j].key == a.voxels[i].key);
    WideSums sums = isIn ? a.voxels[i] : WideSums{ b.voxels[j].key, 0, { 0, 0, 0 }, 0 };
    SecondMoments moments = isIn && withMoments ? a.secondMoments[i] : SecondMoments{};
    if (isInOther)
    {
      isRight = sums.add(b.voxels[j], sign) && isRight;
      withMoments ? add(moments, b.secondMoments[j], sign) : void();
    }
    if (sums.count != 0)
    {
      both.push(sums, withMoments ? &moments : nullptr);
    }
    if (sums.count != 0 && withTallies)
    {
      isIn ? groups.voxels.push_back({ 0, i }) : void();
      isInOther ? groups.voxels.push_back({ 1, j }) : void();
      groups.ends.push_back(groups.voxels.size());
    }
    i += isIn;
    j += isInOther;
  }
  both.gatherTallies(a, b, groups, isRight);
  return both;
}

VoxelRun concatenated(std::vector<VoxelRun>& runs, const Executor& executor)
{
  std::vector<std::size_t> firsts = { 0 };
  bool withMoments = false;
  for (const VoxelRun& run : runs)
  {
    firsts.push_back(firsts.back() + run.size());
    withMoments = withMoments || run.hasMoments();
  }
  VoxelRun all;
  all.append(firsts.back(), withMoments);
  for (const VoxelRun& run : runs)
  {
    all.appendTallies(run, 0, run.size());
  }
  forEachItem(executor, runs.size(),
    [&](std::size_t r)
    {
      const auto copy = [=](const auto& from, auto& to)
      { std::copy(from.begin(), from.end(), to.begin() + std::ptrdiff_t(firsts[r])); };
      copy(runs[r].voxels, all.voxels);
      copy(runs[r].secondMoments, all.secondMoments);
      runs[r] = VoxelRun();
    });
  return all;
}

void VoxelRuns::add(VoxelRun run)
{
  if (run.size() == 0)
  {
    return;
  }
  run.trim();
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
  bool isRight = true; // Sums of points are.
  VoxelRun both = merged(runs_[runs_.size() - 2], runs_.back(), 1, isRight);
  both.trim();
  runs_.pop_back();
  runs_.back() = std::move(both);
}

std::size_t VoxelRuns::bytes() const
{
  return std::accumulate(runs_.begin(), runs_.end(), runs_.capacity() * sizeof(VoxelRun),
    [](std::size_t sum, const VoxelRun& run) { return sum + run.bytes(); });
}

} // namespace simd
} // namespace pointhaptics
