// A device of one's own: a knob that moves up and down and pushes with at most 2 N.
#include <Devices/HapticDevice.h>
#include <Haptics/ServoLoop.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <thread>

using namespace pointhaptics;

class Knob : public HapticDevice
{
public:
  const char* name() const noexcept override { return "knob"; }
  DeviceCapabilities capabilities() const noexcept override
  {
    DeviceCapabilities result;
    result.workspace.include({ 0.0, 0.0, -0.05 }); // metres
    result.workspace.include({ 0.0, 0.0, 0.05 });
    result.maximumForce = 2.0; // the servo loop never asks for more
    result.pushes = true;      // there are motors
    return result;
  }
  // Limits of the mechanics: the loop refuses springs that would make the hand shake.
  HandLimits limits() const noexcept override
  {
    HandLimits result;
    result.damping = 2.0;          // least friction of drive and hand, N s/m
    result.friction = 0.1;         // N
    result.positionStep = 20e-6;   // m
    result.rampDownSeconds = 0.05; // the force goes and comes so slowly
    result.rampUpSeconds = 1.0;
    return result;
  }
  Status open() override { return Status::Ok; } // here the bus would be opened, and the knob homed
  void close() override {}
  // Once a tick, in the servo thread: no memory, no lock, no wait longer than a tick.
  Status read(double seconds, HandState& state) noexcept override
  {
    state.position = { 0.0, 0.0, 0.01 * std::cos(6.0 * seconds) - 0.005 };
    return Status::Ok; // DeviceNotReady while it homes, DeviceLost where the plug is out
  }
  Status write(double, const Vec3& force) noexcept override
  {
    largest = std::max(largest.load(), norm(force)); // here it would go to the motor
    return Status::Ok;
  }
  std::atomic<double> largest{ 0.0 };
};

int main()
{
  HapticSceneInput input;
  for (int i = 0; i < 10000; ++i) // a plane z = 0, 20 mm wide
  {
    input.points.push_back({ 0.0002 * (i % 100 - 50), 0.0002 * (i / 100 - 50), 0.0 });
  }
  auto status = Status::Ok;
  Knob knob;
  ServoLoop servo; // after the device: it stops before that goes
  servo.publishScene(HapticScene::create(std::move(input), status));
  if (knob.open() != Status::Ok || servo.start(knob, {}) != Status::Ok)
  {
    return 1;
  }
  std::this_thread::sleep_for(std::chrono::seconds(2));
  std::printf("force limit %s, ", servo.forceLimit().text().c_str());
  servo.stop();
  std::printf("largest force %.2f N\n", knob.largest.load());
}
