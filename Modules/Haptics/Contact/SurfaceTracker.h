/// @file
/// A point that stays on the local surface fit, nearest to a target.
#pragma once

#include "Core/Surface/SurfaceFit.h"
#include "Haptics/HapticScene.h"

namespace pointhaptics
{

/// The result of following the surface to the point nearest to a target, from best to worst: up to RoundLimit
/// the point may be used.
enum class TrackResult
{
  Converged,
  RoundLimit, ///< Still moving after the last round; the point is on the surface, its foot is not exact.
  Far,        ///< Moved as far along one surface as a call may, and still moving: the foot leapt.
  Lost,       ///< No surface to fit here, or the point moved to another sheet.
};

/// Follows one sheet of a scene. The normal remembers the side, so the cloud needs no global orientation.
/// Plain state; no allocation; one thread.
class SurfaceTracker
{
public:
  /// A few points, or points along a line, determine no fit: the radius is widened so often by this factor.
  static constexpr int kWidenings = 2;
  static constexpr double kWidening = 1.4;

  /// Starts at the origin of @p frame, on a surface of this curvature there, per metre, as fits have it.
  void start(const SurfaceFrame& frame, const double (&curvature)[3]) noexcept;
  /// Turns the normal towards @p side.
  void lookFrom(const Vec3& side) noexcept;

  /// Moves to the surface point nearest to @p target; a bounded number of fits.
  TrackResult follow(const HapticScene& scene, FitCells& memory, const Vec3& target) noexcept;

  /// Carries point and normal along with the model from one transform to another.
  void carry(const AffineTransform& from, const AffineTransform& to) noexcept;

  /// Announces other cells of the same place: the last fit does not hold for them.
  void changeCells() noexcept { fresh_ = false; }

  /// Height of a point above the surface, along the normal; negative inside.
  double height(const Vec3& p) const noexcept { return dot(p - frame_.origin, frame_.normal); }
  /// Height of a point above the last fit itself, not above its tangent plane.
  double heightAboveFit(const Vec3& p) const noexcept;
  const Vec3& point() const noexcept { return frame_.origin; }
  const Vec3& normal() const noexcept { return frame_.normal; }
  /// Finds the surface point above the tangent offset @p t from point(), and the normal there, by the last
  /// fit; beyond half a fit radius along the tangent there.
  void alongSurface(const Vec3& t, Vec3& point, Vec3& normal) const noexcept;
  /// Standard deviation of the points about the surface here, metres: what a fit averages.
  double noise() const noexcept { return scale_.noise; }
  /// RMS distance of the cells from the last fit, metres.
  double residual() const noexcept { return fit_.residual; }
  /// True if the surface continues on all sides: the cells lie about the point, and not on one side of it.
  bool continuesAround() const noexcept;
  double fitRadius() const noexcept { return fit_.radius; }
  double proxyRadius() const noexcept { return scale_.proxyRadius; }

private:
  /// Fits anew at frame_. False: there is no surface to fit.
  bool refit(const HapticScene& scene, FitCells& memory) noexcept;
  /// A round of following: its origin, the step to the foot from there, and the distance to the target.
  struct Round
  {
    Vec3 origin;
    Vec3 step;
    double distance = 0.0;
  };
  void nextPlace(const Round& now, const Round* before, Vec3& place, Vec3& normal) noexcept;
  void adopt(const Vec3& foot, const Vec3& normal) noexcept;

  SurfaceFrame frame_;
  SurfaceFit fit_;
  SurfaceFrame fitFrame_; ///< Frame of fit_, a little behind frame_.
  LocalScale scale_;      ///< Scale at the origin of fitFrame_.
  bool fresh_ = false;    ///< True while fit_ is valid about frame_: the next step may begin with it.
  double curvature_[3] = { 0.0, 0.0, 0.0 };
  double gain_ = 1.0; ///< Length of the step to take over that of the step to the foot that a fit shows.
};

} // namespace pointhaptics
