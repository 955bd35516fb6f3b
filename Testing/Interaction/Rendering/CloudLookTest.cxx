#include "CloudLook.h"

#include "CloudColors.h"
#include "SplatLook.h"

#include "Core/Base/Boxes.h"
#include "Core/Neighbors/LocalShape.h"

#include <gtest/gtest.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <random>

using namespace pointhaptics;

namespace
{

constexpr double kPi = 3.14159265358979323846;

PointView viewOf(const std::vector<Vec3>& points)
{
  return { points.data(), std::int64_t(points.size()) };
}

LocalShape measured(const std::vector<Vec3>& points)
{
  NeighborQuery query;
  query.build(viewOf(points));
  LocalShape shape;
  EXPECT_EQ(measureLocalShape(viewOf(points), query, {}, shape), Status::Ok);
  return shape;
}

class Random
{
public:
  double between(double low, double high) { return low + (high - low) * (double(engine_() >> 11) * 0x1p-53); }

private:
  std::mt19937_64 engine_{ 12 };
};

std::vector<Vec3> ball(int count)
{
  Random random;
  std::vector<Vec3> points;
  while (int(points.size()) < count)
  {
    const Vec3 p{ random.between(-1, 1), random.between(-1, 1), random.between(-1, 1) };
    if (norm(p) < 1.0 && norm(p) > 0.1)
    {
      points.push_back(Vec3(10.0, -20.0, 3.0) + normalized(p));
    }
  }
  return points;
}

std::vector<Vec3> hills(double width, double depth)
{
  Random random;
  std::vector<Vec3> points;
  for (int i = 0; i < 8000; ++i)
  {
    const double x = random.between(0, width);
    const double y = random.between(0, depth);
    points.emplace_back(500000.0 + x, 5e6 + y, 100.0 + 2.0 * std::sin(0.1 * x));
  }
  return points;
}

/// Points where rays from the origin meet a box; up to @p most degrees above the horizon.
std::vector<Vec3> scanned(const Vec3& low, const Vec3& high, double most)
{
  std::vector<Vec3> points;
  for (double above = -60.0; above < most; above += 1.0)
  {
    for (double around = 0.0; around < 360.0; around += 1.0)
    {
      const double a = around * kPi / 180.0;
      const double e = above * kPi / 180.0;
      const Vec3 ray{ std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e) };
      double reach = INFINITY;
      for (int axis = 0; axis < 3; ++axis)
      {
        const double wall = ray[axis] > 0.0 ? high[axis] / ray[axis] : low[axis] / ray[axis];
        reach = std::abs(ray[axis]) > 1e-9 ? std::min(reach, wall) : reach;
      }
      points.push_back(reach * ray);
    }
  }
  return points;
}

CloudKind kindOf(const std::vector<Vec3>& points, const CloudOrientation& orientation = {})
{
  return cloudKind(viewOf(points), measured(points), orientation);
}

TEST(CloudLook, KnowsAnObjectTerrainASweepAndARoom)
{
  EXPECT_EQ(kindOf(ball(6000)), CloudKind::Object);
  EXPECT_EQ(kindOf(hills(100, 90)), CloudKind::Terrain);
  EXPECT_EQ(kindOf(scanned({ -60, -40, -1.5 }, { 80, 70, 1e9 }, 12.0)), CloudKind::Sweep);
  EXPECT_EQ(kindOf(scanned({ -9, -2, -1 }, { 14, 3, 1.2 }, 80.0)), CloudKind::Indoors);
  CloudOrientation camera;
  camera.fromSensor = true;
  EXPECT_EQ(kindOf(ball(500), camera), CloudKind::Frame);
  EXPECT_EQ(kindOf(hills(100, 90), orientationForUpAxis("y")), CloudKind::Object) << "y is up";
}

TEST(CloudLook, NamesItsKinds)
{
  CloudKind kind = CloudKind::Object;
  for (const CloudKind each :
    { CloudKind::Object, CloudKind::Terrain, CloudKind::Sweep, CloudKind::Indoors, CloudKind::Frame })
  {
    EXPECT_TRUE(cloudKindFromName(cloudKindName(each), kind));
    EXPECT_EQ(kind, each);
  }
  EXPECT_FALSE(cloudKindFromName("garden", kind));
  EXPECT_EQ(kind, CloudKind::Frame);
}

