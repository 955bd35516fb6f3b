/// @file
/// Lengths, forces and counts as a person reads them: with their unit, and at most four digits.
#pragma once

#include <cstdint>
#include <string>

namespace pointhaptics
{

/// "12 m", "0.31 mm", "45 um": @p digits significant digits, 1 to 3, in the unit (km, m, mm, um, nm, pm) in
/// which the number is from 0.1 to 999; "0 mm" for zero. What is not finite is called "unknown".
std::string lengthText(double metres, int digits = 3);

/// Text of a length in @p unitName, of @p metresPerUnit, where the number is from 0.1 to 999 in that unit;
/// else as lengthText(metres).
std::string lengthText(double metres, const std::string& unitName, double metresPerUnit, int digits = 3);

/// "12,200", "2.22": rounded to @p digits significant digits, with a comma for each thousand; from 1e15 on
/// with an exponent. @pre above 0.
std::string ratioText(double ratio, int digits = 3);

/// "543,652".
std::string countText(std::int64_t count);

/// "5,032 points at (0, 0, 0), which scanners write for rays without return," are something: areNoReturns().
std::string noReturnsText(std::int64_t count);

} // namespace pointhaptics
