/// @file
/// `pointhaptics bench proxy`: how far the proxy's force is from the exact one, and what an update takes.
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
namespace proxy
{

/// A real scan to be felt, and its mesh where it has one: the surface to judge the force by.
struct Scan
{
  std::string name;
  std::vector<Vec3> points;
  std::vector<std::uint32_t> triangles; ///< Three indices of points each; empty: no mesh.
};

struct ProxyBenchmarkOptions
{
  std::vector<std::int64_t> points = { 47516, 543652 }; ///< The paper's sizes.
  std::vector<double> noises = { 0.0, 20e-6, 100e-6 };  ///< Metres.
  std::vector<Shape> shapes = { Shape::Plane, Shape::Sphere, Shape::Torus, Shape::Ellipsoid, Shape::Saddle,
    Shape::Box, Shape::Sheet, Shape::Hole, Shape::DensityStep };
  std::vector<std::int64_t> sizes = { 10000, 100000, 1000000, 10000000 }; ///< For the study of size.
  std::vector<Scan> scans;
  std::vector<std::string> studies; ///< Empty: all.
  int repetitions = 5;              ///< Walks over each path; the fastest tells the time of a tick.
  int strokes = 60;                 ///< On each scan, straight ones and following ones.

  /// A second or two.
  void makeQuick();
};

std::vector<std::string> studyWords();

/// @param wrong receives which answer is wrong beyond doubt; left empty where none is.
Report benchmarkProxy(const ProxyBenchmarkOptions& options, const Progress& progress, std::string& wrong);

} // namespace proxy
} // namespace bench
} // namespace pointhaptics
