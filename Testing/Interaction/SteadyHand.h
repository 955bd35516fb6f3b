/// @file
/// A simulated hand that stays where it is put, and the servo loop that feels with it.
#pragma once

#include "vtkInteractorStyleHaptic.h"

#include "Devices/SimulatedDevice.h"
#include "Haptics/ServoLoop.h"

#include <gtest/gtest.h>

namespace pointhaptics
{
namespace trial
{

/// Between begin() and its end a style shows it.
class SteadyHand
{
public:
  explicit SteadyHand(const Vec3& start)
    : device(settingsAt(start))
  {
    device.setTarget(start);
  }
  ~SteadyHand()
  {
    servo.stop();
    if (style_)
    {
      style_->SetServoLoop(nullptr);
      style_->SetDevice(nullptr);
    }
  }
  SteadyHand(const SteadyHand&) = delete;
  SteadyHand& operator=(const SteadyHand&) = delete;

  void begin(vtkInteractorStyleHaptic* style)
  {
    ServoSettings settings;
    settings.realtimePriority = false;
    ASSERT_EQ(device.open(), Status::Ok);
    ASSERT_EQ(servo.start(device, HapticParameters(), settings), Status::Ok);
    style_ = style;
    style_->SetServoLoop(&servo);
    style_->SetDevice(&device);
  }

  SimulatedDevice device;
  ServoLoop servo;

private:
  static SimulatedHandSettings settingsAt(const Vec3& start)
  {
    SimulatedHandSettings settings;
    settings.yieldsToForce = false;
    settings.start = start;
    return settings;
  }

  vtkInteractorStyleHaptic* style_ = nullptr;
};

} // namespace trial
} // namespace pointhaptics
