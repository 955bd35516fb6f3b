/// @file
/// --projection --background --point-scale --edl-strength --font-scale: how the viewer draws, whatever the
/// cloud is.
#pragma once

#include "PictureSettings.h"

#include <nlohmann/json.hpp>

namespace CLI
{
class App;
}

namespace pointhaptics::app
{

/// Adds the options to @p command; bad values end the parse with a usage error. Those that keys do too get
/// their help from describeKeyedOptions().
void addPictureOptions(CLI::App& command, PictureSettings& picture);

/// Puts @p picture in @p settings, by the names of the options; what is as if it were never asked for is left
/// out.
void setPicture(nlohmann::ordered_json& settings, const PictureSettings& picture);

/// The setting @p name becomes @p value, as the last one, or goes where that is empty: then nobody chose any.
template <typename Value>
void setUnlessEmpty(nlohmann::ordered_json& settings, const char* name, const Value& value)
{
  settings.erase(name);
  if (!value.empty())
  {
    settings[name] = value;
  }
}

} // namespace pointhaptics::app
