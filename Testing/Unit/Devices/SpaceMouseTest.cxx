#include "../Eventually.h"

#include "Devices/SpaceMouse/SpaceMouse.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <random>
#include <thread>

using namespace pointhaptics;
using namespace pointhaptics::trial;

namespace
{
using Bytes = std::vector<std::uint8_t>;

Bytes report(int kind, std::initializer_list<int> values)
{
  Bytes bytes{ std::uint8_t(kind) };
  for (int value : values)
  {
    bytes.push_back(std::uint8_t(value));
    bytes.push_back(std::uint8_t(value >> 8));
  }
  return bytes;
}

bool take(SpaceMouseDecoder& decoder, const Bytes& bytes, double time = 0.0)
{
  return decoder.take(bytes.data(), int(bytes.size()), time);
}

SpaceMouseSettings withoutDeadZone()
{
  SpaceMouseSettings settings;
  settings.deadZone = 0.0;
  return settings;
}

/// A SpaceMouse in process, plugged in and out by the test.
struct Desk
{
  std::mutex mutex;
  std::condition_variable changed;
  bool plugged = true;
  bool refuses = false;
  int led = -1;
  int opened = 0;
  std::deque<Bytes> reports;

  void say(const Bytes& bytes)
  {
    const std::lock_guard<std::mutex> lock(mutex);
    reports.push_back(bytes);
    changed.notify_all();
  }
  void plug(bool in)
  {
    const std::lock_guard<std::mutex> lock(mutex);
    plugged = in;
    led = -1;
    changed.notify_all();
  }
  int ledNow()
  {
    const std::lock_guard<std::mutex> lock(mutex);
    return led;
  }
};

class DeskLink : public HidLink
{
public:
  explicit DeskLink(Desk& desk)
    : desk_(desk)
  {
  }
  int read(std::uint8_t* bytes, int capacity, int milliseconds) override
  {
    std::unique_lock<std::mutex> lock(desk_.mutex);
    desk_.changed.wait_for(lock, std::chrono::milliseconds(milliseconds),
      [this] { return !desk_.reports.empty() || !desk_.plugged; });
    if (!desk_.plugged)
    {
      return -1;
    }
    if (desk_.reports.empty())
    {
      return 0;
    }
    const Bytes report = desk_.reports.front();
    desk_.reports.pop_front();
    const int count = std::min(capacity, int(report.size()));
    std::copy(report.begin(), report.begin() + count, bytes);
    return count;
  }
  bool write(const std::uint8_t* bytes, int count) override
  {
    const std::lock_guard<std::mutex> lock(desk_.mutex);
    if (count == 2 && bytes[0] == 4)
    {
      desk_.led = bytes[1];
    }
    return desk_.plugged;
  }

private:
  Desk& desk_;
};

class DeskBus : public HidBus
{
public:
  explicit DeskBus(Desk& desk)
    : desk_(desk)
  {
  }
  std::vector<HidFound> find() override
  {
    const std::lock_guard<std::mutex> lock(desk_.mutex);
    std::vector<HidFound> all{ { 0x046d, 0xc077, "/dev/mouse", "An ordinary mouse" } };
    if (desk_.plugged)
    {
      // As a receiver: its keys, a cap that somebody else holds, the cap.
      all.push_back({ 0x256f, 0xc635, "/dev/keys", "SpaceMouse Compact", 1, 6 });
      all.push_back({ 0x256f, 0xc635, "/dev/taken", "SpaceMouse Compact", 1, 8 });
      all.push_back({ 0x256f, 0xc635, "/dev/cap", "SpaceMouse Compact", 1, 8 });
    }
    return all;
  }
  std::unique_ptr<HidLink> open(const HidFound& device, std::string& message) override
  {
    const std::lock_guard<std::mutex> lock(desk_.mutex);
    if (device.path == "/dev/taken")
    {
      message = "taken";
      return nullptr;
    }
    EXPECT_EQ(device.path, "/dev/cap");
    message = desk_.refuses ? "may not" : "";
    ++desk_.opened;
    return desk_.refuses ? nullptr : std::make_unique<DeskLink>(desk_);
  }

private:
  Desk& desk_;
};

}

