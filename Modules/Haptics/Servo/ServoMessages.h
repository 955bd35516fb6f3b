/// @file
/// Check of a servo loop's spring, with the limit that refuses it.
#pragma once

#include "Core/Base/Status.h"
#include "Haptics/HapticParameters.h"
#include "Haptics/Servo/PassivityLimit.h"

#include <string>

namespace pointhaptics
{

/// Ok; InvalidParameter where @p isValid is false or @p parameters are not; else what checkPassive() says of
/// their spring. @p message, where given, names the limit.
Status checkSpring(bool isValid, const HandLimits& limits, const HapticParameters& parameters, double rateHz,
  std::string* message);

} // namespace pointhaptics
