// The hand holds the model by the buttons of the device: no window, no display.
#include "ClutchFixture.h"
#include "vtkHapticOverlay.h"

#include "Devices/SimulatedDevice.h"

#include <gtest/gtest.h>
#include <vtkNew.h>
#include <vtkRenderWindowInteractor.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <vector>

using namespace pointhaptics;
using namespace pointhaptics::trial;

namespace
{

/// A hand that is exactly where it is told to be, and what was sent to its motors.
class TestHand : public HapticPort
{
public:
  TestHand()
    : device(settings())
  {
    forces.reserve(1u << 18);
    static_cast<void>(device.open());
  }
  Status read(double timeSeconds, HandState& state) noexcept override
  {
    const Status status = device.read(timeSeconds, state);
    return silent ? Status::DeviceSilent : status;
  }
  Status write(double timeSeconds, const Vec3& force) noexcept override
  {
    if (forces.size() < forces.capacity())
    {
      forces.push_back(force);
      written = forces.size();
    }
    return device.write(timeSeconds, force);
  }

  static SimulatedHandSettings settings()
  {
    SimulatedHandSettings settings;
    settings.yieldsToForce = false;
    settings.start = { 0.0, 0.0, 0.02 };
    return settings;
  }
  SimulatedDevice device;
  std::vector<Vec3> forces;              ///< The servo thread's until it stops.
  std::atomic<std::size_t> written{ 0 }; ///< Number of forces written.
  std::atomic<bool> silent{ false };
};

class HandClutch : public ClutchFixture
{
protected:
  HandClutch() { style->SetDevice(&hand.device); }
  ~HandClutch() override { this->letGo(); }
  void begin(double x0, double x1) { ClutchFixture::begin(hand, x0, x1); }
  /// The servo loop has seen both.
  void hold(std::uint32_t buttons)
  {
    hand.device.setButtons(buttons);
    ASSERT_TRUE(eventually([&] { return servo.latest().buttons == buttons; }));
  }
  void moveTo(const Vec3& place)
  {
    hand.device.setTarget(place);
    ASSERT_TRUE(eventually([&] { return servo.latest().state.hip == place; }));
  }