TEST(SpaceMouseReport, MatchesItsProductsAndNoOrdinaryMouse)
{
  EXPECT_TRUE(isSpaceMouse(0x046d, 0xc62b));
  EXPECT_TRUE(isSpaceMouse(0x256f, 0xc635));
  EXPECT_FALSE(isSpaceMouse(0x046d, 0xc077));
  EXPECT_FALSE(isSpaceMouse(0x256f, 0xc62b));
  EXPECT_FALSE(isSpaceMouse(0x0403, 0xcb48));
}

TEST(SpaceMouseReport, ReadsBothLayoutsIntoTheWorkspacesFrame)
{
  // Device: X right, Y towards the person, Z down. Workspace: x right, y up, z towards the person.
  SpaceMouseDecoder separate(withoutDeadZone());
  EXPECT_TRUE(take(separate, report(1, { 35, 70, -105 })));
  EXPECT_TRUE(take(separate, report(2, { 350, -350, 175 })));
  SpaceMouseDecoder together(withoutDeadZone());
  EXPECT_TRUE(take(together, report(1, { 35, 70, -105, 350, -350, 175 })));
  for (const SpaceMouseDecoder* decoder : { &separate, &together })
  {
    const SpaceMouseMotion motion = decoder->motion(0.05);
    EXPECT_DOUBLE_EQ(motion.shift.x, 0.1);
    EXPECT_DOUBLE_EQ(motion.shift.y, 0.3);
    EXPECT_DOUBLE_EQ(motion.shift.z, 0.2);
    EXPECT_DOUBLE_EQ(motion.turn.x, 1.0);
    EXPECT_DOUBLE_EQ(motion.turn.y, -0.5);
    EXPECT_DOUBLE_EQ(motion.turn.z, -1.0);
  }
  EXPECT_TRUE(take(together, report(1, { 0, 0, 0 })));
  EXPECT_EQ(together.motion(0.05).turn.x, 1.0) << "a short report says nothing of the turn";
}

TEST(SpaceMouseReport, RestsInTheDeadZoneAndReachesTheFullRangeBeyondIt)
{
  SpaceMouseSettings settings;
  settings.deadZone = 0.2;
  SpaceMouseDecoder decoder(settings);
  for (const auto& [raw, expected] : { std::pair{ 69, 0.0 }, { 70, 0.0 }, { -70, 0.0 }, { 210, 0.5 },
         { -210, -0.5 }, { 350, 1.0 }, { 32767, 1.0 }, { -32768, -1.0 } })
  {
    EXPECT_TRUE(take(decoder, report(1, { raw, 0, 0 })));
    EXPECT_NEAR(decoder.motion(0.0).shift.x, expected, 1e-12) << raw;
    EXPECT_EQ(decoder.motion(0.0).resting(), expected == 0.0);
  }
}

TEST(SpaceMouseReport, RestsWhenTheLastReportIsStale)
{
  SpaceMouseDecoder decoder(withoutDeadZone());
  EXPECT_TRUE(take(decoder, report(1, { 350, 0, 0 }), 10.0));
  EXPECT_TRUE(take(decoder, report(2, { 350, 0, 0 }), 10.05));
  EXPECT_TRUE(take(decoder, report(3, { 5 }), 10.0));
  EXPECT_EQ(decoder.motion(10.1).shift.x, 1.0);
  EXPECT_EQ(decoder.motion(10.11).shift.x, 0.0);
  EXPECT_EQ(decoder.motion(10.11).turn.x, 1.0);
  EXPECT_TRUE(decoder.motion(10.2).resting());
  EXPECT_EQ(decoder.motion(100.0).buttons, 5u) << "a button is down until it is said to be up";
}

TEST(SpaceMouseReport, IgnoresCutUnknownAndRandomReports)
{
  SpaceMouseDecoder decoder;
  EXPECT_FALSE(take(decoder, {}));
  EXPECT_FALSE(take(decoder, { 1 }));
  EXPECT_FALSE(take(decoder, { 1, 2, 3, 4, 5, 6 }));
  EXPECT_FALSE(take(decoder, { 99, 2, 3, 4, 5, 6, 7 }));
  std::mt19937_64 random(9);
  for (int i = 0; i < 100000; ++i)
  {
    Bytes bytes(random() % 20);
    for (std::uint8_t& byte : bytes)
    {
      byte = std::uint8_t(random());
    }
    static_cast<void>(take(decoder, bytes));
    const SpaceMouseMotion motion = decoder.motion(0.0);
    for (int axis = 0; axis < 3; ++axis)
    {
      ASSERT_LE(std::abs(motion.shift[axis]), 1.0);
      ASSERT_LE(std::abs(motion.turn[axis]), 1.0);
    }
  }
}

