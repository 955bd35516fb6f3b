/// @file
/// Shared by the tests of the driver on a real libusb, whatever is below that: patience, a sphere, a hand
/// that touches it.
#pragma once

#include "FalconBench.h"

#include "Haptics/ServoLoop.h"
#include "Shapes/Shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <memory>

namespace pointhaptics
{
namespace trial
{

/// @tparam Falcon a device around a FalconModel, with(use).
template <typename Falcon>
class FalconTouch
{
public:
  /// @param secondsToWait for each step of touch().
  FalconTouch(Falcon& falcon, double secondsToWait)
    : falcon_(falcon)
    , secondsToWait_(secondsToWait)
    , file_(madeUpFirmware())
  {
    falcon.with([](FalconModel& model) { model.expectedFirmware = madeUpFirmware(); });
  }

  /// Answers come through sockets, on a machine that may be busy.
  FalconSettings settings() const
  {
    FalconSettings result;
    result.firmwareFile = file_.path();
    result.retrySeconds = 0.02;
    result.boot.greetings = 20;
    result.answerTimeoutSeconds = 0.2;
    result.replyWaitSeconds = 2e-3;
    return result;
  }

  /// Scene of a sphere of 25 mm radius; @p cellSize in metres.
  static std::shared_ptr<const HapticScene> sphere(int points, double cellSize)
  {
    HapticSceneInput input;
    EXPECT_EQ(generateShape(Shape::Sphere, points, 3, 0.0, input.points), Status::Ok);
    input.cellSize = cellSize;
    Status status = Status::Ok;
    return HapticScene::create(std::move(input), status);
  }

  /// The hand waits outside the sphere: where a touch begins is free space.
  void comeFromOutside()
  {
    falcon_.with(
      [](FalconModel& model) { model.hand.wanted = model.hand.position = center() + Vec3(0.0, 0.0, 0.030); });
  }

  /// Moves the hand's wish 6 mm below the surface until it feels that. Again from outside where the machine
  /// stood still for a second on the way: the loop then takes the hand as new, inside the sphere.
  bool touch(const ServoLoop& loop)
  {
    bool felt = false;
    for (int attempt = 0; attempt < 5 && !felt; ++attempt)
    {
      comeFromOutside();
      EXPECT_TRUE(eventually([&] { return loop.latest().state.hip.z > 0.029; }, secondsToWait_));
      falcon_.with([](FalconModel& model) { model.hand.wanted = center() + Vec3(0.0, 0.0, 0.019); });
      EXPECT_TRUE(eventually([&] { return loop.latest().state.hip.z < 0.0243; }, secondsToWait_));
      const auto pushed = [&] { return loop.latest().state.force.z > 0.1; };
      felt = eventually([&] { return pushed() || loop.latest().state.hip.z < 0.0193; }, secondsToWait_) &&
        pushed();
    }
    return felt;
  }

  /// The person pulls with 200 N/m to 6 mm below the surface, which pushes with @p stiffness: the depth at
  /// which both forces are the same, metres.
  static double depthAtRest(double stiffness) { return 0.006 * 200.0 / (200.0 + stiffness); }
  /// The hand rests there, to @p tolerance newtons.
  bool rests(const ServoLoop& loop, double stiffness, double tolerance)
  {
    const double speed = falcon_.with([](FalconModel& model) { return norm(model.hand.velocity); });
    const double expected = stiffness * depthAtRest(stiffness);
    return std::abs(norm(loop.latest().state.force) - expected) < tolerance && speed < 1e-4;
  }
  void expectAtRest(double stiffness)
  {
    EXPECT_NEAR(falcon_.with([](FalconModel& model) { return model.hand.position.z; }) - center().z,
      0.025 - depthAtRest(stiffness), 60e-6);
  }
  /// After close(): motors and LEDs are off. Prints how the round trips went.
  void expectShutDown(const FalconDevice& device)
  {
    falcon_.with(
      [](FalconModel& model)
      {
        EXPECT_GE(model.frozenFrames, 3);
        EXPECT_EQ(model.command.leds, kFalconLedNone);
      });
    const FalconStatistics statistics = device.statistics();
    std::printf("[ figure   ] round trips %llu, late %llu, timeouts %llu\n",
      static_cast<unsigned long long>(statistics.replies),
      static_cast<unsigned long long>(statistics.lateReplies),
      static_cast<unsigned long long>(statistics.timeouts));
  }

private:
  static Vec3 center() { return falcon::kCenter; }

  Falcon& falcon_;
  double secondsToWait_;
  FirmwareFile file_;
};

} // namespace trial
} // namespace pointhaptics
