/// @file
/// Press-and-slide strokes over clouds without an exact answer.
#pragma once

#include "Benchmark/Proxy/Scenes.h"
#include "Haptics/Proxy.h"

#include <vector>

namespace pointhaptics
{
namespace bench
{
namespace proxy
{

/// A hand comes from 3 mm above a place, goes to 1 mm below it along the normal, and slides on across it.
struct Stroke
{
  Vec3 place;
  Vec3 normal;  ///< Unit, away from the cloud's middle.
  Vec3 tangent; ///< Unit, across the normal.
};

constexpr int kPressTicks = 160;
constexpr int kStrokeTicks = 1160; ///< Pressing included.

/// @p count strokes at random places that can be reached freely from outside; always the same ones.
std::vector<Stroke> strokesOn(const HapticScene& scene, int count);

/// What a hand felt along a stroke.
struct StrokeTrace
{
  std::vector<ProxyState> states;
  std::vector<double> microseconds;
};

/// Slides at 10 mm/s: straight on, or @p following the surface it feels at 1 mm depth, as a hand does. @param
/// wanted the proxy's instructions.
StrokeTrace feelStroke(const HapticScene& scene, const Stroke& stroke, bool following,
  InstructionSet wanted = InstructionSet::Automatic);

} // namespace proxy
} // namespace bench
} // namespace pointhaptics
