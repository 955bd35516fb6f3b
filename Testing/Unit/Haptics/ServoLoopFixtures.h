/// @file
/// A device that does as it is told, and what the tests of the servo loop share.
#pragma once

#include "Unit/Eventually.h"

#include "Haptics/ServoLoop.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <memory>

namespace pointhaptics
{
namespace trial
{
/// Port with scripted answers; every member is set before start() or is atomic.
class ScriptedPort : public HapticPort
{
public:
  std::function<Vec3(double)> path = [](double) { return Vec3(); };
  std::function<Status(int)> readStatus = [](int) { return Status::Ok; }; ///< Status of the n-th read, from
                                                                          ///< 0.
  std::function<Status(int)> writeStatus = [](int) { return Status::Ok; };
  std::function<void(int)> onRead = [](int) {};
  std::function<void(double)> onWrite = [](double) {}; ///< Called with the force.
  HandLimits bounds;                                   ///< Answer of limits().
  double declared = HapticPort::maximumForce();

  std::atomic<int> reads{ 0 };
  std::atomic<int> writes{ 0 };
  std::atomic<double> lastForce{ -1.0 };
  std::atomic<bool> forceAfterFault{ false }; ///< A write after a failed read carried a force.

  Status read(double timeSeconds, HandState& state) noexcept override
  {
    const int n = reads.fetch_add(1);
    onRead(n);
    const Status status = readStatus(n);
    failed_ = status != Status::Ok;
    state.position = path(timeSeconds);
    state.buttons = 5;
    return status;
  }
  Status write(double, const Vec3& force) noexcept override
  {
    lastForce = norm(force);
    onWrite(lastForce);
    forceAfterFault = forceAfterFault || (failed_ && norm(force) != 0.0);
    return writeStatus(writes.fetch_add(1));
  }

  HandLimits limits() const noexcept override { return bounds; }
  double maximumForce() const noexcept override { return declared; }
  bool mayIdle() const noexcept override { return true; }

private:
  bool failed_ = false;
};

/// A plane z = 0 of 0.5 mm spacing, 20 mm wide.
inline std::shared_ptr<const HapticScene> plane()
{
  HapticSceneInput input;
  for (int i = -20; i <= 20; ++i)
  {
    for (int j = -20; j <= 20; ++j)
    {
      input.points.push_back({ 0.0005 * i, 0.0005 * j, 0.0 });
    }
  }
  input.cellSize = 0.0005;
  Status status = Status::Ok;
  return HapticScene::create(std::move(input), status);
}

inline ServoSettings plainSettings()
{
  ServoSettings settings;
  settings.realtimePriority = false;
  return settings;
}

/// From 5 mm above the plane to 1 mm below it within 60 ms, then still.
inline Vec3 press(double timeSeconds)
{
  return { 0.0, 0.0, std::max(-0.001, 0.005 - 0.1 * timeSeconds) };
}

} // namespace trial
} // namespace pointhaptics
