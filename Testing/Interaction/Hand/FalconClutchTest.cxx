// The Falcon's own driver, its buttons and its encoders, hold and move the model: no window, no hardware.
#include "ClutchFixture.h"
#include "Unit/Devices/MemoryLink.h"

#include "Devices/Falcon/FalconDevice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>

using namespace pointhaptics;
using namespace pointhaptics::trial;

namespace
{

/// Positions come from encoders: twice their largest step (FalconDevice::limits()).
constexpr double kTwoSteps = 120e-6;
/// Largest way of the person's hand between two commands, metres: the driver takes no answer that jumps.
constexpr double kLargestStep = 1e-3;

/// State of the person; the servo thread reads it at each command.
struct Person
{
  std::mutex mutex;
  Vec3 place{ 0.0, 0.0, 0.02 };
  Vec3 goal = place;
  std::uint8_t buttons = 0;
};

class FalconClutch : public ClutchFixture
{
protected:
  FalconClutch()
  {
    auto model = std::make_shared<FalconModel>();
    model->runs = true;
    const auto onCommand = [this](FalconModel& moved)
    {
      const std::lock_guard<std::mutex> lock(person.mutex);
      const Vec3 way = person.goal - person.place;
      person.place += std::min(1.0, kLargestStep / std::max(norm(way), 1e-12)) * way;
      moved.hand.position = person.place + falcon::kCenter;
      moved.buttons = person.buttons;
      framesWithoutTorque = moved.frozenFrames;
    };
    falcon = std::make_unique<FalconDevice>(
      FalconSettings(), std::make_unique<MemoryBus<>>(std::move(model), onCommand));
  }
  ~FalconClutch() override
  {
    this->letGo();
    falcon->close();
  }
  void begin()
  {
    ASSERT_EQ(falcon->open(), Status::Ok) << falcon->message();
    ClutchFixture::begin(*falcon, -0.03, 0.03);
    ASSERT_TRUE(eventually([&] { return falcon->state() == FalconState::Armed; }));
  }
  void moveTo(const Vec3& place)
  {
    {
      const std::lock_guard<std::mutex> lock(person.mutex);
      person.goal = place;
    }
    ASSERT_TRUE(eventually([&] { return norm(servo.latest().state.hip - place) < kTwoSteps; }));
  }
  void press(int buttons)
  {
    {
      const std::lock_guard<std::mutex> lock(person.mutex);
      person.buttons = std::uint8_t(buttons);
    }
    ASSERT_TRUE(eventually([&] { return servo.latest().buttons == std::uint32_t(buttons); }));
  }

  Person person;
  std::atomic<int> framesWithoutTorque{ 0 }; ///< In a row, the newest ones.
  std::unique_ptr<FalconDevice> falcon;
};

TEST_F(FalconClutch, MovesTheModelByTheGripWhileTheButtonIsDown)
{
  begin();
  moveTo({ 0.0, 0.0, 0.02 });
  press(1);
  moveTo({ 0.012, -0.005, 0.015 });
  press(0);
  moveTo({ -0.02, 0.01, 0.03 });
  settle();
  EXPECT_NEAR(element(0, 3), 0.012, kTwoSteps);
  EXPECT_NEAR(element(1, 3), -0.005, kTwoSteps);
  EXPECT_NEAR(element(2, 3), -0.005, kTwoSteps);
}

TEST_F(FalconClutch, MovesTheWorkspaceOverTheModelStrokeByStroke)
{
  begin();
  for (int stroke = 0; stroke < 3; ++stroke)
  {
    moveTo({ 0.02, 0.0, 0.02 });
    press(4);
    moveTo({ -0.02, 0.0, 0.02 });
    press(0);
    style->Refresh();
  }
  settle();
  EXPECT_NEAR(element(0, 3), -0.12, 3 * kTwoSteps);
}

TEST_F(FalconClutch, PushesNobodyWhileTheGripHoldsTheModelAndPushesAgainAfterwards)
{
  begin();
  moveTo({ 0.0, 0.0, 0.002 });
  moveTo({ 0.0, 0.0, -0.002 });
  const double whole = 800.0 * 0.002;
  ASSERT_TRUE(eventually([&] { return servo.latest().state.force.z > 0.9 * whole; }))
    << servo.latest().state.force.z;
  EXPECT_TRUE(eventually([&] { return framesWithoutTorque == 0; }));
  press(1);
  style->Refresh();
  ASSERT_TRUE(eventually([&] { return norm(servo.latest().state.force) == 0.0; }));
  moveTo({ 0.005, 0.0, 0.003 });
  style->Refresh();
  EXPECT_TRUE(eventually([&] { return framesWithoutTorque > 50; }));
  press(0);
  settle();
  EXPECT_TRUE(eventually([&] { return servo.latest().state.force.z > 0.9 * whole; }))
    << "the surface went with the grip: " << servo.latest().state.force.z;
}

} // namespace
