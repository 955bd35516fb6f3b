#include "Options/SettingOptions.h"

#include "View/ViewCommand.h"
#include "View/ViewSettings.h"

#include "Core/Base/SettingsMembers.h"

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
    { "--beta", "3" }, { "--r1", "0.001" }, { "--r2", "0.01" }, { "--method", "sphere" },
    { "--preset", "paper" }, { "--stiffness", "500" }, { "--damping", "1.5" }, { "--mu-s", "0.5" },
    { "--force-limit", "3" }, { "--mu-d", "0.25" } };
  return table;
}

/// Gives each option of the members of @p Settings on the command line, and then by the configuration file
/// that is written of it. @p settings: what of the viewer's options they set.
template <typename Settings, typename Find>
void walk(Find settings)
{
  const Settings untouched = settings(Parsed({}).options);
  const auto give = [&](const char* member, const SettingOption& row)
  {
    SCOPED_TRACE(member);
    if (!row.name)
    {
      return;
    }
    EXPECT_GT(std::strlen(row.help), 10u);
    const auto value = values().find(row.name);
    ASSERT_NE(value, values().end()) << "give " << row.name << " a value in this test";
    std::vector<std::string> arguments = { row.name };
    if (!value->second.empty())
    {
      arguments.push_back(value->second);
    }
    const Parsed given(arguments);
    const Settings& changed = settings(given.options);
    EXPECT_EQ(differing(untouched, changed).count(member), 1u) << row.name;
    EXPECT_EQ(given.options.given.count(std::string(row.name).substr(2)), 1u);
    const Parsed again({}, given.options.given);
    EXPECT_TRUE(equal(given.options, again.options)) << given.options.given.dump();
  };
  std::apply([&](const auto&... member) { (give(member.name, member.option), ...); }, Settings::members());
}

TEST(SettingOptions, ReachTheViewerFromCommandLineAndConfiguration)
{
  using O = ViewCommand;
  walk<LatticeSettings>([](const O& o) -> const LatticeSettings& { return o.viewer.voxels.lattice; });
  walk<BandwidthSettings>([](const O& o) -> const BandwidthSettings& { return o.viewer.bandwidth; });
  walk<HapticParameters>([](const O& o) -> const HapticParameters& { return o.viewer.haptics; });
  walk<ContactParameters>([](const O& o) -> const ContactParameters& { return o.viewer.haptics.contact; });
}

TEST(SettingOptions, SetMembersThatAreNotTheirOwn)
{
  EXPECT_TRUE(Parsed({}).options.viewer.voxels.computeCovariance);
  const Parsed plain({ "--no-covariance" });
  EXPECT_FALSE(plain.options.viewer.voxels.computeCovariance);
  EXPECT_TRUE(equal(plain.options, Parsed({}, plain.options.given).options));
  EXPECT_TRUE(Parsed({ "--radius", "0.002" }).options.viewer.bandwidth.fixedRadius);
  EXPECT_FALSE(Parsed({ "--neighbors", "20" }).options.viewer.bandwidth.fixedRadius);
}

TEST(SettingOptions, OfTheContactComeBackFromWhatTheWindowWrites)
{
  const Parsed given(
    { "--stiffness", "500", "--damping", "1.5", "--mu-s", "0.5", "--mu-d", "0.25", "--force-limit", "3" });
  nlohmann::ordered_json written = nlohmann::ordered_json::object();
  setContact(written, given.options.viewer.haptics.contact);
  EXPECT_EQ(written.size(), 5u);
  EXPECT_TRUE(equal(given.options, Parsed({}, written).options));
}

TEST(SettingOptions, LeaveTheVoxelsToTheViewerWhereNobodyChoseThem)
{
  EXPECT_FALSE(Parsed({ "--workspace", "0,1,0,1,0,1" }).options.viewer.hasVoxels());
  EXPECT_TRUE(Parsed({ "--dims", "300" }).options.viewer.hasVoxels()) << "the default, but chosen";
  EXPECT_TRUE(Parsed({ "--voxel", "0.001" }).options.viewer.hasVoxels());
}

} // namespace
