/// @file
/// The viewer under the keys of `pointhaptics bench render`.
#pragma once

#include "Benchmark/Render/RenderBenchmark.h"

#include <memory>
#include <string>

namespace pointhaptics
{
namespace app
{

/// Null: @p message says why not. GUI thread only; needs a display.
std::unique_ptr<bench::render::ModelMover> makeModelMover(
  const std::string& file, int width, int height, std::string& message);

} // namespace app
} // namespace pointhaptics
