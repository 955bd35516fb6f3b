/// @file
/// Mean resampling: the points in each voxel of a lattice become their mean (the paper's "mean filter").
#pragma once

#include "Core/Base/AffineTransform.h"
#include "Core/Base/Executor.h"
#include "Core/Base/Lattice.h"
#include "Core/Base/PointView.h"
#include "Core/Base/ProgressObserver.h"
#include "Core/Base/Status.h"
#include "Core/Resample/AttributeView.h"
#include "Core/Resample/Representative.h"
#include "Core/Simd/InstructionSet.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace pointhaptics
{

class PointIndex;

/// Allocates the results in the caller's memory: run() writes them in place.
class OutputAllocator
{
public:
  /// The arrays. Those of the request's attributes come last: Attributes, and the numbers after it.
  enum Part : std::size_t
  {
    Means,
    Counts,
    Covariances,
    Attributes,
  };
  virtual ~OutputAllocator() = default;
  /// At least so many bytes, aligned for their type, valid until the next run(); or null: the resampler's own
  /// memory. The result may need fewer in the end. Called from the thread that called run(), once for each
  /// part; and once more, for no more than the result needs, where there was too little memory.
  virtual void* allocate(std::size_t part, std::size_t bytes) = 0;
};

/// Points to resample, and the results to make of them.
struct VoxelRequest
{
  PointView points;
  /// An index of the same points, or the one whose points() they are: it skips points outside the lattice
  /// without reading each. May be null.
  const PointIndex* index = nullptr;
  AffineTransform transform; ///< From the cloud's frame into that of the lattice.
  Lattice lattice;
  /// With an index: a part of the lattice. Points outside its box may be skipped; they count as clipped.
  /// Voxels inside are the same as without, bit for bit; others may lack points, or be missing.
  std::optional<Lattice> part;
  bool singlePrecision = false; ///< Means are rounded to float.
  bool covariances = false;
  bool keys = false; ///< For keys().
  /// Arrays of the points, to be reduced to a tuple for each voxel.
  std::vector<AttributeRequest> attributes;
  /// Representative of the points of a voxel, in the place of their mean; counts and covariances stay. For
  /// all but the mean keys are made, points must not be those of index->points(), and are at most 2^32.
  Representative representative = Representative::Mean;
  /// Arrays that choose between points at the same distance and place: see Representative.
  std::vector<AttributeView> tieBreakers;
  /// For voxelIndex(). Conditions as for a representative.
  bool voxelIndex = false;
  /// Points between two reports, at least 1; 0 or more than the default: the default (1.25 million). Four
  /// chunks are summed at once. It changes memory and time, not the results.
  std::int64_t chunkPoints = 0;
  InstructionSet instructions = InstructionSet::Automatic;
  OutputAllocator* allocator = nullptr; ///< Null: the resampler's own memory.
};

/// Resamples clouds. Scratch memory is kept from one run to the next (releaseScratch()).
///
/// The position of a point in the lattice is u = (T p + t - origin) / spacing, in double, about a point near
/// the lattice's origin, so that large coordinates cost no digits. The voxel is floor(u), half-open.
/// Positions are then quantized: truncated to fixed-point numbers whose quantum is a power of two below the
/// length of the lattice's longest axis, at most 2^-31 voxel, 2^-34 on 300^3. Sums of these are exact. Hence
/// results are the same bit for bit for every order of the points, every executor, instruction set and
/// PointIndex.
///
/// Accuracy: a mean is off by at most 2^-31 voxel (a quarter more beyond 2^20 voxels an axis), then rounded
/// once to the output's type; it lies in its voxel. Under a rotation or a scale another version may differ
/// within that bound. Under a matrix whose condition number would cost digits the products are summed in two
/// words each, in half as much time again (several times as much without a fused multiplication).
///
/// Time: a few nanoseconds a point; beyond 4096 voxels an axis some tens of them. Memory beyond input and
/// results: 16 bytes for each of at most 5 million points (with attributes up to 52), a few megabytes, and
/// for more points 48 bytes an active voxel, 144 with covariances, and what VoxelAccumulator says of arrays:
/// sums of 5 million are merged with the others. With representatives or VoxelRequest::voxelIndex all points
/// are held at once, with medians under a transform their places too. One thread at a time may use an object.
class VoxelResampler
{
public:
  VoxelResampler();
  ~VoxelResampler();
  VoxelResampler(VoxelResampler&&) noexcept;
  VoxelResampler& operator=(VoxelResampler&&) noexcept;

  /// Errors: the transform's, the lattice's, InvalidParameter (an index of another number of points, more
  /// than 2^32 points with a representative or VoxelRequest::voxelIndex, an attribute of fewer tuples,
  /// without components or of normals without three), Aborted (the observer said so); there are no voxels
  /// then. A cloud without a point inside is no error.
  Status run(
    const VoxelRequest& request, const Executor& executor = {}, ProgressObserver* observer = nullptr);

  // Results of run(), valid until the next one.
  std::int64_t clippedPoints() const { return results_->clipped; } ///< Finite points outside the lattice.
  /// Points NaN or infinite, before or after the transform.
  std::int64_t invalidPoints() const { return results_->invalid; }
  std::int64_t size() const { return results_->size; } ///< Active voxels.
  const Lattice& lattice() const { return results_->lattice; }
  // Arrays of the voxels in ascending order of their keys (x fastest).
  /// Means, three numbers each; null where the other type was asked for.
  const float* floats() const { return results_->floats; }
  const double* doubles() const { return results_->doubles; }
  const std::int64_t* counts() const { return results_->counts; }
  const std::uint64_t* keys() const { return results_->keys; } ///< If asked for, as the covariances.
  const SymMat3* covariances() const { return results_->covariances; }
  /// The tuples of an attribute of the request, of the array's own type.
  const void* attribute(std::size_t attribute) const { return results_->attributes[attribute]; }
  /// Number of the point that represents each voxel; empty unless a nearest one was requested.
  const std::vector<std::int64_t>& chosenPoints() const { return results_->chosenPoints; }
  /// Voxel of each point, or -1 where it is clipped or invalid; empty unless requested.
  const std::vector<std::int64_t>& voxelIndex() const { return results_->voxelIndex; }

  /// Frees the memory kept, results included.
  void releaseScratch();

private:
  friend class VoxelAccumulator;
  class Implementation;
  struct Results
  {
    Lattice lattice;
    std::int64_t size = 0;
    std::int64_t clipped = 0;
    std::int64_t invalid = 0;
    const float* floats = nullptr;
    const double* doubles = nullptr;
    const std::int64_t* counts = nullptr;
    const std::uint64_t* keys = nullptr;
    const SymMat3* covariances = nullptr;
    std::vector<const void*> attributes = {};
    std::vector<std::int64_t> chosenPoints = {};
    std::vector<std::int64_t> voxelIndex = {};
  };
  std::unique_ptr<Implementation> implementation_;
  const Results* results_; ///< Of the implementation.
};

} // namespace pointhaptics
