/// @file
/// Options as a JSON object: --config reads it, and `view` writes what was given and what the window changed.
#pragma once

#include "Options/Files.h"
#include "Options/SharedOptions.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace pointhaptics
{

struct HapticViewerOptions;
struct HapticViewerState;

namespace app
{

/// Long names of the options a configuration file may set, without the dashes.
std::vector<std::string> configurableNames(CLI::App& command);

/// Takes the values of @p settings, each NAME=VALUE with a name of configurableNames(), for the options of
/// @p command that the command line does not give, and the @p files that they name. Ends in a usage error.
void applySettings(CLI::App& command, const std::vector<std::string>& settings, Files& files);

/// Takes the values of the JSON file. Keys among @p ignored are of another command, and mean nothing here.
/// Ends in a usage error where a key or a value is wrong. @throws Failure where the file cannot be read.
void applyConfigFile(
  CLI::App& command, const std::string& fileName, const std::vector<std::string>& ignored, Files& files);

/// Takes how the cloud of a recording was read, cut and turned from @p settings, a configuration in one line.
/// An axis that was chosen for @p viewer stays.
void takeRecordedReading(const std::string& settings, HapticViewerOptions& viewer);

/// Every option of @p command that has a value, by its long name; files that are written and the options
/// about configuration itself are left out: they are deeds, not state.
nlohmann::ordered_json givenSettings(CLI::App& command);

/// Puts @p state in place of the options that led to it; but --unit, of @p metresPerUnit, stays what it is,
/// for the axes, unless the state has another.
void setState(nlohmann::ordered_json& settings, const HapticViewerState& state, double metresPerUnit);

/// @throws Failure where the file cannot be written.
void writeSettings(const nlohmann::ordered_json& settings, const std::string& fileName);

/// Sets what is felt in @p viewer: where the cloud lies, its lattice, the radius; and the names of options.
void setFelt(HapticViewerOptions& viewer, const LatticeOptions& lattice, const BandwidthOptions& bandwidth,
  bool noCovariance);

/// $XDG_STATE_HOME/pointhaptics/view.json, in ~/.local/state where that is not set. Empty without a home.
std::string recentSettingsFile();

/// The axis that points up in @p file, as keepUp() kept it beside recentSettingsFile(); "": none was kept.
std::string keptUp(const std::string& file);
void keepUp(const std::string& file, const std::string& axis);

/// Writes to recentSettingsFile() what is worth keeping for another cloud: all but model, lattice and paths.
/// A state that cannot be kept is no reason to complain.
void rememberSettings(nlohmann::ordered_json settings);

} // namespace app
} // namespace pointhaptics
