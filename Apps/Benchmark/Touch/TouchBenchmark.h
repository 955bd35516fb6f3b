/// @file
/// Options of `pointhaptics bench touch`: does the touch of a cloud keep to the surface it was sampled
/// from, where that is not smooth?
#pragma once

#include "Benchmark/Touch/TouchMesh.h"
#include "Benchmark/Touch/TouchStrokes.h"

#include "Core/Simd/InstructionSet.h"

#include <cstdint>
#include <string>
#include <vector>

namespace pointhaptics::bench::touch
{

struct TouchBenchmarkOptions
{
  std::vector<TouchMesh> scans; ///< As read from their files.
  std::vector<std::string> meshes = generatedMeshNames();
  std::vector<std::string> methods;  ///< Some of contestantNames(); empty: all.
  std::vector<std::string> families; ///< Some of hardFamilies(); empty: all.
  std::int64_t points = 543652;      ///< Samples of each mesh; the paper's number.
  std::vector<double> sizes = {};    ///< Numbers of samples of the study of scans.
  std::int64_t strokes = 60;         ///< On each mesh.
  StrokeSet strokeSet = StrokeSet::A;
  bool raw = false;  ///< The points themselves, no voxels.
  bool local = true; ///< Finer scenes near the hand, as the program makes them.
  /// From the look at where the hand is until the finer scene there is felt, milliseconds: a look every 5 or
  /// 10 ms, and the time of a build.
  std::int64_t lateTicks = 20;
  InstructionSet instructions =
    InstructionSet::Automatic; ///< Instructions of the proxies; the forces are the same.
  bool quick = false;

  /// A few seconds.
  void makeQuick();
};

} // namespace pointhaptics::bench::touch
