// A servo loop without VTK: a simulated hand, a mass on a spring, presses on a ball of points and yields.
#include <Devices/SimulatedDevice.h>
#include <Haptics/ServoLoop.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <thread>

int main()
{
  pointhaptics::HapticSceneInput input;
  for (int i = 0; i < 20000; ++i) // 3 cm about the origin, evenly along a spiral
  {
    const double z = 1.0 - (2.0 * i + 1.0) / 20000.0;
    const double ring = std::sqrt(1.0 - z * z);
    const double turn = 2.39996323 * i;
    input.points.push_back({ 0.03 * ring * std::cos(turn), 0.03 * ring * std::sin(turn), 0.03 * z });
  }
  auto status = pointhaptics::Status::Ok;
  const auto scene = pointhaptics::HapticScene::create(std::move(input), status);

  pointhaptics::SimulatedDevice hand; // or a FalconDevice
  hand.setPath({ { { 0.0, { 0, 0, 0.04 } }, { 0.5, { 0, 0, 0.025 } }, { 1.0, { 0, 0, 0.025 } } } });
  pointhaptics::ServoLoop servo;
  servo.publishScene(scene);
  if (!scene || hand.open() != pointhaptics::Status::Ok || servo.start(hand, {}) != pointhaptics::Status::Ok)
  {
    std::fprintf(stderr, "there is nothing to feel\n");
    return 1;
  }
  while (servo.running()) // until the path ends; a program with a window would draw meanwhile
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    const pointhaptics::ProxyState state = servo.latest().state;
    std::printf("hand at z = %.1f mm, force %.2f N\n", 1e3 * state.hip.z, state.force.z);
  }
}
