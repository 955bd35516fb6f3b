#include "../Haptics/ServoLoopFixtures.h"
#include "FalconBench.h"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>

using namespace pointhaptics;
using namespace pointhaptics::trial;

namespace
{

constexpr std::array<std::int16_t, kFalconLegs> kNoTorque{};

Vec3 push(const Vec3&)
{
  return { 0.0, 1.0, 0.0 };
}

Vec3 wall(const Vec3& hand)
{
  return { 0.0, 0.0, std::max(0.0, -800.0 * hand.z) };
}

/// Longest force that the model's hand has felt since the last call.
double felt(FalconBench& bench)
{
  const std::lock_guard<std::mutex> lock(bench.wire.mutex);
  const double result = bench.wire.model.largestForce;
  bench.wire.model.largestForce = 0.0;
  return result;
}
}

TEST(FalconDevice, LoadsItsFirmwareHomesAndArms)
{
  FalconBench bench;
  bench.wire.model.deafGreetings = 5;
  bench.wire.model.zeroBeforeReply = true;
  bench.wire.model.wrongEchoes = 2;
  EXPECT_EQ(bench.device->state(), FalconState::Closed);
  EXPECT_EQ(bench.device->read(0.0, bench.hand), Status::DeviceNotOpen);
  EXPECT_EQ(bench.device->write(0.0, Vec3()), Status::DeviceNotOpen);
  ASSERT_EQ(bench.device->open(), Status::Ok) << bench.device->message();
  EXPECT_EQ(bench.wire.model.firmware, madeUpFirmware());
  EXPECT_EQ(bench.device->state(), FalconState::Unhomed);
  EXPECT_TRUE(bench.arm());
  EXPECT_NEAR(norm(bench.hand.position), 0.0, 40e-6) << "within the encoders' steps";
  EXPECT_EQ(bench.device->statistics().connections, 1u);
  EXPECT_EQ(bench.device->statistics().badReplies, 0u);
}

TEST(FalconDevice, SkipsTheLoadingWhereTheFirmwareRunsAlready)
{
  FalconSettings settings;
  settings.firmwareFile = "";
  FalconBench bench(settings);
  bench.wire.model.runs = true;
  bench.wire.model.expectedFirmware.clear();
  ASSERT_EQ(bench.device->open(), Status::Ok) << bench.device->message();
  EXPECT_TRUE(bench.wire.model.firmware.empty());
}

TEST(FalconDevice, SaysWhatIsMissing)
{
  {
    FalconBench bench;
    bench.wire.plugged = false;
    EXPECT_EQ(bench.device->open(), Status::DeviceNotFound);
    EXPECT_EQ(bench.device->state(), FalconState::Closed);
  }
  {
    FalconBench bench;
    bench.wire.openStatus = Status::DeviceNotPermitted;
    EXPECT_EQ(bench.device->open(), Status::DeviceNotPermitted);
    EXPECT_NE(bench.device->message().find("refuses"), std::string::npos);
  }
  {
    FalconSettings settings;
    settings.firmwareFile = "/no/such/file";
    FalconBench bench(settings);
    EXPECT_EQ(bench.device->open(), Status::FirmwareMissing);
    for (const char* part : { "/no/such/file", "No such file", "licence", "POINTHAPTICS_FALCON_FIRMWARE" })
    {
      EXPECT_NE(bench.device->message().find(part), std::string::npos) << bench.device->message();
    }
  }
  {
    FalconBench bench;
    bench.wire.model.silent = true;
    EXPECT_EQ(bench.device->open(), Status::DeviceSilent);
  }
  {
    FalconBench bench;
    bench.wire.model.wrongEchoes = 1000;
    EXPECT_EQ(bench.device->open(), Status::FirmwareNotTaken);
    EXPECT_EQ(bench.wire.openLinks, 0);
  }
  {
    FalconSettings settings;
    settings.limits.maximumForce = 9.0;
    FalconBench bench(settings);
    EXPECT_EQ(bench.device->open(), Status::InvalidParameter);
  }
}

