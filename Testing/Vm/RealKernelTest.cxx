// The drivers on the real libusb and hidapi, and these on a real kernel that takes our devices for plugged
// in.
#include "UhidCap.h"
#include "UsbipFalcon.h"

#include "../Unit/Devices/FalconTouch.h"

#include "Devices/DeviceList.h"
#include "Devices/SpaceMouse/SpaceMouse.h"
#include "Haptics/ServoLoop.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

using namespace pointhaptics;
using namespace pointhaptics::trial;

namespace
{
/// An emulated processor is some thirty times slower than the one it runs on.
constexpr double kRate = 100.0;
constexpr double kStiffness = 150.0; ///< N/m; the Falcon bears 166 at this rate.
constexpr double kSecondsToWait = 10.0;
constexpr double kSecondsToSettle = 3.0;

bool soon(const std::function<bool()>& condition, double seconds = kSecondsToWait)
{
  return eventually(condition, seconds); // an end before that of the machine
}

HapticParameters soft()
{
  HapticParameters parameters;
  parameters.contact.stiffness = kStiffness;
  return parameters;
}

ServoSettings servoSettings()
{
  ServoSettings settings;
  settings.rateHz = kRate;
  // The device's own thread needs the processor too.
  settings.realtimePriority = false;
  return settings;
}

class RealKernel : public ::testing::Test
{
protected:
  FalconSettings settings() const
  {
    FalconSettings result = desk.settings();
    result.boot.replyMilliseconds = 100;
    result.boot.probeMilliseconds = 100;
    return result;
  }

  UsbipFalcon falcon;
  FalconTouch<UsbipFalcon> desk{ falcon, kSecondsToWait };
};

std::string wordOf(const std::filesystem::path& file)
{
  std::ifstream stream(file);
  std::string word;
  stream >> word;
  return word;
}
}

TEST_F(RealKernel, EnumeratesTheFalcon)
{
  ASSERT_TRUE(falcon.plugIn());
  std::filesystem::path found;
  EXPECT_TRUE(soon(
    [&]
    {
      for (const auto& entry : std::filesystem::directory_iterator("/sys/bus/usb/devices"))
      {
        found = wordOf(entry.path() / "idVendor") == "0403" ? entry.path() : found;
      }
      return !found.empty() && wordOf(found / "bConfigurationValue") == "1";
    }));
  EXPECT_EQ(wordOf(found / "idProduct"), "cb48");
  EXPECT_EQ(wordOf(found / "speed"), "12");
  EXPECT_EQ(wordOf(found / "product"), "Falcon");
  std::vector<std::string> notes;
  const std::vector<ListedDevice> list = listDevices(notes);
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0].kind, "falcon");
  EXPECT_EQ(list[0].place, "bus 1 device " + wordOf(found / "devnum"));
  EXPECT_TRUE(list[0].problem.empty()) << list[0].problem;
}

TEST_F(RealKernel, BootsLoadsHomesAndTheHandSettlesInBalance)
{
  falcon.with(
    [](FalconModel& model)
    {
      model.deafGreetings = 2;
      model.wrongEchoes = 1;
      model.zeroBeforeReply = true;
      model.homesByItself = false;
      model.hand.wanted = model.hand.position = falcon::kCenter + Vec3(0.0, 0.0, 0.030);
    });
  ASSERT_TRUE(falcon.plugIn());
  FalconDevice device(settings());
  ASSERT_EQ(device.open(), Status::Ok) << device.message();
  EXPECT_EQ(falcon.with([](FalconModel& model) { return model.firmware; }), madeUpFirmware());
  ServoLoop loop;
  loop.publishScene(desk.sphere(10000, 0.001));
  ASSERT_EQ(loop.start(device, soft(), servoSettings()), Status::Ok);
  EXPECT_TRUE(soon([&] { return device.statistics().replies > 5; }));
  EXPECT_EQ(device.state(), FalconState::Unhomed);
  EXPECT_EQ(
    falcon.with([](FalconModel& model) { return model.command.leds; }), kFalconLedBlue | kFalconHomingBit);
  falcon.with([](FalconModel& model) { model.home(); });
  ASSERT_TRUE(soon([&] { return device.state() == FalconState::Armed; }));
  const auto rests = [&] { return desk.rests(loop, kStiffness, 0.015); };
  const auto settles = [&] { return desk.touch(loop) && soon(rests, kSecondsToSettle); };
  EXPECT_TRUE(settles() || settles() || settles()) << norm(loop.latest().state.force);
  desk.expectAtRest(kStiffness);
  loop.stop();
  device.close();
  desk.expectShutDown(device);
}