TEST(CloudLook, LeavesOutRaysThatDidNotReturn)
{
  const std::vector<Vec3> one = { { 0, 0, 0 }, { 1, 2, 3 }, { NAN, 0, 0 } };
  EXPECT_EQ(drawnPoints(viewOf(one)), (std::vector<std::uint32_t>{ 0, 1 }));
  const std::vector<Vec3> two = { { 0, 0, 0 }, { 1, 2, 3 }, { 0, 0, 0 }, { 4, 5, INFINITY } };
  EXPECT_EQ(drawnPoints(viewOf(two)), (std::vector<std::uint32_t>{ 1 }));
  const std::vector<Vec3> none = { { 0, 0, 0 }, { 0, 0, 0 } };
  EXPECT_EQ(drawnPoints(viewOf(none)).size(), 2U) << "better than nothing";
}

/// The largest coordinates in the picture: 1 is its edge.
Vec3 spread(const std::vector<Vec3>& points, const CameraFit& fit, double aspect)
{
  const Vec3 back = normalized(fit.position - fit.focalPoint);
  const Vec3 right = normalized(cross(fit.up, back));
  const Vec3 up = cross(back, right);
  const double half = std::tan(0.5 * fit.viewAngle * kPi / 180.0);
  Vec3 most;
  for (const Vec3& p : points)
  {
    const Vec3 q = p - fit.position;
    const double distance = -dot(q, back);
    most.x = std::max(most.x, distance > 0.0 ? std::abs(dot(q, right)) / distance / half / aspect : 9.0);
    most.y = std::max(most.y, distance > 0.0 ? std::abs(dot(q, up)) / distance / half : 9.0);
  }
  return most;
}

TEST(CloudLook, FillsTheWindow)
{
  for (const double aspect : { 0.5, 1.0, 1.6, 3.0 })
  {
    for (const std::vector<Vec3>& points : { ball(2000), hills(300, 80), hills(80, 300) })
    {
      const LocalShape shape = measured(points);
      const CloudLook look = cloudLook(kindOf(points), viewOf(points), shape, {});
      const Vec3 most = spread(points, fitCamera(viewOf(points), look, AffineTransform(), aspect), aspect);
      EXPECT_NEAR(std::max(most.x, most.y), 0.92, 1e-6);
    }
  }
}

TEST(CloudLook, IsNotMadeSmallByStrays)
{
  std::vector<Vec3> points = ball(3000);
  const CloudLook look = cloudLook(CloudKind::Object, viewOf(points), measured(points), {});
  const CameraFit fit = fitCamera(viewOf(points), look, AffineTransform(), 1.6);
  std::vector<Vec3> strays = points;
  strays.emplace_back(2000.0, 0.0, 0.0);
  strays.emplace_back(0.0, 0.0, -900.0);
  const CloudLook ofAll = cloudLook(CloudKind::Object, viewOf(strays), measured(strays), {});
  EXPECT_NEAR(
    norm(fitCamera(viewOf(strays), ofAll, AffineTransform(), 1.6).position - fit.position), 0.0, 0.1);
  // A wire that is part of it is no stray.
  for (int i = 0; i < 40; ++i)
  {
    points.emplace_back(10.0, -20.0, 4.0 + 0.05 * i);
  }
  const CloudLook ofWire = cloudLook(CloudKind::Object, viewOf(points), measured(points), {});
  EXPECT_GT(norm(fitCamera(viewOf(points), ofWire, AffineTransform(), 1.6).position - fit.position), 0.5);
}

TEST(CloudLook, ShowsTheSparseSurroundingsOfADenseObject)
{
  const std::vector<Vec3> dense = ball(30000);
  const CloudLook look = cloudLook(CloudKind::Object, viewOf(dense), measured(dense), {});
  Random random;
  std::vector<Vec3> ground = dense;
  std::vector<Vec3> few = dense; // of one in a hundred
  std::vector<Vec3> apart = dense;
  for (int i = 0; i < 900; ++i)
  {
    const Vec3 p{ random.between(-9, 9), random.between(-9, 9), 0.0 };
    ground.push_back(Vec3(10.0, -20.0, 2.0) + p);
    apart.push_back(Vec3(18.0, -12.0, 3.0) + 0.01 * p);
    if (i < 300)
    {
      few.push_back(Vec3(10.0, -20.0, 3.0) + 3.0 * p);
    }
  }
  for (const std::vector<Vec3>& points : { ground, few, apart })
  {
    const CloudLook ofPoints = cloudLook(CloudKind::Object, viewOf(points), measured(points), {});
    const Vec3 most = spread(points, fitCamera(viewOf(points), ofPoints, AffineTransform(), 1.6), 1.6);
    EXPECT_NEAR(std::max(most.x, most.y), 0.92, 1e-6);
  }
  // A sensor sees ever less of the far end, which is not worth a small picture.
  CloudLook sweep = look;
  sweep.cutsSparse = true;
  EXPECT_GT(spread(ground, fitCamera(viewOf(ground), sweep, AffineTransform(), 1.6), 1.6).x, 1.5);
}