  TestHand hand;
};

TEST_F(HandClutch, ShiftsTheModelByTheWayOfTheHandWhileTheButtonIsDownAndByNoOther)
{
  begin(-0.03, 0.03);
  moveTo({ 0.0, 0.0, 0.03 });
  hold(1);
  moveTo({ 0.010, -0.004, 0.025 });
  style->Refresh();
  EXPECT_EQ(style->GetClutch().hold(), "translate-model-by-hand");
  moveTo({ 0.012, -0.004, 0.025 });
  hold(0);
  moveTo({ 0.04, 0.04, 0.04 }); // before anybody has looked
  settle();
  EXPECT_EQ(style->GetClutch().hold(), "");
  EXPECT_NEAR(element(0, 3), 0.012, 1e-12);
  EXPECT_NEAR(element(1, 3), -0.004, 1e-12);
  EXPECT_NEAR(element(2, 3), -0.005, 1e-12);
  EXPECT_TRUE(style->GetModel().undo());
  EXPECT_EQ(element(0, 3), 0.0) << "the whole hold is one change";
}

TEST_F(HandClutch, RollsTheModelUnderTheHand)
{
  begin(-0.03, 0.03);
  hold(2);
  moveTo({ 0.025, 0.0, 0.02 }); // to the right by the ball's radius
  hold(0);
  settle();
  EXPECT_NEAR(element(0, 0), std::cos(1.0), 1e-9);
  EXPECT_NEAR(element(0, 2), std::sin(1.0), 1e-9) << "what is in front goes with the hand";
  EXPECT_NEAR(element(1, 1), 1.0, 1e-12);
}

TEST_F(HandClutch, ZoomsByPullingAndPushing)
{
  begin(-0.03, 0.03);
  hold(8);
  moveTo({ 0.0, 0.01, 0.045 }); // towards the person
  hold(0);
  settle();
  EXPECT_NEAR(element(0, 0), std::exp(1.0), 1e-9);
  hold(8);
  moveTo({ 0.0, 0.01, 0.02 });
  hold(0);
  settle();
  EXPECT_NEAR(element(0, 0), 1.0, 1e-9);
  EXPECT_NEAR(element(1, 3), 0.0, 1e-9);
}

TEST_F(HandClutch, ReachesTheFarEndOfAMetreFromAWorkspaceOfTenCentimetres)
{
  begin(-0.03, 1.0);
  Vec3 eyeBefore;
  renderer->GetActiveCamera()->GetPosition(&eyeBefore.x);
  for (int stroke = 0; stroke < 12; ++stroke)
  {
    moveTo({ 0.04, 0.0, 0.03 });
    hold(4);
    moveTo({ -0.04, 0.0, 0.03 });
    hold(0);
    style->Refresh();
  }
  settle();
  EXPECT_NEAR(element(0, 3), -0.96, 1e-9);
  Vec3 eye;
  renderer->GetActiveCamera()->GetPosition(&eye.x);
  EXPECT_NEAR(eye.x - eyeBefore.x, -0.96, 1e-9) << "the picture of the model stays where it is";
  moveTo({ 0.03, 0.0, 0.01 }); // 0.99 m from the model's origin
  moveTo({ 0.03, 0.0, -0.002 });
  EXPECT_TRUE(eventually([&] { return servo.latest().state.force.z > 1.5; })) << servo.latest().state.force.z;
  moveTo({ 0.045, 0.0, 0.01 });
  moveTo({ 0.045, 0.0, -0.002 });
  EXPECT_FALSE(servo.latest().state.contact) << "past the end of the strip";
}

TEST_F(HandClutch, TakesTheForceAwayWhileItHoldsAndLetsItComeBackSlowly)
{
  begin(-0.03, 0.03);
  moveTo({ 0.0, 0.0, 0.001 });
  moveTo({ 0.0, 0.0, -0.002 });
  const double whole = 1.6;
  ASSERT_TRUE(eventually([&] { return servo.latest().state.force.z > 0.99 * whole; }));
  hold(1);
  style->Refresh();
  ASSERT_TRUE(eventually([&] { return norm(servo.latest().state.force) == 0.0; }));
  for (int step = 1; step <= 40; ++step) // up and aside, the model with it
  {
    moveTo({ 0.0002 * step, 0.0, -0.002 + 0.0001 * step });
    style->Refresh();
    EXPECT_EQ(norm(servo.latest().state.force), 0.0);
  }
  hold(0);
  const std::size_t release = hand.written;
  settle();
  ASSERT_TRUE(eventually([&] { return servo.latest().state.force.z > 0.98 * whole; }))
    << "the model went with the hand: " << servo.latest().state.force.z;
  servo.stop();
  double largest = 0.0;
  for (std::size_t i = release; i < hand.forces.size(); ++i)
  {
    largest = std::max(largest, norm(hand.forces[i]) - norm(hand.forces[i - 1]));
  }
  EXPECT_GT(largest, 0.0);
  // Beside the ramp itself the proxy settles on the moved surface, by 0.1 N a tick, while the gate is little
  // open.
  EXPECT_LT(largest, 3.0 * whole / (1000.0 * ServoLoop::kClutchUpSeconds));
}

TEST_F(HandClutch, SaysInTheWindowThatTheHandHoldsTheModel)
{
  begin(-0.03, 0.03);
  vtkNew<vtkHapticOverlay> overlay;
  style->SetOverlay(overlay);
  style->GetHand().setFollowsMouse(true);
  style->GetHand().setPushesPointer(true);
  style->Refresh();
  EXPECT_NE(overlay->GetStatus().find("touch pushes it"), std::string::npos) << overlay->GetStatus();
  hold(4);
  style->Refresh();
  EXPECT_NE(overlay->GetStatus().find("the hand holds the model"), std::string::npos) << overlay->GetStatus();
  hold(0);
  settle();
  EXPECT_EQ(overlay->GetStatus().find("holds the model"), std::string::npos) << overlay->GetStatus();
}

TEST_F(HandClutch, LetsGoWhenTheDeviceFallsSilent)
{
  begin(-0.03, 0.03);
  hold(1);
  moveTo({ 0.01, 0.0, 0.02 });
  hand.silent = true;
  ASSERT_TRUE(eventually([&] { return servo.latest().device == Status::DeviceSilent; }));
  hand.device.setTarget({ -0.04, 0.0, 0.02 });
  style->Refresh();
  EXPECT_EQ(style->GetClutch().hold(), "");
  hand.silent = false;
  ASSERT_TRUE(eventually([&] { return servo.latest().device == Status::Ok; }));
  moveTo({ -0.03, 0.0, 0.02 });
  hold(0);
  settle();
  // Nobody knows what the hand did in between.
  EXPECT_NEAR(element(0, 3), 0.01 + 0.01, 1e-9);
}

TEST_F(HandClutch, DoesWhatElseAButtonIsBoundToWhenItIsPressed)
{
  begin(-0.03, 0.03);
  style->GetCommands().bind("scale-up", "hand2");
  hold(2);
  style->Refresh();
  const std::uint64_t then = servo.latest().tick;
  ASSERT_TRUE(eventually([&] { return servo.latest().tick > then + 10; }));
  hand.silent = true;
  ASSERT_TRUE(eventually([&] { return servo.latest().device == Status::DeviceSilent; }));
  hand.silent = false;
  ASSERT_TRUE(eventually([&] { return servo.latest().device == Status::Ok; }));
  hold(0);
  settle();
  EXPECT_NEAR(element(0, 0), 1.1, 1e-9) << "once, however long it is held, also past a moment of silence";
}

TEST_F(HandClutch, HoldsAButtonOfTheSimulatedHandAsLongAsItsKey)
{
  begin(-0.03, 0.03);
  vtkNew<vtkRenderWindowInteractor> interactor;
  interactor->SetInteractorStyle(style);
  const auto key = [&](unsigned long event)
  {
    interactor->SetKeyEventInformation(0, 0, 0, 0, "F1");
    interactor->InvokeEvent(event);
  };
  key(vtkCommand::KeyPressEvent);
  EXPECT_TRUE(eventually([&] { return servo.latest().buttons == 1; }));
  for (int repeat = 0; repeat < 3; ++repeat)
  {
    key(vtkCommand::KeyReleaseEvent);
    const std::uint64_t then = servo.latest().tick;
    EXPECT_TRUE(eventually([&] { return servo.latest().tick > then + 3; }));
    EXPECT_EQ(servo.latest().buttons, 1u) << "the timer decides";
    style->Refresh(); // a timer may come between the two
    key(vtkCommand::KeyPressEvent);
    style->Refresh();
    EXPECT_EQ(style->GetClutch().hold(), "translate-model-by-hand") << "a key that repeats stays down";
  }
  key(vtkCommand::KeyReleaseEvent);
  EXPECT_TRUE(eventually(
    [&]
    {
      style->Refresh();
      return servo.latest().buttons == 0;
    }));
  settle();
  EXPECT_EQ(style->GetClutch().hold(), "");
}

} // namespace
