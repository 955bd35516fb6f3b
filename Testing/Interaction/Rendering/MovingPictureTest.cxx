// Pictures in motion where the processor draws them: fewer pixels, which look alike; needs a window, skips
// itself without a display, and on a graphics card.
#include "CloudAppearance.h"
#include "DrawPace.h"
#include "LevelOfDetail.h"
#include "vtkDepthShadingPass.h"
#include "vtkSplatMapper.h"

#include "OffscreenWindow.h"
#include "Unit/SkipWithoutDisplay.h"

#include <gtest/gtest.h>
#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <cmath>
#include <cstdlib>
#include <vector>

using namespace pointhaptics;

namespace
{

/// Splats apart from each other, and a closed wall before their middle.
class MovingPicture
  : public ::testing::Test
  , protected OffscreenWindow
{
protected:
  static constexpr int kWidth = 1000;
  static constexpr int kHeight = 800;

  MovingPicture()
    : OffscreenWindow(kWidth, kHeight)
  {
  }
  void SetUp() override
  {
    SKIP_WITHOUT_DISPLAY();
    this->addWall(0.04, 0.0, 40);
    this->addWall(0.01, 0.01, 80);
    applyBackground(renderer);
    applyDepthShading(renderer);
    renderer->GetActiveCamera()->SetPosition(0.05, 0.02, 0.25);
    renderer->ResetCameraClippingRange();
    window->Render();
    if (!DrawPace::of(vtkOpenGLRenderWindow::SafeDownCast(window)).isNeeded())
    {
      GTEST_SKIP() << "a graphics card draws all pixels in motion, too";
    }
  }

  void addWall(double half, double z, int steps)
  {
    vtkNew<vtkPlaneSource> source;
    source->SetOrigin(-half, -half, z);
    source->SetPoint1(half, -half, z);
    source->SetPoint2(-half, half, z);
    source->SetResolution(steps, steps);
    source->Update();
    vtkNew<vtkPolyData> cloud;
    cloud->SetPoints(source->GetOutput()->GetPoints());
    addHeightArray(cloud, { 0, 1, 0 });
    vtkNew<vtkSplatMapper> mapper;
    mapper->SetInputData(cloud);
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    applyCloudAppearance(cloud, mapper, actor);
    mapper->SetFixedPixels(5.0);
    renderer->AddActor(actor);
  }

  vtkDepthShadingPass* pass() { return vtkDepthShadingPass::GetPassOf(renderer); }

  std::vector<unsigned char> picture(bool isMoving)
  {
    this->pass()->SetIsMoving(isMoving);
    return OffscreenWindow::picture();
  }
};

double meanDifference(const std::vector<unsigned char>& a, const std::vector<unsigned char>& b)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    sum += std::abs(int(a[i]) - int(b[i]));
  }
  return sum / double(a.size());
}

double mean(const std::vector<unsigned char>& picture)
{
  return meanDifference(picture, std::vector<unsigned char>(picture.size()));
}

TEST_F(MovingPicture, HasFewerPixelsAndLooksAlike)
{
  const std::vector<unsigned char> still = this->picture(false);
  EXPECT_EQ(vtkDepthShadingPass::ResolutionOf(renderer), 1.0);
  const std::vector<unsigned char> moving = this->picture(true);
  const double resolution = vtkDepthShadingPass::ResolutionOf(renderer);
  EXPECT_LE(resolution * resolution * kWidth * kHeight, vtkDepthShadingPass::kMostMovingPixels + 1e-6);
  EXPECT_GT(resolution, 0.7);
  EXPECT_NE(moving, still);
  // Splats as large, shades as dark.
  EXPECT_LT(meanDifference(moving, still), 2.0);
  EXPECT_NEAR(mean(moving), mean(still), 0.1);
  EXPECT_EQ(this->picture(true), moving) << "of the same view";
  EXPECT_EQ(this->picture(false), still) << "at rest all is as before";
}

TEST_F(MovingPicture, IsThatAtRestInASmallWindow)
{
  window->SetSize(640, 480);
  const std::vector<unsigned char> still = this->picture(false);
  EXPECT_EQ(this->picture(true), still);
  EXPECT_EQ(vtkDepthShadingPass::ResolutionOf(renderer), 1.0);
}

TEST_F(MovingPicture, GivesWayToOneOfAllPixelsAtRest)
{
  vtkActor* cloud = vtkActor::SafeDownCast(renderer->GetActors()->GetItemAsObject(0));
  LevelOfDetail detail(renderer, cloud);
  detail.setEnabled(true);
  detail.beginFrame(1.0);
  EXPECT_TRUE(detail.isInMotion()) << "the first frame differs from none";
  detail.beginFrame(1.1);
  EXPECT_TRUE(detail.isInMotion());
  detail.beginFrame(2.0);
  EXPECT_FALSE(detail.isInMotion());
  renderer->GetActiveCamera()->Azimuth(1.0);
  detail.showFinestOnce();
  detail.beginFrame(3.0);
  EXPECT_FALSE(detail.isInMotion()) << "a picture that is kept";
  window->InvokeEvent(vtkCommand::EndEvent); // all eyes of it are drawn
  renderer->GetActiveCamera()->Azimuth(1.0);
  detail.beginFrame(4.0);
  EXPECT_TRUE(detail.isInMotion());
  detail.setEnabled(false);
  detail.beginFrame(4.1);
  EXPECT_FALSE(detail.isInMotion());
}

} // namespace
