/// @file
/// Messages of the servo loop about refused springs and rates.
#pragma once

#include "Core/Base/Status.h"
#include "Haptics/HapticParameters.h"
#include "Haptics/Servo/PassivityLimit.h"

#include <string>

namespace pointhaptics
{

/// @p status itself, with the limit in @p message (where given) where a spring or a rate is refused.
Status explained(Status status, const HandLimits& limits, const ContactParameters& contact, double rateHz,
  std::string* message);

} // namespace pointhaptics
