/// @file
/// The state of `view` as a JSON object that --config reads: what was given, and what the window changed.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace CLI
{
class App;
}

namespace pointhaptics
{

struct HapticViewerState;

namespace app
{

/// Every option of @p command that has a value, by its long name; files that are written and the options
/// about configuration itself are left out: they are deeds, not state.
nlohmann::ordered_json givenSettings(CLI::App& command);

/// Puts @p state in place of the options that led to it; but --unit, of @p metresPerUnit, stays what it is,
/// for the axes, unless the state has another.
void setState(nlohmann::ordered_json& settings, const HapticViewerState& state, double metresPerUnit);

/// False: @p message says why the file cannot be written.
bool writeSettings(const nlohmann::ordered_json& settings, const std::string& fileName, std::string& message);

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
