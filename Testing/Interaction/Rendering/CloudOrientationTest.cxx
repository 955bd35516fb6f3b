#include "CloudOrientation.h"

#include "MadeClouds.h"

#include <gtest/gtest.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <array>
#include <cmath>
#include <random>

using namespace pointhaptics;

namespace
{

/// A cloud of two opposite corners and a point that is no number.
vtkSmartPointer<vtkPolyData> makeCloud(const Vec3& minimum, const Vec3& maximum)
{
  return trial::cloudOf({ minimum, { NAN, NAN, NAN }, maximum });
}

void setViewpoint(vtkPolyData* cloud, const double (&values)[7])
{
  vtkNew<vtkDoubleArray> viewpoint;
  viewpoint->SetName("Viewpoint");
  viewpoint->SetNumberOfTuples(7);
  for (int i = 0; i < 7; ++i)
  {
    viewpoint->SetValue(i, values[i]);
  }
  cloud->GetFieldData()->AddArray(viewpoint);
}

TEST(CloudOrientation, StandsAScannedObjectOnItsFloor)
{
  // The bounds of the bunny and of the happy buddha in their PLY files.
  const auto bunny = makeCloud({ -0.095, 0.033, -0.062 }, { 0.061, 0.187, 0.059 });
  const auto buddha = makeCloud({ -0.047, 0.049, -0.048 }, { 0.036, 0.249, 0.035 });
  EXPECT_EQ(guessCloudOrientation(bunny, "PLY (ascii)").up, Vec3(0, 1, 0));
  EXPECT_EQ(guessCloudOrientation(buddha, "ply").up, Vec3(0, 1, 0));
}

TEST(CloudOrientation, StandsASmallObjectOfALaserScannersFormatToo)
{
  const Vec3 low(-0.095, 0.040, -0.062);
  const Vec3 high(0.061, 0.187, 0.059);
  EXPECT_EQ(guessCloudOrientation(makeCloud(low, high), "E57 1.0").up, Vec3(0, 1, 0));
  EXPECT_EQ(guessCloudOrientation(makeCloud(low, high), "LAS").up, Vec3(0, 0, 1));
  // A facade in front of a scanner, a room about it, and an object that stands on z = 0.
  EXPECT_EQ(guessCloudOrientation(makeCloud(100.0 * low, 100.0 * high), "E57 1.0").up, Vec3(0, 0, 1));
  EXPECT_EQ(
    guessCloudOrientation(makeCloud({ -0.5, -0.2, -0.4 }, { 0.5, 0.8, 0.3 }), "E57 1.0").up, Vec3(0, 0, 1));
  EXPECT_EQ(
    guessCloudOrientation(makeCloud({ -0.1, -0.1, 0.0 }, { 0.1, 0.1, 0.2 }), "E57 1.0").up, Vec3(0, 0, 1));
}

TEST(CloudOrientation, LeavesLaserScansWithZUp)
{
  const auto terrain = makeCloud({ 684766, 5017773, 0 }, { 684993, 5018007, 30 });
  const auto street = makeCloud({ -23, -75, -3 }, { 19, 9, 11 });
  const auto lion = makeCloud({ -0.75, -2.8, 2.5 }, { 2.4, 1.5, 7.2 });
  EXPECT_EQ(guessCloudOrientation(terrain, "LAS").up, Vec3(0, 0, 1));
  EXPECT_EQ(guessCloudOrientation(street, "PLY (binary little endian)").up, Vec3(0, 0, 1));
  EXPECT_EQ(guessCloudOrientation(lion, "PLY (binary little endian)").up, Vec3(0, 0, 1));
}

TEST(CloudOrientation, SeesAFrameOfADepthCameraAsTheCameraDid)
{
  const auto frame = makeCloud({ -2.6, -2.2, 1.8 }, { 1.5, 1.6, 5.4 });
  EXPECT_FALSE(guessCloudOrientation(frame, "PCD").fromSensor);
  setViewpoint(frame, { 0, 0, 0, 1, 0, 0, 0 });
  EXPECT_FALSE(guessCloudOrientation(frame, "PCD").fromSensor);
  setViewpoint(frame, { 0, 0, 0, 0, 1, 0, 0 });
  const CloudOrientation orientation = guessCloudOrientation(frame, "PCD");
  EXPECT_TRUE(orientation.fromSensor);
  EXPECT_EQ(orientation.up, Vec3(0, -1, 0));
  EXPECT_EQ(orientation.front, Vec3(0, 0, -1));
}

TEST(CloudOrientation, SeesAFrameBehindTheOriginAgainstZ)
{
  const auto frame = makeCloud({ -2.6, -2.2, -5.4 }, { 1.5, 1.6, -1.8 });
  setViewpoint(frame, { 0, 0, 0, 0, 1, 0, 0 });
  const CloudOrientation orientation = guessCloudOrientation(frame, "PCD");
  EXPECT_TRUE(orientation.fromSensor);
  EXPECT_EQ(orientation.up, Vec3(0, 1, 0));
  EXPECT_EQ(orientation.front, Vec3(0, 0, 1));
}

TEST(CloudOrientation, IgnoresAViewpointOfPointsBehindTheCamera)
{
  const auto room = makeCloud({ -5, -5, -1 }, { 5, 5, 2 });
  setViewpoint(room, { 1, 2, 3, 0, 1, 0, 0 });
  EXPECT_FALSE(guessCloudOrientation(room, "PCD").fromSensor);
}

TEST(CloudOrientation, HasAnAnswerForNothing)
{
  vtkNew<vtkPolyData> empty;
  EXPECT_EQ(guessCloudOrientation(empty, "").up, Vec3(0, 0, 1));
  EXPECT_EQ(guessCloudOrientation(nullptr, "").up, Vec3(0, 0, 1));
}

TEST(CloudOrientation, TurnsTheNamedAxisUp)
{
  for (const char* axis : { "x", "-x", "y", "-y", "z", "-z" })
  {
    const CloudOrientation orientation = orientationForUpAxis(axis);
    const bool isDown = axis[0] == '-';
    const double up = orientation.up[axis[isDown ? 1 : 0] - 'x'];
    EXPECT_EQ(up, isDown ? -1.0 : 1.0) << axis;
  }
}

/// A figure of 1.8 m on its feet: legs, a body, arms and a head, each the surface of an ellipsoid.
vtkSmartPointer<vtkPolyData> makeFigure(const std::array<int, 3>& axes, bool isTurned)
{
  struct Part
  {
    Vec3 middle;
    Vec3 half;
    int count;
  };
  const Part parts[] = { { { -0.1, 0.0, 0.45 }, { 0.08, 0.08, 0.45 }, 3000 },
    { { 0.1, 0.0, 0.45 }, { 0.08, 0.08, 0.45 }, 3000 }, { { -0.1, -0.06, 0.03 }, { 0.05, 0.13, 0.03 }, 500 },
    { { 0.1, -0.06, 0.03 }, { 0.05, 0.13, 0.03 }, 500 }, { { 0.0, 0.0, 1.15 }, { 0.2, 0.12, 0.32 }, 5000 },
    { { 0.0, 0.0, 1.62 }, { 0.09, 0.1, 0.13 }, 1500 }, { { -0.26, 0.0, 1.1 }, { 0.06, 0.06, 0.33 }, 1500 },
    { { 0.26, 0.0, 1.1 }, { 0.06, 0.06, 0.33 }, 1500 } };
  std::vector<Vec3> points;
  for (const Part& part : parts)
  {
    for (int i = 0; i < part.count; ++i)
    {
      const double z = 1.0 - (2.0 * i + 1.0) / part.count;
      const double ring = std::sqrt(1.0 - z * z);
      const Vec3 p = part.middle +
        Vec3{ part.half.x * ring * std::cos(2.4 * i), part.half.y * ring * std::sin(2.4 * i),
          part.half.z * z };
      const double height = isTurned ? -p.z : p.z;
      points.emplace_back(Vec3{ p.x, p.y, height }[axes[0]], Vec3{ p.x, p.y, height }[axes[1]],
        Vec3{ p.x, p.y, height }[axes[2]]);
    }
  }
  return trial::cloudOf(points, VTK_FLOAT);
}

/// Floor, ceiling and walls of 6 by 2.6 by 4 m, y down, with a table on the floor, about a camera.
vtkSmartPointer<vtkPolyData> makeRoom()
{
  std::mt19937 random(1);
  const auto from = [&random](double low, double high)
  { return std::uniform_real_distribution<>(low, high)(random); };
  std::vector<Vec3> points;
  for (int i = 0; i < 4000; ++i)
  {
    points.emplace_back(from(-3, 3), i % 2 ? 1.4 : -1.2, from(-2, 2));
    points.emplace_back(i % 2 ? 3.0 : -3.0, from(-1.2, 1.4), from(-2, 2));
    points.emplace_back(from(-3, 3), from(-1.2, 1.4), i % 2 ? 2.0 : -2.0);
    points.emplace_back(from(-2, 0), 0.65, from(-1, 1));
  }
  return trial::cloudOf(points, VTK_FLOAT);
}

TEST(CloudOrientation, StandsAFigureOnItsFeetWhereverItsHeadIs)
{
  const CloudOrientation usual = guessCloudOrientation(makeFigure({ 0, 1, 2 }, false), "pcd");
  EXPECT_EQ(usual.up, Vec3(0, 0, 1));
  EXPECT_FALSE(usual.isGuess);
  const CloudOrientation tall = guessCloudOrientation(makeFigure({ 0, 2, 1 }, false), "pcd");
  EXPECT_EQ(tall.up, Vec3(0, 1, 0)) << "y up in a format of z up";
  EXPECT_TRUE(tall.isGuess);
  EXPECT_EQ(guessCloudOrientation(makeFigure({ 0, 2, 1 }, true), "ply").up, Vec3(0, -1, 0)) << "y down";
  EXPECT_EQ(guessCloudOrientation(makeFigure({ 2, 1, 0 }, false), "xyz").up, Vec3(1, 0, 0)) << "it lies";
  EXPECT_EQ(guessCloudOrientation(makeFigure({ 0, 2, 1 }, false), "LAS").up, Vec3(0, 0, 1));
}

TEST(CloudOrientation, FindsTheFloorOfARoomInTheFrameOfACamera)
{
  const CloudOrientation orientation = guessCloudOrientation(makeRoom(), "ply");
  EXPECT_EQ(orientation.up, Vec3(0, -1, 0));
  EXPECT_TRUE(orientation.isGuess);
  EXPECT_FALSE(orientation.fromSensor);
}

TEST(CloudOrientation, NamesTheAxisThatPointsUp)
{
  for (const char* axis : { "x", "-x", "y", "-y", "z", "-z" })
  {
    EXPECT_EQ(axisName(orientationForUpAxis(axis).up), axis);
  }
}

} // namespace
