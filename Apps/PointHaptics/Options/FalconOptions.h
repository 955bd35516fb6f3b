/// @file
/// --falcon-firmware --max-force: the same wherever a Falcon is used.
#pragma once

#include "Devices/Falcon/FalconUpdates.h"

#include <string>

namespace CLI
{
class App;
}

namespace pointhaptics::app
{

/// For openProblem().
constexpr const char* kFirmwareOption = "--falcon-firmware FILE";

struct FalconOptions
{
  std::string firmware;
  double maximumForce = 4.0;

  void addTo(CLI::App& command);
  /// The limit of the Falcon's force, where it is given, is one of what is felt without a Falcon too.
  void complete(const CLI::App& command, ContactParameters& contact) const;
  /// Its start ends at a remembered signal (StopSignals.h).
  FalconSettings settings() const;
};

} // namespace pointhaptics::app
