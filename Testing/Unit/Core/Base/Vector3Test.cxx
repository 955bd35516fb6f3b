#include "Core/Base/Vector3.h"

#include "RandomClouds.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace pointhaptics;

namespace
{

void expectEigen(const SymMat3& m, double scale)
{
  const SymEigen e = symmetricEigen(m);
  EXPECT_LE(e.values[0], e.values[1]);
  EXPECT_LE(e.values[1], e.values[2]);
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(norm(e.vectors[i]), 1.0, 1e-14);
    EXPECT_NEAR(dot(e.vectors[i], e.vectors[(i + 1) % 3]), 0.0, 1e-14);
    EXPECT_LE(norm(m * e.vectors[i] - e.values[i] * e.vectors[i]), 1e-14 * scale);
  }
  EXPECT_NEAR(e.values[0] + e.values[1] + e.values[2], m.trace(), 1e-14 * scale);
}

double largest(const SymMat3& m)
{
  return std::fabs(m.xx) + std::fabs(m.yy) + std::fabs(m.zz) + std::fabs(m.xy) + std::fabs(m.yz) +
    std::fabs(m.xz);
}

} // namespace

TEST(Vector3, CrossProductIsRightHanded)
{
  EXPECT_EQ(cross({ 1, 0, 0 }, { 0, 1, 0 }), Vec3(0, 0, 1));
  EXPECT_EQ(cross({ 0, 1, 0 }, { 0, 0, 1 }), Vec3(1, 0, 0));
}

TEST(Vector3, NormalizedFallsBackForZeroAndNonFinite)
{
  const Vec3 fallback(0, 1, 0);
  EXPECT_EQ(normalized({ 0, 0, 0 }, fallback), fallback);
  EXPECT_EQ(normalized({ NAN, 0, 0 }, fallback), fallback);
  EXPECT_EQ(normalized({ INFINITY, 0, 0 }, fallback), fallback);
  EXPECT_NEAR(norm(normalized({ 3, -4, 12 })), 1.0, 1e-15);
}

TEST(Vector3, PerpendicularIsUnitAndPerpendicular)
{
  trial::Random random(7);
  for (int i = 0; i < 1000; ++i)
  {
    const Vec3 n = random.direction();
    EXPECT_NEAR(dot(n, anyPerpendicular(n)), 0.0, 1e-15);
    EXPECT_NEAR(norm(anyPerpendicular(n)), 1.0, 1e-15);
  }
  for (const Vec3& n : { Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(1, 0, 0), Vec3(0, -1, 0) })
  {
    EXPECT_NEAR(dot(n, anyPerpendicular(n)), 0.0, 1e-15);
    EXPECT_NEAR(norm(anyPerpendicular(n)), 1.0, 1e-15);
  }
}

TEST(SymmetricEigen, SolvesRandomMatricesOfEveryScale)
{
  trial::Random random(11);
  for (int i = 0; i < 2000; ++i)
  {
    const double s = std::pow(10.0, random.uniform(-100, 100));
    SymMat3 m{ random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1),
      random.uniform(-1, 1), random.uniform(-1, 1) };
    m *= s;
    expectEigen(m, largest(m));
  }
}

TEST(SymmetricEigen, SolvesRepeatedAndZeroEigenvalues)
{
  expectEigen({ 0, 0, 0, 0, 0, 0 }, 1.0);
  expectEigen({ 2, 2, 2, 0, 0, 0 }, 2.0);
  expectEigen({ 1, 1, 1, 1, 1, 1 }, 3.0);
  expectEigen({ 1, 1e-20, 1, 0, 0, 0 }, 1.0);
  expectEigen(outerProduct({ 1, 2, 3 }), 14.0);
}

TEST(SymmetricEigen, FindsTheNormalOfAFlatCovariance)
{
  const Vec3 n = normalized({ 1, -2, 0.5 });
  const Vec3 a = anyPerpendicular(n);
  SymMat3 m = outerProduct(a);
  m += outerProduct(2.0 * cross(n, a));
  const SymEigen e = symmetricEigen(m);
  EXPECT_NEAR(e.values[0], 0.0, 1e-14);
  EXPECT_NEAR(e.values[1], 1.0, 1e-14);
  EXPECT_NEAR(e.values[2], 4.0, 1e-14);
  EXPECT_NEAR(std::fabs(dot(e.vectors[0], n)), 1.0, 1e-14);
}

TEST(SymmetricEigen, GivesZerosAndUnitAxesForNonFinite)
{
  for (const double bad : { NAN, INFINITY, -INFINITY })
  {
    const SymEigen e = symmetricEigen({ 1, 1, 1, bad, 0, 0 });
    EXPECT_EQ(e.values, (std::array<double, 3>{ 0, 0, 0 }));
    EXPECT_EQ(e.vectors[0], Vec3(1, 0, 0));
    EXPECT_EQ(e.vectors[1], Vec3(0, 1, 0));
    EXPECT_EQ(e.vectors[2], Vec3(0, 0, 1));
  }
}
