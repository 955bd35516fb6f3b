#include "SplatLook.h"

#include <gtest/gtest.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

using namespace pointhaptics;

namespace
{

std::vector<Vec3> ofSphere(int count)
{
  std::mt19937_64 engine(12);
  const auto either = [&engine] { return double(engine() >> 11) * 0x1p-52 - 1.0; };
  std::vector<Vec3> points;
  while (int(points.size()) < count)
  {
    const Vec3 p{ either(), either(), either() };
    if (norm(p) < 1.0 && norm(p) > 0.1)
    {
      points.push_back(Vec3(10.0, -20.0, 3.0) + normalized(p));
    }
  }
  return points;
}

/// A Gaussian splat: logarithms of its standard deviations, and its rotation.
struct Splat
{
  double scale[3];
  double turn[4];
};

/// A cloud with the arrays of a file of splats; @p splatOf(i) is that of each point.
template <typename SplatOf>
vtkSmartPointer<vtkPolyData> splatCloud(const std::vector<Vec3>& points, const SplatOf& splatOf)
{
  vtkNew<vtkPoints> places;
  vtkNew<vtkFloatArray> scales;
  scales->SetName("scale");
  scales->SetNumberOfComponents(3);
  vtkNew<vtkFloatArray> turns;
  turns->SetName("rot");
  turns->SetNumberOfComponents(4);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Splat splat = splatOf(i);
    places->InsertNextPoint(&points[i].x);
    scales->InsertNextTuple(splat.scale);
    turns->InsertNextTuple(splat.turn);
  }
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->SetPoints(places);
  cloud->GetPointData()->AddArray(scales);
  cloud->GetPointData()->AddArray(turns);
  return cloud;
}

/// An ellipsoid flat across x, turned by 90 degrees about y: it is flat across z.
TEST(SplatLook, TakesSizeAndTiltOfGaussianSplats)
{
  const std::vector<Vec3> points = ofSphere(3000);
  const auto cloud = splatCloud(points,
    [](std::size_t i)
    {
      const double size = i == 0 ? 5.0 : 0.05;
      return Splat{ { std::log(0.001), std::log(size), std::log(2.0 * size) },
        { 2.0, 0.0, 2.0, 0.0 } }; // of any length
    });
  vtkNew<vtkFloatArray> logits;
  logits->SetName("opacity");
  logits->SetNumberOfTuples(cloud->GetNumberOfPoints());
  logits->Fill(2.0);
  logits->SetValue(9, -1.0F);
  cloud->GetPointData()->AddArray(logits);
  MeasuredCloud measured;
  ASSERT_TRUE(
    measureCloud(PointView(points.data(), std::int64_t(points.size())), {}, std::nullopt, measured));
  takeOwnShapes(cloud, {}, measured);
  EXPECT_TRUE(measured.look.closesAll);
  EXPECT_TRUE(measured.look.hasOwnLight) << "its colours have the light of its pictures";
  addSplats(cloud, measured);
  vtkDataArray* lengths = cloud->GetPointData()->GetArray(kSplatLengthName);
  EXPECT_NEAR(lengths->GetComponent(7, 0), 2.0 * 1.5 * 0.05 * std::sqrt(2.0), 1e-6);
  EXPECT_LT(lengths->GetComponent(0, 0), 1.0) << "no splat covers what is beside its neighbours";
  EXPECT_LT(lengths->GetComponent(9, 0), 0.9 * lengths->GetComponent(7, 0)) << "a faint one is a point";
  double normal[3];
  cloud->GetPointData()->GetArray(kSplatNormalName)->GetTuple(7, normal);
  EXPECT_NEAR(std::abs(normal[2]) / kSplatNormalUnit, 0.98, 1e-3);
  EXPECT_NEAR(normal[0], 0.0, 2.0);
  addDensity(cloud);
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); i += 100)
  {
    const double spacing = double(measured.shape.points[std::size_t(i)].spacing);
    EXPECT_NEAR(
      cloud->GetPointData()->GetArray("Density")->GetComponent(i, 0) * spacing * spacing, 1.0, 1e-3);
  }
}

/// Two clouds in one: the second one has neither scales nor rotations.
TEST(SplatLook, KeepsMeasuredShapesOfACloudBesideSplats)
{
  const std::vector<Vec3> points = ofSphere(3000);
  const std::size_t splats = 1000;
  const auto both = splatCloud(points,
    [](std::size_t i)
    {
      const double none = i % 2 ? 0.0 : double(NAN);
      return i < splats ? Splat{ { std::log(0.001), std::log(0.05), std::log(0.1) }, { 1.0, 0.0, 1.0, 0.0 } }
                        : Splat{ { none, none, none }, { none, none, none, none } };
    });
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(both->GetPoints());
  MeasuredCloud plain;
  ASSERT_TRUE(measureCloud(PointView(points.data(), std::int64_t(points.size())), {}, std::nullopt, plain));
  MeasuredCloud joined;
  ASSERT_TRUE(measureCloud(PointView(points.data(), std::int64_t(points.size())), {}, std::nullopt, joined));
  addSplats(cloud, plain);
  takeOwnShapes(both, {}, joined);
  EXPECT_FALSE(joined.look.hasOwnLight) << "most points are no splats";
  addSplats(both, joined);
  for (const char* name : { kSplatLengthName, kSplatNormalName })
  {
    vtkDataArray* expected = cloud->GetPointData()->GetArray(name);
    vtkDataArray* actual = both->GetPointData()->GetArray(name);
    for (auto i = vtkIdType(splats); i < vtkIdType(points.size()); ++i)
    {
      ASSERT_EQ(actual->GetComponent(i, 0), expected->GetComponent(i, 0)) << name << " of " << i;
    }
  }
}

} // namespace
