#include "Core/Resample/Reductions/AttributeTuples.h"

#include "AttributePlans.h"
#include "CountingObserver.h"
#include "RandomClouds.h"
#include "Unit/HeldInstructionSets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

using namespace pointhaptics;
using trial::countsOf;
using trial::Plan;
using trial::planFor;
using trial::sameBits;
using trial::typeOf;

namespace
{

/// Adds the tuples in the order of the plan, from an array that has others between them.
template <typename T>
AttributeTuples modeOf(const std::vector<T>& values, int components, const Plan& plan, int piece = 100,
  AttributeStatistic statistic = AttributeStatistic::Mode, InstructionSet set = InstructionSet::Automatic)
{
  constexpr std::size_t kApart = 3;
  const auto width = std::size_t(components);
  std::vector<T> apart(values.size() * kApart);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    apart[i / width * width * kApart + i % width] = values[i];
  }
  AttributeTuples mode({ typeOf<T>(), components, statistic }, set);
  mode.prepare(countsOf(plan));
  const AttributeReducer::Tuples from = { reinterpret_cast<const char*>(apart.data()),
    std::int64_t(kApart * width * sizeof(T)) };
  for (std::size_t first = 0; first < plan.order.size(); first += std::size_t(piece))
  {
    const std::size_t count = std::min(std::size_t(piece), plan.order.size() - first);
    std::vector<std::int64_t> voxels;
    for (std::size_t i = 0; i < count; ++i)
    {
      voxels.push_back(plan.voxels[std::size_t(plan.order[first + i])]);
    }
    mode.add(from, plan.order.data() + first, voxels.data(), int(count));
  }
  return mode;
}

template <typename T>
std::vector<T> written(const AttributeTuples& mode, int components, const Plan& plan)
{
  std::vector<T> modes(std::size_t(plan.size) * std::size_t(components));
  mode.write(nullptr, modes.data());
  return modes;
}

/// By the definition. @pre values are neither NaN nor -0.
template <typename T>
std::vector<T> expectedModes(const std::vector<T>& values, int components, const Plan& plan)
{
  const auto width = std::size_t(components);
  std::vector<std::map<T, int>> numbers(std::size_t(plan.size) * width);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    ++numbers[std::size_t(plan.voxels[i / width]) * width + i % width][values[i]];
  }
  std::vector<T> modes;
  for (const std::map<T, int>& ofVoxel : numbers)
  {
    // The first of the largest ones: the smallest value.
    modes.push_back(std::max_element(ofVoxel.begin(), ofVoxel.end(),
      [](const auto& a, const auto& b) {
        return a.second < b.second;
      })->first);
  }
  return modes;
}

template <typename T>
std::vector<T> labels(std::size_t count, int kinds, std::uint64_t seed)
{
  trial::Random random(seed);
  std::vector<T> values(count);
  for (T& value : values)
  {
    // Neighbours in the order of numbers, and the ends of the type.
    const auto kind = int(random.below(std::size_t(kinds)));
    value = kind == 0 ? std::numeric_limits<T>::lowest() : T(std::numeric_limits<T>::max() - T(kind));
  }
  return values;
}

} // namespace

TEST(AttributeTuples, IsTheValueMostPointsHaveAndTheSmallestOnATie)
{
  const auto expectRight = [](const auto& values, int components)
  {
    using T = typename std::decay_t<decltype(values)>::value_type;
    const std::size_t tuples = values.size() / std::size_t(components);
    for (const std::int64_t voxels : { 1, 40, 700 })
    {
      const Plan plan = planFor(tuples, voxels, 1);
      const std::vector<T> expected = expectedModes(values, components, plan);
      const AttributeTuples mode = modeOf(values, components, plan);
      EXPECT_TRUE(sameBits(written<T>(mode, components, plan), expected)) << voxels;
    }
  };
  expectRight(labels<std::uint8_t>(2000, 5, 2), 1);
  expectRight(labels<std::int8_t>(3000, 3, 3), 3);
  expectRight(labels<std::int16_t>(3000, 3, 4), 2);
  expectRight(labels<std::uint32_t>(2000, 4, 5), 1);
  expectRight(labels<std::int64_t>(2000, 4, 6), 1);
  expectRight(labels<std::uint64_t>(4000, 6, 7), 4);
  expectRight(labels<float>(2000, 2, 8), 1);
  expectRight(labels<double>(3000, 3, 9), 3);
}

TEST(AttributeTuples, FindsTheLowerMiddleValueOfFewAndOfMany)
{
  const auto expectRight = [](auto example, int components)
  {
    using T = decltype(example);
    const auto width = std::size_t(components);
    trial::Random random(std::uint64_t(20 + components));
    std::vector<T> values(6000 * width);
    for (T& value : values)
    {
      value = T(int(random.below(41)) - 20);
    }
    // Some 3 and 12 tuples a voxel, and 600.
    for (const std::int64_t voxels : { 2000, 500, 10 })
    {
      const Plan plan = planFor(6000, voxels, 21);
      std::vector<std::vector<T>> sorted(std::size_t(voxels) * width);
      for (std::size_t i = 0; i < values.size(); ++i)
      {
        sorted[std::size_t(plan.voxels[i / width]) * width + i % width].push_back(values[i]);
      }
      std::vector<T> expected;
      for (std::vector<T>& ofVoxel : sorted)
      {
        std::sort(ofVoxel.begin(), ofVoxel.end());
        expected.push_back(ofVoxel[(ofVoxel.size() - 1) / 2]);
      }
      const AttributeTuples median = modeOf(values, components, plan, 100, AttributeStatistic::Median);
      EXPECT_TRUE(sameBits(written<T>(median, components, plan), expected)) << voxels;
    }
  };
  expectRight(float(), 3);
  expectRight(double(), 1);
  expectRight(std::int8_t(), 2);
  expectRight(std::int64_t(), 4);
}

