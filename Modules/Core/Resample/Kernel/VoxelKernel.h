/// @file
/// The inner loops of mean resampling, one set per instruction set. Private to Core: VoxelResampler drives
/// them. All sets give the same bits.
#pragma once

#include "Core/Base/PointRange.h"
#include "Core/Simd/InstructionSet.h"

#include <cstddef>
#include <cstdint>

namespace pointhaptics::simd
{

__extension__ typedef __int128 Int128;
__extension__ typedef unsigned __int128 UInt128;

/// A coordinate is a fixed-point number of this many bits over the power of two of voxels that covers the
/// longest axis of the lattice.
constexpr int kPositionBits = 43;
/// Largest power of two of voxels on an axis these records hold with 31 bits left for the offset in the
/// voxel.
constexpr int kMaximumIndexBits = kPositionBits - 31;
/// And the smallest: one bit of an index is not in the record.
constexpr int kMinimumIndexBits = 2;
/// Points of a chunk.
constexpr std::int64_t kChunkPoints = 1250000;

/// Distance between memory that one thread writes and memory that another uses: two cache lines, which the
/// processor fetches together.
constexpr std::size_t kApart = 128;

/// Added to an integer below it this leaves the integer in the low bits of the sum.
constexpr double kToBits = 0x1p52;

constexpr std::uint64_t kPositionMask = (std::uint64_t(1) << kPositionBits) - 1;
/// Low bits of z in the first word of a record, below x; as many more are in the second. The top bit of z is
/// left out: it follows from the partition, as no partition spans half the layers.
constexpr int kLowBits = 64 - kPositionBits;
constexpr std::uint64_t kLowMask = (std::uint64_t(1) << kLowBits) - 1;

/// A point record: the quantized position of one point, as low bits of z | x, high bits of z | y. Where more
/// than sums is wanted, it has a payload (PayloadLayout).
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
  Compensated, ///< General, and rounding would cost digits: the pivot is 0, v a dot product in two words.
};

/// The constants that quantize points: from coordinates to positions in the lattice, and to partitions.
/// v = M (p - pivot) + offset in units of the workspace, from the lattice's origin; u = v / quantum.
struct PointQuantizer
{
  double pivot[3];
  double matrix[3][3];
  double offset[3];
  double offsetRest[3]; ///< Rounding error of the offset; only Motion::Compensated uses it.
  double quantum[3];    ///< The spacing over a power of two.
  double reciprocal[3]; ///< 1 / quantum, rounded.
  double remainder[3];  ///< Rounding error of the reciprocal, rounded.
  double limit[3];      ///< u below this is inside.
  Motion motion;
  int fractionBits;      ///< Bits of a position below the voxel.
  bool correctsRounding; ///< quantizePoint() does: see kUncorrectedIndexBits.
  // Which partition: (z >> layerShift) * blocksPerLayer + (y >> rowShift).
  std::uint32_t blocksPerLayer;
  int rowShift;
  int layerShift;
};

struct PointRecordWriter;

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

/// Which cells of a partition have points, and the rank of a cell among them: an occupancy bit for each cell
/// and an entry of the rank table for each word of 64 bits. Both stay in the first-level cache.
struct CellRanks
{
  std::uint64_t* occupancy;
  std::uint32_t* rankTable; ///< Occupied cells in the words before.
  std::size_t words;
};

/// The sums of a partition's occupied cells, in ascending order.
struct CellSums
{
  std::uint32_t* cells;
  PackedSums* sums;
  SecondMoments* secondMoments; ///< Or null.
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

/// How second moments become covariances.
struct CovarianceMap
{
  int fractionBits;
  double unit[3]; ///< A quantum in the frame of the lattice.
};

/// Elements of the widest vectors.
constexpr int kWidest = 8;

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
/// The statistic of a list of up to kFewValues values of one type: see AttributeStatistic. Reads, but does
/// not use, kListVector bytes past the end.
using SelectKernel = void (*)(const void* values, int count, void* to);

/// The inner loops for one instruction set.
struct Kernels
{
  PointKernels<float> floats;
  PointKernels<double> doubles;
  template <typename Real>
  const PointKernels<Real>& of() const
  {
    if constexpr (sizeof(Real) == sizeof(float))
    {
      return floats;
    }
    else
    {
      return doubles;
    }
  }
  /// The cell of each record. Prefetches the block of records that comes @p next: blocks are not contiguous
  /// often enough for the hardware's prefetcher.
  void (*cells)(
    const CellMap&, const PointRecord* records, int count, const PointRecord* next, std::uint32_t* cells);
  /// Sets the occupancy bits of cells.
  void (*setOccupied)(const std::uint32_t* cells, std::size_t count, std::uint64_t* occupancy);
  /// Builds the rank table, of the words alone whose bits are set in @p touched, unless that is null.
  /// @return the number of occupied cells.
  std::uint32_t (*rankWords)(const CellRanks& ranks, const std::uint64_t* touched);
  /// Adds records to the sums of their @p cells, which become their ranks among the occupied cells; fetches
  /// @p next like cells().
  void (*accumulate)(const CellMap&, const CellRanks& ranks, const PointRecord* records, std::uint32_t* cells,
    int count, const PointRecord* next, const CellSums& sums);
  /// Covariances of cells, six numbers each in the order of SecondMoments. Positions among them of those with
  /// too many points for this go to @p full, at most @p count: theirs are not valid. @return the number of
  /// these. Reads, but does not use, kWidest elements past the end.
  int (*covariances)(const CovarianceMap&, const PackedSums* sums, const SecondMoments* secondMoments,
    int count, double* covariances, int* full);
  const SelectKernel* modes; ///< In the order of ScalarType.
  const SelectKernel* medians;
};

/// The set that InstructionSet stands for on this machine.
const Kernels& kernelsFor(InstructionSet wanted);

const Kernels& baselineKernels();
/// Null where the compiler or the processor family lacks them; whether this machine can run them is asked
/// elsewhere.
const Kernels* avx2Kernels();
const Kernels* avx512Kernels();

} // namespace pointhaptics::simd
