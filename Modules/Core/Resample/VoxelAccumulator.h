/// @file
/// Sums of points in the voxels of a lattice that more points can be added to, and taken from.
#pragma once

#include "Core/Base/AffineTransform.h"
#include "Core/Base/Executor.h"
#include "Core/Base/Lattice.h"
#include "Core/Base/PointView.h"
#include "Core/Base/ProgressObserver.h"
#include "Core/Base/Status.h"
#include "Core/Resample/AttributeView.h"
#include "Core/Resample/VoxelResampler.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pointhaptics
{
/// Accumulates clouds voxel by voxel: frames of a sensor, parts of a file, what other processes have summed.
///
/// Sums are exact integers, those of VoxelResampler. So neither the order of add(), subtract() and merge(),
/// nor how the points are split over them, nor threads or instruction sets change a bit of finish(): it gives
/// what VoxelResampler::run() gives for all the points that were added and not subtracted.
///
/// Memory: 48 bytes an active voxel, 144 with covariances, at most a third more, and as much for what was
/// subtracted since the last finish(). Time: that of resampling for the points of a call, and of copying
/// voxels a few times; finish() costs in proportion to the active voxels. Arrays: 8 bytes a voxel and
/// component for each 64 bits of the sums, mostly once; where the most frequent or the middle value is
/// wanted, 8, and 16 for each value of the voxel's points. One thread at a time may use an object.
class VoxelAccumulator
{
public:
  /// An array whose tuples each add() brings, and what becomes of them in a voxel.
  using Array = AccumulatedArray;

  /// @pre lattice.check() is Ok; add() returns its error otherwise. Normals have three components.
  /// @p commonTransform: of all add() and subtract(), which refuse others. Means of normals are turned by it
  /// as run() turns them, to the same bits. Without it each call turns its own vectors, by its own transform
  /// and to their own length: rounded to double, so that what is subtracted must come by the transform it was
  /// added by.
  explicit VoxelAccumulator(const Lattice& lattice, bool covariances = false, std::vector<Array> arrays = {},
    std::optional<AffineTransform> commonTransform = {});
  ~VoxelAccumulator();
  VoxelAccumulator(VoxelAccumulator&&) noexcept;
  VoxelAccumulator& operator=(VoxelAccumulator&&) noexcept;

  const Lattice& lattice() const { return lattice_; }
  bool hasCovariances() const { return covariances_; }
  const std::vector<Array>& arrays() const { return arrays_; }
  /// Another one of the same lattice and arrays, without points.
  VoxelAccumulator withoutPoints() const
  {
    return VoxelAccumulator(lattice_, covariances_, arrays_, common_);
  }
  /// Points added less those subtracted: all, those finite outside the lattice, those NaN or infinite.
  std::int64_t points() const;
  std::int64_t clippedPoints() const;
  std::int64_t invalidPoints() const;

  /// Adds points, mapped by @p transform into the frame of the lattice, with the @p arrays in the order of
  /// arrays(). Errors: the transform's, the lattice's, InvalidParameter (more than kMostPoints in all, other
  /// arrays, fewer tuples than points, a transform that is not the common one), Aborted; nothing is added
  /// then.
  Status add(const PointView& points, const std::vector<AttributeView>& arrays,
    const AffineTransform& transform = {}, const Executor& executor = {},
    ProgressObserver* observer = nullptr)
  {
    return this->change(*added_, points, arrays, transform, executor, observer);
  }
  /// Without arrays.
  Status add(const PointView& points, const AffineTransform& transform = {}, const Executor& executor = {},
    ProgressObserver* observer = nullptr)
  {
    return this->change(*added_, points, {}, transform, executor, observer);
  }
  /// Takes points out that were added, or will be before finish(): the same coordinates, tuples and
  /// transform.
  Status subtract(const PointView& points, const std::vector<AttributeView>& arrays,
    const AffineTransform& transform = {}, const Executor& executor = {},
    ProgressObserver* observer = nullptr)
  {
    return this->change(*subtracted_, points, arrays, transform, executor, observer);
  }
  Status subtract(const PointView& points, const AffineTransform& transform = {},
    const Executor& executor = {}, ProgressObserver* observer = nullptr)
  {
    return this->change(*subtracted_, points, {}, transform, executor, observer);
  }
  /// Adds all of another's sums. InvalidParameter: another lattice, covariances in one of them only, other
  /// arrays, another common transform, too many points; nothing is changed then.
  Status merge(const VoxelAccumulator& other);
  /// Merges another accumulator that is no longer needed: its sums are not copied, and it has none
  /// afterwards.
  Status merge(VoxelAccumulator&& other);

  /// Results to make of the sums; as in VoxelRequest.
  struct Request
  {
    bool singlePrecision = false;
    bool keys = false;
    InstructionSet instructions = InstructionSet::Automatic;
    OutputAllocator* allocator = nullptr;
  };
  /// Makes @p result: its means, counts, covariances, arrays, keys, as after run(). More can be added
  /// afterwards. Errors: InvalidParameter (points were subtracted that had not been added, as far as counts
  /// and the values of labels tell), Aborted.
  Status finish(const Request& request, VoxelResampler& result, const Executor& executor = {},
    ProgressObserver* observer = nullptr);

  /// The sums as bytes, for a file or another process: a version, the lattice, the voxels of part(@p first,
  /// @p end); those of all voxels are the same for equal sums. Machines with the other order of bytes refuse
  /// them. Empty where points were subtracted that had not been added.
  std::string serialize(std::uint64_t first = 0, std::uint64_t end = ~std::uint64_t(0));
  /// The voxels whose keys are from @p first to before @p end, and their points alone; those clipped or
  /// invalid go with the first key, 0. The parts of all ranges merge to the whole. None where points were
  /// subtracted that had not been added.
  VoxelAccumulator part(std::uint64_t first, std::uint64_t end);
  /// Points that add() and subtract() take at once: see VoxelRequest::chunkPoints.
  void setChunkPoints(std::int64_t points) { chunkPoints_ = points; }
  /// Frees the scratch memory that add() and subtract() keep for the next call.
  void releaseScratch() { engine_.releaseScratch(); }
  /// Keys of active voxels in ascending order, every @p step th of them (at least 1). None where points were
  /// subtracted that had not been added.
  std::vector<std::uint64_t> keys(std::int64_t step = 1);
  /// Reads the bytes of serialize(). InvalidParameter, with @p result unchanged: bytes of another version or
  /// that no accumulator writes. Sizes are checked before memory is allocated; keys ascend and lie in the
  /// lattice, means in their voxels.
  static Status deserialize(std::string_view bytes, VoxelAccumulator& result);

  /// Added, or subtracted: their sums fit on every lattice.
  static constexpr std::int64_t kMostPoints = std::int64_t(1) << 34;

private:
  class Sums;
  Status change(Sums& sums, const PointView& points, const std::vector<AttributeView>& arrays,
    const AffineTransform& transform, const Executor& executor, ProgressObserver* observer);
  bool settle();

  std::unique_ptr<Sums> added_;
  std::unique_ptr<Sums> subtracted_;
  VoxelResampler engine_;
  Lattice lattice_;
  bool covariances_;
  std::vector<Array> arrays_;
  std::int64_t chunkPoints_ = 0;
  std::optional<AffineTransform> common_; ///< The transform of all points.
};

} // namespace pointhaptics
