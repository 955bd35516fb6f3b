// Modes and medians of arrays in voxels, of every count and type.
#include "AttributePlans.h"
#include "RandomClouds.h"
#include "Unit/HeldInstructionSets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

using namespace pointhaptics;
using trial::Plan;
using trial::planFor;
using trial::reducedValues;
using trial::sameBits;

namespace
{

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

/// Tuples in which the ends of the type are frequent, in voxels of 1 to 80 points and one of 700: modes and
/// medians by the definition, of every instruction set.
template <typename T>
void expectRightOfEveryCount(int components)
{
  constexpr std::int64_t kVoxels = 81;
  const auto width = std::size_t(components);
  trial::Random random(std::uint64_t(30 + sizeof(T)));
  const T values[] = { std::numeric_limits<T>::lowest(), T(1), T(3), std::numeric_limits<T>::max() };
  Plan plan;
  plan.size = kVoxels;
  std::vector<T> tuples;
  std::vector<std::vector<T>> sorted(std::size_t(kVoxels) * width);
  for (std::int64_t voxel = 0; voxel < kVoxels; ++voxel)
  {
    const std::int64_t points = voxel + 1 < kVoxels ? voxel + 1 : 700;
    for (std::int64_t i = 0; i < points; ++i)
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
    { return reducedValues(tuples, components, plan, statistic, { set }); };
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
    const std::vector<double> modes = reducedValues(values, 1, plan, AttributeStatistic::Mode);
    EXPECT_TRUE(std::isnan(modes[0])) << "two of three";
    EXPECT_FALSE(std::signbit(modes[0]));
    EXPECT_TRUE(modes[1] == 0.0 && !std::signbit(modes[1]));
    EXPECT_EQ(modes[2], 3.0) << "a tie: NaN is the largest value";
    EXPECT_TRUE(modes[3] == 0.0 && !std::signbit(modes[3])) << "alone";
    std::reverse(plan.order.begin(), plan.order.end());
  }
}
