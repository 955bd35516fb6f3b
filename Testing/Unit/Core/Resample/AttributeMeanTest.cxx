// Means of arrays in voxels, of every type and range.
#include "AttributePlans.h"
#include "ExactSum.h"
#include "RandomClouds.h"

#include "Unit/HeldInstructionSets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstring>
#include <limits>

using namespace pointhaptics;
using trial::countsOf;
using trial::ExactSum;
using trial::Plan;
using trial::planFor;
using trial::reducedTuples;
using trial::reducedValues;
using trial::sameBits;
using trial::typeOf;

namespace
{

__extension__ typedef __int128 Int128;

/// Integers: exact sums of 128 bits, halves away from zero.
template <typename T>
std::vector<T> roundedMeans(const std::vector<T>& values, int components, const Plan& plan)
{
  std::vector<T> means;
  const std::vector<std::int64_t> counts = countsOf(plan);
  std::vector<Int128> sums(counts.size() * std::size_t(components), 0);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const std::size_t c = std::size_t(components);
    sums[std::size_t(plan.voxels[i / c]) * c + i % c] += Int128(values[i]);
  }
  for (std::size_t s = 0; s < sums.size(); ++s)
  {
    const Int128 n = counts[s / std::size_t(components)];
    const Int128 magnitude = sums[s] < 0 ? -sums[s] : sums[s];
    const Int128 rounded = magnitude / n + (2 * (magnitude % n) >= n ? 1 : 0);
    means.push_back(T(sums[s] < 0 ? -rounded : rounded));
  }
  return means;
}

/// Real numbers: the mean is the exact one but for two roundings, and a float the nearest to it.
template <typename T>
void expectExact(const std::vector<T>& values, int components, const Plan& plan)
{
  const std::vector<T> means = reducedValues(values, components, plan);
  const std::vector<double> doubles =
    reducedValues(std::vector<double>(values.begin(), values.end()), components, plan);
  const std::vector<std::int64_t> counts = countsOf(plan);
  std::vector<ExactSum> sums(means.size());
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const std::size_t c = std::size_t(components);
    sums[std::size_t(plan.voxels[i / c]) * c + i % c].add(double(values[i]), 1);
  }
  for (std::size_t s = 0; s < sums.size(); ++s)
  {
    const std::int64_t count = counts[s / std::size_t(components)];
    const double got = doubles[s];
    ASSERT_TRUE(sums[s].isMean(got, count)) << "sum " << s << " mean " << got;
    ASSERT_EQ(means[s], T(got)) << "sum " << s;
  }
}

template <typename T>
void expectIndependentOfOrder(const std::vector<T>& values, int components, Plan plan)
{
  const std::vector<T> expected = reducedValues(values, components, plan);
  for (const std::uint64_t seed : { 1, 2 })
  {
    plan.order.clear();
    for (const std::size_t i : trial::randomOrder(plan.voxels.size(), seed))
    {
      plan.order.push_back(std::int64_t(i));
    }
    EXPECT_TRUE(sameBits(reducedValues(values, components, plan), expected));
  }
}

template <typename T>
std::vector<T> extremesOf(std::size_t n, std::uint64_t seed)
{
  trial::Random random(seed);
  const T extremes[] = { std::numeric_limits<T>::lowest(), std::numeric_limits<T>::max(), T(0), T(1), T(-1) };
  std::vector<T> values;
  for (std::size_t i = 0; i < n; ++i)
  {
    values.push_back(extremes[random.below(5)]);
  }
  return values;
}

/// 10^low to 10^high with any sign.
template <typename T>
std::vector<T> magnitudes(std::size_t n, double low, double high, std::uint64_t seed)
{
  trial::Random random(seed);
  std::vector<T> values;
  for (std::size_t i = 0; i < n; ++i)
  {
    const double value = std::pow(10.0, random.uniform(low, high));
    values.push_back(T(random.below(2) == 0 ? value : -value));
  }
  return values;
}

} // namespace

template <typename T>
class AttributeMeanOfIntegers : public testing::Test
{
};
using Integers = testing::Types<std::int8_t, std::uint8_t, std::int16_t, std::uint16_t, std::int32_t,
  std::uint32_t, std::int64_t, std::uint64_t>;
TYPED_TEST_SUITE(AttributeMeanOfIntegers, Integers, );