TEST_F(RealKernel, LetsTheFalconBeUnpluggedInContactAndComeBack)
{
  desk.comeFromOutside();
  ASSERT_TRUE(falcon.plugIn());
  FalconDevice device(settings());
  ASSERT_EQ(device.open(), Status::Ok) << device.message();
  ServoLoop loop;
  loop.publishScene(desk.sphere(10000, 0.001));
  ASSERT_EQ(loop.start(device, soft(), servoSettings()), Status::Ok);
  ASSERT_TRUE(soon([&] { return device.state() == FalconState::Armed; }));
  ASSERT_TRUE(desk.touch(loop));
  falcon.unplug();
  EXPECT_TRUE(soon([&] { return device.state() != FalconState::Armed; }));
  EXPECT_TRUE(soon([&] { return norm(loop.latest().state.force) == 0.0; }));
  EXPECT_TRUE(loop.running()) << "an unplugged device is a state";
  EXPECT_TRUE(soon([&] { return device.message().find("none is plugged in") != std::string::npos; }))
    << device.message();
  desk.comeFromOutside();
  ASSERT_TRUE(falcon.plugIn());
  ASSERT_TRUE(soon([&] { return device.statistics().connections == 2; })) << device.message();
  ASSERT_TRUE(soon([&] { return device.state() == FalconState::Armed; }));
  EXPECT_TRUE(desk.touch(loop));
  loop.stop();
  device.close();
}

TEST_F(RealKernel, GivesTheFalconUpToUsAndTakesItBack)
{
  // Debian's serial driver leaves the Falcon alone until somebody tells it not to.
  std::ofstream("/sys/bus/usb-serial/drivers/ftdi_sio/new_id") << "0403 cb48" << std::flush;
  ASSERT_TRUE(falcon.plugIn());
  const std::filesystem::path port = "/dev/ttyUSB0";
  ASSERT_TRUE(soon([&] { return std::filesystem::exists(port); })) << "ftdi_sio did not take it";
  FalconDevice device(settings());
  ASSERT_EQ(device.open(), Status::Ok) << device.message();
  EXPECT_FALSE(std::filesystem::exists(port));
  device.close();
  EXPECT_TRUE(soon([&] { return std::filesystem::exists(port); })) << "it may be a serial port again";
}

TEST(RealKernelHid, ReadsTheSpaceMouseSetsItsLedAndFindsItAgain)
{
  UhidCap cap;
  SpaceMouseSettings settings;
  settings.deadZone = 0.0;
  settings.staleSeconds = 100.0;
  settings.retrySeconds = 0.02;
  SpaceMouse mouse(settings);
  ASSERT_EQ(mouse.start(), Status::Ok) << mouse.message();
  EXPECT_FALSE(mouse.motion().connected);
  for (int round = 0; round < 2; ++round)
  {
    ASSERT_TRUE(cap.plugIn());
    ASSERT_TRUE(soon([&] { return mouse.motion().connected && cap.led() == 1; }))
      << round << " " << mouse.message();
    std::vector<std::string> notes;
    const std::vector<ListedDevice> list = listDevices(notes);
    ASSERT_EQ(list.size(), 2u);
    EXPECT_EQ(list[0].kind, "spacemouse");
    EXPECT_NE(list[0].name.find("SpaceMouse"), std::string::npos) << list[0].name;
    EXPECT_TRUE(list[0].problem.empty()) << list[0].problem;
    cap.say({ 1, 35, 0, 70, 0, 0x5e, 0x01 }); // 35, 70, 350
    cap.say({ 2, 0x5e, 0x01, 0, 0, 0, 0 });   // 350
    cap.say({ 3, 2, 0 });
    EXPECT_TRUE(soon([&] { return mouse.motion().buttons == 2; }));
    EXPECT_DOUBLE_EQ(mouse.motion().shift.x, 0.1);
    EXPECT_DOUBLE_EQ(mouse.motion().shift.y, -1.0);
    EXPECT_DOUBLE_EQ(mouse.motion().shift.z, 0.2);
    EXPECT_DOUBLE_EQ(mouse.motion().turn.x, 1.0);
    cap.unplug();
    EXPECT_TRUE(soon([&] { return !mouse.motion().connected; }));
    EXPECT_TRUE(mouse.motion().resting());
  }
  ASSERT_TRUE(cap.plugIn());
  ASSERT_TRUE(soon([&] { return mouse.motion().connected && cap.led() == 1; }));
  mouse.stop();
  EXPECT_EQ(cap.led(), 0);
}
