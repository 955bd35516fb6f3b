#include "CloudOrientation.h"

#include <gtest/gtest.h>
#include <vtkCamera.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <cmath>

using namespace pointhaptics;

namespace
{

/// A cloud of two opposite corners and a point that is no number.
vtkSmartPointer<vtkPolyData> makeCloud(const Vec3& minimum, const Vec3& maximum)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->InsertNextPoint(minimum.x, minimum.y, minimum.z);
  points->InsertNextPoint(NAN, NAN, NAN);
  points->InsertNextPoint(maximum.x, maximum.y, maximum.z);
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->SetPoints(points);
  return cloud;
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

TEST(CloudOrientation, PlacesTheCameraInFrontOfTheWorkspace)
{
  vtkNew<vtkCamera> camera;
  for (const char* axis : { "x", "-x", "y", "-y", "z", "-z" })
  {
    const CloudOrientation orientation = orientationForUpAxis(axis);
    placeCamera(camera, orientation, { 1, 2, 3 }, 0.1, 0.0, 0.0);
    Vec3 forward;
    camera->GetDirectionOfProjection(&forward.x);
    EXPECT_NEAR(dot(forward, orientation.front), -1.0, 1e-12) << axis;
    EXPECT_GT(camera->GetDistance(), 0.1) << axis;
    const bool isDown = axis[0] == '-';
    const double up = orientation.up[axis[isDown ? 1 : 0] - 'x'];
    EXPECT_EQ(up, isDown ? -1.0 : 1.0) << axis;
  }
}

} // namespace