TEST(CloudLook, FillsAParallelPictureToo)
{
  const std::vector<Vec3> points = hills(300, 80);
  CloudLook look = cloudLook(CloudKind::Terrain, viewOf(points), measured(points), {});
  for (const double elevation : { 0.0, 35.0, 90.0, -90.0 })
  {
    look.elevation = elevation;
    look.tilt = 0.0;
    const CameraFit fit = fitCamera(viewOf(points), look, AffineTransform(), 1.6, 0.0, true);
    const Vec3 back = normalized(fit.position - fit.focalPoint);
    const Vec3 right = cross(fit.up, back);
    const double half = norm(fit.position - fit.focalPoint) * std::tan(0.5 * fit.viewAngle * kPi / 180.0);
    double width = 0.0;
    double height = 0.0;
    for (const Vec3& p : points)
    {
      width = std::max(width, std::abs(dot(p - fit.focalPoint, right)) / (1.6 * half));
      height = std::max(height, std::abs(dot(p - fit.focalPoint, fit.up)) / half);
    }
    EXPECT_NEAR(std::max(width, height), 0.92, 1e-6) << elevation;
    EXPECT_NEAR(back.z, std::sin(elevation * kPi / 180.0), 1e-9);
  }
}

TEST(CloudLook, LaysAStripAcrossTheWindow)
{
  for (const bool alongX : { true, false })
  {
    const std::vector<Vec3> points = alongX ? hills(400, 50) : hills(50, 400);
    const CloudLook look = cloudLook(CloudKind::Terrain, viewOf(points), measured(points), {});
    const CameraFit fit = fitCamera(viewOf(points), look, AffineTransform(), 1.6);
    const Vec3 ahead = normalized(fit.focalPoint - fit.position);
    EXPECT_LT(std::abs(alongX ? ahead.x : ahead.y), 0.3);
    EXPECT_NEAR(std::asin(-ahead.z) * 180.0 / kPi, 55.0, 0.1);
  }
}

TEST(CloudLook, LooksAtTheFacesOfWalls)
{
  // The only wall is in the direction of +x: it looks towards -x, and there the viewer stands.
  std::vector<Vec3> points;
  for (int i = 0; i < 2500; ++i)
  {
    points.emplace_back(5.0, 0.1 * (i % 50) - 2.5, 0.1 * (i / 50) - 2.5);
  }
  const CloudLook look = cloudLook(CloudKind::Indoors, viewOf(points), measured(points), {});
  EXPECT_LT(look.front.x, -0.99);
  EXPECT_TRUE(look.hidesBackFaces);
  EXPECT_FALSE(cloudLook(CloudKind::Sweep, viewOf(points), measured(points), {}).hidesBackFaces);
}

TEST(CloudLook, SeesAFrameFromItsSensor)
{
  std::vector<Vec3> points;
  for (int row = 0; row < 60; ++row)
  {
    for (int column = 0; column < 80; ++column)
    {
      const double z = 2.0 + 0.01 * column;
      points.emplace_back(z * 0.01 * (column - 20), z * 0.01 * (row - 30), z);
    }
  }
  CloudOrientation camera;
  camera.up = { 0, -1, 0 };
  camera.fromSensor = true;
  LocalShape shape = measured(points);
  const CloudLook look = cloudLook(CloudKind::Frame, viewOf(points), shape, camera);
  const CameraFit fit = fitCamera(viewOf(points), look, AffineTransform::translation({ 1, 2, 3 }), 1.6);
  EXPECT_NEAR(norm(fit.position - Vec3(1, 2, 3)), 0.0, 1e-12);
  EXPECT_NEAR(fit.viewAngle, 2.0 * std::atan(0.3) * 180.0 / kPi, 1.5);
  spaceByRays(viewOf(points), shape);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    EXPECT_NEAR(double(shape.points[i].spacing), 0.01 * points[i].z, 1e-6);
  }
}

