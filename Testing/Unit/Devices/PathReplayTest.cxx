#include "Devices/PathReplay.h"

#include <gtest/gtest.h>

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
