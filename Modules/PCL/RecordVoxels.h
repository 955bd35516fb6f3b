/// @file
/// Mean resampling of clouds whose points are records: coordinates and other fields together, as PCL has
/// them. Free of PCL and Eigen.
#pragma once

#include "Core/Base/Lattice.h"
#include "Core/Base/ScalarType.h"
#include "Core/Resample/VoxelResampler.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace pointhaptics
{

/// Numbers that follow each other in each record.
struct RecordField
{
  std::size_t offset = 0; ///< Bytes from the start of a record.
  ScalarType type = ScalarType::Float;
  int components = 1;
  AttributeStatistic statistic = AttributeStatistic::Mean; ///< A normal has three real numbers.
};

/// Records in the caller's memory. Of strides and offsets that are no multiples of the numbers' sizes, and of
/// x, y and z that do not follow each other, coordinates are copied; else nothing is.
struct RecordCloud
{
  const char* records = nullptr;
  std::int64_t size = 0;
  std::size_t step = 0; ///< Bytes from one record to the next.
  std::array<std::size_t, 3> xyz{};
  ScalarType type = ScalarType::Float; ///< Type of x, y and z: Float or Double.
};

struct RecordVoxelSettings
{
  Vec3 leaf;                      ///< Edges of a voxel; faces are at whole multiples of them.
  std::int64_t minimumPoints = 0; ///< Voxels of fewer points are left out.
  bool keepKeys = false;          ///< For indexOf().
  unsigned threads = 0;           ///< At most so many; 0: as vtkSMPTools is set.
};

/// One run of VoxelResampler over records. Scratch memory is kept for the next run. One
/// thread at a time.
class RecordVoxels
{
public:
  RecordVoxels();
  ~RecordVoxels();
  /// The other one is then as after its construction.
  RecordVoxels(RecordVoxels&& other);
  RecordVoxels& operator=(RecordVoxels&& other) noexcept;
  RecordVoxels(const RecordVoxels&) = delete;
  RecordVoxels& operator=(const RecordVoxels&) = delete;

  /// Errors: Empty (no finite point), those of alignedLattice() and VoxelResampler::run(); size() is then 0.
  /// @param fields beside the coordinates, which are kept by write().
  Status run(
    const RecordCloud& cloud, const std::vector<RecordField>& fields, const RecordVoxelSettings& settings);

  /// Voxels that are not left out, in the order of their index, x fastest.
  std::int64_t size() const;
  /// Writes means at the offsets of @p xyz, and fields at @p offsets, one for each of run()'s, into size()
  /// records; other bytes stay. @p records: step bytes each, coordinates of run()'s type.
  void write(char* records, std::size_t step, const std::array<std::size_t, 3>& xyz,
    const std::vector<std::size_t>& offsets) const;

  /// Lattice of the last run, and the multiple of the edges at which it starts on each axis.
  const Lattice& lattice() const;
  const std::array<std::int64_t, 3>& first() const;
  /// The number among size() of the voxel at (i, j, k), counted as multiples of the edges; -1 where there is
  /// none, and without keepKeys.
  std::int64_t indexOf(const std::array<std::int64_t, 3>& voxel) const;
  /// indexOf() of every voxel of the lattice, x fastest; empty without keepKeys, or where they are more than
  /// @p most. 4 bytes each.
  std::vector<int> layout(std::int64_t most) const;
  /// The voxel of a point, counted as multiples of the edges.
  static std::array<std::int64_t, 3> voxelOf(const Vec3& point, const Vec3& leaf);

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

} // namespace pointhaptics
