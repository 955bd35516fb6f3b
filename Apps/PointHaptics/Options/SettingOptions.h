/// @file
/// From the members of a settings struct (Core/Base/SettingsMembers.h) to options of the program: tables that
/// say how a user gives each member, or why not, and the function that adds the options.
#pragma once

#include "Options/OptionParsing.h"

#include "Core/Bandwidth/BandwidthSettings.h"
#include "Core/Base/SettingsMembers.h"
#include "Core/Resample/VoxelMeanSettings.h"
#include "Haptics/HapticParameters.h"

#include <CLI/CLI.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace pointhaptics::app
{

/// How a member is given on the command line, and by the option's name in a configuration file.
struct SettingOption
{
  const char* member;     ///< As the struct lists it.
  const char* option;     ///< Such as "--beta". Null: it has none, and text says why.
  const char* text;       ///< For --help.
  const char* form = "";  ///< Unit of the value, for --help.
  NumberRange range = {}; ///< Range of numbers.
};

/// True if @p table has a row for each member of @p Settings, in the order of its list. To be asserted at
/// compile time beside each table: whoever adds a member decides here how a user gives it.
template <typename Settings, std::size_t Count>
constexpr bool describesEveryMember(const SettingOption (&table)[Count])
{
  if (Count != numberOfMembers<Settings>)
  {
    return false;
  }
  return std::apply(
    [&](const auto&... member)
    {
      std::size_t i = 0;
      bool same = true;
      ((same = same && std::string_view(member.name) == table[i].member, ++i), ...);
      return same;
    },
    Settings::members());
}

constexpr const char* kMetres = "METRES"; ///< Form of an option that takes a length.

inline constexpr SettingOption kLatticeOptions[] = {
  { "dimensions", "--dims", "Voxels on each axis of the lattice; default 300", "N|Nx,Ny,Nz" },
  { "voxelSize", "--voxel", "Edge of a cubic voxel, instead of --dims", kMetres, { 0.0, kUnbounded, true } },
  { "automaticWorkspace", nullptr, "cleared by --workspace" },
  { "workspace", "--workspace", "Box of the lattice; default: a cube about the transformed cloud",
    "x0,x1,y0,y1,z0,z1" },
};
static_assert(describesEveryMember<LatticeSettings>(kLatticeOptions));

constexpr NumberRange kLength{ 0.0, kUnbounded, true };
constexpr NumberRange kNeighbors{ 1.0, double(std::numeric_limits<int>::max()) };
constexpr const char* kByCommand = "the command knows which arrays it needs";

inline constexpr SettingOption kBandwidthOptions[] = {
  { "fixedRadius", nullptr, "set by --radius and cleared by --neighbors" },
  { "numberOfNeighbors", "--neighbors", "Nearest neighbours the spread is taken from; default 16", "N",
    kNeighbors },
  { "radius", "--radius", "All points in a ball of this radius, instead of --neighbors", kMetres, kLength },
  { "rule", "--rule", "From spread to bandwidth; default normal-reference" },
  { "radiusScale", "--beta", "Proxy radius over bandwidth; default 4", "B", { 0.0, 1e6, true } },
  { "minimumRadius", "--r1", "Smallest proxy radius; default 2.2 local spacings", kMetres, kLength },
  { "maximumRadius", "--r2", "Largest proxy radius; default none", kMetres, kLength },
  { "smoothRadius", "--smooth",
    "Cut radii so that no two differ by more than half the distance of their points" },
  { "usePointCounts", nullptr, "the radius is to follow the density of the points, never that of the means" },
  { "densityKernel", nullptr, "--density of the command bandwidth, beside computeDensity" },
  { "computeBandwidth", nullptr, kByCommand },
  { "computeProxyRadius", nullptr, kByCommand },
  { "computeDensity", nullptr, kByCommand },
  { "computeMeanBandwidth", nullptr, kByCommand },
};
static_assert(describesEveryMember<BandwidthSettings>(kBandwidthOptions));

constexpr NumberRange kFriction{ 0.0, 10.0 };
constexpr NumberRange kForceLimits{ 0.0, std::numeric_limits<double>::infinity(), true };
inline constexpr SettingOption kTouchOptions[] = {
  { "method", "--method",
    "How the proxy meets the surface: a fit (the default), a sphere among the points, or the paper's steps" },
  { "contact", nullptr, "its members have options of their own" },
  { "gradientSteps", "--preset",
    "Gains of --method gradient-steps; default tuned, paper for the printed ones" },
};
static_assert(describesEveryMember<HapticParameters>(kTouchOptions));

inline constexpr SettingOption kContactOptions[] = {
  { "stiffness", "--stiffness", "Stiffness of the surface; default 800", "N_PER_M", { 0.0, 1e5 } },
  { "damping", "--damping", "Of the hand's speed along the normal, in contact; default 0", "N_S_PER_M",
    { 0.0, 1e3 } },
  { "staticFriction", "--mu-s", "Static friction; default that of --mu-d", "X", kFriction },
  { "dynamicFriction", "--mu-d", "Dynamic friction; default 0", "X", kFriction },
  { "settleRate", nullptr, "a guard against kicks that nobody has had a reason to change" },
  { "deviceDamping", nullptr, "a property of the device, which tells it by its limits" },
  { "forceLimit", "--force-limit",
    "The force never exceeds this, fades where the hand is far from its contact, and lets it go; above 0, "
    "inf: "
    "none, in virtual time only; default 8",
    "N", kForceLimits },
};
static_assert(describesEveryMember<ContactParameters>(kContactOptions));

///@{
/// Adds the option of @p row, which sets @p member; there is an overload for each type that has a form on the
/// command line. A flag sets a member that is false, and clears one that is true.
inline CLI::Option* addSetting(CLI::App& command, const SettingOption& row, double& member)
{
  return addNumber(command, row.option, member, row.range, row.form, row.text);
}
CLI::Option* addSetting(CLI::App& command, const SettingOption& row, int& member);
CLI::Option* addSetting(CLI::App& command, const SettingOption& row, bool& member);
CLI::Option* addSetting(CLI::App& command, const SettingOption& row, BandwidthRule& rule);
CLI::Option* addSetting(CLI::App& command, const SettingOption& row, ProxyMethod& method);
CLI::Option* addSetting(CLI::App& command, const SettingOption& row, GradientStepsParameters& steps);
CLI::Option* addSetting(CLI::App& command, const SettingOption& row, std::array<std::int64_t, 3>& dimensions);
CLI::Option* addSetting(CLI::App& command, const SettingOption& row, Bounds& box);
///@}

/// Refuses a type without a form on the command line: @p row must name no option.
template <typename Member>
CLI::Option* addSetting(CLI::App&, const SettingOption& row, Member&)
{
  throw std::logic_error(std::string(row.option) + ": its type needs an overload of addSetting()");
}

/// Adds the options of @p table to @p group of the help.
template <typename Settings, std::size_t Count>
void addSettings(
  CLI::App& command, Settings& settings, const SettingOption (&table)[Count], const std::string& group)
{
  std::size_t i = 0;
  const OptionGroup inGroup(command, group);
  visitMembers(settings,
    [&](const char*, auto& member)
    {
      const SettingOption& row = table[i++];
      if (row.option)
      {
        addSetting(command, row, member);
      }
    });
}

} // namespace pointhaptics::app
