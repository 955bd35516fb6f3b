/// @file
/// --neighbors --radius --rule --beta --r1 --r2 --smooth: the same wherever a proxy radius is computed.
#pragma once

#include "Core/Bandwidth/BandwidthSettings.h"

namespace CLI
{
class App;
}

namespace pointhaptics::app
{

struct BandwidthOptions
{
  BandwidthSettings settings; ///< With what was given.

  /// Adds the options to @p command; bad values, r1 > r2 among them, end the parse with a usage error.
  void addTo(CLI::App& command);
};

} // namespace pointhaptics::app
