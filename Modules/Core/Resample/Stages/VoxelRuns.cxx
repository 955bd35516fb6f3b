#include "Core/Resample/Stages/VoxelRuns.h"

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
/// Calls each(i, j) for the voxels of two runs in order: i in one, j in the other, or its end.
template <typename Each>
void forMerged(const VoxelRun& a, const VoxelRun& b, const Each& each)
{
  for (std::size_t i = 0, j = 0; i < a.size() || j < b.size();)
  {
    const bool isIn = i < a.size() && (j == b.size() || a.voxels[i].key <= b.voxels[j].key);
    const bool isInOther = j < b.size() && (!isIn || b.voxels[j].key == a.voxels[i].key);
    each(isIn ? i : a.size(), isInOther ? j : b.size());
    i += isIn;
    j += isInOther;
  }
}

}

VoxelRun merged(const VoxelRun& a, const VoxelRun& b)
{
  std::size_t size = 0;
  forMerged(a, b, [&](std::size_t, std::size_t) { ++size; });
  VoxelRun both;
  both.reserve(size, a.hasMoments() || b.hasMoments());
  forMerged(a, b,
    [&](std::size_t i, std::size_t j)
    {
      const bool isIn = i < a.size();
      const VoxelRun& from = isIn ? a : b;
      const std::size_t voxel = isIn ? i : j;
      both.push(from.voxels[voxel], from.momentsOf(voxel));
      both.appendTallies(from, voxel, voxel + 1);
      if (isIn && j < b.size())
      {
        both.addToLast(b.voxels[j], b.momentsOf(j));
        static_cast<void>(both.addTalliesToLast(b, j)); // Sums of points are right.
      }
    });
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

bool subtracted(const VoxelRun& from, const VoxelRun& run, VoxelRun& difference)
{
  bool isRight = true;
  forMerged(from, run,
    [&](std::size_t i, std::size_t j)
    {
      if (i == from.size() || j == run.size())
      {
        isRight = isRight && i < from.size();
        difference.append(from, i, i + std::size_t(isRight));
        return;
      }
      WideSums left = from.voxels[i];
      const WideSums& less = run.voxels[j];
      left.count -= less.count;
      isRight = isRight && left.count >= 0;
      for (int axis = 0; axis < 3; ++axis)
      {
        const Int128 rest = left.sum(axis) - less.sum(axis);
        isRight = isRight && rest >= 0 && (left.count > 0 || rest == 0);
        left.add(axis, -less.low[axis], -std::uint64_t(less.sum(axis) >> 64) - (less.low[axis] > 0));
      }
      if (left.count > 0)
      {
        difference.append(from, i, i + 1);
        difference.voxels.back() = left;
        for (int m = 0; run.hasMoments() && m < 6; ++m)
        {
          difference.secondMoments.back().lanes[m] -= run.secondMoments[j].lanes[m];
        }
        isRight = difference.addTalliesToLast(run, j, -1) && isRight;
      }
    });
  return isRight;
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
  VoxelRun both = merged(runs_[runs_.size() - 2], runs_.back());
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