TEST(FalconDevice, GivesUpWhereNoGreetingIsAnswered)
{
  FalconSettings settings;
  settings.boot.greetings = 7;
  FalconBench bench(settings);
  bench.wire.model.deafGreetings = 1000;
  EXPECT_EQ(bench.device->open(), Status::DeviceSilent);
  EXPECT_EQ(bench.wire.model.deafGreetings, 1000 - 2 * 7);
}

TEST(FalconDevice, EndsItsStartOnRequest)
{
  std::atomic<int> asked{ 0 };
  FalconSettings settings;
  settings.cancelled = [&] { return ++asked >= 2; };
  FalconBench bench(settings);
  bench.wire.model.deafGreetings = 1 << 30;
  // As hardware: an unanswered greeting takes its time.
  bench.wire.receivesSlowly = true;
  EXPECT_EQ(bench.device->open(), Status::Aborted);
  EXPECT_EQ(asked, 2);
  EXPECT_EQ(bench.wire.openLinks, 0);
  EXPECT_EQ(bench.device->state(), FalconState::Closed);
  EXPECT_NE(bench.device->message().find("on request"), std::string::npos);
}

TEST(FalconDevice, GivesNoForceBeforeHomingAndAsksForItInEveryCommand)
{
  FalconBench bench;
  bench.wire.model.homesByItself = false;
  ASSERT_EQ(bench.device->open(), Status::Ok);
  bench.wire.model.framesWithoutHomingBit = 0;
  bench.wire.model.hand.wanted.z -= 0.01;
  for (int i = 0; i < 300; ++i)
  {
    EXPECT_EQ(bench.tick(push), Status::DeviceNotReady);
    EXPECT_EQ(bench.device->raw().command.motors, kNoTorque);
  }
  EXPECT_EQ(felt(bench), 0.0);
  EXPECT_EQ(bench.device->state(), FalconState::Unhomed);
  EXPECT_EQ(bench.device->raw().command.leds, kFalconHomingBit | kFalconLedBlue);
  bench.wire.model.home();
  EXPECT_TRUE(bench.arm(wall)) << "the jump of the counts at that moment is none of the hand";
  EXPECT_EQ(bench.device->statistics().badReplies, 0u);
  EXPECT_GT(felt(bench), 0.5);
  EXPECT_EQ(bench.wire.model.framesWithoutHomingBit, 0);
  EXPECT_EQ(bench.device->raw().command.leds, kFalconHomingBit | kFalconLedGreen);
}

TEST(FalconDevice, TheHandSettlesWhereBothSpringsBalance)
{
  FalconBench bench;
  ASSERT_EQ(bench.device->open(), Status::Ok);
  ASSERT_TRUE(bench.arm(wall));
  bench.wire.model.hand.wanted = falcon::kCenter - Vec3(0.0, 0.0, 0.01);
  for (int i = 0; i < 2000; ++i)
  {
    ASSERT_EQ(bench.tick(wall), Status::Ok);
  }
  // 200 N/m pull 10 mm below the wall of 800 N/m: at rest 2 mm below it, to half an encoder step.
  EXPECT_NEAR(bench.wire.model.hand.position.z - falcon::kCenter.z, -0.01 * 200.0 / 1000.0, 20e-6);
  EXPECT_NEAR(bench.hand.position.z, -0.002, 40e-6);
  EXPECT_NEAR(bench.wire.model.force.z, 1.6, 0.03);
  EXPECT_LT(std::hypot(bench.wire.model.force.x, bench.wire.model.force.y), 0.01);
}

TEST(FalconDevice, KeepsToItsForceLimit)
{
  FalconBench bench;
  ASSERT_EQ(bench.device->open(), Status::Ok);
  ASSERT_TRUE(bench.arm([](const Vec3&) { return Vec3(0.0, 100.0, 0.0); }));
  EXPECT_LT(felt(bench), 4.01);
  EXPECT_GT(bench.wire.model.hand.position.y, 0.015) << "4 N against 200 N/m";
}

