// Hand mode before anything is touched.
#include "CloudAppearance.h"
#include "HandDistance.h"
#include "InteractorStyleFixture.h"
#include "SteadyHand.h"
#include "vtkHapticOverlay.h"
#include "vtkHapticProps.h"
#include "vtkSplatMapper.h"

#include "Haptics/Proxy.h"

#include <gtest/gtest.h>
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCommand.h>

#include <string>

using namespace pointhaptics;

namespace
{

/// The cloud is the plane z = 0; the person looks along -z.
class HandMode : public InteractorStyleFixture
{
protected:
  void SetUp() override
  {
    InteractorStyleFixture::SetUp();
    if (IsSkipped())
    {
      return;
    }
    style_->SetDevice(&device_);
    device_.setTarget({ 0.04, 0.04, 0.045 });
  }
  void TearDown() override { style_->SetDevice(nullptr); }

  ProxyState freeAt(const Vec3& hip) const
  {
    ProxyState state;
    state.hip = hip;
    return state;
  }

  SimulatedDevice device_;
};

TEST_F(HandMode, BeginsAboveTheSurfaceUnderThePointer)
{
  interactor_->SetEventInformation(110, 95, 0, 0);
  this->press("f");
  EXPECT_LT(std::abs(device_.target().x), 0.02);
  EXPECT_LT(std::abs(device_.target().y), 0.02);
  EXPECT_NEAR(device_.target().z, 0.001, 1e-4); // 1 % of the workspace
  this->press("f");
  EXPECT_NEAR(device_.target().z, 0.001, 1e-4) << "it stays where it was when the mode ends";
}

TEST_F(HandMode, LeavesTheHandWhereNothingIsUnderThePointer)
{
  interactor_->SetEventInformation(2, 2, 0, 0);
  this->press("f");
  EXPECT_DOUBLE_EQ(device_.target().x, 0.04);
  EXPECT_DOUBLE_EQ(device_.target().z, 0.045);
}

TEST_F(HandMode, ArrowKeysMoveTheHandAndWithoutItTheModel)
{
  interactor_->SetEventInformation(2, 2, 0, 0);
  device_.setTarget({ 0, 0, 0.02 });
  this->press("Right");
  EXPECT_GT(this->element(0, 3), 0.0);
  EXPECT_DOUBLE_EQ(device_.target().x, 0.0);
  style_->GetModel().reset();
  this->press("f");
  this->press("Right");
  EXPECT_GT(device_.target().x, 0.0);
  this->press("Down");
  EXPECT_LT(device_.target().y, 0.0);
  this->press("Prior");
  EXPECT_LT(device_.target().z, 0.02);
  EXPECT_TRUE(this->modelIsIdentity());
}

TEST_F(HandMode, KnowsHowFarTheCloudIsAndWhere)
{
  style_->Refresh();
  HandDistance distance(style_->GetScenes());
  EXPECT_FALSE(distance.distance());
  ProxyState state = this->freeAt({ 0.0, 0.0, 0.02 });
  distance.update(&state);
  ASSERT_TRUE(distance.nearest());
  EXPECT_NEAR(*distance.distance(), 0.02, 1e-4);
  EXPECT_EQ(distance.text(style_->GetScreen().axes()), "nearest point 20 mm away: deeper");
  state = this->freeAt({ 0.045, 0.0, -0.013 }); // the plane ends at 0.03
  distance.update(&state);
  EXPECT_EQ(distance.text(style_->GetScreen().axes()), "nearest point 20 mm away: left, nearer to you");
  state.contact = true;
  distance.update(&state);
  EXPECT_EQ(distance.distance(), 0.0);
  EXPECT_EQ(distance.text(style_->GetScreen().axes()), "");
  distance.update(nullptr);
  EXPECT_FALSE(distance.distance());
}

TEST_F(HandMode, SaysTheDistanceAndHowToTouchUntilItWasDone)
{
  pointhaptics::trial::SteadyHand hand({ 0.0, 0.0, 0.03 });
  SimulatedDevice& device = hand.device;
  vtkNew<vtkHapticProps> props;
  vtkNew<vtkHapticOverlay> overlay;
  props->AddTo(renderer_);
  overlay->AddTo(renderer_);
  hand.begin(style_);
  style_->SetProps(props);
  style_->SetOverlay(overlay);
  const auto says = [&](const char* words) { return overlay->GetStatus().find(words) != std::string::npos; };
  interactor_->SetEventInformation(2, 2, 0, 0);
  EXPECT_TRUE(this->eventually([&] { return hand.servo.latest().state.radius > 0.0; }));
  EXPECT_FALSE(says("nearest point")) << "of a hand that nobody moves";
  this->press("f");
  EXPECT_TRUE(this->eventually([&] { return says("nearest point 30 mm away: deeper"); }))
    << overlay->GetStatus();
  EXPECT_TRUE(says("move: mouse    deeper: wheel, Page Up    leave: F")) << overlay->GetStatus();
  double nearest[3];
  EXPECT_TRUE(props->GetNearest(nearest));
  EXPECT_NEAR(nearest[2], 0.0, 1e-4);
  // A step is a part of the way, so it is shorter the nearer the surface is.
  this->press("Prior");
  const double first = 0.03 - device.target().z;
  EXPECT_NEAR(first, 0.005, 1e-9); // the longest
  device.setTarget({ 0.0, 0.0, 0.004 });
  EXPECT_TRUE(this->eventually([&] { return says("nearest point 4 mm away"); })) << overlay->GetStatus();
  this->press("Prior");
  EXPECT_NEAR(0.004 - device.target().z, 0.0012, 1e-4);
  device.setTarget({ 0.0, 0.0, -0.002 });
  EXPECT_TRUE(this->eventually([&] { return says("in contact") && !says("move: mouse"); }))
    << overlay->GetStatus();
  EXPECT_FALSE(says("nearest point"));
  EXPECT_FALSE(props->GetNearest(nearest));
}

TEST_F(HandMode, AClickWithCtrlBringsTheHandToTheSurfaceAndADragTakesHoldOfIt)
{
  this->drag(vtkCommand::LeftButtonPressEvent, vtkCommand::LeftButtonReleaseEvent, 0, 0, true, false);
  EXPECT_NEAR(device_.target().x, 0.0, 1e-3);
  EXPECT_NEAR(device_.target().z, 0.001, 1e-4);
  device_.setTarget({ 0.0, 0.0, -0.002 });
  this->drag(vtkCommand::LeftButtonPressEvent, vtkCommand::LeftButtonReleaseEvent, 10, 0, true, false);
  EXPECT_GT(device_.target().x, 0.002);
  EXPECT_NEAR(device_.target().z, -0.002, 1e-9) << "a hand that is under the pointer is dragged on";
}

/// Seen from the side, what slides along the view plane leaves the surface or digs into it.
/// Hand mode and a drag with Ctrl hold the press both.
class HandThatPresses
  : public HandMode
  , public ::testing::WithParamInterface<bool>
{
};

TEST_P(HandThatPresses, TouchesAfterTwoStepsOfTheWheelAndHoldsHowDeepItPresses)
{
  const int control = this->GetParam() ? 1 : 0;
  window_->SetSize(800, 800);
  vtkNew<vtkSplatMapper> mapper;
  mapper->SetInputConnection(resampler_->GetOutputPort());
  mapper->SetFixedPixels(5.0);
  vtkNew<vtkActor> cloud;
  cloud->SetMapper(mapper);
  renderer_->AddActor(cloud);
  applyDepthShading(renderer_);
  renderer_->GetActiveCamera()->Azimuth(35.0);
  renderer_->ResetCameraClippingRange();
  window_->Render();
  pointhaptics::trial::SteadyHand hand({ 0.0, 0.0, 0.03 });
  hand.begin(style_);
  interactor_->SetEventInformation(400, 400, control, 0);
  ASSERT_TRUE(this->eventually(
    [&] { return hand.servo.latest().state.radius > 0.0 && style_->GetScenes().isSettled(); }));
  ASSERT_TRUE(style_->GetPicker().surfaceAt(400, 400));
  if (control)
  {
    interactor_->InvokeEvent(vtkCommand::LeftButtonPressEvent);
  }
  else
  {
    this->press("f");
  }
  const auto isTouching = [&] { return hand.servo.latest().state.contact; };
  const auto height = [&] { return hand.servo.latest().state.hip.z; };
  ASSERT_TRUE(this->eventually([&] { return height() < 0.002; }))
    << hand.device.target().z << " " << height();
  EXPECT_FALSE(isTouching());
  interactor_->InvokeEvent(vtkCommand::MouseWheelForwardEvent);
  ASSERT_TRUE(this->eventually([&] { return height() < 0.0007; }))
    << hand.device.target().z << " " << height();
  interactor_->InvokeEvent(vtkCommand::MouseWheelForwardEvent);
  ASSERT_TRUE(this->eventually(isTouching)) << hand.device.target().z;
  interactor_->InvokeEvent(vtkCommand::MouseWheelForwardEvent); // deeper by a step
  EXPECT_TRUE(this->eventually([&] { return height() < -0.0003; }));
  interactor_->InvokeEvent(vtkCommand::TimerEvent);
  const double press = -hand.device.target().z;
  for (int pixels = 15; pixels <= 75; pixels += 15)
  {
    const double before = hand.device.target().x;
    interactor_->SetEventInformation(400 + pixels, 400, control, 0);
    interactor_->InvokeEvent(vtkCommand::MouseMoveEvent);
    EXPECT_GT(hand.device.target().x, before + 0.0005);
    EXPECT_NEAR(-hand.device.target().z, press, 1e-4) << pixels;
    EXPECT_TRUE(this->eventually([&] { return hand.servo.latest().state.hip.x > before + 0.0005; }));
    EXPECT_TRUE(isTouching()) << pixels;
  }
}

INSTANTIATE_TEST_SUITE_P(ByModeAndByDrag, HandThatPresses, ::testing::Bool());

TEST_F(HandMode, ComesToTheSurfaceOnceTheSceneIsThatOfThePicture)
{
  interactor_->SetEventInformation(110, 95, 0, 0);
  style_->GetModel().scale(1.1);
  ASSERT_TRUE(style_->GetScenes().isChanged());
  this->press("f");
  EXPECT_DOUBLE_EQ(device_.target().z, 0.045);
  ASSERT_TRUE(this->eventually([&] { return style_->GetScenes().isSettled(); }));
  style_->Refresh();
  EXPECT_NEAR(device_.target().z, 0.001, 1e-4);
}

} // namespace
