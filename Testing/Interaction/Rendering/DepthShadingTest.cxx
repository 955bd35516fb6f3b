// Pixels that the shading by depth darkens: needs a window, skips itself without a display.
#include "CloudAppearance.h"
#include "vtkCloudAxes.h"
#include "vtkDepthShadingPass.h"

#include "OffscreenWindow.h"
#include "Unit/SkipWithoutDisplay.h"

#include <gtest/gtest.h>
#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include <algorithm>
#include <vector>

using namespace pointhaptics;

namespace
{
constexpr int kShadedSize = 100;
constexpr double kStep = 0.001;

/// A white wall, and 1 mm in front of its left half another one.
class DepthShading
  : public ::testing::Test
  , protected OffscreenWindow
{
protected:
  DepthShading()
    : OffscreenWindow(kShadedSize, kShadedSize)
  {
  }
  void SetUp() override
  {
    SKIP_WITHOUT_DISPLAY();
    addWall(-0.02, 0.02, 0.0);
    addWall(-0.02, 0.0, kStep);
    renderer->GetActiveCamera()->SetViewAngle(8.0);
    renderer->ResetCameraClippingRange();
  }

  void addWall(double x0, double x1, double z)
  {
    vtkNew<vtkPlaneSource> wall;
    wall->SetOrigin(x0, -0.02, z);
    wall->SetPoint1(x1, -0.02, z);
    wall->SetPoint2(x0, 0.02, z);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(wall->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->LightingOff();
    renderer->AddActor(actor);
  }

  /// Darkest value in the middle row, 0 to 255.
  int darkest(double tolerance)
  {
    applyDepthShading(renderer, tolerance);
    const std::vector<unsigned char> row = this->picture(kShadedSize / 2, kShadedSize / 2);
    return *std::min_element(row.begin(), row.end());
  }

  std::vector<unsigned char> pictureWithin(double nearest, double farthest)
  {
    renderer->GetActiveCamera()->SetClippingRange(nearest, farthest);
    return picture();
  }
};

TEST_F(DepthShading, DarkensAStepThatIsLargerThanTheToleranceOnly)
{
  EXPECT_LT(darkest(0.0), 245);
  EXPECT_EQ(darkest(1.5 * kStep), 255) << "the same pass, another tolerance";
  const int half = darkest(0.1 * kStep);
  EXPECT_LT(half, 255);
  EXPECT_GT(half, darkest(0.0));
}

TEST_F(DepthShading, APictureIsTheSameToTheByteWhateverElseWidensTheClippingRange)
{
  renderer->GetActiveCamera()->Azimuth(40.0); // each pixel has a depth of its own
  applyDepthShading(renderer, 0.1 * kStep);
  const std::vector<unsigned char> first = pictureWithin(0.150, 0.26);
  EXPECT_EQ(pictureWithin(0.150 * (1.0 + 1e-7), 0.26 * (1.0 - 1e-7)), first);
  EXPECT_EQ(pictureWithin(0.155, 0.27), first);
  const double once[2] = { renderer->GetActiveCamera()->GetClippingRange()[0],
    renderer->GetActiveCamera()->GetClippingRange()[1] };
  EXPECT_EQ(pictureWithin(once[0], once[1]), first);
  EXPECT_EQ(renderer->GetActiveCamera()->GetClippingRange()[0], once[0]) << "steps stay where they are";
  EXPECT_EQ(renderer->GetActiveCamera()->GetClippingRange()[1], once[1]);
  EXPECT_LE(once[0], 0.150);
  EXPECT_GE(once[1], 0.27);
}

/// Right of a line that stands in front of the wall: a step of the depth would darken these columns.
TEST_F(DepthShading, TheBoxOfTheAxesDarkensNothingBesideItsLines)
{
  constexpr int kLarge = 300;
  window->SetSize(kLarge, kLarge);
  applyDepthShading(renderer, 0.0);
  constexpr int kRow = 200; // above the directions of the axes, below the texts of the upper edge
  const std::vector<unsigned char> plain = this->picture(kRow, kRow);
  vtkNew<vtkCloudAxes> axes;
  const double bounds[6] = { 0.005, 0.05, -0.05, 0.05, -0.001, 0.01 };
  axes->SetBounds(bounds);
  axes->AddTo(renderer);
  axes->SetVisibility(true);
  const std::vector<unsigned char> crossed = this->picture(kRow, kRow);
  ASSERT_EQ(crossed.size(), plain.size());
  int changed = 0;
  for (std::size_t i = 3 * 198; i < plain.size(); i += 3) // left of it its numbers stand
  {
    changed += plain[i] != crossed[i];
  }
  EXPECT_GT(changed, 0) << "the line is seen";
  EXPECT_LE(changed, 2);
}

} // namespace