TEST(FalconDevice, DisarmedGivesNoForceAndRampsWhenArmedAgain)
{
  FalconBench bench;
  bench.device->setArmed(false);
  ASSERT_EQ(bench.device->open(), Status::Ok);
  EXPECT_FALSE(bench.arm(push));
  EXPECT_EQ(bench.device->state(), FalconState::Homed);
  EXPECT_EQ(felt(bench), 0.0);
  bench.device->setArmed(true);
  for (int i = 0; i < 100; ++i)
  {
    ASSERT_EQ(bench.tick(push), Status::Ok);
  }
  EXPECT_GT(felt(bench), 0.05);
  EXPECT_LT(bench.wire.model.force.y, 0.15);
  bench.device->setArmed(false);
  ASSERT_EQ(bench.tick(push), Status::Ok);
  felt(bench);
  ASSERT_EQ(bench.tick(push), Status::Ok);
  EXPECT_EQ(felt(bench), 0.0);
}

TEST(FalconDevice, GoesOnWithTheLastPositionForAMomentOfSilenceThenWithoutForce)
{
  FalconBench bench;
  ASSERT_EQ(bench.device->open(), Status::Ok);
  ASSERT_TRUE(bench.arm(push));
  bench.wire.model.silent = true;
  ASSERT_EQ(bench.tick(push), Status::Ok) << "one answer is under way";
  const double y = bench.hand.position.y;
  int ok = 0;
  Status status = Status::Ok;
  while ((status = bench.tick(push)) == Status::Ok)
  {
    ++ok;
    ASSERT_NE(bench.device->raw().command.motors, kNoTorque) << "the last position serves";
    ASSERT_EQ(bench.hand.position.y, y);
  }
  EXPECT_EQ(status, Status::DeviceSilent);
  EXPECT_NEAR(ok, 19, 1);
  for (int i = 0; i < 100; ++i)
  {
    EXPECT_EQ(bench.device->raw().command.motors, kNoTorque) << i;
    EXPECT_EQ(bench.tick(push), Status::DeviceSilent);
  }
  EXPECT_GE(bench.device->statistics().timeouts, 3u);
  bench.wire.model.silent = false;
  // It answers again: the position is back, and the force begins with the ramp.
  static_cast<void>(bench.tick(push));
  felt(bench);
  for (int i = 0; i < 50; ++i)
  {
    ASSERT_EQ(bench.tick(push), Status::Ok);
  }
  EXPECT_LT(felt(bench), 0.1);
}

TEST(FalconDevice, AJumpOfTheEncodersGivesNoForceUntilItIsBelieved)
{
  FalconBench bench;
  ASSERT_EQ(bench.device->open(), Status::Ok);
  ASSERT_TRUE(bench.arm(push));
  bench.wire.model.hand.position = falcon::kCenter + Vec3(0.03, 0.02, -0.03);
  bench.wire.model.hand.wanted = bench.wire.model.hand.position;
  ASSERT_EQ(bench.tick(push), Status::Ok) << "the answer under way is from before";
  const Vec3 before = bench.hand.position;
  EXPECT_EQ(bench.tick(push), Status::DeviceBadReply);
  EXPECT_EQ(bench.hand.position, before) << "held";
  EXPECT_FALSE(bench.hand.isNew);
  int bad = 1;
  do
  {
    EXPECT_EQ(bench.device->raw().command.motors, kNoTorque) << bad;
    ++bad;
  } while (bench.tick(push) == Status::DeviceBadReply);
  --bad;
  EXPECT_TRUE(bench.hand.isNew) << "it did not move there";
  EXPECT_EQ(bench.tick(push), Status::Ok);
  EXPECT_FALSE(bench.hand.isNew);
  EXPECT_LE(bad, 6);
  EXPECT_NEAR(bench.hand.position.x, 0.03, 1e-3);
  EXPECT_EQ(bench.device->statistics().badReplies, std::uint64_t(bad));
}

