// Requests of the driver to the serial chip, one by one. The model of the device minds only some of them, the
// chip all: with other settings it loses bytes, or answers late.
#include "Devices/Falcon/FalconBoot.h"

#include "FalconBench.h"

#include <gtest/gtest.h>

#include <utility>

using namespace pointhaptics;
using namespace pointhaptics::trial;

namespace
{
using Asked = std::pair<int, int>;

constexpr Asked kResetAll{ 0, 0 };
constexpr Asked kPurgeReceived{ 0, 1 };
constexpr Asked kPurgeSent{ 0, 2 };
constexpr Asked kRtsLow{ 1, 0x0200 };
constexpr Asked kDtrLow{ 1, 0x0100 };
constexpr Asked kDtrHigh{ 1, 0x0101 };
constexpr Asked kNoFlowControl{ 2, 0 };
constexpr Asked kEightBitsNoParityOneStop{ 4, 0x0008 };
constexpr Asked k16Milliseconds{ 9, 16 };
constexpr Asked k1Millisecond{ 9, 1 };

/// The chip divides 3 MHz; 0x4000 stands for half of one.
constexpr Asked k9600Baud{ 3, 0x4000 | 312 };
constexpr Asked k142857Baud{ 3, 3000000 / 142857 };
constexpr Asked k1500000Baud{ 3, 3000000 / 1500000 };

constexpr std::size_t kGreetingSize = 3;

class FalconBooting : public ::testing::Test
{
protected:
  FalconBooting() { wire.model.expectedFirmware = madeUpFirmware(200); }

  /// The requests since the last call, and that all came when the host had sent @p bytes.
  std::vector<Asked> asked(std::size_t bytes)
  {
    std::vector<Asked> result;
    for (; seen < wire.model.controls.size() && wire.model.controls[seen].bytesBefore == bytes; ++seen)
    {
      result.emplace_back(wire.model.controls[seen].request, wire.model.controls[seen].value);
    }
    return result;
  }
  void expectNothingElse() const { EXPECT_EQ(seen, wire.model.controls.size()); }

  const std::vector<Asked> forGreeting{ kResetAll, kPurgeReceived, kPurgeSent, k16Milliseconds, k9600Baud,
    kEightBitsNoParityOneStop, kNoFlowControl, kRtsLow, kDtrLow, kDtrHigh };
  const std::vector<Asked> forLoading{ kDtrLow, k142857Baud };
  const std::vector<Asked> forRunning{ k1Millisecond, k1500000Baud, kPurgeReceived, kPurgeSent };

  FalconOnAWire wire;
  WiredLink<> link{ wire };
  std::atomic<bool> cancelled{ false };
  FalconBoot boot{ link, FalconBootSettings(), cancelled };
  std::size_t seen = 0;
};
}

TEST_F(FalconBooting, SetsTheChipAsTheBootLoaderWantsItBeforeItGreets)
{
  wire.model.deafGreetings = 2;
  ASSERT_EQ(boot.greet(), Status::Ok);
  EXPECT_EQ(asked(0), forGreeting);
  expectNothingElse();
  EXPECT_EQ(wire.model.bytesTaken, 3 * kGreetingSize);
}

TEST_F(FalconBooting, ChangesTheRateBeforeItLoadsAndToRunModeOnlyAfterTheLastByte)
{
  ASSERT_EQ(boot.greet(), Status::Ok);
  EXPECT_EQ(asked(0), forGreeting);
  ASSERT_EQ(boot.load(madeUpFirmware(200)), Status::Ok);
  EXPECT_EQ(asked(kGreetingSize), forLoading);
  EXPECT_EQ(asked(kGreetingSize + 1 + 200), forRunning);
  expectNothingElse();
  EXPECT_TRUE(wire.model.runs);
}

TEST_F(FalconBooting, LeavesRunModeAloneWhereALoadFailed)
{
  wire.model.wrongEchoes = 1;
  ASSERT_EQ(boot.greet(), Status::Ok);
  EXPECT_EQ(asked(0), forGreeting);
  EXPECT_EQ(boot.load(madeUpFirmware(200)), Status::FirmwareNotTaken);
  EXPECT_EQ(asked(kGreetingSize), forLoading);
  expectNothingElse();
}

TEST_F(FalconBooting, ProbesInRunModeWithAllTheSettingsOfTheLine)
{
  wire.model.runs = true;
  ASSERT_EQ(boot.probe(), Status::Ok);
  std::vector<Asked> expected{ kEightBitsNoParityOneStop, kNoFlowControl };
  expected.insert(expected.end(), forRunning.begin(), forRunning.end());
  EXPECT_EQ(asked(0), expected);
  expectNothingElse();
}
