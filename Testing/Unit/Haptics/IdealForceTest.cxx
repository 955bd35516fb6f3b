#include "Shapes/IdealForce.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace pointhaptics;

namespace
{

std::vector<Vec3> sampleOf(Shape shape, double noise = 0.0, int count = 3000)
{
  std::vector<Vec3> points;
  EXPECT_EQ(generateShape(shape, count, 5, noise, points), Status::Ok);
  return points;
}

bool recognize(const std::vector<Vec3>& points, Shape& shape)
{
  return recognizeShape(PointView(points.data(), std::int64_t(points.size())), shape);
}

} // namespace

TEST(IdealForce, RecognizesEachShapeItCanKnow)
{
  for (int i = 0; i < kNumberOfShapes; ++i)
  {
    const Shape drawn = static_cast<Shape>(i);
    Shape known = Shape::Idol;
    ASSERT_TRUE(recognize(sampleOf(drawn), known)) << shapeName(drawn);
    EXPECT_STREQ(shapeName(known), shapeName(drawn == Shape::DensityStep ? Shape::Plane : drawn));
  }
}

TEST(IdealForce, RecognizesCoordinatesOfFilesAndPassesOverWhatIsNotFinite)
{
  std::vector<float> floats;
  for (const Vec3& p : sampleOf(Shape::Torus))
  {
    floats.insert(floats.end(), { float(p.x), float(p.y), float(p.z) });
  }
  floats[0] = NAN;
  Shape known = Shape::Plane;
  EXPECT_TRUE(recognizeShape(PointView(floats.data(), std::int64_t(floats.size() / 3)), known));
  EXPECT_EQ(known, Shape::Torus);
}

TEST(IdealForce, DoesNotTakeNoiseOrOtherCloudsForAShape)
{
  Shape known = Shape::Idol;
  EXPECT_FALSE(recognize(sampleOf(Shape::Sphere, 1e-4), known));
  EXPECT_FALSE(recognize({}, known));
  EXPECT_FALSE(recognize({ { NAN, 0, 0 } }, known));
  std::vector<Vec3> moved = sampleOf(Shape::Sphere);
  for (Vec3& p : moved)
  {
    p.x += 1e-5;
  }
  EXPECT_FALSE(recognize(moved, known));
  EXPECT_FALSE(recognize({ { 0.0, 0.0, 0.0 }, { 0.0, 0.06, 0.0 } }, known)) << "beyond all shapes";
  EXPECT_EQ(known, Shape::Idol);
}

TEST(IdealForce, IsTheSpringBelowTheSurfaceWhereverTheModelIs)
{
  const AffineTransform model = AffineTransform::translation({ 0.01, 0, 0 }) *
    AffineTransform::rotation(70.0, { 1, 2, 3 }) * AffineTransform::scaling({ 1.6, 1.6, 1.6 });
  IdealForce ideal(Shape::Sphere); // radius 0.025 * 1.6 = 0.04 about (0.01, 0, 0)
  EXPECT_EQ(ideal.at({ 0.06, 0, 0 }, model, 800.0), 0.0);
  EXPECT_NEAR(ideal.at({ 0.048, 0, 0 }, model, 800.0), 800.0 * 0.002, 1e-9);
  EXPECT_NEAR(ideal.at({ 0.01, 0.035, 0 }, model, 400.0), 400.0 * 0.005, 1e-9);
  EXPECT_EQ(ideal.at({ 0.01, 0.041, 0 }, model, 800.0), 0.0);
  EXPECT_TRUE(std::isnan(ideal.at({ 0, 0, 0 }, AffineTransform::scaling({ 1, 2, 1 }), 800.0)));
  EXPECT_TRUE(std::isnan(ideal.at({ NAN, 0, 0 }, model, 800.0)));
}

TEST(IdealForce, KeepsTheSideTheHandCameFromUntilItGoesAroundTheRim)
{
  const AffineTransform model;
  IdealForce fromBelow(Shape::Plane);
  EXPECT_EQ(fromBelow.at({ 0, 0, -0.01 }, model, 800.0), 0.0);
  EXPECT_NEAR(fromBelow.at({ 0, 0, 0.002 }, model, 800.0), 1.6, 1e-9);
  EXPECT_EQ(fromBelow.at({ 0.045, 0, 0.002 }, model, 800.0), 0.0) << "past the rim";
  EXPECT_EQ(fromBelow.at({ 0, 0, 0.002 }, model, 800.0), 0.0) << "it is above now";
  EXPECT_NEAR(fromBelow.at({ 0, 0, -0.001 }, model, 800.0), 0.8, 1e-9);
  IdealForce throughHole(Shape::Hole);
  EXPECT_EQ(throughHole.at({ 0, 0.002, 0.01 }, model, 800.0), 0.0);
  EXPECT_EQ(throughHole.at({ 0, 0.002, -0.01 }, model, 800.0), 0.0);
  EXPECT_TRUE(std::isnan(IdealForce(Shape::Sheet).at({ 0, 0, 0 }, model, 800.0)));
}
