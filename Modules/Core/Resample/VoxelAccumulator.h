/// @file
/// Sums of points in the voxels of a lattice that more points can be added to.
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
#include <string>
#include <string_view>
#include <vector>

namespace pointhaptics
{
namespace simd
{
class VoxelRuns;
}

/// Points: all, and of these the ones that are in no voxel.
struct PointCounts
{
  std::int64_t points = 0;
  std::int64_t clipped = 0;
  std::int64_t invalid = 0;
};

/// Accumulates clouds voxel by voxel: parts of a file, what other processes have summed.
///
/// Sums are exact integers, those of VoxelResampler. So neither the order of add() and merge(), nor how the
/// points are split over them, nor threads or instruction sets change a bit of finish(): it gives what
/// VoxelResampler::run() gives for all the points that were added.
///
/// Memory: 48 bytes an active voxel, 144 with covariances, at most a third more. Time: that of resampling for
/// the points of a call, and of copying voxels a few times; finish() costs in proportion to the active
/// voxels. Arrays: 8 bytes a voxel and component for each 64 bits of the sums, mostly once; where the most
/// frequent or the middle value is wanted, 8, and 16 for each value of the voxel's points. One thread at a
/// time may use an object.
class VoxelAccumulator
{
public:
  /// An array whose tuples each add() brings, and what becomes of them in a voxel.
  using Array = AccumulatedArray;

  /// @pre lattice.check() is Ok; add() returns its error otherwise. Normals have three components.
  /// @p transform: of all points, into the frame of the lattice.
  explicit VoxelAccumulator(const Lattice& lattice, bool covariances = false, std::vector<Array> arrays = {},
    const AffineTransform& transform = {});
  ~VoxelAccumulator();
  VoxelAccumulator(VoxelAccumulator&&) noexcept;
  VoxelAccumulator& operator=(VoxelAccumulator&&) noexcept;

  /// Points added: all, those finite outside the lattice, those NaN or infinite.
  std::int64_t points() const { return counts_.points; }
  std::int64_t clippedPoints() const { return counts_.clipped; }
  std::int64_t invalidPoints() const { return counts_.invalid; }

  /// Adds points, with the @p arrays in their order. Errors: the transform's, the lattice's, InvalidParameter
  /// (more than kMostPoints in all, other arrays, fewer tuples than points), Aborted; nothing is added then.
  Status add(const PointView& points, const std::vector<AttributeView>& arrays = {},
    const Executor& executor = {}, ProgressObserver* observer = nullptr);
  /// Adds all of another's sums, which has none afterwards. InvalidParameter: another lattice, covariances in
  /// one of them only, other arrays, another transform, too many points; nothing is changed then.
  Status merge(VoxelAccumulator&& other);

  /// Makes @p result: its means, counts, covariances, arrays, keys, as after run(). More can be added
  /// afterwards. Of @p request count singlePrecision, keys, instructions, allocator. Error: Aborted.
  Status finish(VoxelRequest request, VoxelResampler& result, const Executor& executor = {},
    ProgressObserver* observer = nullptr);

  /// The sums as bytes, for a file or another process: a version, the lattice, the voxels of part(@p first,
  /// @p end). Machines with the other order of bytes refuse them.
  std::string serialize(std::uint64_t first = 0, std::uint64_t end = ~std::uint64_t(0));
  /// The voxels whose keys are from @p first to before @p end, and their points alone; those clipped or
  /// invalid go with the first key, 0. The parts of all ranges merge to the whole;
  /// part(0, 0) has none.
  VoxelAccumulator part(std::uint64_t first, std::uint64_t end);
  /// Frees the scratch memory that add() keeps for the next call.
  void releaseScratch() { engine_.releaseScratch(); }
  /// Keys of active voxels in ascending order.
  std::vector<std::uint64_t> keys();
  /// Reads the bytes of serialize(). InvalidParameter, with @p result unchanged: bytes of another version, or
  /// cut or changed on their way, which their checksum tells. Not for bytes that somebody may have forged.
  static Status deserialize(std::string_view bytes, VoxelAccumulator& result);

  /// Their sums fit on every lattice.
  static constexpr std::int64_t kMostPoints = std::int64_t(1) << 34;

private:
  template <typename Archive>
  void exchange(Archive& archive);

  std::unique_ptr<simd::VoxelRuns> runs_;
  PointCounts counts_;
  VoxelResampler engine_;
  Lattice lattice_;
  bool covariances_;
  std::vector<Array> arrays_;
  AffineTransform transform_;
};

} // namespace pointhaptics
