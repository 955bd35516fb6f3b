/// @file
/// `pointhaptics bench friction`: is the pull along the surface mu times the push across it, at every speed?
#pragma once

#include "Benchmark/Report/Report.h"

#include "Shapes/Shapes.h"

#include <cstdint>
#include <string>
#include <vector>

namespace pointhaptics
{
namespace bench
{
namespace friction
{

struct FrictionBenchmarkOptions
{
  std::int64_t points = 543652;
  std::vector<double> speeds = { 0.010, 0.050, 0.100 }; ///< Metres per second.
  std::vector<Shape> shapes = { Shape::Plane, Shape::Sphere, Shape::Torus, Shape::Ellipsoid, Shape::Saddle };

  /// A second or two.
  void makeQuick();
};

/// @param wrong receives which answer is wrong beyond doubt; left empty where none is.
Report benchmarkFriction(
  const FrictionBenchmarkOptions& options, const Progress& progress, std::string& wrong);

} // namespace friction
} // namespace bench
} // namespace pointhaptics
