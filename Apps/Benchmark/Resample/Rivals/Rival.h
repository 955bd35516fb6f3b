/// @file
/// One way to turn a cloud into voxel means: ours or another library's, behind one face.
#pragma once

#include "Core/Base/Lattice.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

class vtkPolyData;

namespace pointhaptics::bench::resample
{

/// The task of every contestant of a race.
struct ResampleTask
{
  vtkPolyData* cloud = nullptr; ///< Float points, no cells. Stays the caller's.
  Bounds workspace;             ///< A cube about the origin.
  std::int64_t dimension = 300; ///< Voxels on an axis of the workspace.
  double leaf = 0.0;            ///< Edge of a voxel.
};

/// A result, and the lattice it is meant to be on.
struct ResampleAnswer
{
  Lattice lattice;
  std::vector<double> xyz;
  std::vector<std::int64_t> counts; ///< Empty where the rival has none.
  std::string fault;                ///< A fault that needs no comparison of numbers; empty: there is none.
};

/// The rule by which an answer is judged.
enum class ComparedWith
{
  ExactMeans,  ///< To the last digit, in the order of the voxels.
  Means,       ///< Points at faces may be placed by float rounding.
  TheirVoxels, ///< One point in each voxel, in their order, and the counts.
};

/// Use: load once, then any number of before and run, then answer.
class Rival
{
public:
  virtual ~Rival() = default;
  virtual std::string name() const = 0;
  virtual ComparedWith comparedWith() const { return ComparedWith::Means; }
  /// Why this task is beyond the rival; empty: it is not.
  virtual std::string refusal(const ResampleTask&) const { return {}; }
  /// Copies the cloud into the rival's own form. Not timed.
  virtual void load(const ResampleTask& task) = 0;
  /// Undoes whatever would spare the next run its work. Not timed.
  virtual void before() {}
  virtual void run() = 0;
  virtual ResampleAnswer answer() const = 0;
};

} // namespace pointhaptics::bench::resample
