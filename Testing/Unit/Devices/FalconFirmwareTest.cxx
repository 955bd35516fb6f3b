#include "Devices/Falcon/FalconFirmware.h"

#include "FalconBench.h"

#include <gtest/gtest.h>

#include <cstdlib>

using namespace pointhaptics;
using namespace pointhaptics::trial;

TEST(FalconFirmware, IsReadFromTheFileThatIsNamed)
{
  FalconFirmware firmware;
  std::string message;
  const FirmwareFile right(madeUpFirmware());
  EXPECT_EQ(readFalconFirmware(right.path(), firmware, message), Status::Ok);
  EXPECT_EQ(firmware.bytes, madeUpFirmware());
  EXPECT_TRUE(firmware.note.empty());
  const FirmwareFile small(madeUpFirmware(100));
  EXPECT_EQ(readFalconFirmware(small.path(), firmware, message), Status::Ok);
  EXPECT_NE(firmware.note.find("8492"), std::string::npos);
  const FirmwareFile empty(madeUpFirmware(0));
  EXPECT_EQ(readFalconFirmware(empty.path(), firmware, message), Status::FirmwareMissing);
  const FirmwareFile large(madeUpFirmware(70000));
  EXPECT_EQ(readFalconFirmware(large.path(), firmware, message), Status::FirmwareMissing);
  EXPECT_EQ(readFalconFirmware(::testing::TempDir(), firmware, message), Status::FirmwareMissing);
  EXPECT_EQ(readFalconFirmware("", firmware, message), Status::FirmwareMissing);
  EXPECT_NE(message.find("licence"), std::string::npos);
  EXPECT_TRUE(firmware.bytes.empty());
}

TEST(FalconFirmware, IsNamedByTheEnvironmentWhereNoOptionDoes)
{
  ASSERT_EQ(setenv(kFirmwareVariable, "/from/the/environment", 1), 0);
  EXPECT_EQ(falconFirmwareFile(""), "/from/the/environment");
  EXPECT_EQ(falconFirmwareFile("/from/the/option"), "/from/the/option");
  ASSERT_EQ(unsetenv(kFirmwareVariable), 0);
  EXPECT_EQ(falconFirmwareFile(""), "");
}
