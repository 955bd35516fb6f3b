// Clouds whose lengths mean nothing: degrees, and points far from all others.
#include "RunProgram.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace
{

using namespace pointhaptics;
using apptest::parseTable;

class Lengths : public apptest::CommandLine
{
};

TEST_F(Lengths, DegreesAreFeltInMetresAndNotResampled)
{
  std::string rows;
  for (int i = 0; i < 2500; ++i)
  {
    rows += fmt::format("{:.9f} {:.9f} 40\n", 8.0 + 4e-6 * (i % 50), 50.0 + 2.5e-6 * (i / 50));
  }
  const std::string header = "ply\nformat ascii 1.0\ncomment LengthUnit degree\nelement vertex 2500\n"
                             "property double x\nproperty double y\nproperty double z\nend_header\n";
  this->write("degrees.ply", header + rows);
  this->write("path.csv", "t,x,y,z\n0,0,0,40.5\n0.5,0,0,39.99\n");
  const auto said =
    this->run({ "feel", "degrees.ply", "--path", "path.csv", "--voxel", "0.5", "-o", "f.csv" });
  EXPECT_EQ(said.exitCode, 0) << said.errors;
  EXPECT_NE(said.errors.find("degrees of longitude and latitude"), std::string::npos) << said.errors;
  EXPECT_GT(parseTable(this->read("f.csv")).at("force_z").back(), 0.5) << "14 m of ground under the hand";
  const auto refused = this->run({ "resample", "degrees.ply", "-o", "o.ply" });
  EXPECT_EQ(refused.exitCode, 1);
  EXPECT_NE(
    refused.errors.find("project the cloud to metres, or give metres a degree and of a unit of height: "
                        "--scale 71474.7,111195,1"),
    std::string::npos)
    << refused.errors;
  EXPECT_FALSE(this->exists("o.ply"));
  EXPECT_EQ(this->run({ "resample", "degrees.ply", "--scale", "71000,111000,1", "-o", "o.ply" }).exitCode, 0);
  std::filesystem::remove(this->path("o.ply"));
  const std::string stretched = "1,0,0,0,0,1,0,0,0,0,0.001,0,0,0,0,1"; // of z alone
  for (const std::vector<std::string>& words : { std::vector<std::string>{ "resample", "--unit", "ft" },
         std::vector<std::string>{ "resample", "--matrix", stretched },
         std::vector<std::string>{ "bandwidth" } })
  {
    std::vector<std::string> all = words;
    all.insert(all.end(), { "degrees.ply", "-o", "o.ply" });
    const auto outcome = this->run(all);
    EXPECT_EQ(outcome.exitCode, 1) << words.back();
    EXPECT_NE(outcome.errors.find("x and y are degrees and z is a length"), std::string::npos)
      << outcome.errors;
  }
  EXPECT_FALSE(this->exists("o.ply"));
}

TEST_F(Lengths, TheCureForDegreesWorksNearThePoles)
{
  this->write(
    "pole.csv", "longitude,latitude,alt\n8.5,89.9999999,100\n8.51,89.9999998,101\n8.52,89.9999997,102\n");
  const std::string errors = this->run({ "resample", "pole.csv", "-o", "o.ply" }).errors;
  const std::size_t at = errors.find("--scale ");
  ASSERT_NE(at, std::string::npos) << errors;
  const std::string scale = errors.substr(at + 8, errors.find_first_of(" \n", at + 8) - at - 8);
  EXPECT_EQ(this->run({ "resample", "pole.csv", "--scale", scale, "-o", "o.ply" }).exitCode, 0) << scale;
  this->write(
    "date.csv", "longitude,latitude,alt\n179.999,10,100\n-179.999,10.001,101\n179.9995,10.002,102\n");
  const std::string across = this->run({ "resample", "date.csv", "-o", "o.ply" }).errors;
  EXPECT_NE(across.find("both sides of 180 degrees"), std::string::npos) << across;
  EXPECT_EQ(across.find("--scale"), std::string::npos);
}

TEST_F(Lengths, UnitsOfTheFileEndWithTheirCoordinates)
{
  this->write("in.csv", "lon,lat,height [ft]\n8.5,49.1,300\n8.6,49.2,301\n8.7,49.3,302\n");
  ASSERT_EQ(this->run({ "resample", "in.csv", "--scale", "73000,111000,0.3048", "-o", "o.vtp" }).exitCode, 0);
  EXPECT_EQ(this->read("o.vtp").find("HeightUnit"), std::string::npos);
  this->write("ft.csv", "x [ft],y [ft],z [ft]\n8.5,49.1,300\n8.6,49.2,301\n8.7,49.3,302\n");
  this->run({ "bandwidth", "ft.csv", "--unit", "m", "-o", "o.vtp" });
  EXPECT_NE(this->succeed({ "info", "o.vtp" }).find("unit     m (the file says so)"), std::string::npos);
}

TEST_F(Lengths, BandwidthsSayThatPointsAreFar)
{
  this->succeed({ "generate", "sphere", "-n", "3000", "-o", "good.xyz" });
  this->write("far.xyz", this->read("good.xyz") + "900 900 900 0 0 1\n");
  const auto outcome = this->run({ "bandwidth", "far.xyz", "-o", "o.vtp" });
  EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
  EXPECT_NE(outcome.errors.find("1 of 3,001 points is far from all others"), std::string::npos)
    << outcome.errors;
  EXPECT_EQ(this->run({ "bandwidth", "good.xyz", "-o", "o.vtp" }).errors, "");
}

TEST_F(Lengths, BallsThatHoldTheWholeCloudAreRefused)
{
  this->succeed({ "generate", "sphere", "-n", "1100000", "-o", "big.ply" });
  this->refuse(1, { "bandwidth", "big.ply", "--radius", "100", "-o", "o.vtp" },
    { "hold 1100000 points each", "give a smaller radius" });
  EXPECT_FALSE(this->exists("o.vtp"));
}

} // namespace
