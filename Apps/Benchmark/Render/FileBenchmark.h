/// @file
/// `pointhaptics bench render --file`: what the picture of a file costs, with the look the viewer chooses.
#pragma once

#include "Benchmark/Render/RenderBenchmark.h"

namespace pointhaptics
{
namespace bench
{
namespace render
{

/// Of RenderBenchmarkOptions::files: frames in motion, the picture at rest, and each effect by itself. Needs
/// a display. @param wrong what could not be measured; empty: nothing.
Report benchmarkFiles(const RenderBenchmarkOptions& options, const Progress& progress, std::string& wrong);

} // namespace render
} // namespace bench
} // namespace pointhaptics