namespace
{

/// Tuples in which the ends of the type are frequent, in voxels of 1 to 80 points: modes and medians by the
/// definition, of every instruction set.
template <typename T>
void expectRightOfEveryCount(int components)
{
  constexpr std::int64_t kMostPoints = 80;
  const auto width = std::size_t(components);
  trial::Random random(std::uint64_t(30 + sizeof(T)));
  const T values[] = { std::numeric_limits<T>::lowest(), T(1), T(3), std::numeric_limits<T>::max() };
  Plan plan;
  plan.size = kMostPoints;
  std::vector<T> tuples;
  std::vector<std::vector<T>> sorted(std::size_t(kMostPoints) * width);
  for (std::int64_t voxel = 0; voxel < kMostPoints; ++voxel)
  {
    for (std::int64_t i = 0; i <= voxel; ++i)
    {
      plan.order.push_back(std::int64_t(plan.voxels.size()));
      plan.voxels.push_back(voxel);
      for (std::size_t c = 0; c < width; ++c)
      {
        tuples.push_back(values[random.below(4)]);
        sorted[std::size_t(voxel) * width + c].push_back(tuples.back());
      }
    }
  }
  std::vector<T> medians;
  for (std::vector<T>& ofVoxel : sorted)
  {
    std::sort(ofVoxel.begin(), ofVoxel.end());
    medians.push_back(ofVoxel[(ofVoxel.size() - 1) / 2]);
  }
  const std::vector<T> modes = expectedModes(tuples, components, plan);
  for (const InstructionSet set : heldInstructionSets())
  {
    const auto found = [&](AttributeStatistic statistic)
    { return written<T>(modeOf(tuples, components, plan, 100, statistic, set), components, plan); };
    EXPECT_TRUE(sameBits(found(AttributeStatistic::Mode), modes)) << sizeof(T);
    EXPECT_TRUE(sameBits(found(AttributeStatistic::Median), medians)) << sizeof(T);
  }
}

}

TEST(AttributeTuples, AreTheSameOnAllInstructionSetsForEveryCountAndType)
{
  for (const int components : { 1, 3 })
  {
    expectRightOfEveryCount<std::int8_t>(components);
    expectRightOfEveryCount<std::uint8_t>(components);
    expectRightOfEveryCount<std::int16_t>(components);
    expectRightOfEveryCount<std::uint16_t>(components);
    expectRightOfEveryCount<std::int32_t>(components);
    expectRightOfEveryCount<std::uint32_t>(components);
    expectRightOfEveryCount<std::int64_t>(components);
    expectRightOfEveryCount<std::uint64_t>(components);
    expectRightOfEveryCount<float>(components);
    expectRightOfEveryCount<double>(components);
  }
}

TEST(AttributeTuples, TakesNaNsAsOneValueAndZerosAsOne)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double otherNan = -nan;
  const std::vector<double> values = { nan, 1, otherNan, /**/ -0.0, 0.0, 5, /**/ 7, nan, 3, /**/ -0.0 };
  Plan plan = planFor(values.size(), 4, 1);
  plan.voxels = { 0, 0, 0, 1, 1, 1, 2, 2, 2, 3 };
  for (int turn = 0; turn < 2; ++turn)
  {
    const std::vector<double> modes = written<double>(modeOf(values, 1, plan), 1, plan);
    EXPECT_TRUE(std::isnan(modes[0])) << "two of three";
    EXPECT_FALSE(std::signbit(modes[0]));
    EXPECT_TRUE(modes[1] == 0.0 && !std::signbit(modes[1]));
    EXPECT_EQ(modes[2], 3.0) << "a tie: NaN is the largest value";
    EXPECT_TRUE(modes[3] == 0.0 && !std::signbit(modes[3])) << "alone";
    std::reverse(plan.order.begin(), plan.order.end());
  }
}

TEST(AttributeTuples, StartsFromNothingEachTime)
{
  const std::vector<int> values = labels<int>(900, 3, 13);
  AttributeTuples mode({ ScalarType::Int32, 1, AttributeStatistic::Mode });
  for (const Plan& plan : { planFor(900, 500, 14), planFor(900, 30, 15) })
  {
    mode.prepare(countsOf(plan));
    mode.add({ reinterpret_cast<const char*>(values.data()), sizeof(int) }, plan.order.data(),
      plan.voxels.data(), 900);
    EXPECT_TRUE(sameBits(written<int>(mode, 1, plan), expectedModes(values, 1, plan)));
  }
  AttributeTuples none({ ScalarType::Int32, 1, AttributeStatistic::Mode });
  none.prepare({});
  none.write(nullptr, nullptr);
}
