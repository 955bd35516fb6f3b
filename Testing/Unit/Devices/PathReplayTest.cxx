#include "Devices/PathReplay.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace pointhaptics;

namespace
{
HipPath path()
{
  HipPath result;
  result.points = { { 10.0, { 0.0, 0.0, 0.01 } }, { 10.5, { 0.0, 0.0, -0.01 } } };
  return result;
}
}

TEST(PathReplayDevice, FollowsThePathFromTimeZero)
{
  PathReplayDevice device(path());
  ASSERT_EQ(device.open(), Status::Ok);
  HandState hand;
  for (int tick = 0; tick <= 500; ++tick)
  {
    ASSERT_EQ(device.read(tick / 1000.0, hand), Status::Ok) << tick;
    ASSERT_NEAR(hand.position.z, 0.01 - 0.02 * tick / 500.0, 1e-15);
  }
  EXPECT_EQ(device.read(0.501, hand), Status::EndOfPath);
}

TEST(PathReplayDevice, HoldsTheLastPositionOnRequest)
{
  PathReplayDevice device(path(), true);
  ASSERT_EQ(device.open(), Status::Ok);
  HandState hand;
  EXPECT_EQ(device.read(99.0, hand), Status::Ok);
  EXPECT_EQ(hand.position.z, -0.01);
}

TEST(PathReplayDevice, StartsAgainWhenOpenedAgain)
{
  PathReplayDevice device(path());
  HandState hand;
  EXPECT_EQ(device.read(0.0, hand), Status::DeviceNotOpen);
  for (int round = 0; round < 2; ++round)
  {
    ASSERT_EQ(device.open(), Status::Ok);
    ASSERT_EQ(device.read(0.0, hand), Status::Ok);
    EXPECT_EQ(hand.position.z, 0.01);
    EXPECT_EQ(device.read(2.0, hand), Status::EndOfPath);
    device.close();
  }
  EXPECT_EQ(device.write(0.0, Vec3()), Status::DeviceNotOpen);
}

TEST(PathReplayDevice, RefusesWhatIsNoPath)
{
  EXPECT_EQ(PathReplayDevice(HipPath()).open(), Status::Empty);
  HipPath backwards = path();
  std::swap(backwards.points[0], backwards.points[1]);
  EXPECT_EQ(PathReplayDevice(backwards).open(), Status::InvalidParameter);
}

TEST(PathReplayDevice, KnowsItsWorkspace)
{
  const DeviceCapabilities capabilities = PathReplayDevice(path()).capabilities();
  EXPECT_EQ(capabilities.workspace.minimum, Vec3(0.0, 0.0, -0.01));
  EXPECT_EQ(capabilities.workspace.maximum, Vec3(0.0, 0.0, 0.01));
}

TEST(RecordingDevice, RecordsAPathThatReplaysTheSame)
{
  PathReplayDevice replay(path());
  RecordingDevice recorder(replay, 1000);
  ASSERT_EQ(recorder.open(), Status::Ok);
  HandState hand;
  for (int tick = 0; recorder.read(tick / 1000.0, hand) == Status::Ok; ++tick)
  {
    EXPECT_EQ(recorder.write(tick / 1000.0, Vec3()), Status::Ok);
  }
  EXPECT_EQ(recorder.recorded().points.size(), 501u);
  EXPECT_EQ(recorder.recorded().check(), Status::Ok);
  EXPECT_EQ(recorder.lostSamples(), 0u);
  std::size_t hint = 0;
  EXPECT_NEAR(recorder.recorded().position(0.25, hint).z, 0.0, 1e-15);
}

TEST(RecordingDevice, CountsWhatDoesNotFit)
{
  PathReplayDevice replay(path(), true);
  RecordingDevice recorder(replay, 8);
  ASSERT_EQ(recorder.open(), Status::Ok);
  const std::size_t capacity = recorder.recorded().points.capacity();
  HandState hand;
  for (std::size_t tick = 0; tick < capacity + 5; ++tick)
  {
    ASSERT_EQ(recorder.read(double(tick) / 1000.0, hand), Status::Ok);
  }
  EXPECT_EQ(recorder.recorded().points.size(), capacity);
  EXPECT_EQ(recorder.lostSamples(), 5u);
}

TEST(RecordingDevice, KeepsAValidPathWhenTimeStartsAgain)
{
  PathReplayDevice replay(path(), true);
  RecordingDevice recorder(replay, 8);
  ASSERT_EQ(recorder.open(), Status::Ok);
  HandState hand;
  for (double time : { 0.0, 0.1, 0.0, 0.1, 0.2 })
  {
    ASSERT_EQ(recorder.read(time, hand), Status::Ok);
  }
  EXPECT_EQ(recorder.recorded().points.size(), 3u);
  EXPECT_EQ(recorder.lostSamples(), 2u);
  EXPECT_EQ(recorder.recorded().check(), Status::Ok);
}
