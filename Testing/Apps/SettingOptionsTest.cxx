#include "Options/SettingOptions.h"

#include "View/ViewCommand.h"
#include "View/ViewSettings.h"

#include "../Unit/ChangedSettings.h"

#include "Core/Resample/VoxelMeanSettings.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <set>
#include <string>
#include <vector>

using namespace pointhaptics;
using namespace pointhaptics::app;

namespace
{

constexpr const char* kCostOnly = "changes the cost only; for programs and measurements";

/// How the other settings of a resampling are given: none has an option of every command.
inline constexpr SettingOption kVoxelMeanOptions[] = {
  { "lattice", nullptr, "its members have options of their own" },
  { "outputPointsPrecision", nullptr, "the file's, and double where the cloud is felt" },
  { "computeCovariance", nullptr, "--covariance of resample, --no-covariance of feel and view" },
  { "passAttributes", nullptr, "only feel has no use for them" },
  { "categoricalArrays", nullptr, "the labels of LAS are known; others are named by programs" },
  { "exactCategoricalNames", nullptr, "the labels of LAS are known" },
  { "representative", nullptr, "--representative of resample: what is felt are means" },
  { "minimumPointsPerVoxel", nullptr, "--minimum-points of resample" },
  { "computeVoxelIndex", nullptr, "--voxel-index of resample" },
  { "keepOriginalPointIds", nullptr, "--original-ids of resample" },
  { "usePointIndex", nullptr, kCostOnly },
  { "instructionSet", nullptr, kCostOnly },
};
static_assert(describesEveryMember<VoxelMeanSettings>(kVoxelMeanOptions));

/// `view cloud.ply ...`, parsed and completed.
struct Parsed
{
  explicit Parsed(std::vector<std::string> arguments, const nlohmann::ordered_json& configuration = {})
  {
    // Tests run at once.
    const std::string file =
      ::testing::TempDir() + ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".json";
    options.addTo(command);
    if (!configuration.empty())
    {
      writeSettings(configuration, file);
      arguments.insert(arguments.end(), { "--config", file });
    }
    arguments.insert(arguments.begin(), "cloud.ply");
    std::reverse(arguments.begin(), arguments.end());
    command.parse(arguments);
    Files files;
    options.complete(command, files);
  }