class Colors : public ::testing::Test
{
protected:
  void use(const std::vector<Vec3>& points)
  {
    vtkNew<vtkPoints> positions;
    positions->SetDataTypeToDouble();
    for (const Vec3& p : points)
    {
      positions->InsertNextPoint(p.x, p.y, p.z);
    }
    cloud_->SetPoints(positions);
    query_.build(viewOf(points));
    EXPECT_EQ(measureLocalShape(viewOf(points), query_, {}, shape_), Status::Ok);
  }
  void add(const char* name, const std::function<double(Vec3)>& value)
  {
    vtkNew<vtkFloatArray> array;
    array->SetName(name);
    for (vtkIdType i = 0; i < cloud_->GetNumberOfPoints(); ++i)
    {
      Vec3 p;
      cloud_->GetPoint(i, &p.x);
      array->InsertNextValue(float(value(p)));
    }
    cloud_->GetPointData()->AddArray(array);
  }
  void addRgb(int range)
  {
    vtkNew<vtkUnsignedCharArray> rgb;
    rgb->SetName("RGB");
    rgb->SetNumberOfComponents(3);
    for (vtkIdType i = 0; i < cloud_->GetNumberOfPoints(); ++i)
    {
      const auto value = static_cast<unsigned char>(range * i / cloud_->GetNumberOfPoints());
      rgb->InsertNextTuple3(value, 100, 100);
    }
    cloud_->GetPointData()->SetScalars(rgb);
  }
  CloudColors chosen(CloudKind kind)
  {
    CloudLook look;
    look.kind = kind;
    look.hasOwnLight = kind == CloudKind::Frame;
    return chooseColors(cloud_, query_, shape_, look);
  }

  vtkNew<vtkPolyData> cloud_;
  NeighborQuery query_;
  LocalShape shape_;
};

TEST_F(Colors, AreItsOwnWhereTheyDiffer)
{
  use(ball(3000));
  addRgb(200);
  EXPECT_EQ(chosen(CloudKind::Object).rule, ColorRule::Rgb);
  EXPECT_EQ(chosen(CloudKind::Frame).lightStrength, 0.0);
  addRgb(10);
  EXPECT_EQ(chosen(CloudKind::Object).rule, ColorRule::Clay);
}

TEST_F(Colors, AreClayForAStatueAndHeightForTerrain)
{
  use(ball(3000));
  EXPECT_EQ(chosen(CloudKind::Object).rule, ColorRule::Clay);
  EXPECT_EQ(chosen(CloudKind::Terrain).rule, ColorRule::Height);
  EXPECT_EQ(chosen(CloudKind::Frame).rule, ColorRule::Depth);
}

TEST_F(Colors, AreClayForAPlateWhoseHeightsAreNoise)
{
  for (const double noise : { 0.0, 0.3, 10.0 })
  {
    std::vector<Vec3> plate = hills(100, 90); // about a point a square unit
    Random random;
    for (Vec3& p : plate)
    {
      p.z = 100.0 + random.between(-noise, noise);
    }
    use(plate);
    EXPECT_EQ(chosen(CloudKind::Terrain).rule, noise < 1.0 ? ColorRule::Clay : ColorRule::Height) << noise;
  }
  std::vector<Vec3> waves = hills(100, 90); // lower than points are apart, and no noise
  for (Vec3& p : waves)
  {
    p.z = 100.0 + 0.3 * std::sin(0.1 * p.x);
  }
  use(waves);
  EXPECT_EQ(chosen(CloudKind::Terrain).rule, ColorRule::Height);
}

TEST_F(Colors, AreClassesWhereThereAreThree)
{
  use(hills(100, 90));
  add("Classification", [](const Vec3& p) { return p.x < 500030.0 ? 2.0 : 1.0; });
  EXPECT_EQ(chosen(CloudKind::Terrain).rule, ColorRule::Height) << "one class tells little";
  add("Classification", [](const Vec3& p) { return p.x < 500030.0 ? 2.0 : p.x < 500060.0 ? 5.0 : 6.0; });
  EXPECT_EQ(chosen(CloudKind::Terrain).rule, ColorRule::Classes);
}

TEST_F(Colors, TakeIntensityThatIsAPatternAndNoNoise)
{
  use(hills(100, 90));
  Random random;
  add("Intensity", [&random](const Vec3&) { return random.between(0, 1000); });
  EXPECT_EQ(chosen(CloudKind::Terrain).intensity, "");
  add("Intensity", [](const Vec3& p) { return std::sin(0.1 * p.x) > 0.0 ? 800.0 : 50.0; });
  EXPECT_EQ(chosen(CloudKind::Terrain).intensity, "Intensity");
  EXPECT_EQ(chosen(CloudKind::Object).rule, ColorRule::Height) << "clay would hide it";
  const auto colors = makeColors(cloud_, chosen(CloudKind::Terrain), CloudLook());
  ASSERT_NE(colors, nullptr);
  EXPECT_EQ(colors->GetNumberOfTuples(), cloud_->GetNumberOfPoints());
}

