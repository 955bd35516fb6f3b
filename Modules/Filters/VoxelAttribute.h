/// @file
/// Reduces a point array of the input to one tuple per voxel.
#pragma once

#include "ArrayPool.h"

#include "Core/Base/AffineTransform.h"
#include "Core/Base/Buffer.h"
#include "Core/Base/Executor.h"
#include "Core/Base/ProgressObserver.h"
#include "Core/Resample/AttributeMean.h"
#include "Core/Resample/AttributeTuples.h"
#include "Core/Resample/PointRows.h"

#include "vtkSmartPointer.h"

#include <cstdint>
#include <variant>
#include <vector>

class vtkDataArray;

namespace pointhaptics
{

enum class AttributeKind
{
  Mean,     ///< Averaged, integers rounded to nearest.
  Normal,   ///< Averaged, turned with the transform, re-normalised.
  Category, ///< The value most points have, component by component; the smallest on a tie.
  Median,   ///< Component by component, of an even number the lower middle one.
  Chosen,   ///< That of the point that stands for the voxel.
};

/// Properties of an input array, independent of which points are averaged: valid until its values change.
struct AttributeValues
{
  AttributeRange range;
  vtkSmartPointer<vtkDataArray> copy; ///< Plain tuples in memory, where the input is something else; or null.
};

/// With VoxelResampler::visitPointsByVoxel() and parents(): prepare(), add() for all points, output(), then
/// for each coarser level coarsen() and output(). With visitPointsByVoxelSet(): prepareSets(), for each set
/// of voxels add all points to Tuples from tuplesOfSet() and writeSet(), then output().
class VoxelAttribute
{
public:
  /// Keeps a reference to @p input; if its memory is not plain tuples of numbers, it is copied first. @p
  /// known: values() of an earlier object of the same input and kind, or null.
  VoxelAttribute(vtkDataArray* input, AttributeKind kind, const AttributeValues* known,
    InstructionSet instructions, const Executor& executor);
  AttributeValues values() const;

  /// Sums of the tuples of each voxel, or the tuples themselves.
  using Tuples = std::variant<AttributeMean, AttributeTuples>;
  /// @p counts: points of each voxel. @p mostPoints: of a voxel, at coarser levels too. @p spare: sums
  /// to reuse the memory of, or nothing.
  static void prepare(Tuples& tuples, const std::int64_t* counts, std::int64_t voxels,
    std::int64_t mostPoints, Buffer<std::int64_t> spare = {}, const Executor& executor = {});
  /// @p from: copies of tuples, each @p stride bytes after the one before.
  static void add(
    Tuples& tuples, const void* from, std::size_t stride, const std::int64_t* voxels, int count);

  /// The tuples that add() needs.
  TupleSource source() const;
  void prepare(const std::int64_t* counts, std::int64_t voxels, std::int64_t mostPoints,
    Buffer<std::int64_t> spare, const Executor& executor);
  void add(const void* tuples, std::size_t stride, const std::int64_t* voxels, int count);
  /// The memory of the sums, for reuse; nothing if it is more than 32 bytes a voxel and component.
  Buffer<std::int64_t> takeSums();

  /// Whether the voxels of a set can be written independently.
  bool canWriteSets() const;
  void prepareSets(std::int64_t voxels, const AffineTransform& transform, ArrayPool& pool);
  Tuples tuplesOfSet() const;
  /// Values of the voxels from @p first on. @p counts: points of each of these.
  void writeSet(const Tuples& tuples, std::int64_t first, const std::int64_t* counts) const;

  void coarsen(const std::vector<std::int64_t>& parents, std::int64_t voxels);
  /// One tuple per voxel, of the type, name, components, information and lookup table of the input; null if
  /// the observer, which may be null, aborted the work. @p counts: points of each voxel.
  vtkSmartPointer<vtkDataArray> output(const std::int64_t* counts, const AffineTransform& transform,
    ArrayPool& pool, const Executor& executor, ProgressObserver* observer);

  const AttributeView& view() const { return view_; }
  /// The tuples of the @p points, as output() gives them: for AttributeKind::Chosen, which needs nothing
  /// else.
  vtkSmartPointer<vtkDataArray> chosen(
    const std::vector<std::int64_t>& points, ArrayPool& pool, const Executor& executor) const;

private:
  vtkSmartPointer<vtkDataArray> inOwnType(vtkSmartPointer<vtkDataArray> plain) const;
  void setNormalColumns(const AffineTransform& transform);
  bool write(const Tuples& tuples, vtkDataArray* output, std::int64_t first, const std::int64_t* counts,
    const Executor& executor, ProgressObserver* observer) const;
  void writeIntegerNormals(vtkDataArray* output, const std::int64_t* counts, const Executor& executor) const;

  vtkSmartPointer<vtkDataArray> input_; ///< As given.
  vtkSmartPointer<vtkDataArray> plain_; ///< The same as tuples in memory.
  AttributeKind kind_;
  AttributeView view_; ///< Of plain_.
  std::int64_t voxels_ = 0;
  std::int64_t finestVoxels_ = 0;
  Tuples tuples_;
  vtkSmartPointer<vtkDataArray> written_; ///< By writeSet().
  Vec3 normalColumns_[3];                 ///< The inverse transpose of the transform.
};

/// Turns normals by the inverse transpose of @p transform and makes them unit vectors; those in integers keep
/// their length.
void turnNormals(vtkDataArray* normals, const AffineTransform& transform);

} // namespace pointhaptics
