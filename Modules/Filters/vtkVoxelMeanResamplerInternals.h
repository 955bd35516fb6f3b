/// @file
/// The steps of vtkVoxelMeanResampler. Private to Filters.
#pragma once

#include "PolyDataAccess.h"
#include "SmpExecutor.h"
#include "VoxelArrays.h"
#include "VoxelAttribute.h"
#include "VoxelOutput.h"
#include "vtkVoxelMeanResampler.h"

#include "Core/Neighbors/PointIndex.h"
#include "Core/Resample/VoxelResampler.h"

#include "vtkDataArray.h" // For Seen
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h" // For Seen

#include <memory>
#include <optional>
#include <vector>

class vtkPointSet;
class vtkPolyData;

namespace pointhaptics
{

/// The part of an update's progress after which the means are known.
constexpr double kRunEnd = 0.9;

}

/// One update's steps, and what is kept from one to the next.
class vtkVoxelMeanResampler::Internals : public pointhaptics::ProgressObserver
{
public:
  explicit Internals(vtkVoxelMeanResampler* filter)
    : Filter(filter)
  {
  }

  // The steps of a run; false after an error was reported, or the execution aborted.

  /// Reads settings and transform, and finds the workspace that all clouds share.
  bool Begin(const Clouds& clouds);
  /// Means, and where they are asked for the points with their voxels.
  bool Update(vtkPointSet* input, vtkPolyData* means, vtkPolyData* index);
  /// Lets go of what the run needed.
  void End(bool succeeded);
  /// Frees what is kept between updates; called during an update, at its end.
  void ReleaseCaches();
  std::size_t ScratchBytes() const;

  /// Maps the fraction to the current part of the update and passes it to the filter.
  bool report(double fraction) override;

  pointhaptics::VoxelResampler Engine;
  pointhaptics::PointIndex Index;

private:
  /// The point arrays of the input that are averaged, and where their means go.
  struct NamedAttribute
  {
    pointhaptics::VoxelAttribute attribute;
    pointhaptics::VoxelArray found;
  };
  /// An array as it was when something was learned of it.
  struct ArraySeen
  {
    vtkWeakPointer<vtkDataArray> data;
    const void* address = nullptr;
    vtkIdType size = 0;
    vtkMTimeType time = 0;

    ArraySeen() = default;
    /// @p ownersTime: of what it belongs to.
    ArraySeen(vtkDataArray* array, vtkMTimeType ownersTime);
    bool operator==(const ArraySeen& other) const;
  };
  static ArraySeen SeenPoints(vtkPointSet* input);
  struct KnownValues
  {
    ArraySeen seen;
    pointhaptics::AttributeStatistic statistic;
    pointhaptics::AttributeValues values;
  };

  /// Starts a part of the update of a cloud, from the end of the previous part to @p end: report() maps to
  /// it.
  void BeginPart(double end);
  // The steps of an update; false after an error was reported, or the execution aborted.
  bool FindWorkspace(const Clouds& clouds);
  pointhaptics::Bounds BoundsOf(const std::vector<pointhaptics::PointView>& parts);
  bool MakeLattice(vtkPointSet* input);
  bool Fill(vtkPointSet* input, vtkPolyData* output);
  void FillIndex(vtkPointSet* input, vtkPolyData* output);
  /// Says which categories no cloud has, and that no point is left.
  void WarnOfNames(const Clouds& clouds);
  /// Lets go of the input and its arrays.
  void Release();

  /// A point of the input stands for each voxel.
  bool KeepsPoints() const;
  void ChooseArrays(vtkPointSet* input);
  bool UseIndex(vtkPointSet* input);
  bool Resample(vtkPointSet* input);

  vtkVoxelMeanResampler* Filter;
  pointhaptics::VoxelMeanSettings Settings;      ///< Settings of this run: observers of progress may set
                                                 ///< others.
  pointhaptics::AffineTransform Transform;       ///< Transform of this run.
  std::optional<pointhaptics::Bounds> Workspace; ///< Workspace of all clouds; none: each has its own.
  vtkIdType NumberOfPoints = 0;                  ///< Number of points of all clouds.
  bool Aborted = false;
  pointhaptics::SmpExecutor Smp;
  pointhaptics::VoxelRequest Request;
  std::unique_ptr<pointhaptics::PointAccess> Points;
  std::vector<NamedAttribute> Attributes;
  pointhaptics::ArrayPool Pool;
  std::optional<std::vector<std::int64_t>> Kept; ///< Voxels of output 0, where some may be left out.
  double PartBegin = 0.0;
  double PartEnd = 0.0;
  bool IsRunning = false;
  bool ReleaseCachesAtEnd = false;
  // Which input was seen last, and how often a part of it.
  ArraySeen Seen;
  int PartialViews = 0;
  bool Indexed = false;
  std::vector<KnownValues> Known; ///< Values of the arrays of the last input, if it may be indexed.
};
