/// @file
/// --method --preset --stiffness --damping --mu-s --mu-d: the same wherever a cloud is felt.
#pragma once

#include "Haptics/HapticParameters.h"

#include <nlohmann/json.hpp>

namespace CLI
{
class App;
}

namespace pointhaptics::app
{

struct TouchOptions
{
  HapticParameters parameters; ///< With what was given.

  /// Adds the options to @p command; bad values end the parse with a usage error.
  void addTo(CLI::App& command);
  /// Completes values once all options of @p command are known: mu_s where only mu_d is given. Ends in a
  /// usage error where they contradict each other; warns of one that has no effect.
  void complete(const CLI::App& command);
};

/// Ends in a usage error where the force limit is beyond what a servo loop may push with. @p cure: another
/// cure than a lower limit, ", or ...".
void checkForceLimitOfDevices(const ContactParameters& contact, const std::string& cure);

/// Puts the members of @p contact in @p settings, by the names of their options.
void setContact(nlohmann::ordered_json& settings, const ContactParameters& contact);

} // namespace pointhaptics::app
