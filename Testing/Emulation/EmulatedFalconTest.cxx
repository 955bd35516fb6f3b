#include "EmulatedFalcon.h"
#include "UnderUmockdev.h"

#include "../Unit/Devices/FalconTouch.h"

#include "Devices/DeviceList.h"
#include "Haptics/ServoLoop.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <thread>

#include <fcntl.h>
#include <linux/usbdevice_fs.h>
#include <sys/ioctl.h>
#include <unistd.h>
using namespace pointhaptics;
using namespace pointhaptics::trial;

namespace
{

/// An emulated machine with one Falcon, and the driver on the real libusb.
class EmulatedUsb : public UnderUmockdev
{
protected:
  FalconSettings settings() const
  {
    FalconSettings result = desk.settings();
    // On a busy machine an answer may take its time; where one comes at all, waiting longer costs nothing.
    result.boot.replyMilliseconds = 1000;
    result.boot.probeMilliseconds = 30;
    return result;
  }

  EmulatedFalcon falcon{ bed() };
  FalconTouch<EmulatedFalcon> desk{ falcon, 60.0 };
};
}

TEST_F(EmulatedUsb, IsEmptyWithoutADevice)
{
  FalconDevice device(settings());
  EXPECT_EQ(device.open(), Status::DeviceNotFound);
  EXPECT_NE(device.message().find("0403:cb48"), std::string::npos) << device.message();
}

TEST_F(EmulatedUsb, BootsAFalconWhoseFirstTriesFail)
{
  falcon.plugIn();
  falcon.with(
    [](FalconModel& model)
    {
      model.deafGreetings = 3;
      model.wrongEchoes = 1;
      model.zeroBeforeReply = true;
    });
  std::vector<std::string> notes;
  const std::vector<ListedDevice> list = listDevices(notes);
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0].kind, "falcon");
  EXPECT_EQ(list[0].place, "bus 1 device 2");
  EXPECT_TRUE(list[0].problem.empty()) << list[0].problem;
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("no SpaceMouse was found"), std::string::npos) << notes[0];
  FalconSettings patient = settings();
  patient.boot.replyMilliseconds = 100; // three greetings are not answered
  FalconDevice device(patient);
  ASSERT_EQ(device.open(), Status::Ok) << device.message();
  EXPECT_TRUE(falcon.claimed());
  EXPECT_EQ(falcon.with([](FalconModel& model) { return model.firmware; }), madeUpFirmware());
  device.close();
  EXPECT_FALSE(falcon.claimed());
  EXPECT_EQ(falcon.pendingTransfers(), 0) << "all transfers came back";
}

TEST_F(EmulatedUsb, SaysWhoHoldsADeviceThatIsBusy)
{
  falcon.plugIn();
  falcon.refuseClaims(EBUSY);
  FalconDevice device(settings());
  EXPECT_EQ(device.open(), Status::DeviceLost);
  EXPECT_NE(device.message().find("another program"), std::string::npos) << device.message();
  std::vector<std::string> notes;
  const std::vector<ListedDevice> list = listDevices(notes);
  ASSERT_EQ(list.size(), 2u);
  EXPECT_NE(list[0].problem.find("another program"), std::string::npos) << list[0].problem;
}

TEST_F(EmulatedUsb, SurvivesUnpluggingInContactThreeTimes)
{
  falcon.plugIn();
  desk.comeFromOutside();
  FalconDevice device(settings());
  ASSERT_EQ(device.open(), Status::Ok) << device.message();
  ServoLoop loop;
  loop.publishScene(desk.sphere(40000, 0.0005));
  ASSERT_EQ(loop.start(device, HapticParameters()), Status::Ok);
  for (std::uint64_t round = 1; round <= 3; ++round)
  {
    ASSERT_TRUE(eventually([&] { return device.state() == FalconState::Armed; })) << round;
    ASSERT_TRUE(desk.touch(loop)) << round;
    const std::uint64_t connections = device.statistics().connections;
    falcon.unplug();
    EXPECT_TRUE(eventually([&] { return device.state() != FalconState::Armed; }));
    EXPECT_TRUE(eventually([&] { return norm(loop.latest().state.force) == 0.0; }));
    EXPECT_TRUE(loop.running()) << "an unplugged device is a state";
    desk.comeFromOutside();
    falcon.plugIn();
    ASSERT_TRUE(eventually([&] { return device.statistics().connections > connections; }))
      << round << " " << device.message();
  }
  loop.stop();
  device.close();
  EXPECT_FALSE(falcon.claimed());
}

TEST_F(EmulatedUsb, MayBeUnpluggedWhileSomebodyOpensIt)
{
  std::atomic<bool> ends{ false };
  std::atomic<int> answered{ 0 };
  std::thread user(
    [&]
    {
      while (!ends)
      {
        // A node that is not there costs umockdev a place in a small table.
        const char* const name = "/dev/bus/usb/001/002";
        const int node = access(name, F_OK) == 0 ? open(name, O_RDWR) : -1;
        std::uint32_t capabilities = 0;
        answered += node >= 0 && ioctl(node, USBDEVFS_GET_CAPABILITIES, &capabilities) == 0 ? 1 : 0;
        if (node >= 0)
        {
          close(node);
        }
      }
    });
  for (int round = 0; round < 30; ++round)
  {
    falcon.plugIn();
    const int before = answered;
    EXPECT_TRUE(eventually([&] { return answered > before; })) << round;
    // At another moment of the next opening each time.
    std::this_thread::sleep_for(std::chrono::microseconds(50 * round));
    falcon.unplug();
  }
  ends = true;
  user.join();
}
