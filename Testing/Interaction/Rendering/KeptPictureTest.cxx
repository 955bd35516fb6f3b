// A cloud at rest is drawn once, however a hand moves over it: needs a window, skips itself without a
// display.
#include "CloudAppearance.h"
#include "LevelOfDetail.h"
#include "vtkDepthShadingPass.h"
#include "vtkHapticProps.h"
#include "vtkSplatMapper.h"

#include "OffscreenWindow.h"
#include "Unit/SkipWithoutDisplay.h"

#include <gtest/gtest.h>
#include <vtkActor.h>
#include <vtkCallbackCommand.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

using namespace pointhaptics;

namespace
{

constexpr int kSize = 400;
/// Pixels that the marks of a touch reach from the hand.
constexpr int kReach = 110;

/// A square of 8 cm that faces the viewer at z = 0, of discs that close it.
vtkSmartPointer<vtkPolyData> makeWall()
{
  constexpr int kSteps = 80;
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> lengths;
  lengths->SetName("Bandwidth");
  vtkNew<vtkFloatArray> normals;
  normals->SetName("SurfaceNormal");
  normals->SetNumberOfComponents(3);
  for (int i = 0; i < kSteps * kSteps; ++i)
  {
    points->InsertNextPoint(
      0.001 * (i % kSteps - kSteps / 2), 0.001 * (i / kSteps - kSteps / 2), 0.0002 * (i % 3));
    lengths->InsertNextValue(0.002f);
    normals->InsertNextTuple3(0.0, 0.0, 1.0);
  }
  auto wall = vtkSmartPointer<vtkPolyData>::New();
  wall->SetPoints(points);
  wall->GetPointData()->AddArray(lengths);
  wall->GetPointData()->AddArray(normals);
  addHeightArray(wall, { 0, 1, 0 });
  return wall;
}

class KeptPicture
  : public ::testing::Test
  , protected OffscreenWindow
{
protected:
  KeptPicture()
    : OffscreenWindow(kSize, kSize)
  {
  }
  void SetUp() override
  {
    SKIP_WITHOUT_DISPLAY();
    vtkNew<vtkSplatMapper> splats;
    const vtkSmartPointer<vtkPolyData> wall = makeWall();
    splats->SetInputData(wall);
    applyCloudAppearance(wall, splats, actor_);
    splats->Settings().sizeScale = 1.0;
    splats->Settings().ambientLight = true;
    splats->Settings().surfaces = true;
    actor_->SetMapper(splats);
    renderer->AddActor(actor_);
    applyBackground(renderer);
    applyDepthShading(renderer);
    props_->AddTo(renderer);
    marker_.addTo(renderer);
    props_->GetWorkspaceActor()->VisibilityOff();
    props_->SetSmallestSphereRadius(0.002);
    detail_.setEnabled(true);
    begin_->SetClientData(this);
    begin_->SetCallback(
      [](vtkObject*, unsigned long, void* self, void*) { static_cast<KeptPicture*>(self)->beginFrame(); });
    renderer->AddObserver(vtkCommand::StartEvent, begin_);
    for (int frame = 0; frame < 4; ++frame)
    {
      this->picture();
    }
  }
  void TearDown() override { renderer->RemoveObserver(begin_); }

  void beginFrame()
  {
    detail_.beginFrame(now_);
    this->pass()->SetBlendsSplats(detail_.isFinest());
  }
  vtkDepthShadingPass* pass() { return vtkDepthShadingPass::GetPassOf(renderer); }

  /// A second later.
  std::vector<unsigned char> picture()
  {
    now_ += 1.0;
    renderer->ResetCameraClippingRange();
    return OffscreenWindow::picture();
  }

  /// The picture where a hand at @p x, @p y presses with its HIP at @p z.
  std::vector<unsigned char> touched(double x, double y, double z)
  {
    ProxyState state;
    state.contact = true;
    state.hip = { x, y, z };
    state.proxy = { x, y, 0.0 };
    state.sphereCenter = { x, y, 0.002 };
    state.radius = 0.002;
    state.normal = { 0, 0, 1 };
    state.force = { 0, 0, -800.0 * z };
    props_->Update(state);
    return this->picture();
  }

  double now_ = 100.0;
  vtkNew<vtkActor> actor_;
  vtkNew<vtkHapticProps> props_;
  PickMarker marker_;
  vtkNew<vtkCallbackCommand> begin_;
  LevelOfDetail detail_{ renderer, actor_ };
};

std::array<int, 3> pixel(const std::vector<unsigned char>& picture, int x, int y)
{
  const std::size_t at = 3 * std::size_t(y * kSize + x);
  return { picture[at], picture[at + 1], picture[at + 2] };
}

TEST_F(KeptPicture, OfACloudAtRestIsNotDrawnAgainWhereAHandMovesOverIt)
{
  ASSERT_TRUE(detail_.isFinest());
  const std::vector<unsigned char> bare = this->picture();
  const auto drawn = this->pass()->GetNumberOfPictures();
  for (const double x : { -0.012, -0.004, 0.004, 0.3 }) // the last one is out of view, and out of the range
  {
    const std::vector<unsigned char> picture = this->touched(x, 0.0, -0.003);
    EXPECT_TRUE(detail_.isFinest());
    EXPECT_NE(x < 0.1, picture == bare);
    const int middle = kSize / 2 + int(x / 0.0536 * kSize / 2); // the picture is 10.7 cm wide
    for (int y = 0; y < kSize; ++y)
    {
      for (int column = 0; column < kSize; ++column)
      {
        const bool isNear = std::abs(column - middle) < kReach && std::abs(y - kSize / 2) < kReach;
        ASSERT_TRUE(isNear || pixel(picture, column, y) == pixel(bare, column, y)) << column << ", " << y;
      }
    }
  }
  const double place[3] = { 0.01, 0.01, 0.0 };
  marker_.mark({ place[0], place[1], place[2] }, std::nullopt, 0.004);
  EXPECT_NE(this->picture(), bare);
  marker_.hide();
  props_->HideTouch();
  EXPECT_EQ(this->picture(), bare);
  EXPECT_EQ(this->pass()->GetNumberOfPictures(), drawn);
}

TEST_F(KeptPicture, HidesMarksThatLieBehindTheCloud)
{
  props_->HideTouch();
  const std::array<int, 3> wall = pixel(this->picture(), kSize / 2, kSize / 2);
  const auto distance = [&wall](const std::array<int, 3>& color)
  { return std::abs(color[0] - wall[0]) + std::abs(color[1] - wall[1]) + std::abs(color[2] - wall[2]); };
  ProxyState state;
  state.radius = 0.0; // no sphere
  state.hip = state.sphereCenter = { 0.0, 0.0, 0.01 };
  props_->Update(state);
  const int seen = distance(pixel(this->picture(), kSize / 2, kSize / 2));
  state.hip = state.sphereCenter = { 0.0, 0.0, -0.01 };
  props_->Update(state);
  const int hidden = distance(pixel(this->picture(), kSize / 2, kSize / 2));
  EXPECT_GT(hidden, 10) << "seen faintly";
  EXPECT_LT(hidden, 3 * seen / 4);
}

} // namespace
