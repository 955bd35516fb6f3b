/// @file
/// `pointhaptics bench io --studies packed`: how fast compressed and packed files of laser scanners are read.
#pragma once

#include "Benchmark/Report/Report.h"

#include <cstdint>

namespace pointhaptics
{
namespace bench
{

struct RaceSettings;

namespace io
{

class Files;

/// Points a second of our reader, on two threads, beside the same points uncompressed and beside the bytes.
/// The cloud is a made-up survey: scan lines over hills. @param allRight becomes false where a coordinate
/// differs from that of the uncompressed file.
ReportPart studyPacked(std::int64_t points, const RaceSettings& settings, const Files& files, bool& allRight);

} // namespace io
} // namespace bench
} // namespace pointhaptics
