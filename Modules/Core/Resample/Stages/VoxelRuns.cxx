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
  std::size_t common = 0;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();)
  {
    const std::uint64_t ofA = a.voxels[i].key;
    const std::uint64_t ofB = b.voxels[j].key;
    common += ofA == ofB;
    i += ofA <= ofB;
    j += ofB <= ofA;
  }
  const bool withTallies = !a.tallies.empty() || !b.tallies.empty();
  VoxelRun both;
  both.reserve(a.size() + b.size() - common, a.hasMoments() || b.hasMoments());
  VoxelGroups groups;
  groups.sign = sign;
  for (std::size_t i = 0, j = 0; i < a.size() || j < b.size();)
  {
    const bool isIn = i < a.size() && (j == b.size() || a.voxels[i].key <= b.voxels[j].key);
    const bool isInOther = j < b.size() && (!isIn || b.voxels[j].key == a.voxels[i].key);
    both.push(isIn ? a.voxels[i] : b.voxels[j], isIn ? a.momentsOf(i) : b.momentsOf(j));
    const bool isLeft =
      isIn && isInOther ? both.addToLast(b.voxels[j], b.momentsOf(j), sign) : isIn || sign > 0;
    isRight = isRight && isLeft;
    const bool isEmpty = both.voxels.back().count == 0;
    if (isEmpty)
    {
      both.pop();
    }
    if (withTallies && !isEmpty)
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
  all.voxels.resize(firsts.back());
  all.secondMoments.resize(withMoments ? firsts.back() : 0);
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