TYPED_TEST(AttributeMeanOfIntegers, IsRoundedFromTheExactSumAtTheExtremes)
{
  for (int components = 1; components <= 9; ++components)
  {
    const std::vector<TypeParam> values = extremesOf<TypeParam>(2000 * std::size_t(components), 1);
    const Plan plan = planFor(2000, 300, std::uint64_t(components));
    EXPECT_EQ(reducedValues(values, components, plan), roundedMeans(values, components, plan));
    expectIndependentOfOrder(values, components, plan);
  }
}

TYPED_TEST(AttributeMeanOfIntegers, KeepsTheExtremesWhereAllAreTheSame)
{
  using Limits = std::numeric_limits<TypeParam>;
  for (const TypeParam value : { Limits::min(), Limits::max(), TypeParam(0) })
  {
    const std::vector<TypeParam> values(3000, value);
    const Plan plan = planFor(3000, 2, 2);
    EXPECT_EQ(reducedValues(values, 1, plan), (std::vector<TypeParam>{ value, value }));
  }
}

TEST(AttributeMean, RoundsHalvesAwayFromZero)
{
  const std::vector<std::int64_t> values{ 1, 2, -1, -2, -3, -2, -1, 0, 4, 5 };
  Plan plan = planFor(10, 5, 1);
  plan.voxels = { 0, 0, 1, 1, 2, 2, 3, 3, 4, 4 };
  EXPECT_EQ(reducedValues(values, 1, plan), (std::vector<std::int64_t>{ 2, -2, -3, -1, 5 }));
  const std::vector<std::int16_t> shorts(values.begin(), values.end());
  EXPECT_EQ(reducedValues(shorts, 1, plan), (std::vector<std::int16_t>{ 2, -2, -3, -1, 5 }));
}

TEST(AttributeMean, OfRealNumbersIsExactForEveryRangeAndWidth)
{
  for (int components = 1; components <= 9; ++components)
  {
    const auto c = std::size_t(components);
    const Plan plan = planFor(600, 50, c);
    for (const double low : { -307.0, -30.0, -2.0, 0.0, 250.0 })
    {
      const double high = std::min(300.0, low + 3.0 * components * components);
      expectExact(magnitudes<double>(600 * c, low, high, 3), components, plan);
      expectIndependentOfOrder(magnitudes<double>(600 * c, low, high, 3), components, plan);
    }
    expectExact(magnitudes<float>(600 * c, -4.0 * components, 3.0 * components, 4), components, plan);
    expectIndependentOfOrder(
      magnitudes<float>(600 * c, -4.0 * components, 3.0 * components, 4), components, plan);
  }
}

TEST(AttributeMean, OfMixedMagnitudesKeepsWhatIsLeftWhenTheLargeOnesCancel)
{
  for (const double tiny : { 1e-300, DBL_TRUE_MIN, 1.0, 1e-16, 3e283 })
  {
    std::vector<double> values;
    for (int i = 0; i < 500; ++i)
    {
      values.insert(values.end(), { 1e300 + 1e285 * i, tiny * (1 + i % 3), -1e300 - 1e285 * i });
    }
    expectExact(values, 1, planFor(1500, 1, 5));
    expectExact(values, 3, planFor(500, 7, 6));
    Plan triples = planFor(1500, 500, 7);
    for (std::size_t i = 0; i < 1500; ++i)
    {
      triples.voxels[i] = std::int64_t(i) / 3;
    }
    expectExact(values, 1, triples);
    expectIndependentOfOrder(values, 1, triples);
  }
}

TEST(AttributeMean, RoundsTheSumOnceWhateverIsFarBelow)
{
  const Plan plan = planFor(4, 1, 1);
  for (const double sign : { 1.0, -1.0 })
  {
    const std::vector<double> tie{ sign, sign * 0x1p-53, 0.0, 0.0 };
    EXPECT_EQ(reducedValues(tie, 1, plan)[0], sign * 0.25);
    const std::vector<double> above{ sign, sign * 0x1p-53, sign * 0x1p-300, 0.0 };
    EXPECT_EQ(reducedValues(above, 1, plan)[0], sign * 0.25 * (1.0 + 0x1p-52));
    const std::vector<double> below{ sign, sign * 0x1p-53, -sign * 0x1p-300, 0.0 };
    EXPECT_EQ(reducedValues(below, 1, plan)[0], sign * 0.25);
  }
}

