#include "Core/Base/Status.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

using namespace pointhaptics;

TEST(Status, HasAnOwnSentenceForEveryValue)
{
  std::set<std::string> sentences;
  for (int value = 0; value <= int(Status::PointsTooFar); ++value)
  {
    const char* text = message(Status(value));
    ASSERT_NE(text, nullptr) << value;
    EXPECT_FALSE(std::string(text).empty()) << value;
    EXPECT_TRUE(sentences.insert(text).second) << value << " repeats: " << text;
  }
}

TEST(Status, SentencesNameTheCure)
{
  const std::map<Status, std::string> cures = { { Status::Empty, "check the workspace" },
    { Status::SingularTransform, "use scales other than 0" },
    { Status::NonFiniteTransform, "use finite numbers" },
    { Status::InvalidWorkspace, "must be finite with maximum above minimum" },
    { Status::InvalidDimensions, "must be between 1 and 2097152" },
    { Status::InvalidVoxelSize, "must be finite and above 0" },
    { Status::LatticeNotAddressable, "use a larger voxel size" },
    { Status::InvalidNeighborhood, "needs at least 1 neighbour, or a radius above 0" },
    { Status::InvalidRadiusBounds, "must be finite, not negative, and r1 not above r2" },
    { Status::DegenerateSample, "give at least two distinct values" },
    { Status::EquationUnsolved, "use another rule" }, { Status::InvalidParameter, "give a value within it" },
    { Status::Aborted, "start it again" }, { Status::DeviceNotOpen, "call open() first" },
    { Status::EndOfPath, "open the device again" }, { Status::FileNotReadable, "check its name" },
    { Status::FileMalformed, "check what wrote it" }, { Status::FileNotWritable, "check the folder" },
    { Status::DeviceNotFound, "check its cable" }, { Status::DeviceNotPermitted, "install the udev rule" },
    { Status::DeviceNotReady, "wait while it starts" }, { Status::DeviceLost, "plug it in again" },
    { Status::DeviceSilent, "check its power supply" }, { Status::DeviceBadReply, "check its cable" },
    { Status::FirmwareMissing, "name the file" }, { Status::FirmwareNotTaken, "check the file" },
    { Status::NotPassive, "use less of them" }, { Status::RateNotSupported, "use a lower rate" },
    { Status::PointsTooFar, "leave out those that are far" } };
  for (int value = 1; value <= int(Status::PointsTooFar); ++value)
  {
    const auto cure = cures.find(Status(value));
    ASSERT_NE(cure, cures.end()) << value << " has no cure: " << message(Status(value));
    EXPECT_NE(std::string(message(Status(value))).find(cure->second), std::string::npos)
      << "no '" << cure->second << "' in: " << message(Status(value));
  }
}

TEST(Status, SentencesKnowNoProgram)
{
  for (int value = 0; value <= int(Status::PointsTooFar); ++value)
  {
    EXPECT_EQ(std::string(message(Status(value))).find("--"), std::string::npos)
      << "an option of a program in: " << message(Status(value));
  }
}

TEST(Status, SentenceOfAnUnknownValueSaysSo)
{
  EXPECT_STREQ(message(Status(12345)), "unknown status");
}
