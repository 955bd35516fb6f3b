// Picking in pictures for two eyes: needs a window, skips itself without a display.
#include "PointPicking.h"
#include "ScreenMarks.h"

#include "Unit/SkipWithoutDisplay.h"

#include <gtest/gtest.h>
#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <cmath>

using namespace pointhaptics;

namespace
{

/// Two points at unlike depths, seen by two eyes.
class PickingInStereo : public ::testing::TestWithParam<int>
{
protected:
  void SetUp() override
  {
    SKIP_WITHOUT_DISPLAY();
    vtkNew<vtkPoints> points;
    points->InsertNextPoint(0.01, 0.0, -0.3);
    points->InsertNextPoint(-0.01, 0.005, 0.1);
    cloud_->SetPoints(points);
    window_->SetOffScreenRendering(1);
    window_->SetSize(400, 200);
    window_->AddRenderer(renderer_);
    vtkCamera* camera = renderer_->GetActiveCamera();
    camera->SetPosition(0, 0, 0.4);
    camera->SetFocalPoint(0, 0, 0);
    camera->SetClippingRange(0.1, 1.0);
    camera->SetEyeAngle(8.0);
    window_->SetStereoType(GetParam());
    window_->StereoRenderOn();
    window_->Render();
  }
  /// Pixels of the whole picture of an eye.
  Pixel placeOf(const Vec3& point, bool isLeft)
  {
    renderer_->GetActiveCamera()->SetLeftEye(isLeft);
    return ScreenProjection(renderer_)(point);
  }
  bool picks(vtkIdType index, double x, double y)
  {
    PickedPoint picked;
    return pickPoint(cloud_, renderer_, x, y, 3.0, picked) && picked.index == index;
  }
  Vec3 point(vtkIdType index)
  {
    Vec3 p;
    cloud_->GetPoint(index, &p.x);
    return p;
  }

  vtkNew<vtkPolyData> cloud_;
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkRenderWindow> window_;
};

TEST_P(PickingInStereo, TakesWhatIsUnderThePointer)
{
  for (vtkIdType i = 0; i < 2; ++i)
  {
    const Pixel left = placeOf(point(i), true);
    const Pixel right = placeOf(point(i), false);
    ASSERT_GT(std::abs(left.x - right.x), 10.0) << "the parallax would not tell";
    if (GetParam() == VTK_STEREO_SPLITVIEWPORT_HORIZONTAL)
    {
      EXPECT_TRUE(picks(i, 0.5 * left.x, left.y)) << i;
      EXPECT_TRUE(picks(i, 200.0 + 0.5 * right.x, left.y)) << i;
      EXPECT_FALSE(picks(i, left.x, left.y)) << i;
    }
    else
    {
      EXPECT_TRUE(picks(i, 0.5 * (left.x + right.x), left.y)) << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
  Kinds, PickingInStereo, ::testing::Values(VTK_STEREO_ANAGLYPH, VTK_STEREO_SPLITVIEWPORT_HORIZONTAL));

} // namespace
