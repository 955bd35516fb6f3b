// Surfaces of points have no holes in the pictures of a HapticViewer.
#include "HapticViewerFixture.h"

#include "../Unit/SkipWithoutDisplay.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkPNGReader.h>
#include <vtkPointData.h>

#include <cmath>
#include <random>

using namespace pointhaptics;

namespace
{

/// Pixels in the middle third of the picture, each way, that the black background shows through, and all.
struct Holes
{
  int dark = 0;
  int all = 0;
};

Holes holesOf(const std::string& fileName)
{
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(fileName.c_str());
  reader->Update();
  const int* size = reader->GetOutput()->GetDimensions();
  vtkDataArray* pixels = reader->GetOutput()->GetPointData()->GetScalars();
  Holes holes;
  for (int y = size[1] / 3; y < 2 * size[1] / 3; ++y)
  {
    for (int x = size[0] / 3; x < 2 * size[0] / 3; ++x)
    {
      ++holes.all;
      holes.dark += pixels->GetComponent(vtkIdType(y) * size[0] + x, 0) < 80.0;
    }
  }
  return holes;
}

class ClosedSurfaces : public HapticViewerTest
{
protected:
  ClosedSurfaces()
  {
    options_.width = 400;
    options_.height = 300;
    options_.colorBy = "Clay";
    options_.picture.background = "black";
  }
  Holes holesIn(vtkPolyData* cloud)
  {
    this->save(cloud, "picture.png");
    return holesOf(this->path("picture.png"));
  }
};

/// At random on a square of edge 1 in the plane z = 0.
vtkSmartPointer<vtkPolyData> randomSquare(int count)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-0.5, 0.5);
  vtkNew<vtkPoints> points;
  for (int i = 0; i < count; ++i)
  {
    const double x = place(random);
    points->InsertNextPoint(x, place(random), 0.0);
  }
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->SetPoints(points);
  return cloud;
}

TEST_F(ClosedSurfaces, PointsAtRandomCloseFromAboveAndAtASlant)
{
  SKIP_WITHOUT_DISPLAY();
  options_.up = "z";
  options_.kind = "object";
  // Neighbours are about 1.5 pixels apart.
  for (const double elevation : { 90.0, 35.0, 20.0 })
  {
    const double a = elevation * 3.14159265358979323846 / 180.0;
    const double distance = 0.13; // the square is 10 cm wide in the workspace
    options_.camera = { 0.0, -distance * std::cos(a), distance * std::sin(a), 0, 0, 0, 0, std::sin(a),
      std::cos(a) };
    const Holes holes = holesIn(randomSquare(80000));
    EXPECT_LT(holes.dark, holes.all / 5000) << "of " << holes.all << " pixels at " << elevation << " degrees";
  }
}

/// At random on a ball of radius 1.
vtkSmartPointer<vtkPolyData> randomBall(int count)
{
  std::mt19937 random(4);
  std::normal_distribution<double> place;
  vtkNew<vtkPoints> points;
  for (int i = 0; i < count; ++i)
  {
    const double x = place(random);
    const double y = place(random);
    const Vec3 p = normalized({ x, y, place(random) });
    points->InsertNextPoint(p.x, p.y, p.z);
  }
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->SetPoints(points);
  return cloud;
}

TEST_F(ClosedSurfaces, FewPointsCloseInTheFirstView)
{
  SKIP_WITHOUT_DISPLAY();
  options_.width = 800;
  options_.height = 600;
  const Holes holes = holesIn(randomBall(10000));
  EXPECT_LT(holes.dark, holes.all / 200) << "of " << holes.all << " pixels";
}

TEST_F(ClosedSurfaces, APlaneStaysClosedHoweverNearItIs)
{
  SKIP_WITHOUT_DISPLAY();
  options_.up = "z";
  options_.kind = "object";
  // The square is 10 cm wide, and neighbours are 30 to 400 pixels apart.
  for (const double distance : { 0.04, 0.015, 0.003 })
  {
    for (const double focus : { 0.0, -0.1 }) // the wheel leaves the focal point in the middle of an object
    {
      options_.camera = { 0.003, 0.004, distance, 0.003, 0.004, focus, 0, 1, 0 };
      const Holes holes = holesIn(randomSquare(2000));
      EXPECT_LT(holes.dark, holes.all / 200)
        << "of " << holes.all << " pixels from " << distance << " m, focus at " << focus;
    }
  }
}

/// A wall that turns away to the right, as a camera with so many rays sees it.
vtkSmartPointer<vtkPolyData> slantedWall(int columns, int rows)
{
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, 0.006);
  vtkNew<vtkPoints> points;
  for (int i = 0; i < columns * rows; ++i)
  {
    const double x = (i % columns - 0.5 * columns) / columns;
    const double y = (i / columns - 0.5 * rows) / columns;
    const double z = 2.0 / (1.2 - 2.0 * x) + noise(random); // along z = 1.7 + 1.7 x
    points->InsertNextPoint(x * z, y * z, z);
  }
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->SetPoints(points);
  return cloud;
}

TEST_F(ClosedSurfaces, AFrameOfACameraClosesWhereItsWallsTurnAway)
{
  SKIP_WITHOUT_DISPLAY();
  // Rays are about as far apart as pixels.
  options_.height = 250;
  options_.up = "-y";
  options_.kind = "frame";
  const Holes holes = holesIn(slantedWall(320, 240));
  EXPECT_EQ(holes.dark, 0) << "of " << holes.all << " pixels";
}

} // namespace
