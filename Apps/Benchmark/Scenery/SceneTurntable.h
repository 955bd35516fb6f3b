/// @file
/// The viewer's picture for benchmarks.
#pragma once

#include "Benchmark/Render/RenderBenchmark.h"

#include <memory>
#include <string>

namespace pointhaptics
{
namespace app
{

/// The viewer's scene of @p file in a window of its own, off the screen. Null: @p message says why not. GUI
/// thread only; needs a display.
std::unique_ptr<bench::render::Turntable> makeSceneTurntable(
  const std::string& file, int width, int height, std::string& message);

} // namespace app
} // namespace pointhaptics
