/// @file
/// The inner loops of mean resampling, one set per instruction set. Private to Core: VoxelResampler drives
/// them. All sets give the same bits.
#pragma once

#include "Core/Base/PointBlocks.h"
#include "Core/Simd/InstructionSet.h"

#include <cstddef>
#include <cstdint>
#include <tuple>

namespace pointhaptics::simd
{

__extension__ typedef __int128 Int128;
__extension__ typedef unsigned __int128 UInt128;

/// A coordinate is a fixed-point number of this many bits over the power of two of voxels that covers the
/// longest axis of the lattice.
constexpr int kPositionBits = 43;
/// Largest power of two of voxels on an axis that records hold with 31 bits left for the offset in the voxel.
/// Those of finer lattices have the index of the voxel alone; points are quantized again for their sums.
constexpr int kMaximumIndexBits = kPositionBits - 31;
/// And the smallest: one bit of an index is not in the record.
constexpr int kMinimumIndexBits = 2;
/// Bits of the index of a voxel of a fine lattice, on each axis: z above y above x, in the order of keys.
constexpr int kFineBits = 21;
/// Points of a chunk.
constexpr std::int64_t kChunkPoints = 1250000;

/// Distance between memory that one thread writes and memory that another uses: two cache lines, which the
/// processor fetches together.
constexpr std::size_t kApart = 128;
/// Bits of a position: those of a double's mantissa without the leading one.
constexpr int kDoubleBits = 52;
constexpr std::uint64_t kPositionMask = (std::uint64_t(1) << kDoubleBits) - 1;
/// Low bits of z in the first word of a record, below x; as many more are in the second. The top bit of z is
/// left out: it follows from the partition, as no partition spans half the layers.
constexpr int kLowBits = 64 - kPositionBits;
constexpr std::uint64_t kLowMask = (std::uint64_t(1) << kLowBits) - 1;

/// A point record: the quantized position of one point, as low bits of z | x, high bits of z | y; on fine
/// lattices the index of its voxel, first. Where more than sums is wanted, it has a payload (PayloadLayout).
struct alignas(16) PointRecord
{
  std::uint64_t first;
  std::uint64_t second;
};

/// Records are written into blocks of a power of two of records, at most so many, aligned to their size.
constexpr std::size_t kBlockRecords = 4096 / sizeof(PointRecord);
/// Records of a line of the caches.
constexpr int kLineRecords = 64 / sizeof(PointRecord);
constexpr int kLineNumbers = 64 / sizeof(std::uint32_t);

/// Parts of the matrix and the offset that must be applied.
enum class Motion
{
  Scale, ///< The matrix is diagonal.
  General,
  Compensated, ///< General, and rounding would cost digits: the pivot is 0, v is summed with its rounding
               ///< error.
  Fine,        ///< Likewise, with more bits than a record has.
};

/// The constants that quantize points: from coordinates to positions in the lattice, and to partitions.
/// The pivot is the cloud's point that maps to the lattice's origin. v = M (p - pivot) + offset in units of
/// the workspace, from the lattice's origin; u = v / quantum.
struct PointQuantizer
{
  double pivot[3];
  double matrix[3][3];
  double offset[3];
  double offsetRest[3]; ///< Rounding error of the offset; only compensated motions use it.
  double quantum[3];    ///< The spacing over a power of two.
  double reciprocal[3]; ///< 1 / quantum, rounded.
  double remainder[3];  ///< Rounding error of the reciprocal, rounded.
  double limit[3];      ///< u below this is inside.
  Motion motion;
  int fractionBits; ///< Bits of a position below the voxel.
  // Which partition: (z >> layerShift) * blocksPerLayer + (y >> rowShift).
  std::uint32_t blocksPerLayer;
  int rowShift;
  int layerShift;
};

constexpr std::uint32_t kNoBlock = ~std::uint32_t(0);

/// An array whose tuples go with the records of their points.
struct PayloadArray
{
  const char* values; ///< Address of the first number.
  std::int64_t step;  ///< Bytes from one tuple to the next.
  int bytes;          ///< Bytes of a tuple.
  int offset;         ///< In bytes, of a tuple in a payload.
};

/// Layout of a record's payload: its first word is the number of the point, if that is of use; tuples follow.
struct PayloadLayout
{
  static constexpr int kMostWords = 9;
  static constexpr int kMostArrays = 8;

