#include "Core/Base/AffineTransform.h"

#include "RandomClouds.h"

#include <gtest/gtest.h>

#include <cfloat>
#include <cmath>

using namespace pointhaptics;

namespace
{

AffineTransform randomTransform(trial::Random& random)
{
  AffineTransform t;
  for (auto& row : t.m)
  {
    for (double& v : row)
    {
      v = random.uniform(-2, 2);
    }
  }
  return t;
}

void expectNear(const Vec3& a, const Vec3& b, double tolerance)
{
  EXPECT_LE(norm(a - b), tolerance) << a.x << ' ' << a.y << ' ' << a.z;
}

} // namespace

TEST(AffineTransform, IsTheIdentityByDefault)
{
  const AffineTransform t;
  EXPECT_TRUE(t.isIdentity());
  EXPECT_EQ(t.check(), Status::Ok);
  EXPECT_EQ(t.determinant(), 1.0);
  EXPECT_EQ(t.apply({ 1, -2, 3 }), Vec3(1, -2, 3));
  EXPECT_FALSE(AffineTransform::translation({ 0, 0, 1 }).isIdentity());
  EXPECT_FALSE(AffineTransform::scaling({ 1, 2, 1 }).isIdentity());
}

TEST(AffineTransform, RotatesRightHanded)
{
  const double tiny = 1e-15;
  expectNear(AffineTransform::rotation(90, { 0, 0, 1 }).apply({ 1, 0, 0 }), { 0, 1, 0 }, tiny);
  expectNear(AffineTransform::rotation(90, { 1, 0, 0 }).apply({ 0, 1, 0 }), { 0, 0, 1 }, tiny);
  expectNear(AffineTransform::rotation(90, { 0, 7, 0 }).apply({ 0, 0, 1 }), { 1, 0, 0 }, tiny);
  expectNear(AffineTransform::rotation(120, { 1, 1, 1 }).apply({ 1, 0, 0 }), { 0, 1, 0 }, tiny);
  EXPECT_NEAR(AffineTransform::rotation(37, { 1, -2, 0.3 }).determinant(), 1.0, 1e-14);
}

TEST(AffineTransform, TellsSimilarities)
{
  double scale = 0.0;
  EXPECT_TRUE((AffineTransform::rotation(37, { 1, -2, 0.3 }) * AffineTransform::scaling({ -3, 3, 3 }))
                .isSimilarity(scale));
  EXPECT_NEAR(scale, 3.0, 1e-14);
  EXPECT_FALSE(AffineTransform::scaling({ 1, 1, 1.0001 }).isSimilarity(scale));
  EXPECT_FALSE(AffineTransform::scaling({ 0, 0, 0 }).isSimilarity(scale));
  EXPECT_FALSE(AffineTransform::scaling({ NAN, 1, 1 }).isSimilarity(scale));
}

TEST(AffineTransform, ProductAppliesTheRightOneFirst)
{
  const AffineTransform scale = AffineTransform::scaling({ 2, 3, 4 });
  const AffineTransform shift = AffineTransform::translation({ 1, 1, 1 });
  EXPECT_EQ((shift * scale).apply({ 1, 1, 1 }), Vec3(3, 4, 5));
  EXPECT_EQ((scale * shift).apply({ 1, 1, 1 }), Vec3(4, 6, 8));
  EXPECT_EQ(shift.applyToVector({ 1, 2, 3 }), Vec3(1, 2, 3));
}

TEST(AffineTransform, InverseUndoesEveryRandomTransform)
{
  trial::Random random(3);
  for (int i = 0; i < 500; ++i)
  {
    const AffineTransform t = randomTransform(random);
    if (std::fabs(t.determinant()) < 0.05)
    {
      continue;
    }
    ASSERT_EQ(t.check(), Status::Ok);
    const Vec3 p = random.inBox({ -1, -1, -1 }, { 1, 1, 1 });
    expectNear(t.inverse().apply(t.apply(p)), p, 1e-11);
    expectNear(t.apply(t.inverse().apply(p)), p, 1e-11);
  }
}

