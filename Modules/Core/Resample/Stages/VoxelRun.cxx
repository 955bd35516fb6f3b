#include "Core/Resample/Stages/VoxelRun.h"

#include <algorithm>
#include <new>
#include <numeric>
#include <utility>

namespace pointhaptics::simd
{
namespace
{

/// A run that is more than so many times as large as the one after it waits for more: all runs together are
/// at most a third larger than the largest, and no voxel is copied more than a few times.
constexpr std::size_t kRunRatio = 4;

}

bool VoxelRun::append(const VoxelRun* a, std::size_t i, const VoxelRun* b, std::size_t j, int sign)
{
  const VoxelRun& either = a ? *a : *b;
  WideSums sums = a ? a->voxels[i] : WideSums{ b->voxels[j].key, 0, { 0, 0, 0 }, 0 };
  bool isRight = true;
  if (b)
  {
    sign > 0 ? sums.add(b->voxels[j]) : void(isRight = sums.subtract(b->voxels[j]));
  }
  voxels.push_back(sums);
  if (either.hasMoments())
  {
    SecondMoments moments = a ? a->secondMoments[i] : SecondMoments{};
    for (int m = 0; b && m < 6; ++m)
    {
      moments.lanes[m] += sign > 0 ? b->secondMoments[j].lanes[m] : -b->secondMoments[j].lanes[m];
    }
    secondMoments.push_back(moments);
  }
  tallies.resize(either.tallies.size());
  for (std::size_t array = 0; array < tallies.size(); ++array)
  {
    isRight =
      tallies[array].append(a ? &a->tallies[array] : nullptr, i, b ? &b->tallies[array] : nullptr, j, sign) &&
      isRight;
  }
  return isRight;
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
      static_cast<void>(tallies[array].append(&run.tallies[array], voxel, nullptr, 0, 1));
    }
  }
}

std::size_t VoxelRun::bytes() const
{
  return std::accumulate(tallies.begin(), tallies.end(),
    voxels.capacity() * sizeof(WideSums) + secondMoments.capacity() * sizeof(SecondMoments),
    [](std::size_t sum, const VoxelTally& tally) { return sum + tally.bytes(); });
}

VoxelRun merged(const VoxelRun& a, const VoxelRun& b, int sign, bool& isRight)
{
  VoxelRun all;
  all.voxels.reserve(a.size() + b.size());
  all.secondMoments.reserve(a.secondMoments.size() + b.secondMoments.size());
  for (std::size_t i = 0, j = 0; i < a.size() || j < b.size();)
  {
    const bool isIn = i < a.size() && (j == b.size() || a.voxels[i].key <= b.voxels[j].key);
    const bool isInOther = j < b.size() && (!isIn || b.voxels[j].key == a.voxels[i].key);
    const bool isEmpty = sign < 0 && isIn && isInOther && a.voxels[i].count == b.voxels[j].count;
    // A voxel without points is left out; its sums must then be zero, or other points were subtracted.
    const bool isLeft = isEmpty ? WideSums(a.voxels[i]).subtract(b.voxels[j])
                                : all.append(isIn ? &a : nullptr, i, isInOther ? &b : nullptr, j, sign);
    isRight = isRight && isLeft;
    i += isIn;
    j += isInOther;
  }
  return all;
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
  bool isRight = true;
  VoxelRun both = merged(runs_[runs_.size() - 2], runs_.back(), 1, isRight);
  runs_.pop_back();
  runs_.back() = std::move(both);
}

} // namespace pointhaptics::simd