TEST(AttributeMean, OfExtremeRealNumbersIsExact)
{
  const Plan plan = planFor(2000, 30, 8);
  expectExact(extremesOf<float>(2000, 9), 1, plan);
  expectExact(extremesOf<double>(2000, 9), 1, plan);
  expectExact(std::vector<double>(2000, DBL_MAX), 1, plan);
  expectExact(std::vector<double>(2000, -DBL_TRUE_MIN), 1, plan);
  expectExact(std::vector<float>(2000, FLT_TRUE_MIN), 1, plan);
  trial::Random random(10);
  std::vector<double> denormals;
  std::vector<float> denormalFloats;
  for (int i = 0; i < 2000; ++i)
  {
    denormals.push_back(DBL_TRUE_MIN * std::floor(random.uniform(-1e15, 1e15)));
    denormalFloats.push_back(FLT_TRUE_MIN * float(std::floor(random.uniform(-8e6, 8e6))));
  }
  expectExact(denormals, 1, plan);
  expectExact(denormalFloats, 1, plan);
  denormals[7] = DBL_MAX;
  expectExact(denormals, 2, planFor(1000, 30, 11));
}

TEST(AttributeMean, OfALonePointIsItsValue)
{
  for (const double low : { -323.0, -30.0, -3.0, 0.0 })
  {
    const std::vector<double> doubles = magnitudes<double>(900, low, 0.0 - low > 300.0 ? 308.0 : -low, 12);
    const Plan plan = planFor(300, 300, 13);
    EXPECT_EQ(reducedValues(doubles, 3, plan), doubles);
    const std::vector<float> floats = magnitudes<float>(300, std::max(low, -45.0), 38.0, 14);
    EXPECT_EQ(reducedValues(floats, 1, plan), floats);
  }
}

TEST(AttributeMean, OfZerosIsZero)
{
  const Plan plan = planFor(100, 10, 15);
  EXPECT_EQ(reducedValues(std::vector<double>(200, 0.0), 2, plan), std::vector<double>(20, 0.0));
  EXPECT_EQ(reducedValues(std::vector<float>(100, -0.0F), 1, plan), std::vector<float>(10, 0.0F));
}

namespace
{

/// Means and, of three components, vectors: on all instruction sets and from parts what they are here.
template <typename T>
void expectSameOnAllPaths(const std::vector<T>& values, int components, const Plan& plan)
{
  const AffineTransform transform =
    AffineTransform::rotation(40, { 1, 2, 3 }) * AffineTransform::scaling({ 2, 3, 5 });
  const auto results = [&](InstructionSet set, std::int64_t chunkPoints)
  {
    std::vector<T> all =
      reducedValues(values, components, plan, AttributeStatistic::Mean, { set, {}, chunkPoints });
    if (components == 3)
    {
      const std::vector<T> vectors =
        reducedValues(values, components, plan, AttributeStatistic::Normal, { set, transform, chunkPoints });
      all.insert(all.end(), vectors.begin(), vectors.end());
    }
    return all;
  };
  const std::vector<T> expected = results(InstructionSet::Baseline, 0);
  for (const InstructionSet set : heldInstructionSets())
  {
    EXPECT_TRUE(sameBits(results(set, 0), expected)) << components << " components";
  }
  EXPECT_TRUE(sameBits(results(InstructionSet::Automatic, 50), expected))
    << components << " components, in parts";
}

}

TEST(AttributeMean, IsTheSameOnAllInstructionSetsAndFromPartsBitForBit)
{
  for (const int components : { 1, 2, 3, 4, 100, 1000 })
  {
    const std::size_t tuples = components > 10 ? 100 : 5000;
    const std::size_t size = tuples * std::size_t(components);
    const Plan plan = planFor(tuples, std::int64_t(tuples) / 3, 30);
    expectSameOnAllPaths(extremesOf<std::int8_t>(size, 31), components, plan);
    expectSameOnAllPaths(extremesOf<std::uint8_t>(size, 32), components, plan);
    expectSameOnAllPaths(extremesOf<std::int16_t>(size, 33), components, plan);
    expectSameOnAllPaths(extremesOf<std::uint16_t>(size, 34), components, plan);
    expectSameOnAllPaths(extremesOf<std::int32_t>(size, 35), components, plan);
    expectSameOnAllPaths(extremesOf<std::uint32_t>(size, 36), components, plan);
    std::vector<float> floats = magnitudes<float>(size, -3, 2, 37);
    expectSameOnAllPaths(floats, components, plan);
    // Sums of 0 have no direction; nor has what is not finite.
    std::fill(floats.begin(), floats.begin() + components, 0.0F);
    expectSameOnAllPaths(floats, components, plan);
    floats[1] = INFINITY;
    expectSameOnAllPaths(floats, components, plan);
    std::vector<double> doubles = magnitudes<double>(size, -3, 3, 38);
    expectSameOnAllPaths(doubles, components, plan);
    for (double& value : doubles)
    {
      value = std::floor(1024.0 * value);
    }
    expectSameOnAllPaths(doubles, components, plan);
  }
}

