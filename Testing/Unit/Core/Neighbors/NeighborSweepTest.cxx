#include "Core/Neighbors/NeighborSweep.h"
#include "Core/Reference/ReferenceNeighbors.h"

#include "RandomClouds.h"

#include "Unit/HeldInstructionSets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace pointhaptics;
using trial::view;

namespace
{

struct NamedCloud
{
  const char* name;
  std::vector<Vec3> points;
};

std::vector<Vec3> scaled(std::vector<Vec3> points, double scale)
{
  for (Vec3& p : points)
  {
    p *= scale;
  }
  return points;
}

std::vector<Vec3> joined(std::vector<Vec3> points, const std::vector<Vec3>& more)
{
  points.insert(points.end(), more.begin(), more.end());
  return points;
}

std::vector<Vec3> lattice(double spacing)
{
  std::vector<Vec3> points;
  for (const std::size_t i : trial::randomOrder(1728, 21))
  {
    points.push_back(spacing * Vec3(double(i % 12), double(i / 12 % 12), double(i / 144)));
  }
  return points;
}

std::vector<Vec3> withNan(std::vector<Vec3> points)
{
  for (std::size_t i = 0; i < points.size(); i += 5)
  {
    points[i][int(i % 3)] = i % 2 ? NAN : INFINITY;
  }
  return points;
}

std::vector<NamedCloud> clouds()
{
  const std::vector<Vec3> square = trial::randomBox(1500, 11, { 0, 0, 0 }, { 1, 1, 0 });
  const std::vector<Vec3> cube = trial::randomBox(1500, 12, { -1, -1, -1 }, { 1, 1, 1 });
  const std::vector<Vec3> sparse = trial::randomBox(90, 13, { 1, 0, 0 }, { 2, 1, 0 });
  std::vector<Vec3> line;
  trial::Random random(14);
  for (int i = 0; i < 800; ++i)
  {
    line.push_back(random.uniform() * Vec3(1, 2, 3));
  }
  return { { "no point", {} }, { "one point", { { 1, 2, 3 } } },
    { "two points", { { 0, 0, 0 }, { 1, 0, 0 } } }, { "square", square }, { "cube", cube }, { "line", line },
    { "lattice, all ties", lattice(0.1) }, { "all identical", std::vector<Vec3>(700, Vec3(0.1, 0.2, 0.3)) },
    { "every point twice", joined(cube, cube) },
    { "half of them in one place", joined(square, std::vector<Vec3>(1500, square[3])) },
    { "sixteen times as dense", joined(square, sparse) },
    { "a thousand times as dense", joined(scaled(square, 0.03), sparse) },
    { "points apart", joined(square, { { 50, 0, 0 }, { 0, 1e9, 0 }, { 1e-30, 0, 1e15 } }) },
    { "tiny", scaled(cube, 1e-9) }, { "huge", scaled(cube, 1e9) },
    { "squares underflow", scaled(square, 1e-170) }, { "squares overflow", scaled(square, 1e200) },
    { "denormal", scaled(cube, 1e-310) },
    { "far from zero", joined({ { 4.6e6, 5e5, 100 } }, scaled(lattice(0.001), 1.0)) },
    { "not finite", withNan(square) } };
}

struct All
{
  std::vector<Neighbor> neighbors;
  std::vector<int> counts;
};

/// Points at one place have one answer.
All nearestOf(const PointView& points, int k, const Executor& executor = {})
{
  NeighborQuery query;
  query.build(points, executor);
  const auto size = std::size_t(points.size());
  All all{ std::vector<Neighbor>(size * std::size_t(k)), std::vector<int>(size, 0) };
  forRange(executor, NeighborSweep::leaves(query), 1,
    [&](std::int64_t begin, std::int64_t end)
    {
      NeighborSweep(query, k).run(begin, end,
        [&](const NeighborList& list)
        {
          const std::int64_t index = query.index(list.slot);
          all.counts[std::size_t(index)] = list.count;
          for (int i = 0; i < list.count; ++i)
          {
            all.neighbors[std::size_t(index * k + i)] = { list.squaredDistances[i],
              query.index(list.slots[i]) };
          }
        });
    });
  query.visitRepeats(
    [&](std::int64_t repeated, std::int64_t slot)
    {
      const std::int64_t first = query.index(slot);
      all.counts[std::size_t(repeated)] = all.counts[std::size_t(first)];
      std::copy_n(all.neighbors.begin() + first * k, k, all.neighbors.begin() + repeated * k);
    });
  return all;
}

void expectEqual(const All& a, const All& b)
{
  ASSERT_EQ(a.counts, b.counts);
  for (std::size_t i = 0; i < a.neighbors.size(); ++i)
  {
    ASSERT_EQ(a.neighbors[i].index, b.neighbors[i].index);
    ASSERT_EQ(a.neighbors[i].squaredDistance, b.neighbors[i].squaredDistance);
  }
}

void expectBruteForce(const std::vector<Vec3>& points, int k, std::size_t step)
{
  const All all = nearestOf(view(points), k);
  for (std::size_t i = 0; i < points.size(); i += step)
  {
    if (!isFinite(points[i]))
    {
      ASSERT_EQ(all.counts[i], 0);
      continue;
    }
    const std::vector<Neighbor> expected = reference::nearest(view(points), points[i], std::size_t(k));
    ASSERT_EQ(all.counts[i], int(expected.size()));
    for (std::size_t j = 0; j < expected.size(); ++j)
    {
      const Neighbor& found = all.neighbors[i * std::size_t(k) + j];
      ASSERT_EQ(found.index, expected[j].index) << "neighbour " << j << " of point " << i;
      ASSERT_EQ(found.squaredDistance, expected[j].squaredDistance);
    }
  }
}

std::vector<double> listsOf(const NeighborQuery& query, int k, InstructionSet set)
{
  std::vector<double> found;
  NeighborSweep sweep(query, k, set);
  sweep.run(0, NeighborSweep::leaves(query),
    [&](const NeighborList& list)
    {
      found.push_back(double(list.slot));
      found.insert(found.end(), list.squaredDistances, list.squaredDistances + list.count);
      found.insert(found.end(), list.slots, list.slots + list.count);
    });
  return found;
}

} // namespace