  int words = 0; ///< Number of 32-bit words; 0: no payload.
  bool numbered = false;
  int count = 0;
  PayloadArray arrays[kMostArrays] = {};
};

/// The write position of one thread in each partition.
struct PointRecordWriter
{
  PointRecord** cursors;
  std::uintptr_t blockMask;  ///< Bytes of a block, less one.
  PointRecord* records;      ///< Start of all blocks.
  std::uint32_t* lastBlocks; ///< Last block of each partition, or kNoBlock.
  std::uint32_t* previous;   ///< For each block, the block before it in its partition, or
                             ///< kNoBlock.
  std::uint32_t* taken;      ///< Blocks that all writers have taken: they share it.
  std::uint32_t nextBlock;   ///< Next of the blocks that were taken in advance.
  std::uint32_t endBlock;
  std::uint32_t* payloads;        ///< Payload of each record.
  PayloadLayout layout;           ///< Layout of a payload.
  const std::uint32_t* originals; ///< Numbers from the first range's begin on; or null: they ascend.
  std::uint32_t firstNumber;      ///< Number of the first range's begin.
  std::int64_t inside;
  std::int64_t invalid;
};

/// Blocks a writer takes at once: an atomic operation waits for all stores before it.
constexpr std::uint32_t kTakenBlocks = 32;

/// Where a partition's first block begins to be filled: without this stagger all cursors would compete for
/// the same few sets of the first-level cache. @pre blockRecords: a power of two.
static inline std::size_t firstRecord(std::uint32_t partition, std::size_t blockRecords)
{
  return kLineRecords * (partition & (blockRecords / kLineRecords - 1));
}

/// The cursor of a partition: at first, and where it stands at the end of its block, in a new block.
__attribute__((always_inline)) static inline PointRecord* cursorOf(
  PointRecordWriter& writer, PointRecord* const* cursors, std::uintptr_t blockMask, std::uint64_t partition)
{
  PointRecord* const cursor = cursors[partition];
  if (__builtin_expect((reinterpret_cast<std::uintptr_t>(cursor) & blockMask) != 0, true))
  {
    return cursor;
  }
  if (writer.nextBlock == writer.endBlock)
  {
    writer.nextBlock = __atomic_fetch_add(writer.taken, kTakenBlocks, __ATOMIC_RELAXED);
    writer.endBlock = writer.nextBlock + kTakenBlocks;
  }
  const std::uint32_t block = writer.nextBlock++;
  const std::uint32_t last = writer.lastBlocks[partition];
  writer.previous[block] = last;
  writer.lastBlocks[partition] = block;
  const std::size_t blockRecords = (blockMask + 1) / sizeof(PointRecord);
  return writer.records + block * blockRecords +
    (last == kNoBlock ? firstRecord(std::uint32_t(partition), blockRecords) : 0);
}

/// Which cell of a partition a record is in: x + columns (row - firstRow).
struct CellMap
{
  int fractionBits;
  std::uint32_t columns;
  std::uint32_t rowsPerLayer;
  std::uint32_t firstRow;
  std::uint32_t firstRecordRow; ///< Without the bit of z that is left out of the records.
};

/// Sums of one chunk in one cell: x, y, low bits of z, count | high bits of z.
struct alignas(32) PackedSums
{
  std::uint64_t lanes[4];
};
/// The count stands above the sum of the high bits: fewer than 2^21 points of kPositionBits - kLowBits bits.
constexpr int kCountShift = 43;
constexpr std::size_t kMostPackedPoints = (std::size_t(1) << 21) - 1;
static_assert(kChunkPoints <= std::int64_t(kMostPackedPoints) && 21 + kPositionBits - kLowBits <= kCountShift,
  "the high bits of z must not reach the count");

static inline std::int64_t packedCount(const PackedSums& sums)
{
  return std::int64_t(sums.lanes[3] >> kCountShift);
}
static inline std::int64_t packedZ(const PackedSums& sums)
{
  constexpr std::uint64_t kHighMask = (std::uint64_t(1) << kCountShift) - 1;
  return std::int64_t(sums.lanes[2] + ((sums.lanes[3] & kHighMask) << kLowBits));
}

/// Second moments of a voxel's points: sums of products of their offsets in the voxel, in the order of
/// SymMat3: xx yy zz xy yz xz. They are kept modulo 2^128, as the central moments that covarianceOf()
/// computes from them are small.
struct SecondMoments
{
  UInt128 lanes[6];
};

/// Tables to rank the cells of a partition, in the first-level cache: an occupancy bit for each cell, 0
/// between partitions, and an entry of the rank table for each word of 64 bits.
struct CellTables
{
  std::uint64_t* occupancy;
  std::uint32_t* rankTable; ///< Occupied cells in the words before.
  std::size_t words;
};

/// Whether the matrix of a transform scales and mirrors only.
static inline bool isDiagonal(const double m[3][4])
{
  return m[0][1] == 0.0 && m[0][2] == 0.0 && m[1][0] == 0.0 && m[1][2] == 0.0 && m[2][0] == 0.0 &&
    m[2][1] == 0.0;
}

/// Offsets of a record's point in its voxel, as fractions of it. These are static: sources of several
/// instruction sets include them, and the linker must not choose one set's for all.
static inline std::uint64_t xFraction(const PointRecord& r, std::uint64_t fractionMask)
{
  return (r.first >> kLowBits) & fractionMask;
}
static inline std::uint64_t yFraction(const PointRecord& r, std::uint64_t fractionMask)
{
  return (r.second >> kLowBits) & fractionMask;
}
static inline std::uint64_t zFraction(const PointRecord& r, std::uint64_t fractionMask)
{
  return ((r.first & kLowMask) | ((r.second & kLowMask) << kLowBits)) & fractionMask;
}

static inline void addProducts(SecondMoments& sums, std::uint64_t x, std::uint64_t y, std::uint64_t z)
{
  sums.lanes[0] += UInt128(x) * x;
  sums.lanes[1] += UInt128(y) * y;
  sums.lanes[2] += UInt128(z) * z;
  sums.lanes[3] += UInt128(x) * y;
  sums.lanes[4] += UInt128(y) * z;
  sums.lanes[5] += UInt128(x) * z;
}

/// Voxels on their way from the sums to the result, at most this many at once.
constexpr int kBatch = 256;

/// How sums become coordinates. The mean of a voxel is origin + (index + sum / (count 2^fractionBits))
/// spacing.
struct MeanMap
{
  double origin[3];
  double spacing[3];
  double quantum; ///< 2^-fractionBits
  // Closer to a face rounding may carry a mean into the next voxel. In quanta: from the lower face, and from
  // there on to as much below the upper one.
  double margin[3];
  double clearance[3];
};

/// Elements of the widest vectors.
constexpr int kWidest = 4;

/// The inner loops over numbers of one type; coordinates are x y z interleaved.
template <typename Real>
struct PointKernels
{
  /// Quantizes the points of @p count ranges of an array and appends those inside to their partitions.
  void (*partition)(
    const PointQuantizer&, const Real* xyz, const PointRange* ranges, std::int64_t count, PointRecordWriter&);
  /// Coordinates and counts of cells with their sums. Positions among them of means so near a face that they
  /// need another look go to @p nearFace. @return the number of these. Reads, but does not use, kWidest
  /// elements past the end.
  int (*packedMeans)(const MeanMap&, const CellMap&, const std::uint32_t* cells, const PackedSums* sums,
    int count, Real* xyz, std::int64_t* counts, int* nearFace);
  /// Widens a box (x0 x1 y0 y1 z0 z1) by the transformed points that are finite before and after. @p stride:
  /// numbers from one point to the next.
  void (*bounds)(
    const double matrix[3][4], const Real* xyz, std::int64_t count, std::int64_t stride, double box[6]);
};

/// Longer lists are left to others.
constexpr int kFewValues = 64;
/// Bytes of the vectors that lists are read in.
constexpr int kListVector = 32;
/// The statistic of up to kFewValues orderedKey()s of values of one type: see AttributeStatistic. Reads, but
/// does not use, kListVector bytes past the end.
using SelectKernel = void (*)(const void* values, int count, void* to);

/// The inner loops for one instruction set.
struct Kernels
{
  std::tuple<PointKernels<float>, PointKernels<double>> points;
  template <typename Real>
  const PointKernels<Real>& of() const
  {
    return std::get<PointKernels<Real>>(points);
  }
  /// The cell of each record. Prefetches the block of records that comes @p next: blocks are not contiguous
  /// often enough for the hardware's prefetcher.
  void (*cells)(
    const CellMap&, const PointRecord* records, int count, const PointRecord* next, std::uint32_t* cells);
  /// Turns the cells of @p count records into ranks among the cells that have records. These go to
  /// @p occupied in ascending order. @return their number.
  std::uint32_t (*rank)(
    const CellTables& tables, std::uint32_t* cells, std::size_t count, std::uint32_t* occupied);
  /// Adds records to the sums of their ranks, and to the second moments unless these are null; fetches @p
  /// next like cells().
  void (*accumulate)(int fractionBits, const PointRecord* records, const std::uint32_t* ranks, int count,
    const PointRecord* next, PackedSums* sums, SecondMoments* secondMoments);
  /// Offsets x y z in their voxels of points of a fine lattice. Reads and writes kWidest points past the end.
  void (*fineOffsets)(const PointQuantizer&, const double* xyz, int count, std::uint64_t* offsets);
  const SelectKernel* modes; ///< In the order of ScalarType.
  const SelectKernel* medians;
};

/// The set that InstructionSet stands for on this machine.
const Kernels& kernelsFor(InstructionSet wanted);

const Kernels& baselineKernels();
/// Null where the compiler or the processor family lacks them; whether this machine can run them is asked
/// elsewhere.
const Kernels* avx2Kernels();

} // namespace pointhaptics::simd