  CLI::App command{ "", "view" };
  ViewCommand options;
};

bool equal(const ViewCommand& a, const ViewCommand& b)
{
  return equalSettings(a.viewer.voxels, b.viewer.voxels) &&
    equalSettings(a.viewer.bandwidth, b.viewer.bandwidth) &&
    equalSettings(a.viewer.haptics, b.viewer.haptics);
}

template <typename Value>
bool isEqual(const Value& a, const Value& b)
{
  if constexpr (isSettings<Value>)
  {
    return equalSettings(a, b);
  }
  else
  {
    return a == b;
  }
}

/// Names of the members that are not equal.
template <typename Settings>
std::set<std::string> differing(const Settings& a, const Settings& b)
{
  std::set<std::string> names;
  const auto compare = [&](const auto& member)
  {
    if (!isEqual(a.*(member.pointer), b.*(member.pointer)))
    {
      names.insert(member.name);
    }
  };
  std::apply([&](const auto&... member) { (compare(member), ...); }, Settings::members());
  return names;
}

/// A value in the form of the command line that is not the default.
const std::map<std::string, std::string>& values()
{
  static const std::map<std::string, std::string> table = { { "--dims", "100,50,25" }, { "--voxel", "0.002" },
    { "--workspace", "0,1,0,2,0,3" }, { "--neighbors", "20" }, { "--radius", "0.002" }, { "--rule", "scott" },
    { "--beta", "3" }, { "--r1", "0.001" }, { "--r2", "0.01" }, { "--smooth", "" }, { "--method", "sphere" },
    { "--preset", "paper" }, { "--stiffness", "500" }, { "--damping", "1.5" }, { "--mu-s", "0.5" },
    { "--force-limit", "3" }, { "--mu-d", "0.25" } };
  return table;
}

/// Gives each option of @p table on the command line, and then by the configuration file that is written of
/// it. @p settings is what of the viewer's options @p table is about.
template <typename Settings, std::size_t Count, typename Find>
void walk(const SettingOption (&table)[Count], Find settings)
{
  Settings untouched = settings(Parsed({}).options);
  std::vector<std::string> names;
  visitMembers(untouched, [&](const char* name, const auto&) { names.emplace_back(name); });
  for (std::size_t i = 0; i < Count; ++i)
  {
    const SettingOption& row = table[i];
    SCOPED_TRACE(row.member);
    EXPECT_EQ(names[i], row.member);
    EXPECT_GT(std::strlen(row.text), 10u) << "a help text, or why there is no option";
    if (!row.option)
    {
      continue;
    }
    const auto value = values().find(row.option);
    ASSERT_NE(value, values().end()) << "give " << row.option << " a value in this test";
    std::vector<std::string> arguments = { row.option };
    if (!value->second.empty())
    {
      arguments.push_back(value->second);
    }
    const Parsed given(arguments);
    const Settings& changed = settings(given.options);
    EXPECT_EQ(differing(untouched, changed).count(row.member), 1u) << row.option;
    EXPECT_EQ(given.options.given.count(std::string(row.option).substr(2)), 1u);
    const Parsed again({}, given.options.given);
    EXPECT_TRUE(equal(given.options, again.options)) << given.options.given.dump();
  }
}

TEST(SettingOptions, OfTheLatticeReachTheViewerFromCommandLineAndConfiguration)
{
  walk<LatticeSettings>(
    kLatticeOptions, [](const ViewCommand& o) -> const LatticeSettings& { return o.viewer.voxels.lattice; });
}

TEST(SettingOptions, OfTheResamplingReachTheViewerFromCommandLineAndConfiguration)
{
  walk<VoxelMeanSettings>(
    kVoxelMeanOptions, [](const ViewCommand& o) -> const VoxelMeanSettings& { return o.viewer.voxels; });
  EXPECT_TRUE(Parsed({}).options.viewer.voxels.computeCovariance);
  const Parsed plain({ "--no-covariance" });
  EXPECT_FALSE(plain.options.viewer.voxels.computeCovariance);
  EXPECT_TRUE(equal(plain.options, Parsed({}, plain.options.given).options));
}

TEST(SettingOptions, OfTheBandwidthReachTheViewerFromCommandLineAndConfiguration)
{
  walk<BandwidthSettings>(
    kBandwidthOptions, [](const ViewCommand& o) -> const BandwidthSettings& { return o.viewer.bandwidth; });
  EXPECT_TRUE(Parsed({ "--radius", "0.002" }).options.viewer.bandwidth.fixedRadius);
  EXPECT_FALSE(Parsed({ "--neighbors", "20" }).options.viewer.bandwidth.fixedRadius);
}

TEST(SettingOptions, OfTheTouchReachTheViewerFromCommandLineAndConfiguration)
{
  walk<HapticParameters>(
    kTouchOptions, [](const ViewCommand& o) -> const HapticParameters& { return o.viewer.haptics; });
  walk<ContactParameters>(kContactOptions,
    [](const ViewCommand& o) -> const ContactParameters& { return o.viewer.haptics.contact; });
}

TEST(SettingOptions, OfTheContactComeBackFromWhatTheWindowWrites)
{
  forEachChange(ContactParameters(),
    [](const std::string& name, ContactParameters changed)
    {
      changed.staticFriction = std::max(changed.staticFriction, changed.dynamicFriction);
      nlohmann::ordered_json written = nlohmann::ordered_json::object();
      setContact(written, changed);
      const ContactParameters& read = Parsed({}, written).options.viewer.haptics.contact;
      for (const SettingOption& row : kContactOptions)
      {
        if (name == row.member)
        {
          EXPECT_EQ(equalSettings(read, changed), row.option != nullptr) << name;
        }
      }
    });
}

TEST(SettingOptions, LeaveTheVoxelsToTheViewerWhereNobodyChoseThem)
{
  EXPECT_FALSE(Parsed({ "--workspace", "0,1,0,1,0,1" }).options.viewer.hasVoxels());
  EXPECT_TRUE(Parsed({ "--dims", "300" }).options.viewer.hasVoxels()) << "the default, but chosen";
  EXPECT_TRUE(Parsed({ "--voxel", "0.001" }).options.viewer.hasVoxels());
}

} // namespace
