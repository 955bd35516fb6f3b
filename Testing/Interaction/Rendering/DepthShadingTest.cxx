// Pixels that the shading by depth darkens: needs a window, skips itself without a display.
#include "CloudAppearance.h"
#include "vtkCloudAxes.h"
#include "vtkDepthShadingPass.h"

#include "Unit/SkipWithoutDisplay.h"

#include <gtest/gtest.h>
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <vector>

using namespace pointhaptics;

namespace
{
constexpr int kShadedSize = 100;
constexpr double kStep = 0.001;

/// A white wall, and 1 mm in front of its left half another one.
class DepthShading : public ::testing::Test
{
protected:
  void SetUp() override
  {
    SKIP_WITHOUT_DISPLAY();
    addWall(-0.02, 0.02, 0.0);
    addWall(-0.02, 0.0, kStep);
    renderer_->GetActiveCamera()->SetPosition(0, 0, 0.2);
    renderer_->GetActiveCamera()->SetFocalPoint(0, 0, 0);
    renderer_->GetActiveCamera()->SetViewAngle(8.0);
    renderer_->ResetCameraClippingRange();
    window_->SetOffScreenRendering(1);
    window_->SetMultiSamples(0);
    window_->SetSize(kShadedSize, kShadedSize);
    window_->AddRenderer(renderer_);
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
    renderer_->AddActor(actor);
  }

  /// Darkest value in the middle row, 0 to 255.
  int darkest(double tolerance)
  {
    applyDepthShading(renderer_, tolerance);
    window_->Render();
    vtkNew<vtkUnsignedCharArray> row;
    window_->GetPixelData(0, kShadedSize / 2, kShadedSize - 1, kShadedSize / 2, 0, row);
    return *std::min_element(row->GetPointer(0), row->GetPointer(0) + row->GetNumberOfValues());
  }

  std::vector<unsigned char> pictureWithin(double nearest, double farthest)
  {
    renderer_->GetActiveCamera()->SetClippingRange(nearest, farthest);
    return picture();
  }
  std::vector<unsigned char> picture()
  {
    window_->Render();
    vtkNew<vtkUnsignedCharArray> pixels;
    window_->GetPixelData(0, 0, kShadedSize - 1, kShadedSize - 1, 0, pixels);
    return { pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues() };
  }

  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkRenderWindow> window_;
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
  renderer_->GetActiveCamera()->Azimuth(40.0); // each pixel has a depth of its own
  applyDepthShading(renderer_, 0.1 * kStep);
  const std::vector<unsigned char> first = pictureWithin(0.150, 0.26);
  EXPECT_EQ(pictureWithin(0.150 * (1.0 + 1e-7), 0.26 * (1.0 - 1e-7)), first);
  EXPECT_EQ(pictureWithin(0.155, 0.27), first);
  const double once[2] = { renderer_->GetActiveCamera()->GetClippingRange()[0],
    renderer_->GetActiveCamera()->GetClippingRange()[1] };
  EXPECT_EQ(pictureWithin(once[0], once[1]), first);
  EXPECT_EQ(renderer_->GetActiveCamera()->GetClippingRange()[0], once[0]) << "steps stay where they are";
  EXPECT_EQ(renderer_->GetActiveCamera()->GetClippingRange()[1], once[1]);
  EXPECT_LE(once[0], 0.150);
  EXPECT_GE(once[1], 0.27);
}

/// Right of a line that stands in front of the wall: a step of the depth would darken these columns.
TEST_F(DepthShading, TheBoxOfTheAxesDarkensNothingBesideItsLines)
{
  constexpr int kLarge = 300;
  window_->SetSize(kLarge, kLarge);
  applyDepthShading(renderer_, 0.0);
  const auto columnsRightOfTheLine = [this]
  {
    window_->Render();
    vtkNew<vtkUnsignedCharArray> row; // above the directions of the axes, below the texts of the upper edge
    window_->GetPixelData(0, 200, kLarge - 1, 200, 0, row);
    return std::vector<unsigned char>(row->GetPointer(0), row->GetPointer(0) + row->GetNumberOfValues());
  };
  const std::vector<unsigned char> plain = columnsRightOfTheLine();
  vtkNew<vtkCloudAxes> axes;
  const double bounds[6] = { 0.005, 0.05, -0.05, 0.05, -0.001, 0.01 };
  axes->SetBounds(bounds);
  axes->AddTo(renderer_);
  axes->SetVisibility(true);
  const std::vector<unsigned char> crossed = columnsRightOfTheLine();
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
