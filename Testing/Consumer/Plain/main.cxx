// Presses a hand onto a plane of points in the servo loop: the installed package without VTK.
#include <Devices/SimulatedDevice.h>
#include <Haptics/ServoLoop.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <thread>

using namespace pointhaptics;

int main()
{
  HapticSceneInput input;
  for (int i = -40; i <= 40; ++i)
  {
    for (int j = -40; j <= 40; ++j)
    {
      input.points.push_back({ 0.0005 * i, 0.0005 * j, 0.0 });
    }
  }
  Status status = Status::Ok;
  const std::shared_ptr<const HapticScene> scene = HapticScene::create(std::move(input), status);
  if (!scene)
  {
    std::fprintf(stderr, "no scene: %s\n", message(status));
    return 1;
  }
  HipPath path;
  path.points = { { 0.0, { 0.0, 0.0, 0.005 } }, { 0.1, { 0.0, 0.0, -0.001 } },
    { 0.2, { 0.0, 0.0, -0.001 } } };
  SimulatedHandSettings settings;
  settings.yieldsToForce = false;
  SimulatedDevice device(settings);
  device.setPath(path);
  ServoLoop loop;
  loop.publishScene(scene);
  if (device.open() != Status::Ok || loop.start(device, HapticParameters()) != Status::Ok)
  {
    std::fprintf(stderr, "the servo loop does not start\n");
    return 1;
  }
  while (loop.running())
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  const double force = loop.latest().state.force.z;
  std::printf("force %.6f N at 1 mm depth, expected 0.8 N\n", force);
  return std::abs(force - 0.8) < 0.008 ? 0 : 1;
}