TEST_F(Colors, OfAPlaceStayWhereMorePointsComeIn)
{
  use(hills(100, 90));
  add("Intensity", [](const Vec3& p) { return std::sin(0.1 * p.x) > 0.0 ? 800.0 : 50.0; });
  const CloudColors coarse = chosen(CloudKind::Terrain);
  ASSERT_EQ(coarse.rule, ColorRule::Height);
  const auto before = makeColors(cloud_, coarse, CloudLook());
  // As many points again, high above and dark.
  vtkNew<vtkPolyData> all;
  vtkNew<vtkPoints> points;
  points->SetDataType(cloud_->GetPoints()->GetDataType());
  vtkNew<vtkFloatArray> intensity;
  intensity->SetName("Intensity");
  const vtkIdType count = cloud_->GetNumberOfPoints();
  for (vtkIdType i = 0; i < 2 * count; ++i)
  {
    double p[3];
    cloud_->GetPoint(i % count, p);
    points->InsertNextPoint(p[0], p[1], p[2] + (i < count ? 0.0 : 500.0));
    intensity->InsertNextValue(
      i < count ? float(cloud_->GetPointData()->GetArray("Intensity")->GetComponent(i, 0)) : 1.0F);
  }
  all->SetPoints(points);
  all->GetPointData()->AddArray(intensity);
  const auto after = makeColors(all, coarse, CloudLook());
  for (vtkIdType i = 0; i < 3 * count; ++i)
  {
    ASSERT_EQ(before->GetValue(i), after->GetValue(i)) << i / 3;
  }
}

/// Floaters about a splat or a scan from photographs: the more of them, the nearer they are to each other.
TEST(CloudLook, FollowsTheCoreAmongNearFloaters)
{
  for (const int floaters : { 30, 300, 1000 })
  {
    std::vector<Vec3> points = ball(20000);
    Random random;
    for (int i = 0; i < floaters; ++i)
    {
      points.emplace_back(
        10.0 + random.between(-3, 3), -20.0 + random.between(-3, 3), 3.0 + random.between(-3, 3));
    }
    const CloudLook look = cloudLook(CloudKind::Object, viewOf(points), measured(points), {});
    const CameraFit fit = fitCamera(viewOf(points), look, AffineTransform(), 1.6);
    const Vec3 most = spread(ball(20000), fit, 1.6);
    EXPECT_GT(most.y, 0.82) << floaters;
    EXPECT_LT(most.y, 0.93) << floaters;
  }
}

/// A bush of a few points beside a dense scan is no cloud of floaters.
TEST(CloudLook, ShowsASparsePartBesideADenseOne)
{
  std::vector<Vec3> points = ball(20000);
  const Vec3 middle = points[0];
  Random random;
  const auto normal = [&random]
  {
    double sum = 0.0;
    for (int i = 0; i < 12; ++i)
    {
      sum += random.between(-0.5, 0.5);
    }
    return sum;
  };
  for (int i = 0; i < 1200; ++i)
  {
    points.push_back(middle + Vec3{ 4.0 + 0.8 * normal(), 0.8 * normal(), 0.8 * normal() });
  }
  const CloudLook look = cloudLook(CloudKind::Object, viewOf(points), measured(points), {});
  const auto shown = std::count_if(points.begin() + 20000, points.end(),
    [&look](const Vec3& p) { return look.core.empty() || contains(look.core, p); });
  EXPECT_GT(shown, 1100);
}

TEST(CloudLook, ShowsTheDiscsOfAFewPoints)
{
  const std::vector<Vec3> points = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 0, 1 }, { 1, 0, 1 } };
  CloudLook look;
  look.azimuth = look.elevation = 0.0;
  look.discRadius = 0.3;
  std::vector<Vec3> rims;
  for (const Vec3& p : points)
  {
    for (const double side : { -look.discRadius, look.discRadius })
    {
      rims.push_back(p + Vec3{ side, 0, 0 });
      rims.push_back(p + Vec3{ 0, 0, side });
    }
  }
  for (const double aspect : { 0.5, 1.0, 1.6 })
  {
    const Vec3 most = spread(rims, fitCamera(viewOf(points), look, AffineTransform(), aspect), aspect);
    EXPECT_NEAR(std::max(most.x, most.y), 1.0, 1e-6) << aspect;
  }
}

} // namespace
