/// @file
/// The steps of vtkDistributedVoxelMeanResampler. Private to Parallel.
#pragma once

#include "PolyDataAccess.h"
#include "SmpExecutor.h"
#include "VoxelAttribute.h"
#include "VoxelOutput.h"

#include "Core/Distributed/SharedVoxels.h"
#include "Core/Resample/VoxelMeanSettings.h"
#include "Core/Resample/VoxelResampler.h"

#include "vtkPointSet.h"
#include "vtkSmartPointer.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

class vtkAbstractTransform;
class vtkFieldData;
class vtkPolyData;

namespace pointhaptics
{

/// The steps of one update. Each returns what is wrong, the same on all ranks, or nothing.
class DistributedUpdate
{
public:
  DistributedUpdate(Ranks& ranks, const VoxelMeanSettings& settings, vtkPointSet* input)
    : ranks_(ranks)
    , settings_(settings)
    , input_(input)
    , points_(input->GetPoints())
  {
  }

  /// @p field: of the output, that of the input so far.
  std::string prepare(vtkAbstractTransform* transform, vtkFieldData* field);
  std::string run(vtkPolyData* output);
  /// Fills the output with the index of this rank's points in the @p voxels that run() has just
  /// given to this rank's output, and those of the others.
  std::string fillIndex(vtkPolyData* output, vtkIdType voxels);
  std::int64_t clippedPoints() const { return clipped_; }
  std::int64_t invalidPoints() const { return invalid_; }
  const std::vector<std::string>& dropped() const { return dropped_; }

private:
  bool agree(const std::string& text)
  {
    const std::vector<std::string> texts = ranks_.gather(text);
    return std::all_of(texts.begin(), texts.end(), [&](const std::string& t) { return t == texts.front(); });
  }
  bool sharesSums() const { return settings_.representative == Representative::Mean; }
  std::string chooseArrays();
  void choosePrecision();
  /// The voxels of @p points, with keys.
  VoxelRequest requestOf(const PointView& points, const Lattice& lattice);
  /// The voxels of this rank's points.
  std::string findOwnVoxels(const Lattice& lattice, VoxelResampler& own);
  // Means: sums are shared.
  std::string runOfSums(vtkPolyData* output);
  // Others: points go to the rank that has their voxel.
  std::string runOfPoints(vtkPolyData* output);
  vtkSmartPointer<vtkPolyData> sharePoints(const VoxelResampler& own);
  /// With found_: what points have beside places, counts and covariances.
  void fill(vtkPolyData* output, const VoxelRequest& request);

  Ranks& ranks_;
  const VoxelMeanSettings& settings_;
  vtkPointSet* input_;
  PointAccess points_;
  SmpExecutor smp_;
  OutputMemory memory_;
  AffineTransform transform_;
  Lattice lattice_;
  bool singlePrecision_ = true;
  std::vector<VoxelAttribute> found_;
  std::vector<std::string> dropped_;
  std::int64_t clipped_ = 0; ///< Number of points outside the workspace, on all ranks.
  std::int64_t invalid_ = 0;
  std::vector<std::uint64_t> ranges_;             ///< Ranges of keys of all ranks.
  std::vector<std::int64_t> numbers_;             ///< Numbers among the points of all ranks, of those that
                                                  ///< came to this one; for KeepOriginalPointIds.
  VoxelResampler made_;                           ///< Result for this rank's range.
  std::optional<std::vector<std::int64_t>> kept_; ///< Voxels of this rank that stay, where some may be left
                                                  ///< out.
};

} // namespace pointhaptics
