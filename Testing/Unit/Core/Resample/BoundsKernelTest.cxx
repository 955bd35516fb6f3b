// The box of a cloud, of each instruction set: extremes and what is not finite stand at the ends of vectors
// and blocks.
#include "Core/Resample/Kernel/VoxelKernel.h"

#include "RandomClouds.h"

#include "Unit/HeldInstructionSets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace pointhaptics;
using namespace pointhaptics::simd;

namespace
{

/// Bounds of the points that are finite before and after the transform, one by one.
template <typename Real>
Bounds plainBoundsOf(const AffineTransform& transform, const std::vector<Real>& xyz, std::size_t stride)
{
  Bounds box;
  for (std::size_t i = 0; i < xyz.size(); i += stride)
  {
    const Vec3 p(xyz[i], xyz[i + 1], xyz[i + 2]);
    if (isFinite(p) && isFinite(transform.apply(p)))
    {
      box.include(transform.apply(p));
    }
  }
  return box;
}

template <typename Real>
Bounds boundsOf(
  const Kernels& kernels, const AffineTransform& transform, const std::vector<Real>& xyz, std::size_t stride)
{
  double box[6] = { INFINITY, -INFINITY, INFINITY, -INFINITY, INFINITY, -INFINITY };
  const auto count = std::int64_t((xyz.size() + stride - 1) / stride);
  kernels.of<Real>().bounds(transform.m, xyz.data(), count, std::int64_t(stride), box);
  Bounds bounds;
  if (box[0] <= box[1])
  {
    bounds.include({ box[0], box[2], box[4] });
    bounds.include({ box[1], box[3], box[5] });
  }
  return bounds;
}

template <typename Real>
void expectBounds(const AffineTransform& transform, const std::vector<Real>& xyz, std::size_t stride)
{
  const Bounds expected = plainBoundsOf(transform, xyz, stride);
  for (const InstructionSet set : heldInstructionSets())
  {
    const Bounds box = boundsOf(kernelsFor(set), transform, xyz, stride);
    ASSERT_EQ(box.minimum, expected.minimum) << int(set);
    ASSERT_EQ(box.maximum, expected.maximum) << int(set);
  }
}

/// Clouds whose extremes, and what is not finite, are anywhere: at the ends of vectors, blocks and the cloud.
/// Between points are numbers that are none of theirs, and nothing is behind the last one's z.
template <typename Real>
void tryBounds(const AffineTransform& transform, std::size_t stride)
{
  trial::Random random(8);
  for (const std::size_t size : { 0, 1, 15, 16, 17, 1023, 1024, 1025, 2048, 5000 })
  {
    SCOPED_TRACE(size);
    for (int i = 0; i < 60; ++i)
    {
      std::vector<Real> xyz(size > 0 ? stride * size - (stride - 3) : 0);
      for (Real& x : xyz)
      {
        x = Real(random.uniform(-1, 1));
      }
      for (int extreme = 0; size > 0 && extreme < i % 7; ++extreme)
      {
        xyz[random.below(xyz.size())] = Real(random.uniform(-9, 9));
      }
      for (int broken = 0; size > 0 && broken < i % 3; ++broken)
      {
        const double values[] = { NAN, INFINITY, -INFINITY, sizeof(Real) == 8 ? 1e300 : 9.0 };
        xyz[random.below(xyz.size())] = Real(values[random.below(4)]);
      }
      for (std::size_t at = 0; at < xyz.size(); ++at)
      {
        xyz[at] = at % stride < 3 ? xyz[at] : i % 2 ? Real(99) : Real(NAN);
      }
      ASSERT_NO_FATAL_FAILURE(expectBounds(transform, xyz, stride));
    }
  }
}

} // namespace

TEST(BoundsKernel, FindsTheBoxOfTheFinitePoints)
{
  AffineTransform mirror = AffineTransform::scaling({ -1.7, 1e20, 0.3 });
  mirror.m[0][3] = 0.1;
  mirror.m[2][3] = -1e7;
  AffineTransform shear = mirror;
  shear.m[1][2] = 2.5;
  for (const AffineTransform& transform : { AffineTransform(), mirror, shear })
  {
    for (const std::size_t stride : { 3, 4, 8 })
    {
      SCOPED_TRACE(transform.m[1][2]);
      SCOPED_TRACE(stride);
      ASSERT_NO_FATAL_FAILURE(tryBounds<float>(transform, stride));
      ASSERT_NO_FATAL_FAILURE(tryBounds<double>(transform, stride));
    }
  }
}