TEST(FalconDevice, BelievesNoJumpWhoseAnswersContradictEachOther)
{
  FalconBench bench;
  ASSERT_EQ(bench.device->open(), Status::Ok);
  ASSERT_TRUE(bench.arm(push));
  ASSERT_EQ(bench.tick(push), Status::Ok);
  Vec3 before;
  const Vec3 places[] = { { 0.03, 0.0, 0.0 }, { -0.03, 0.0, 0.0 }, { 0.0, 0.0, -0.04 } };
  for (int i = 0; i < 30; ++i)
  {
    bench.wire.model.hand.position = bench.wire.model.hand.wanted = falcon::kCenter + places[i % 3];
    const Status status = bench.tick(push);
    EXPECT_EQ(status, i == 0 ? Status::Ok : Status::DeviceBadReply) << i;
    before = i == 0 ? bench.hand.position : before;
    EXPECT_EQ(bench.hand.position, before) << "held";
  }
}

TEST(FalconDevice, CatchesUpAfterAnAnswerThatCameATickTooLate)
{
  std::deque<std::uint8_t> onTheWay;
  int none = 2;
  FalconBench bench; // uses them until it closes
  ASSERT_EQ(bench.device->open(), Status::Ok);
  ASSERT_TRUE(bench.arm(push));
  EXPECT_EQ(bench.device->statistics().largestUnanswered, 0u);
  // From now on a packet holds one answer, and the two first packets hold none.
  bench.wire.distort = [&](std::vector<std::uint8_t>& bytes)
  {
    onTheWay.insert(onTheWay.end(), bytes.begin(), bytes.end());
    const std::size_t count = none-- > 0 ? 0 : std::min<std::size_t>(onTheWay.size(), kFalconFrameSize);
    bytes.assign(onTheWay.begin(), onTheWay.begin() + std::ptrdiff_t(count));
    onTheWay.erase(onTheWay.begin(), onTheWay.begin() + std::ptrdiff_t(count));
  };
  for (int i = 0; i < 5; ++i)
  {
    ASSERT_EQ(bench.tick(), Status::Ok);
  }
  bench.wire.model.hand.position = bench.wire.model.hand.wanted = falcon::kCenter + Vec3(0.0, 0.0, 0.003);
  bench.wire.model.hand.velocity = {};
  ASSERT_EQ(bench.tick(), Status::Ok);
  ASSERT_EQ(bench.tick(), Status::Ok);
  EXPECT_NEAR(bench.hand.position.z, 0.003, 100e-6) << "the position of the tick before";
}

TEST(FalconDevice, CountsADelayThatWaitingDoesNotCure)
{
  std::deque<std::vector<std::uint8_t>> onTheWay;
  int asked = 0;
  FalconBench bench; // uses them until it closes
  ASSERT_EQ(bench.device->open(), Status::Ok);
  ASSERT_TRUE(bench.arm(push));
  // Two answers are always under way.
  bench.wire.distort = [&](std::vector<std::uint8_t>& bytes)
  {
    ++asked;
    if (!bytes.empty())
    {
      onTheWay.push_back(bytes);
      bytes.clear();
    }
    if (onTheWay.size() > 2)
    {
      bytes = onTheWay.front();
      onTheWay.pop_front();
    }
  };
  for (int i = 0; i < 100; ++i)
  {
    ASSERT_EQ(bench.tick(push), Status::Ok);
  }
  EXPECT_EQ(bench.device->statistics().largestUnanswered, 2u);
  EXPECT_LE(asked, 150) << "no tick waits for ever for what does not come";
}

TEST(FalconDevice, AHandThatHomesElsewhereComesToTheSurfaceAnew)
{
  FalconBench bench;
  bench.wire.model.hand.position = bench.wire.model.hand.wanted = falcon::kCenter + Vec3(0.0, 0.0, 0.003);
  ASSERT_EQ(bench.device->open(), Status::Ok);
  ServoLoop loop;
  loop.publishScene(plane());
  ASSERT_EQ(loop.start(*bench.device, HapticParameters(), plainSettings()), Status::Ok);
  ASSERT_TRUE(eventually([&] { return loop.latest().state.hip.z > 0.0029; }));
  {
    const std::lock_guard<std::mutex> lock(bench.wire.mutex);
    bench.wire.model.homesByItself = false;
    bench.wire.model.loseHoming();
    bench.wire.model.hand.position = falcon::kCenter - Vec3(0.0, 0.0, 0.03);
  }
  ASSERT_TRUE(eventually([&] { return bench.device->state() == FalconState::Unhomed; }));
  {
    const std::lock_guard<std::mutex> lock(bench.wire.mutex);
    bench.wire.model.home();
  }
  ASSERT_TRUE(eventually([&] { return loop.latest().state.hip.z < -0.029; }));
  EXPECT_FALSE(loop.latest().state.contact) << "it did not go through the surface";
  loop.stop();
}

