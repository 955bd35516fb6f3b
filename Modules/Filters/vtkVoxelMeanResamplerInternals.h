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
#include "vtkTimeStamp.h"
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

  /// RequestData: an output for each level, and one for the index of the points' voxels or null. @return
  /// false if it stays empty: an error was reported, or the execution aborted.
  bool Update(
    vtkPointSet* input, const std::vector<vtkSmartPointer<vtkPolyData>>& outputs, vtkPolyData* index);
  /// Frees what is kept between updates; called during an update, at its end.
  void ReleaseCaches();
  /// 0: all.
  void SetNumberOfThreads(unsigned most) { this->Smp = pointhaptics::SmpExecutor(most); }
  std::size_t ScratchBytes() const;

  /// Maps the fraction to the current part of the update and passes it to the filter.
  bool report(double fraction) override;

  pointhaptics::VoxelResampler Engine;
  pointhaptics::PointIndex Index;
  bool Aborted = false;
  vtkTimeStamp RetryTime;

private:
  /// The point arrays of the input that are averaged, and where their means go.
  struct NamedAttribute
  {
    pointhaptics::VoxelAttribute attribute;
    std::vector<int> roles; ///< vtkDataSetAttributes::AttributeTypes it is the active one of.
    bool isNormal;
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
    pointhaptics::AttributeKind kind;
    pointhaptics::AttributeValues values;
  };
  class UpdateScope;

  /// Starts a pass over the points, which covers the fractions from @p begin to @p end of an update.
  void BeginPass(double begin, double end);
  /// Starts a part of the pass, from the end of the previous part to @p end: report() maps to it.
  void BeginPart(double end);
  // The steps of an update; false after an error was reported, or the execution aborted.
  bool ReadTransform();
  bool MakeLattice(vtkPointSet* input);
  bool Run(vtkPointSet* input, bool isFirst);
  bool FillAll(vtkPointSet* input, const vtkSmartPointer<vtkPolyData>* outputs);
  bool AddArrays(int level, vtkPointData* data);
  bool Fill(int level, vtkPointSet* input, vtkPolyData* output);
  void FillIndex(vtkPointSet* input, vtkPolyData* output);
  /// Lets go of the input and its arrays.
  void Release();

  /// A point of the input stands for each voxel.
  bool KeepsPoints() const;
  /// What an attribute is on a level.
  vtkSmartPointer<vtkDataArray> ReducedArray(std::size_t i, int level);
  void ChooseArrays(vtkPointSet* input, bool warns);
  bool UseIndex(vtkPointSet* input);
  bool Resample(vtkPointSet* input, bool isFirst);

  vtkVoxelMeanResampler* Filter;
  pointhaptics::SmpExecutor Smp;
  pointhaptics::VoxelRequest Request;
  std::unique_ptr<pointhaptics::PointAccess> Points;
  std::vector<NamedAttribute> Attributes;
  pointhaptics::ArrayPool Pool;
  pointhaptics::ArrayAllocator Allocator{ this->Pool };
  std::optional<std::vector<std::int64_t>> Kept; ///< Voxels of output 0, where some may be left out.
  double PassBegin = 0.0;
  double PassEnd = 1.0;
  double PartBegin = 0.0;
  double PartEnd = 0.0;
  bool IsRunning = false;
  bool ReleaseCachesAtEnd = false;
  // Which input was seen last, and how often a part of it.
  ArraySeen Seen;
  int PartialViews = 0;
  bool Indexed = false;
  std::vector<KnownValues> Known; ///< Of the arrays of the last input, if it may be indexed.
};