TEST(NeighborSweep, EqualsBruteForceOnEveryKindOfCloud)
{
  for (const NamedCloud& cloud : clouds())
  {
    for (const int k : { 1, 2, 9, 17, 65, 72, 73, 128, 512, 513 })
    {
      SCOPED_TRACE(std::string(cloud.name) + ", k = " + std::to_string(k));
      expectBruteForce(cloud.points, k, 13);
    }
  }
}

TEST(NeighborSweep, GivesTheSameBitsWithEveryInstructionSet)
{
  SKIP_WITHOUT_OTHER_INSTRUCTION_SETS();
  for (const NamedCloud& cloud : clouds())
  {
    SCOPED_TRACE(cloud.name);
    NeighborQuery query;
    query.build(view(cloud.points));
    std::vector<double> expected[2];
    for (const InstructionSet set : heldInstructionSets())
    {
      for (const bool isMany : { false, true })
      {
        const std::vector<double> found = listsOf(query, isMany ? 150 : 17, set);
        expected[isMany] = set == InstructionSet::Baseline ? found : expected[isMany];
        ASSERT_EQ(found, expected[isMany]) << int(set);
      }
    }
  }
}

TEST(NeighborSweep, DoesNotDependOnThreadsNorOnTheTypeOfNumber)
{
  std::vector<Vec3> points = trial::randomBox(20000, 17, { 0, 0, 0 }, { 1, 1, 0.1 });
  std::vector<float> floats;
  for (Vec3& p : points)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      floats.push_back(float(p[axis]));
      p[axis] = double(floats.back());
    }
  }
  const All expected = nearestOf(view(points), 10);
  expectEqual(nearestOf(view(points), 10, trial::BackwardExecutor(7)), expected);
  for (const int threads : { 2, 8 })
  {
    expectEqual(nearestOf(view(points), 10, trial::ThreadedExecutor(threads)), expected);
  }
  expectEqual(nearestOf({ floats.data(), 20000 }, 10), expected);
}