TEST(FalconDevice, RampsAnewAndNoticesSilenceWhenAnotherLoopTakesIt)
{
  FalconBench bench;
  ASSERT_EQ(bench.device->open(), Status::Ok);
  ASSERT_TRUE(bench.arm(push));
  bench.time = 0.0;
  ASSERT_EQ(bench.tick(push), Status::Ok);
  felt(bench);
  for (int i = 0; i < 50; ++i)
  {
    ASSERT_EQ(bench.tick(push), Status::Ok);
  }
  EXPECT_LT(felt(bench), 0.1) << "the ramp";
  bench.wire.model.silent = true;
  for (int i = 0; i < 25; ++i)
  {
    static_cast<void>(bench.tick(push));
  }
  EXPECT_EQ(bench.device->statistics().timeouts, 1u);
}

TEST(FalconDevice, SurvivesUnpluggingThreeTimesAndHomesAnew)
{
  FalconBench bench;
  ASSERT_EQ(bench.device->open(), Status::Ok);
  for (std::uint64_t round = 1; round <= 3; ++round)
  {
    ASSERT_TRUE(bench.arm(wall)) << round;
    {
      const std::lock_guard<std::mutex> lock(bench.wire.mutex);
      bench.wire.plugged = false;
      bench.wire.model.powerOff();
    }
    EXPECT_EQ(bench.tick(wall), Status::DeviceLost);
    EXPECT_EQ(bench.tick(wall), Status::DeviceNotReady) << "a state, not an error";
    EXPECT_TRUE(eventually([&] { return bench.wire.openLinks == 0; })) << "released";
    EXPECT_NE(bench.device->state(), FalconState::Armed);
    {
      const std::lock_guard<std::mutex> lock(bench.wire.mutex);
      bench.wire.plugged = true;
    }
    EXPECT_TRUE(eventually([&] { return bench.device->statistics().connections == round + 1; }));
    EXPECT_EQ(bench.wire.model.firmware, madeUpFirmware());
    felt(bench);
    for (int i = 0; i < 30; ++i)
    {
      static_cast<void>(bench.tick([](const Vec3&) { return Vec3(0.0, 3.0, 0.0); }));
    }
    EXPECT_LT(felt(bench), 0.1) << "the force begins with the ramp";
  }
}

TEST(FalconDevice, ClosesWithAnsweredCommandsWithoutForceAndLedsOff)
{
  FalconBench bench;
  ASSERT_EQ(bench.device->open(), Status::Ok);
  ASSERT_TRUE(bench.arm([](const Vec3&) { return Vec3(0.0, 2.0, 0.0); }));
  EXPECT_EQ(bench.wire.model.frozenFrames, 0);
  bench.device->close();
  EXPECT_GE(bench.wire.model.frozenFrames, 3);
  EXPECT_EQ(bench.wire.model.command.leds, kFalconLedNone);
  EXPECT_EQ(bench.wire.openLinks, 0);
  EXPECT_EQ(bench.device->state(), FalconState::Closed);
  bench.device->close();
  ASSERT_EQ(bench.device->open(), Status::Ok) << "may be opened again";
  EXPECT_TRUE(bench.arm());
}

TEST(FalconDevice, AwaitsAnswersToItsLastCommandsAndNotToThoseBefore)
{
  FalconBench bench;
  ASSERT_EQ(bench.device->open(), Status::Ok);
  ASSERT_TRUE(bench.arm([](const Vec3&) { return Vec3(0.0, 2.0, 0.0); }));
  // From now on every answer is three readings old.
  std::deque<std::vector<std::uint8_t>> onTheWay(3);
  bench.wire.distort = [&](std::vector<std::uint8_t>& bytes)
  {
    onTheWay.push_back(bytes);
    bytes = onTheWay.front();
    onTheWay.pop_front();
  };
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_EQ(bench.tick([](const Vec3&) { return Vec3(0.0, 2.0, 0.0); }), Status::Ok);
  }
  bench.device->close();
  EXPECT_GE(bench.wire.model.frozenFrames, 3 + 3);
}