TEST(AffineTransform, NormalsStayPerpendicularUnderShearAndMirror)
{
  trial::Random random(5);
  for (int i = 0; i < 500; ++i)
  {
    const AffineTransform t = randomTransform(random);
    if (std::fabs(t.determinant()) < 0.05)
    {
      continue;
    }
    const Vec3 n = random.direction();
    const Vec3 a = anyPerpendicular(n);
    const Vec3 b = cross(n, a);
    const Vec3 turned = normalized(t.applyToNormal(n));
    EXPECT_NEAR(dot(turned, normalized(t.applyToVector(a))), 0.0, 1e-12);
    EXPECT_NEAR(dot(turned, normalized(t.applyToVector(b))), 0.0, 1e-12);
    EXPECT_GT(dot(turned, t.applyToVector(n)), 0.0) << "the normal must stay on its side";
  }
}

TEST(AffineTransform, ReportsSingularOnes)
{
  AffineTransform t = AffineTransform::scaling({ 1, 1, 0 });
  EXPECT_EQ(t.check(), Status::SingularTransform);
  EXPECT_TRUE(t.inverse().isIdentity());
  t = {};
  t.m[2][0] = 1;
  t.m[2][2] = 0; // the third row repeats the first
  EXPECT_EQ(t.check(), Status::SingularTransform);
  // Dependent rows whose computed determinant is only rounding.
  const double rows[3][3] = { { 0.1, 0.2, 0.3 }, { 0.4, 0.5, 0.6 }, { 0.7, 0.8, 0.9 } };
  for (int i = 0; i < 9; ++i)
  {
    t.m[i / 3][i % 3] = rows[i / 3][i % 3];
  }
  EXPECT_EQ(t.check(), Status::SingularTransform);
}

TEST(AffineTransform, ReportsNonFiniteOnes)
{
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      for (const double bad : { NAN, INFINITY, -INFINITY })
      {
        AffineTransform t;
        t.m[row][column] = bad;
        EXPECT_EQ(t.check(), Status::NonFiniteTransform) << row << ' ' << column << ' ' << bad;
        EXPECT_TRUE(t.inverse().isIdentity());
      }
    }
  }
}

TEST(AffineTransform, TransformsThatOverflowAreErrorsNotNumbers)
{
  for (const double huge : { 1e150, DBL_MAX })
  {
    const AffineTransform t = AffineTransform::scaling({ huge, huge, huge });
    if (t.check() == Status::Ok)
    {
      const AffineTransform inverse = t.inverse();
      EXPECT_NEAR(inverse.m[0][0] * huge, 1.0, 1e-14);
      EXPECT_EQ(inverse.check() == Status::NonFiniteTransform, false);
    }
  }
  EXPECT_EQ(AffineTransform::scaling({ 1e-310, 1e-310, 1e-310 }).check(), Status::SingularTransform);
}

TEST(AffineTransform, AcceptsUniformScalesWhoseDeterminantIsNoNumber)
{
  for (const double s : { 1e-300, 1e-110, 1e-101, 1e110, 1e300 })
  {
    const AffineTransform t =
      AffineTransform::scaling({ s, s, s }) * AffineTransform::rotation(30, { 1, 2, 3 });
    ASSERT_EQ(t.check(), Status::Ok) << s;
    expectNear(t.inverse().apply(t.apply({ 1, 2, 3 })), { 1, 2, 3 }, 1e-14);
    expectNear(normalized(t.applyToNormal({ 1, 0, 0 })), t.applyToVector({ 1, 0, 0 }) / s, 1e-15);
  }
}

TEST(AffineTransform, AcceptsStretchingBeforeARotationAsAfterIt)
{
  const AffineTransform turn = AffineTransform::rotation(40, { 1, 2, 3 });
  for (const Vec3& factors : { Vec3(1e6, 1, 1e-6), Vec3(1e12, 1e12, 1e-2), Vec3(1e-9, 1e3, 1) })
  {
    const AffineTransform stretch = AffineTransform::scaling(factors);
    EXPECT_EQ((turn * stretch).check(), Status::Ok) << factors.x;
    EXPECT_EQ((stretch * turn).check(), Status::Ok) << factors.x;
  }
  // Neither order makes a flat one regular.
  const AffineTransform flat = AffineTransform::scaling({ 1, 1e6, 0 });
  EXPECT_EQ((turn * flat).check(), Status::SingularTransform);
  EXPECT_EQ((flat * turn).check(), Status::SingularTransform);
  EXPECT_EQ((turn * flat * turn).check(), Status::SingularTransform);
}
