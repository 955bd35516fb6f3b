/// @file
/// Mean resampling: the points in each voxel of a lattice become their mean (the paper's "mean filter").
#pragma once

#include "Core/Base/AffineTransform.h"
#include "Core/Base/Executor.h"
#include "Core/Base/Lattice.h"
#include "Core/Base/PointView.h"
#include "Core/Base/ProgressObserver.h"
#include "Core/Base/Status.h"
#include "Core/Resample/PointRows.h"
#include "Core/Simd/InstructionSet.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace pointhaptics
{

class PointIndex;

/// Memory of the caller's for the results of the finest level: run() leaves them where they are to stay, and
/// copying them there does nothing.
class ResultMemory
{
public:
  enum class Part
  {
    Means,
    Counts,
    Covariances,
  };
  virtual ~ResultMemory() = default;
  /// At least so many bytes, aligned for their type, which are the result's until the next run(): more than
  /// it needs in the end. Called from the thread that called run(), at most once for each part.
  virtual void* reserve(Part part, std::size_t bytes) = 0;
};

/// What to resample, and what to make of it.
struct VoxelRequest
{
  PointView points;
  /// An index of the same points, or the one whose points() they are: those outside are then not looked at
  /// one by one. May be null.
  const PointIndex* index = nullptr;
  AffineTransform transform; ///< From the cloud's frame into that of the lattice.
  Lattice lattice;
  /// With an index: points outside the box of this lattice, whose voxels are ones of the other, may be left
  /// out; they count as clipped. Voxels inside are the same as without, bit for bit; others may lack points,
  /// or be missing.
  std::optional<Lattice> part;
  bool singlePrecision = false; ///< Means are rounded to float.
  bool covariances = false;
  bool keys = false; ///< For keys(), assign() and parents().
  /// What assign() hands out of each point.
  std::vector<TupleSource> tuples;
  /// assign() will follow: run() remembers, if the points are few, what it will tell, so that it takes less
  /// time.
  bool assigned = false;
  /// Level l is a lattice 2^l times as coarse, until that is one voxel; further levels repeat it.
  int levels = 1;
  InstructionSet instructions = InstructionSet::Automatic;
  ResultMemory* memory = nullptr; ///< Null: the resampler's own.
};

/// Resamples clouds, one after the other; memory for the work is kept between them (releaseScratch()).
///
/// A point's place is u = (T p + t - origin) / spacing, in double about a point near the lattice's origin,
/// so that large coordinates cost no digits; its voxel is floor(u), half-open. Places are then cut to
/// fixed-point numbers whose quantum is the same on a lattice and on one twice as coarse: at most 2^-31
/// voxel, 2^-34 on 300^3. Sums of those are exact. Hence results are the same bit for bit for every order of
/// the points, every executor, instruction set and PointIndex, and a coarser level equals the resampling of
/// the points at its spacing (on lattices of up to 4096 voxels an axis; beyond, quanta are finer still and a
/// level that crosses this border may differ by 2^-31 voxel: see exactLevels()). Error of a mean: at most
/// 2^-31 voxel, then one rounding to the output's type; a mean lies in its voxel. Counts are 64-bit. Where a
/// matrix, by its condition number, would cost digits, its products are summed in two words each, in about
/// half as much time again (several times as much on processors without a fused multiplication).
///
/// Time: a few nanoseconds a point; beyond 4096 voxels an axis some tens of them, growing with the logarithm
/// of the points. Memory beyond input and results: 16 bytes for each of at most 1.25 million points, 60 bytes
/// an active voxel (20 of them its results, where these are not in the caller's memory), a few megabytes (of
/// which up to 1.3 for each thread where a layer of the lattice has up to 4 million voxels); lattices beyond
/// 4096 an axis: 30 bytes (38 for assign()) for each of at most 524,288 points and 66 an active voxel;
/// covariances: 100 an active voxel more, 132 on these. One object is used by one thread at a time; the
/// executor's threads may be many.
class VoxelResampler
{
public:
  VoxelResampler();
  ~VoxelResampler();
  VoxelResampler(VoxelResampler&&) noexcept;
  VoxelResampler& operator=(VoxelResampler&&) noexcept;

  /// How many of @p levels levels from the finest, @p lattice, on equal the resampling of the points at their
  /// spacing bit for bit: all where it has at most 4096 voxels an axis; else those before the first that has
  /// (or, from more than 2^20 on, the first of fewer).
  static int exactLevels(const Lattice& lattice, int levels);

  /// Errors: the transform's, the lattice's, InvalidParameter (levels below 1 or above 22, an index of
  /// another number of points), Aborted (the
  /// observer said so); there are no voxels then. A cloud without a point inside is no error.
  Status run(
    const VoxelRequest& request, const Executor& executor = {}, ProgressObserver* observer = nullptr);

  // What run() made. Levels count from 0, the lattice asked for.
  std::int64_t clippedPoints() const;     ///< Finite points outside the lattice.
  std::int64_t invalidPoints() const;     ///< Points NaN or infinite, before or after the transform.
  std::int64_t size(int level = 0) const; ///< Active voxels.
  /// Of the voxel that has most of them.
  std::int64_t mostPoints(int level = 0) const;
  const Lattice& lattice(int level = 0) const;
  /// Voxels in ascending order of their keys (x fastest). @p xyz: 3 size(level) numbers, of the type asked
  /// for.
  void copyMeans(int level, float* xyz, const Executor& executor = {}) const;
  void copyMeans(int level, double* xyz, const Executor& executor = {}) const;
  void copyCounts(int level, std::int64_t* counts, const Executor& executor = {}) const;
  /// The same until the next run().
  const std::int64_t* counts(int level = 0) const;
  void copyKeys(int level, std::uint64_t* keys, const Executor& executor = {}) const;
  void copyCovariances(int level, SymMat3* covariances, const Executor& executor = {}) const;
  /// Of each voxel of level - 1, the voxel of @p level it lies in. @pre level >= 1, keys were asked for.
  const std::vector<std::int64_t>& parents(int level) const;

  /// Tells again which voxel of level 0 each point inside lies in: visit(rows, voxels, count) is called for
  /// pieces, with what VoxelRequest::tuples asks for, possibly by several threads at once, but no two at once
  /// have a voxel in common. Tuples travel with the points, so that those of a voxel come together: memory,
  /// kept like the other, of up to 64 bytes for each of at most 1.25 million points. Wider ones are collected
  /// from all over the memory they are in. @pre run() was Ok with the same request, keys among it.
  /// @return Ok or Aborted.
  using Visitor = std::function<void(const PointRows& rows, const std::int64_t* voxels, int count)>;
  Status assign(const VoxelRequest& request, const Visitor& visit, const Executor& executor = {},
    ProgressObserver* observer = nullptr);

  /// The same for one set of voxels after the other: work(first, voxels, forPoints) is called for all sets,
  /// voxels first and on, possibly by several threads at once, and forPoints(visit) visits all points of
  /// these voxels; their numbers then count from first. @pre that of assign(), and canAssignInSets()
  using SetWork = std::function<void(
    std::int64_t first, std::int64_t voxels, const std::function<void(const Visitor&)>& forPoints)>;
  void assignInSets(const VoxelRequest& request, const SetWork& work, const Executor& executor = {});
  /// run() remembers all points: see VoxelRequest::assigned.
  bool canAssignInSets() const;

  std::size_t scratchBytes() const;
  /// Frees the memory kept, results included.
  void releaseScratch();

private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

} // namespace pointhaptics
