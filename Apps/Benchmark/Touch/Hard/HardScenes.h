/// @file
/// The scenes of the study "hard": clouds on which touch goes wrong easily, and the hands that show it.
/// Metres, workspace of 100 mm. Clouds have fixed seeds; the hands follow the set of strokes.
#pragma once

#include "Benchmark/Touch/TouchBenchmark.h"

#include "Shapes/PortableRandom.h"

#include <functional>
#include <string>
#include <vector>

namespace pointhaptics::bench::touch::hard
{

constexpr double kTwoPi = 6.28318530717958647692;

/// A place of a surface and the unit direction from which a hand comes.
struct TouchPlace
{
  Vec3 point;
  Vec3 up;
};

struct HardScene
{
  std::string name; ///< The family, then what distinguishes the row.
  std::vector<Vec3> points;
  TouchMesh mesh;         ///< The truth; empty: there is none.
  bool isSolid = false;   ///< The mesh is closed and met from outside. Open meshes have both windings.
  bool hasErrors = false; ///< The force is compared with the truth's; of solids only.
  std::vector<TouchStroke> strokes;
  std::vector<TouchPlace> loopPlaces; ///< Where a simulated hand presses; empty: nowhere.
};

/// Makes one scene, as each is a cloud.
struct HardSceneMaker
{
  std::string family;
  std::function<HardScene()> make;
};

/// The families, in the order of the report.
std::vector<std::string> hardFamilies();
/// The rows of the families in options.families, all where that is empty; with options.quick one or two a
/// family, of small clouds and few strokes. The family "scan" has two rows for each cloud of options.scans,
/// fitted into the workspace and eight times nearer, and a third for its vertices where it has triangles.
std::vector<HardSceneMaker> hardScenes(const TouchBenchmarkOptions& options);

/// All of @p values, with options.quick the first one, which stands for the others.
template <class Value>
std::vector<Value> someOf(const TouchBenchmarkOptions& options, std::vector<Value> values)
{
  values.resize(options.quick ? 1 : values.size());
  return values;
}

/// A stroke that goes on from its last point, m/s.
void goTo(TouchStroke& stroke, const Vec3& to, double speed);
struct Leg
{
  Vec3 to;
  double speed = 0.0;
};
/// A hand that was let go at the end of the last leg has time to be free for 50 ticks: it stays for 300.
constexpr int kAwayTicks = 300;
TouchStroke strokeAlong(const Vec3& start, const std::vector<Leg>& legs);

/// Each triangle with both windings, so that it is met from either side.
TouchMesh twoSided(TouchMesh mesh);
/// An open square sheet in the plane z = 0, met from both sides.
TouchMesh sheetMesh(double half);
/// A prism of height @p height about z = 0 between two polygons with equally many corners; an open ring in
/// the plane z = 0, not two-sided, where @p height is 0.
TouchMesh ringMesh(const std::vector<Vec3>& outer, const std::vector<Vec3>& inner, double height);

/// A hand at @p place: @p kind 0 presses, 1 slides at 5 to 500 mm/s, 2 jabs at 1 m/s, 3 trembles at 8 Hz.
/// Each ends by pulling 60 mm straight away.
TouchStroke handAt(const TouchPlace& place, int kind, detail::PortableRandom& random);
std::vector<TouchStroke> handsAt(const std::vector<TouchPlace>& places, detail::PortableRandom& random);
/// Random points of a cloud, with the normals of their neighbourhoods on the emptier side.
std::vector<TouchPlace> placesOn(const std::vector<Vec3>& points, int count, detail::PortableRandom& random);

/// The generated clouds without a truth: misregistered, noise, strays, grids; and those of files.
void addClouds(const TouchBenchmarkOptions& options, std::vector<HardSceneMaker>& all);
/// Seeds of hands: no set shares a place with another.
std::uint64_t hardSeed(const TouchBenchmarkOptions& options, std::uint64_t family);

} // namespace pointhaptics::bench::touch::hard
