/// @file
/// `devices --diagnose`: checks that need a Falcon and its owner.
#pragma once

#include "Devices/Falcon/FalconUpdates.h"

#include <string>

namespace pointhaptics::app
{

/// Walks through LEDs, homing, encoder directions, rate, and motors with at most 0.5 N, asking on the
/// terminal; writes @p reportFile line by line, so that it holds what was found however this ends. @p yes:
/// asks nothing, and leaves out what a person must do (encoder directions). @throws Failure that says what
/// failed, how many checks found something wrong, or that it was stopped by a signal.
void diagnoseFalcon(const FalconSettings& settings, const std::string& reportFile, bool yes);

} // namespace pointhaptics::app
