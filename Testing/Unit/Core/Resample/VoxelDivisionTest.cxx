// The divisions of the vector loops, by counts and by spacings, are correctly rounded: those of the baseline.
#include "Core/Resample/Kernel/VoxelKernel.h"

#include "RandomClouds.h"
#include "ResamplerRuns.h"

#include "Unit/HeldInstructionSets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace pointhaptics;
using namespace pointhaptics::simd;
using namespace pointhaptics::trial;

namespace
{

const std::vector<InstructionSet> kSets = heldInstructionSets();

struct Fraction
{
  std::int64_t sum;
  std::int64_t count;
};

/// Fractions of all sizes, as many again next to midpoints of two doubles.
std::vector<Fraction> fractions(std::size_t n)
{
  Random random(1);
  std::vector<Fraction> all;
  while (all.size() < n)
  {
    const auto bits = int(random.below(20)); // As many as a packed sum counts.
    const std::int64_t count = 1 + std::int64_t(random.uniform() * std::ldexp(1.0, bits));
    all.push_back({ std::int64_t(random.uniform() * std::ldexp(1.0, int(random.below(62)))), count });
    const std::int64_t few = 1 + std::int64_t(random.below(255));
    const std::int64_t midpoint = 2 * std::int64_t(random.uniform(0.5, 1.0) * 0x1p53) + 1;
    all.push_back({ few * midpoint + std::int64_t(random.below(3)) - 1, few });
    // So near that one correction of the product is needed, and enough.
    const std::int64_t sum = std::int64_t(random.uniform(0.5, 1.0) * 0x1p53);
    all.push_back({ sum, count });
  }
  return all;
}

/// A spacing, and a place whose quotient by it is as near to the midpoint of two doubles as any may be. One
/// of these is a quantum of the lattice (300 voxels), so that a quotient rounded to the other shows.
struct NearMidpoint
{
  double spacing;
  double place;
};

NearMidpoint nearMidpoint(Random& random)
{
  constexpr std::uint64_t kModulus = std::uint64_t(1) << 54;
  constexpr std::uint64_t kQuantum = std::uint64_t(1) << 20;
  __extension__ typedef unsigned __int128 Wide;
  for (;;)
  {
    const std::uint64_t quantum = kQuantum * (std::uint64_t(1) << 33 | random.below(std::size_t(1) << 33));
    const std::uint64_t midpoint = random.below(2) == 0 ? quantum - 1 : quantum + 1;
    std::uint64_t inverse = 1; // modulo 2^64, by Newton's method
    for (int i = 0; i < 6; ++i)
    {
      inverse *= 2 - midpoint * inverse;
    }
    inverse %= kModulus;
    // midpoint spacing is 1 more, or less, than a multiple of the modulus.
    const bool isMore = inverse < kModulus / 2;
    const std::uint64_t spacing = isMore ? inverse : kModulus - inverse;
    const auto place = std::uint64_t((Wide(midpoint) * spacing + (isMore ? -1 : 1)) / kModulus);
    if (spacing >= kModulus / 4 && place < kModulus / 2)
    {
      return { double(spacing) * 0x1p-52, double(place) * 0x1p-52 };
    }
  }
}

}

TEST(VoxelDivision, ByCountsIsCorrectlyRounded)
{
  MeanMap map{};
  map.quantum = 1.0;
  for (double& spacing : map.spacing)
  {
    spacing = 1.0;
  }
  const std::vector<Fraction> all = fractions(300000);
  const CellMap cellMap = { 0, 1, 1, 0, 0 };
  const std::vector<std::uint32_t> cells(kBatch + kWidest, 0);
  std::vector<PackedSums> packed(kBatch + kWidest);
  for (const InstructionSet set : kSets)
  {
    const Kernels& kernels = kernelsFor(set);
    for (std::size_t first = 0; first + kBatch <= all.size(); first += kBatch)
    {
      for (std::size_t i = 0; i < kBatch; ++i)
      {
        const auto sum = std::uint64_t(all[first + i].sum);
        packed[i] = { { sum, sum, sum, std::uint64_t(all[first + i].count) << kCountShift } };
      }
      double means[3 * kBatch];
      std::int64_t counts[kBatch];
      int nearFace[kBatch];
      kernels.of<double>().packedMeans(
        map, cellMap, cells.data(), packed.data(), kBatch, means, counts, nearFace);
      for (int i = 0; i < kBatch; ++i)
      {
        const Fraction& fraction = all[first + std::size_t(i)];
        const double expected = double(fraction.sum) / double(fraction.count);
        ASSERT_EQ(counts[i], fraction.count);
        for (int axis = 0; axis < 3; ++axis)
        {
          ASSERT_EQ(means[3 * i + axis], expected)
            << fraction.sum << " / " << fraction.count << ", set " << int(set);
        }
      }
    }
  }
}

TEST(VoxelDivision, BySpacingsIsThatOfTheBaselineAtTheFaces)
{
  Random random(2);
  Lattice lattice = latticeOf(300, 300, 300);
  for (int i = 0; i < 60; ++i)
  {
    const double spacing = std::exp(random.uniform(-9.0, 9.0));
    lattice.spacing = { spacing, spacing, spacing };
    const double corner = i % 2 == 0 ? 0.0 : spacing * random.uniform(-400.0, 400.0);
    lattice.origin = { corner, corner, corner };
    std::vector<Vec3> points;
    for (int j = 0; j < 1000; ++j)
    {
      Vec3 point;
      for (int axis = 0; axis < 3; ++axis)
      {
        const double face = corner + double(random.below(301)) * spacing;
        const double to = random.below(2) == 0 ? -HUGE_VAL : HUGE_VAL;
        point[axis] = random.below(3) == 0 ? face : std::nextafter(face, to);
      }
      points.push_back(point);
    }
    VoxelRequest request;
    request.points = { points.data(), std::int64_t(points.size()) };
    request.lattice = lattice;
    request.keys = true;
    request.instructions = InstructionSet::Baseline;
    const RunResult expected = runOf(request);
    for (const InstructionSet set : kSets)
    {
      request.instructions = set;
      expectSame(
        runOf(request), expected, "spacing " + std::to_string(spacing) + " set " + std::to_string(int(set)));
    }
  }
}

TEST(VoxelDivision, BySpacingsIsCorrectlyRoundedNextToMidpoints)
{
  Random random(3);
  Lattice lattice = latticeOf(300, 300, 300);
  for (int i = 0; i < 400; ++i)
  {
    const NearMidpoint hard = nearMidpoint(random);
    lattice.spacing = { hard.spacing, hard.spacing, hard.spacing };
    // As many as the widest vector has.
    const std::vector<Vec3> points(kWidest, Vec3(hard.place, hard.place, hard.place));
    VoxelRequest request;
    request.points = { points.data(), std::int64_t(points.size()) };
    request.lattice = lattice;
    request.keys = true;
    const double quantum = 0x1p-34;
    const double expected = std::floor(hard.place / hard.spacing / quantum) * quantum * hard.spacing;
    for (const InstructionSet set : kSets)
    {
      request.instructions = set;
      const RunResult result = runOf(request);
      ASSERT_EQ(result.voxels.means.size(), 3u);
      EXPECT_EQ(result.voxels.means[0], expected)
        << hard.place << " / " << hard.spacing << ", set " << int(set);
    }
  }
}
