/// @file
/// A quadric through the cells near a point: the local surface that the accurate proxy stands on.
#pragma once

#include "Core/Surface/CellPyramid.h"
#include "Core/Surface/FitCells.h"

namespace pointhaptics
{

/// Origin on (or near) the surface, unit normal towards the free side, unit tangents a and b = n x a.
struct SurfaceFrame
{
  Vec3 origin;
  Vec3 a{ 1, 0, 0 };
  Vec3 b{ 0, 1, 0 };
  Vec3 normal{ 0, 0, 1 };

  /// Turns the tangents along with the normal, as little as possible.
  void turnTo(const Vec3& newNormal) noexcept;
  /// Coordinates (along a, b, normal) of a point, in its own unit.
  Vec3 toLocal(const Vec3& p) const noexcept
  {
    const Vec3 d = p - origin;
    return { dot(d, a), dot(d, b), dot(d, normal) };
  }
  Vec3 toWorld(const Vec3& local) const noexcept
  {
    return origin + local.x * a + local.y * b + local.z * normal;
  }
};

/// Parameters of a fit besides the cells.
struct FitSettings
{
  double radius = 0.0; ///< rho, metres, above 0.
  double gate = 0.0; ///< Cells more than this below the surface (metres) belong to another sheet; 0: no gate.
  bool twoSidedGate =
    false; ///< Leave out cells above the surface too: for the first fit, before the side is known.
  double curvature[3] = { 0, 0, 0 }; ///< (uu, uv, vv) of the fit before, per metre: the gate follows it.
};

/// Slopes of the traced surface. The fit moves with its origin, so the surface it traces has not quite the
/// slopes of the quadric. The traced slopes make the foot point the true nearest one, and closed paths free
/// of energy. The height is fitted with cubic terms, too, so that k0 to k5 are right where the curvature
/// changes.
struct TracedSlopes
{
  double strength =
    0.0; ///< 0: the quadric's slopes, 1: the traced surface's. Noise is amplified up to twofold at 1.
  Vec3 radiusGradient; ///< grad rho at the origin.
  double cubic = 0.0;  ///< Weight of the cubic terms where it is above the strength, 0 to 1.
};

enum class FitQuality
{
  None,  ///< Fewer than three cells that span a plane.
  Plane, ///< Too few cells, or too badly placed, for the curvature.
  Quadric,
};

/// Height z over the frame, all lengths divided by the fit radius: z = k0 + k1 u + k2 v + k3 uu + k4 uv + k5
/// vv, and where they were fitted the cubic terms c0 uuu + c1 uuv + c2 uvv + c3 vvv.
struct SurfaceFit
{
  FitQuality quality = FitQuality::None;
  double k[6] = { 0, 0, 0, 0, 0, 0 };
  double cubic[4] = { 0, 0, 0, 0 };
  double radius = 0.0;    ///< rho the coefficients are scaled by, metres.
  double residual = 0.0;  ///< Weighted RMS distance of the cells' means from the fit, metres.
  double centroidU = 0.0; ///< Weighted centroid over rho: 0 inside a surface, 0.235 on a straight rim.
  double centroidV = 0.0;
  int cells = 0; ///< Cells with weight.

  double height(double u, double v) const noexcept
  {
    const double* c = cubic;
    return k[0] + u * (k[1] + u * (k[3] + c[0] * u + c[1] * v) + v * k[4]) +
      v * (k[2] + v * (k[5] + c[2] * u + c[3] * v));
  }
  double slopeU(double u, double v) const noexcept
  {
    return k[1] + u * (2.0 * k[3] + 3.0 * cubic[0] * u + 2.0 * cubic[1] * v) + v * (k[4] + cubic[2] * v);
  }
  double slopeV(double u, double v) const noexcept
  {
    return k[2] + v * (2.0 * k[5] + 3.0 * cubic[3] * v + 2.0 * cubic[2] * u) + u * (k[4] + cubic[1] * u);
  }
};

/// A fit with its errors, estimated from the residuals.
struct SurfaceFitError
{
  double noise = 0.0;   ///< Standard deviation of single points about the surface, metres.
  double leftOut = 0.0; ///< Part of the points, weighted, that the gate left out: of other sheets.
  double standardError[3] = { 0, 0, 0 }; ///< Standard errors of rho k0 (metres), k1 and k2, for noise 1
                                         ///< metre.
};

/// Weighted least squares over the cells within the radius, weights count (1 - d^2/rho^2)^4; the quadratic
/// terms use each cell's covariance, which makes the fit exact for every quadric height field however coarse
/// the cells are. The level of detail follows the radius and changes without a step. No allocation, no
/// exception; work bounded by the blocks of @p memory. 0.3 to 0.8 us where the cells are gathered already.
/// @param slopes where given, with cubic terms, and k1 and k2 those of the traced surface; left as they
/// are where the fit is a plane.
SurfaceFit fitSurface(const CellPyramid& pyramid, const SurfaceFrame& frame, const FitSettings& settings,
  FitCells& memory, const TracedSlopes* slopes = nullptr) noexcept;

/// As fitSurface() above, with the errors of position and slopes; for building scenes, several times the
/// cost. @param cubic with the cubic terms; less than a Quadric where the cells do not determine them.
SurfaceFit fitSurface(const CellPyramid& pyramid, const SurfaceFrame& frame, const FitSettings& settings,
  FitCells& memory, SurfaceFitError& error, bool cubic = false) noexcept;

/// Starts on the surface near @p onSurface with the approximate normal in @p frame: a few fits, each from the
/// foot of the origin. Cells further than @p gate (metres; half as much again in the first fit) above or
/// below the former fit, at first the plane, do not count. @p curvature receives the last fit's, per metre.
/// False: no fit.
bool settleOnSurface(const CellPyramid& pyramid, const Vec3& onSurface, double radius, double gate,
  FitCells& memory, SurfaceFrame& frame, SurfaceFit& fit, double curvature[3]) noexcept;

/// Depth of the gate that keeps a second sheet out, over the fit radius.
constexpr double kGateDepth = 0.2;

/// Gets the fit's point over (u, v), both over the fit radius, and the unit normal there.
void pointAt(
  const SurfaceFit& fit, const SurfaceFrame& frame, double u, double v, Vec3& point, Vec3& normal) noexcept;

/// Finds the fit's point nearest to @p target and the unit normal there, by Newton steps from the frame's
/// origin, bounded to half a fit radius from it. @return false when it stopped at a bound.
bool footPoint(
  const SurfaceFit& fit, const SurfaceFrame& frame, const Vec3& target, Vec3& foot, Vec3& normal) noexcept;

/// Finds the unit normal (either side) of the cells within @p radius of @p center by their covariance; false
/// when the cells do not span a plane.
bool principalNormal(
  const CellPyramid& pyramid, const Vec3& center, double radius, FitCells& memory, Vec3& normal) noexcept;

} // namespace pointhaptics
