/// @file
/// `devices --diagnose`: what only a Falcon and its owner can confirm.
#pragma once

#include "HandDevice.h"

#include <string>

namespace pointhaptics
{
namespace app
{

/// Walks through lights, homing, encoder directions, rate, and motors with at most 0.5 N, asking on the
/// terminal; writes @p reportFile, also where a check failed half way. @p yes: asks nothing. False: @p
/// message says what failed; checks that found something wrong are in the report, not an error.
bool diagnoseFalcon(
  const FalconOptions& options, const std::string& reportFile, bool yes, std::string& message);

} // namespace app
} // namespace pointhaptics