TEST(AttributeMean, OfRealNumbersIsExactWhereSumsJustFitAWord)
{
  // 53 bits from 2 to the last of the smallest number and 10 for a thousand points; then one more.
  for (const double smallest : { 0x1p-29, 0x1p-30 })
  {
    for (const double sign : { 1.0, -1.0 })
    {
      std::vector<float> values(1000, float(sign * (2.0 - 0x1p-23)));
      values[500] = float(smallest);
      expectExact(values, 1, planFor(1000, 1, 40));
      expectSameOnAllPaths(values, 1, planFor(1000, 1, 40));
    }
  }
}

TEST(AttributeMean, MakesUnitVectorsOfTurnedMeans)
{
  const std::vector<float> values{ 1, 2, 2, 3, 2, 2, 0, 0, 1, 0, 0, -1 };
  Plan plan = planFor(4, 2, 41);
  plan.voxels = { 0, 0, 1, 1 };
  const AffineTransform quarterTurn = { { { 0, -1, 0, 0 }, { 1, 0, 0, 0 }, { 0, 0, 1, 0 } } };
  const std::vector<float> vectors =
    reducedValues(values, 3, plan, AttributeStatistic::Normal, { InstructionSet::Automatic, quarterTurn });
  const float third = float(2.0 / std::sqrt(12.0));
  EXPECT_EQ(vectors, (std::vector<float>{ -third, third, third, 0, 0, 0 }));
}

TEST(AttributeMean, LeavesOutNaNAndTakesInfinitiesAsIeeeAdditionDoes)
{
  const double inf = INFINITY;
  for (const double finite : { 1.0, 0.0, 1e-300, DBL_MAX })
  {
    const std::vector<double> values{ NAN, finite, inf, finite, -inf, -finite, inf, -inf, NAN, inf, finite,
      finite };
    Plan plan = planFor(12, 6, 16);
    plan.voxels = { 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5 };
    const std::vector<double> means = reducedValues(values, 1, plan);
    EXPECT_EQ(means[0], finite);
    EXPECT_EQ(means[1], inf);
    EXPECT_EQ(means[2], -inf);
    EXPECT_TRUE(std::isnan(means[3]));
    EXPECT_EQ(means[4], inf);
    EXPECT_EQ(means[5], finite);
    const std::vector<float> floats(values.begin(), values.end() - 2);
    plan.voxels.resize(10);
    plan.order.resize(10);
    plan.size = 5;
    const std::vector<float> narrow = reducedValues(floats, 1, plan);
    EXPECT_TRUE(std::isnan(narrow[3]) && narrow[4] == float(inf));
    EXPECT_TRUE(!std::isfinite(float(finite)) || narrow[0] == float(finite));
    EXPECT_TRUE(narrow[1] == float(inf) && narrow[2] == -float(inf));
  }
}

/// Nothing but a build with a sanitizer of undefined behaviour can tell alignment; others look at the values.
TEST(AttributeMean, ReadsFieldsOfPackedRecords)
{
  const std::vector<double> values = magnitudes<double>(900, -3, 3, 26);
  constexpr std::size_t kRecord = 1 + 3 * sizeof(double);
  std::vector<char> records(300 * kRecord);
  for (std::size_t i = 0; i < 300; ++i)
  {
    std::memcpy(records.data() + i * kRecord + 1, values.data() + 3 * i, 3 * sizeof(double));
  }
  const Plan plan = planFor(300, 40, 27);
  const AttributeView view = { records.data() + 1, ScalarType::Double, 3, 300, std::int64_t(kRecord) };
  const std::vector<char> means = reducedTuples({ view }, plan);
  const std::vector<double> expected = reducedValues(values, 3, plan);
  EXPECT_EQ(std::memcmp(means.data(), expected.data(), means.size()), 0);
}
