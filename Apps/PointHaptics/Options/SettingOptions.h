/// @file
/// Options of the program from the list of a settings struct (Core/Base/SettingsMembers.h).
#pragma once

#include "Options/OptionParsing.h"

#include "Core/Bandwidth/BandwidthSettings.h"
#include "Core/Base/Lattice.h"
#include "Haptics/HapticParameters.h"

#include <CLI/CLI.hpp>

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <tuple>

namespace pointhaptics::app
{

///@{
/// Adds the option of @p row, which sets @p member; there is an overload for each type that has a form on the
/// command line. A flag sets a member that is false, and clears one that is true.
inline CLI::Option* addSetting(CLI::App& command, const SettingOption& row, double& member)
{
  return addNumber(command, row.name, member, row.range, row.form, row.help);
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
  throw std::logic_error(std::string(row.name) + ": its type needs an overload of addSetting()");
}

/// Adds the options of @p settings, whose members they set, to @p group of the help.
template <typename Settings>
void addSettings(CLI::App& command, Settings& settings, const std::string& group)
{
  const OptionGroup inGroup(command, group);
  const auto add = [&](const SettingOption& row, auto& member)
  {
    if (row.name)
    {
      addSetting(command, row, member);
    }
  };
  std::apply([&](const auto&... member) { (add(member.option, settings.*(member.pointer)), ...); },
    Settings::members());
}

} // namespace pointhaptics::app
