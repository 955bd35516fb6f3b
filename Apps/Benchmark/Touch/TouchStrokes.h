/// @file
/// Hands that press, slide and lift on a mesh, and what they must feel.
#pragma once

#include "Benchmark/Touch/Methods/MeshGodObject.h"

#include <cstdint>
#include <vector>

namespace pointhaptics::bench::touch
{

constexpr double kTickSeconds = 1e-3;
constexpr double kPressSpeed = 0.025; ///< Metres a second.
constexpr int kRestTicks = 60;        ///< After the hand has lifted.

/// The HIP of each tick, metres.
struct TouchStroke
{
  std::vector<Vec3> hip;
};

/// Sets of places that no other set shares: rules are chosen on the one and tried on the other.
enum class StrokeSet
{
  A,
  B
};

/// @p count strokes at places uniform over the area that a straight line reaches from 4 mm outside. Press to
/// 1 mm at 25 mm/s, slide 10 mm in a random tangential direction at 20 mm/s (even strokes) or 50 mm/s (odd),
/// lift 5 mm at 50 mm/s, stay. The same ones for the same set and mesh.
std::vector<TouchStroke> strokesOn(const TriangleTree& tree, int count, StrokeSet set);

/// Straight from @p from to @p to at @p speed m/s, appended; @p from itself where the stroke is empty.
void moveTo(TouchStroke& stroke, const Vec3& from, const Vec3& to, double speed);
void stay(TouchStroke& stroke, int ticks);

/// The force of the god object along a stroke, and where it can be relied on.
struct TouchTruth
{
  struct Tick
  {
    Vec3 force;           ///< N.
    bool contact = false; ///< Contact of the god object at the hand itself.
    /// In contact, and eight god objects whose hands are shifted (four by 10 um, four by 50 um) feel the same
    /// within 25 %; only for forces above kForceFloor.
    bool holds = false;
    bool free = false; ///< All nine are free.
  };
  /// All ticks of the stroke, or those up to where a free hand comes out through a facet from behind: it was
  /// inside an open scan, and a cloud, which has no inside, may hold it there.
  std::vector<Tick> ticks;
  /// Ticks before the god object leaps from contact to contact, by more than 4 times the way of the hand and
  /// 0.2 mm: from there on which of two places is right is a matter of chance.
  std::size_t certain = 0;
  bool leaps() const { return certain < ticks.size(); }
};

constexpr double kForceFloor = 0.04; ///< N.

TouchTruth truthOf(const TriangleTree& tree, const TouchStroke& stroke, double stiffness, std::uint64_t seed);

} // namespace pointhaptics::bench::touch
