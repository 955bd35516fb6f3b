/// @file
/// The inner loops of the local surface fit, one version per instruction set. Private to Core: SurfaceFit
/// drives them. All versions give the same bits: eight lanes, joined in one order, no fused multiply-adds.
#pragma once

#include "Core/Base/Vector3.h"
#include "Core/Simd/InstructionSet.h"

namespace pointhaptics
{
namespace simd
{

constexpr int kFitLanes = 8;
/// Free numbers behind each array. Without them equal indices of all arrays would compete for the same few
/// cache lines.
constexpr int kFitGap = kFitLanes;

/// Cells near a center, each quantity in an array of its own; positions relative to the center.
struct alignas(64) FitBlock
{
  static constexpr int kCapacity = 1024;

  double x[kCapacity + kFitGap];
  double y[kCapacity + kFitGap];
  double z[kCapacity + kFitGap];
  double count[kCapacity + kFitGap];
  double xx[kCapacity + kFitGap];
  double xy[kCapacity + kFitGap];
  double xz[kCapacity + kFitGap];
  double yy[kCapacity + kFitGap];
  double yz[kCapacity + kFitGap];
  double zz[kCapacity + kFitGap];
  int size = 0;
  int level = -1; ///< Level of the cells; -1: the block is empty.
  Vec3 center;
  double reach = 0.0; ///< Radius about the center within which all cells are here.

  void set(int i, const Vec3& p, double n, const SymMat3& c)
  {
    x[i] = p.x;
    y[i] = p.y;
    z[i] = p.z;
    count[i] = n;
    xx[i] = c.xx;
    xy[i] = c.xy;
    xz[i] = c.xz;
    yy[i] = c.yy;
    yz[i] = c.yz;
    zz[i] = c.zz;
  }
  /// Makes cell @p i one without weight.
  void clear(int i) { set(i, Vec3(), 0.0, SymMat3()); }
};

/// Values of a node of the field of fit radii, the radius first; see kScaleValues in RadiusField.h.
constexpr int kFieldValues = 6;

/// Nodes of the field near a center.
struct alignas(64) FieldBlock
{
  static constexpr int kCapacity = 128;

  double x[kCapacity];
  double y[kCapacity];
  double z[kCapacity];
  double present[kCapacity]; ///< 1, or 0 in the padding.
  double values[kFieldValues][kCapacity];
  int size = 0;
  Vec3 center;
  double reach = -1.0;

  void clear(int i)
  {
    x[i] = y[i] = z[i] = present[i] = 0.0;
    for (auto& each : values)
    {
      each[i] = 0.0;
    }
  }
};

struct FieldSums
{
  double weights = 0.0;
  double values[kFieldValues] = {};
  double weightGradient[3] = {};
  double radiusGradient[3] = {}; ///< Gradient of the sum of weight times radius.
};

/// The frame and parameters of a fit; lengths in the unit of the block.
struct FitView
{
  Vec3 origin; ///< Origin of the frame, relative to the block's center.
  Vec3 a;
  Vec3 b;
  Vec3 normal;
  double radius = 0.0;
  double blendWeight = 1.0; ///< Weight of this level, where a fit blends two.
  double gate = 0.0;        ///< Depth of the gate, over the radius; 0: none.
  bool twoSidedGate = false;
  double bend[3] = { 0.0, 0.0, 0.0 };
};

/// One row per cell with its terms P, height, weights; lengths over the radius.
struct alignas(64) FitRows
{
  static constexpr int kCapacity = 2 * FitBlock::kCapacity;

  double u[kCapacity + kFitGap];
  double v[kCapacity + kFitGap];
  double uu[kCapacity + kFitGap];
  double uv[kCapacity + kFitGap];
  double vv[kCapacity + kFitGap];
  double height[kCapacity + kFitGap];
  double weight[kCapacity + kFitGap];      ///< n g (1 - e)^4
  double slopeWeight[kCapacity + kFitGap]; ///< 4 n g (1 - e)^3
  double e[kCapacity + kFitGap];
  double can[kCapacity + kFitGap]; ///< a'C n
  double cbn[kCapacity + kFitGap]; ///< b'C n
  double count[kCapacity + kFitGap];
  int size = 0; ///< A multiple of kFitLanes; rows without a cell have weight 0.
};

/// Sums over the ten terms T = P, Q: W T T' (lower triangle, row by row), W T z, W z z, and how many weights
/// are above 0.
struct FitSums
{
  double a[55];
  double rhs[10];
  double zz;
  double cells;
};

/// A height over the frame with ten terms, P and Q, and the row of the inverse normal matrix that gives k0.
struct TracedFit
{
  double k[10] = {};
  double row[10] = {};
};

/// Changes of the height by a moving origin, as the part of the moving weights and that of the turning frame;
/// see traceSlopes().
struct TraceSums
{
  double moveA;
  double moveB;
  double turnA;
  double turnB;
};

/// Points about a ball, each quantity in an array of its own with room for whole groups of lanes.
struct BallPoints
{
  const double* x;
  const double* y;
  const double* z;
  const double* radius; ///< Radius by which each point keeps the ball away.
  int size;             ///< Number of points, a multiple of kFitLanes; the last ones lie far away.
};

struct FitKernels
{
  /// Appends a row for each cell of @p block. Groups of cells beyond the radius may be left out.
  void (*appendRows)(const FitBlock& block, const FitView& view, FitRows& rows);
  /// All sums but those of the cubic terms Q = (uuu, uuv, uvv, vvv), and these.
  void (*sumRows)(const FitRows& rows, FitSums& sums);
  void (*sumCubicRows)(const FitRows& rows, FitSums& sums);
  /// @param ra, rb gradient of the radius along a and b.
  void (*traceRows)(const FitRows& rows, const TracedFit& fit, double ra, double rb, TraceSums& sums);
  /// Indices of the points nearer to @p p than sqrt(@p radius2), ascending; at most @p most of them. @return
  /// how many.
  int (*pointsWithin)(const BallPoints& points, const Vec3& p, double radius2, int* indices, int most);
  /// As pointsWithin(), for the points nearer than @p scale times their radius and @p extra.
  int (*ballsWithin)(
    const BallPoints& points, const Vec3& p, double scale, double extra, int* indices, int most);
  /// Length that a place can go from @p from along the unit vector @p direction, at most @p length, before it
  /// is nearer to a point than @p scale times its radius. A way that leads into a point by less than @p
  /// tangential of its radius does not count.
  double (*sweepBall)(const BallPoints& points, const Vec3& from, const Vec3& direction, double length,
    double scale, double tangential);
  /// Weights (1 - d^2/reach^2)^3 of the nodes about @p position, relative to the block's center.
  void (*sumField)(const FieldBlock& block, const Vec3& position, double reach, FieldSums& sums);
};

/// Loops of usableInstructionSet(@p wanted).
const FitKernels& fitKernels(InstructionSet wanted = InstructionSet::Automatic) noexcept;

const FitKernels& baselineFitKernels();
/// Loops of one instruction set; null where the compiler or the processor family lacks it.
const FitKernels* avx2FitKernels();

} // namespace simd
} // namespace pointhaptics
