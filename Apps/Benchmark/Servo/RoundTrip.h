/// @file
/// How long a command and its answer take through libusb, with an emulated Falcon at the other end.
#pragma once

#include "Benchmark/Report/Report.h"

namespace pointhaptics
{
namespace bench
{
namespace servo
{

/// The program that the tests build where umockdev is found; it lies beside this one.
constexpr const char* kRoundTripProgram = "PointHapticsRoundTrip";

/// Runs that program for @p seconds and fills @p part. False where it is not there. @p right becomes false
/// where it failed, or an answer was lost or wrong.
bool roundTripStudy(double seconds, ReportPart& part, bool& right);

} // namespace servo
} // namespace bench
} // namespace pointhaptics
