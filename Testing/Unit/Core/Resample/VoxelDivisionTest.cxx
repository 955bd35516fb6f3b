// The vector loops divide by spacings as the baseline does: correctly rounded.
#include "Core/Resample/Kernel/VoxelKernel.h" // kWidest

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
