/// @file
/// One way to turn a cloud into voxel means: ours or another library's, behind one face.
#pragma once

#include "Core/Base/Lattice.h"
#include "Core/Resample/Representative.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

class vtkPolyData;

namespace pointhaptics
{
namespace bench
{
namespace resample
{

/// What every contestant of a race is asked to do.
struct ResampleTask
{
  vtkPolyData* cloud = nullptr; ///< Float points, no cells. Stays the caller's.
  Bounds workspace;             ///< A cube about the origin.
  std::int64_t dimension = 300; ///< Voxels on an axis of the workspace.
  double leaf = 0.0;            ///< Edge of a voxel.
};

/// What came out, and the lattice it is meant to be on.
struct ResampleAnswer
{
  Lattice lattice;
  std::vector<double> xyz;
  std::vector<std::int64_t> counts; ///< Empty where the rival has none.
  std::string fault;                ///< What is wrong before any number is compared; empty: nothing.
};

/// What an answer is compared with.
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
  /// Bytes of the result that run() left.
  virtual std::int64_t resultBytes() const = 0;
};

/// As vtkVoxelMeanResampler numbers them.
enum class InstructionSet : int
{
  Automatic = 0,
  Baseline,
  Avx2,
  Avx512,
};
const char* instructionSetName(InstructionSet set);

/// Which of ours: each of these is a contestant.
struct OursSettings
{
  std::string name = "ours";
  bool automaticWorkspace = false;
  bool covariance = false;
  /// Names of the arrays of the cloud that are reduced; the others are not even passed in.
  std::vector<std::string> arrays;
  Representative representative = Representative::Mean;
  bool voxelIndex = false;
  InstructionSet instructionSet = InstructionSet::Automatic;
};

std::unique_ptr<Rival> makeOurs(const OursSettings& settings = {});
std::unique_ptr<Rival> makeVtkVoxelGrid();

/// The words of --rivals, those that were built.
std::vector<std::string> rivalWords();
/// @p word must be one of them. Loads the rival's module the first time; throws std::runtime_error where it
/// cannot be loaded.
std::unique_ptr<Rival> makeRival(const std::string& word);

} // namespace resample
} // namespace bench
} // namespace pointhaptics
