#include "SplatLook.h"

#include "Core/Base/AffineTransform.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <random>
#include <vector>

using namespace pointhaptics;

namespace
{

/// Adds points on the sides of a box, turned against the axes.
void addBox(const Vec3& corner, const Vec3& size, int count, std::vector<Vec3>& points)
{
  std::mt19937_64 engine(7);
  const auto upTo = [&engine](double most) { return most * (double(engine() >> 11) * 0x1p-53); };
  const double areas[3] = { size.y * size.z, size.x * size.z, size.x * size.y };
  for (int i = 0; i < count; ++i)
  {
    const double at = upTo(areas[0] + areas[1] + areas[2]);
    const int axis = at < areas[0] ? 0 : at < areas[0] + areas[1] ? 1 : 2;
    Vec3 p{ upTo(size.x), upTo(size.y), upTo(size.z) };
    p[axis] = upTo(1.0) < 0.5 ? 0.0 : size[axis];
    points.push_back(AffineTransform::rotation(23.0, { 0, 0, 1 }).apply(corner + p));
  }
}

CloudLook lookOf(const std::vector<Vec3>& points)
{
  MeasuredCloud measured;
  EXPECT_TRUE(
    measureCloud({ points.data(), std::int64_t(points.size()) }, CloudOrientation(), std::nullopt, measured));
  return measured.look;
}

TEST(RoomEvidence, ShowsTheInsideOfARoomThatIsRegisteredToItsFloor)
{
  std::vector<Vec3> points;
  addBox({ 10, 20, 0 }, { 5, 4, 2.5 }, 8000, points);
  EXPECT_EQ(lookOf(points).kind, CloudKind::Object) << "an empty one may be a box seen from outside";
  addBox({ 12, 22, 0.5 }, { 1.6, 0.8, 0.3 }, 1000, points);
  const CloudLook look = lookOf(points);
  EXPECT_EQ(look.kind, CloudKind::Indoors);
  EXPECT_GT(look.sensor.z, 1.5);
  EXPECT_LT(look.sensor.z, 2.4);
  EXPECT_GT(norm(look.sensor), 10.0);
}

} // namespace
