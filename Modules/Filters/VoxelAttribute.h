/// @file
/// A point array of the input on its way to one tuple per voxel.
#pragma once

#include "ArrayPool.h"

#include "Core/AffineTransform.h"
#include "Core/AttributeMean.h"
#include "Core/Buffer.h"
#include "Core/Executor.h"
#include "Core/PointRows.h"
#include "Core/Watcher.h"

#include "vtkSmartPointer.h"

#include <cstdint>
#include <memory>
#include <vector>

class vtkDataArray;

namespace pointhaptics
{

enum class AttributeKind
{
  Mean,     ///< Averaged, integers rounded to nearest.
  Normal,   ///< Averaged, turned with the transform, re-normalised.
  Category, ///< The value most points have, component by component; the smallest on a tie.
};

/// What an input array's values say whatever is averaged of them: it stays true as long as they do not
/// change.
struct AttributeValues
{
  AttributeRange range;
  vtkSmartPointer<vtkDataArray> copy; ///< As plain tuples in memory, where the input is not; or null.
};

/// Used as VoxelResampler::assign() and parents() go: prepare(), add() for all points, output(), then for
/// each coarser level coarsen() and output(). Or as assignInSets() goes: prepareSets(), for each set of
/// voxels all that an AttributeMean from sumsOfSet() is to be given and writeSet(), then output().
class VoxelAttribute
{
public:
  /// Holds on to @p input; one whose memory is not plain tuples of numbers is copied first. @p known: from
  /// values() of one of the same input and kind, or null.
  VoxelAttribute(vtkDataArray* input, AttributeKind kind, const AttributeValues* known,
    InstructionSet instructions, const Executor& executor);
  AttributeValues values() const;

  /// @p spare: sums another attribute has no more use for, or nothing.
  /// @p mostPoints: of a voxel, at coarser levels too.
  void prepare(
    std::int64_t voxels, std::int64_t mostPoints, Buffer<std::int64_t> spare, const Executor& executor);
  /// The memory of the sums, for a spare: nothing if it is more than 32 bytes a voxel and component.
  Buffer<std::int64_t> takeSums();
  /// Whether each voxel's value comes from sums alone.
  bool canWriteSets() const;
  void prepareSets(std::int64_t voxels, const AffineTransform& transform, ArrayPool& pool);
  AttributeMean sumsOfSet() const { return mean_->another(); }
  /// Values of the voxels from @p first on. @p counts: points of each of these.
  void writeSet(const AttributeMean& sums, std::int64_t first, const std::int64_t* counts) const;
  /// What add() needs of each point.
  TupleSource source() const;
  /// Copies of tuples, each @p stride bytes after the one before.
  void add(const void* tuples, std::size_t stride, const std::int64_t* voxels, int count);
  void coarsen(const std::vector<std::int64_t>& parents, std::int64_t voxels);
  /// One tuple per voxel, of the type, name, components, information and lookup table of the input; null if
  /// the watcher, who may be none, ended the work. @p counts: points of each voxel.
  vtkSmartPointer<vtkDataArray> output(const std::int64_t* counts, const AffineTransform& transform,
    ArrayPool& pool, const Executor& executor, Watcher* watcher);

private:
  void setNormalColumns(const AffineTransform& transform);
  bool write(
    vtkDataArray* output, const std::int64_t* counts, const Executor& executor, Watcher* watcher) const;
  void writeNormals(vtkDataArray* output, const std::int64_t* counts, const Executor& executor) const;
  bool writeCategories(vtkDataArray* output, const Executor& executor, Watcher* watcher) const;

  vtkSmartPointer<vtkDataArray> input_; ///< As given.
  vtkSmartPointer<vtkDataArray> plain_; ///< The same as tuples in memory.
  AttributeKind kind_;
  std::int64_t voxels_ = 0;
  std::int64_t finestVoxels_ = 0;
  std::unique_ptr<AttributeMean> mean_;
  vtkSmartPointer<vtkDataArray> written_; ///< By writeSet().
  Vec3 normalColumns_[3];                 ///< The inverse transpose of the transform.
  std::vector<std::int64_t> voxelOf_;     ///< Of each point, for categories; -1: outside.
};

} // namespace pointhaptics