TEST(SpaceMouse, IsFoundReadUnpluggedAndFoundAgain)
{
  Desk desk;
  SpaceMouseSettings settings = withoutDeadZone();
  settings.retrySeconds = 0.002;
  settings.staleSeconds = 100.0;
  SpaceMouse mouse(settings, std::make_unique<DeskBus>(desk));
  EXPECT_FALSE(mouse.motion().connected);
  ASSERT_EQ(mouse.start(), Status::Ok);
  for (int round = 0; round < 3; ++round)
  {
    ASSERT_TRUE(eventually([&] { return mouse.motion().connected && desk.ledNow() == 1; })) << round;
    EXPECT_EQ(mouse.message(), "SpaceMouse Compact");
    desk.say(report(1, { 350, 0, 0 }));
    desk.say({ 3, 1, 0 });
    EXPECT_TRUE(eventually([&] { return mouse.motion().shift.x == 1.0 && mouse.motion().buttons == 1; }));
    desk.plug(false);
    EXPECT_TRUE(eventually([&] { return !mouse.motion().connected; }));
    EXPECT_TRUE(mouse.motion().resting()) << "a cap that is gone does not turn the model for ever";
    EXPECT_EQ(mouse.motion().buttons, 0u);
    desk.plug(true);
  }
  ASSERT_TRUE(eventually([&] { return mouse.motion().connected && desk.ledNow() == 1; }));
  mouse.stop();
  EXPECT_EQ(desk.ledNow(), 0) << "LED off";
  EXPECT_FALSE(mouse.motion().connected);
}

TEST(SpaceMouse, IsAtRestInEveryReadThatFindsItGone)
{
  Desk desk;
  SpaceMouseSettings settings = withoutDeadZone();
  settings.retrySeconds = 1e-5;
  settings.staleSeconds = 100.0;
  SpaceMouse mouse(settings, std::make_unique<DeskBus>(desk));
  ASSERT_EQ(mouse.start(), Status::Ok);
  std::atomic<bool> done{ false };
  std::atomic<int> wrong{ 0 };
  std::thread reader(
    [&]
    {
      while (!done)
      {
        const SpaceMouseMotion motion = mouse.motion();
        wrong += !motion.connected && (!motion.resting() || motion.buttons != 0) ? 1 : 0;
      }
    });
  bool came = true;
  for (int round = 0; round < 300 && came; ++round)
  {
    desk.say(report(1, { 350, 0, 0 }));
    desk.say({ 3, 1, 0 });
    came = eventually([&] { return mouse.motion().buttons == 1; });
    desk.plug(false);
    came = came && eventually([&] { return !mouse.motion().connected; });
    desk.plug(true);
  }
  done = true;
  reader.join();
  EXPECT_TRUE(came);
  EXPECT_EQ(wrong, 0);
}

TEST(SpaceMouse, SaysWhyItCannotBeOpenedAndTriesAgain)
{
  Desk desk;
  desk.refuses = true;
  SpaceMouseSettings settings;
  settings.retrySeconds = 0.002;
  SpaceMouse mouse(settings, std::make_unique<DeskBus>(desk));
  ASSERT_EQ(mouse.start(), Status::Ok);
  EXPECT_TRUE(eventually([&] { return mouse.message() == "may not"; }));
  {
    const std::lock_guard<std::mutex> lock(desk.mutex);
    desk.refuses = false;
  }
  EXPECT_TRUE(eventually([&] { return mouse.motion().connected; }));
}

TEST(SpaceMouse, WithoutABusSaysWhatToInstall)
{
  SpaceMouse mouse(SpaceMouseSettings(), nullptr);
  EXPECT_EQ(mouse.start(), Status::DeviceNotFound);
  EXPECT_NE(mouse.message().find("libhidapi-dev"), std::string::npos);
}