TEST(FalconDevice, CountsCommandsThatCouldNotBeSent)
{
  FalconBench bench;
  ASSERT_EQ(bench.device->open(), Status::Ok);
  ASSERT_TRUE(bench.arm());
  bench.wire.busy = true;
  EXPECT_EQ(bench.tick(), Status::Ok) << "the answer to the last command is still there";
  EXPECT_EQ(bench.tick(), Status::Ok) << "late, not lost";
  bench.wire.busy = false;
  EXPECT_EQ(bench.device->statistics().skippedCommands, 2u);
}

TEST(FalconDevice, NeverPushesBeyondItsLimitsOnADistortedWire)
{
  std::mt19937_64 random(21);
  FalconBench bench;
  ASSERT_EQ(bench.device->open(), Status::Ok);
  ASSERT_TRUE(bench.arm(wall));
  bench.wire.distort = [&](std::vector<std::uint8_t>& bytes)
  {
    static std::vector<std::uint8_t> kept;
    switch (random() % 8)
    {
      case 0: // Damaged.
        for (std::uint8_t& byte : bytes)
        {
          byte = random() % 3 ? byte : std::uint8_t(random());
        }
        break;
      case 1: // Reordered.
        std::shuffle(bytes.begin(), bytes.end(), random);
        break;
      case 2: // Cut.
        bytes.resize(bytes.empty() ? 0 : random() % bytes.size());
        break;
      case 3: // Doubled.
        bytes.insert(bytes.end(), bytes.begin(), bytes.end());
        break;
      case 4: // Delayed.
        kept.swap(bytes);
        break;
      case 5: // A frame of somebody else's.
      {
        FalconReply reply;
        for (std::int16_t& encoder : reply.encoders)
        {
          encoder = std::int16_t(random());
        }
        reply.homed = random() & 7;
        const FalconFrame frame = encode(reply);
        bytes.assign(frame.begin(), frame.end());
        break;
      }
      default:
        break;
    }
  };
  int good = 0;
  for (int i = 0; i < 5000; ++i)
  {
    good += bench.tick([](const Vec3&) { return Vec3(0.0, 50.0, 0.0); }) == Status::Ok ? 1 : 0;
    ASSERT_TRUE(isFinite(bench.hand.position));
    ASSERT_LE(norm(bench.hand.position), 0.25);
  }
  EXPECT_GT(good, 100);
  EXPECT_LT(felt(bench), 4.05);
  EXPECT_GT(bench.device->statistics().badReplies, 100u);
  EXPECT_GT(bench.device->statistics().droppedBytes, 100u);
  bench.wire.distort = [](std::vector<std::uint8_t>&) {};
  EXPECT_TRUE(bench.arm()) << "and works again on a good wire";
}

TEST(FalconDevice, TellsWhatItCanDo)
{
  FalconBench bench;
  const DeviceCapabilities can = bench.device->capabilities();
  EXPECT_EQ(can.maximumForce, 4.0);
  const double stiffness = largestPassiveStiffness(bench.device->limits(), 0.0, 1000.0);
  EXPECT_GT(stiffness, 800.0) << "the default stiffness must pass";
  EXPECT_LT(stiffness, 3000.0);
  EXPECT_DOUBLE_EQ(can.workspace.extent().x, 0.1);
  EXPECT_GT(bench.device->limits().rampDownSeconds, 0.05);
  EXPECT_STREQ(bench.device->name(), "falcon");
  bench.wire.model.buttons = 9;
  ASSERT_EQ(bench.device->open(), Status::Ok);
  ASSERT_TRUE(bench.arm());
  EXPECT_EQ(bench.hand.buttons, 9u);
}
