/// @file
/// The paper's spherical proxy, exact: a ball among the points that decides about contact.
#pragma once

#include "Haptics/Contact/BallCells.h"
#include "Haptics/Contact/BallLengths.h"
#include "Haptics/Contact/FlatPlace.h"
#include "Haptics/HapticScene.h"

#include <cmath>
#include <cstdint>

namespace pointhaptics
{

/// A ball that keeps away from each point of the cloud by that point's radius (ContactField.h) and goes to
/// the HIP unless something is in its way. The radii do not change with time, so where the ball may be does
/// not depend on how it came there. Nothing else decides about contact: no rims, edges, holes or sides. It is
/// free exactly when its center is the HIP.
///
/// Each tick it slides: the way to the HIP loses the parts that lead into the points it touches (up to three
/// planes; Zilles and Salisbury 1995), and ends where it would meet the next point. Where the bumps between
/// the points hold it although the pull leans, it glides: a slightly smaller ball goes along the smoothed
/// surface, and the ball follows where that brings it nearer to the HIP. Beside an edge the bumps would lead
/// it around: it does not leave the flat place that it lies on while that goes on under the HIP.
///
/// A ball that begins among points without room is smaller by one scale, and grows to its full size where it
/// is free. Lattice frame, metres. Plain state; no allocation; bounded work; one thread.
class ProxyBall
{
public:
  void reset() noexcept { *this = ProxyBall(); }
  /// Moves the ball with the model: @p change takes a place of the old lattice frame into the new one.
  void carry(const AffineTransform& change, double scale) noexcept;

  /// Announces a scene with other points of the same place: the ball keeps its contact point.
  void changeCells() noexcept { isAmongOthers_ = true; }

  /// Moves the ball towards the HIP. @param cells the memory of the points near the ball. @param hip finite.
  /// @param isPatient true where a fit follows the surface: the ball then lets bumps hold it back by up to
  /// half its radius. @param status receives bits.
  void step(const HapticScene& scene, BallCells& cells, const Vec3& hip, bool isPatient,
    std::uint32_t& status) noexcept;

  /// Replaces a step: moves the ball above the bumps and the noise of a smooth surface to the foot @p foot of
  /// @p hip on it, with the unit normal @p up, if no point is in its way. @param noise standard deviation of
  /// the points about the surface, metres. False: it stays, and must step.
  bool ride(const HapticScene& scene, BallCells& cells, const Vec3& hip, const Vec3& foot, const Vec3& up,
    double noise, std::uint32_t& status) noexcept;

  /// True if points within a radius lie on all sides of @p foot, in no half plane, in the face with the unit
  /// normal @p up: the ball cannot pass there.
  bool hasPointsAround(
    const HapticScene& scene, BallCells& cells, const Vec3& foot, const Vec3& up) const noexcept;

  /// The ball is at the HIP.
  bool isFree() const noexcept { return center_ == hip_; }
  /// Moves the ball off its points, over bumps or around an edge, and down to the surface through @p foot
  /// with the unit normal @p up. False, and it stays: a point is in its way, it would get further from the
  /// HIP than bumps are high, or a HIP in front of that surface is not yet past the edge.
  bool goTo(const HapticScene& scene, BallCells& cells, const Vec3& foot, const Vec3& up,
    std::uint32_t& status) noexcept;
  /// False: a step could not follow to @p hip, and the ball is on its way.
  bool isThere(const Vec3& hip) const noexcept { return hip_ == hip; }
  /// False: the last step went straight, through nothing.
  bool hasSlid() const noexcept { return hasSlid_; }
  /// True if the last step was ride().
  bool hasRidden() const noexcept { return hasRidden_; }
  const Vec3& center() const noexcept { return center_; }
  /// Radius of the point that the ball touches, times the scale; metres.
  double radius() const noexcept { return radius_; }
  /// Factor on all radii: below 1 where the ball began without room.
  double scale() const noexcept { return scale_; }
  /// The ball's point nearest to @p hip. @pre not free
  Vec3 nearestPoint(const Vec3& hip) const noexcept
  {
    const Vec3 pull = hip - center_;
    const double length = norm(pull);
    return length > 0.0 ? center_ + (radius_ / length) * pull : center_;
  }
  /// Depth of the HIP below that point, metres; negative: the HIP is inside the ball.
  double depth(const Vec3& hip) const noexcept { return norm(hip - center_) - radius_; }

private:
  /// Allows for the rounding of a covered point.
  static constexpr double kClear = 1.0 - 1e-9;
  /// Budget of one step, in rounds; a move costs one. A hand at 1 m/s needs some ten.
  static constexpr int kMostRounds = 192;

  /// The scene, the gathered points and the budget of one step.
  struct Work
  {
    const HapticScene& scene;
    BallCells& cells;
    std::uint32_t& status;
    int rounds = kMostRounds;
  };

  void makeRoom(Work& work, double full) noexcept;
  void place(Work& work, const Vec3& hip) noexcept;
  void placeAmongOthers(Work& work) noexcept;
  void grow(Work& work) noexcept;
  void walk(Work& work, const Vec3& hip) noexcept;
  bool advance(Work& work, const Vec3& direction, double length, double& gone) noexcept;
  void slide(Work& work, const Vec3& hip) noexcept;
  bool mayWait(const Vec3& hip, bool isPatient) const noexcept;
  bool glide(Work& work, const Vec3& hip) noexcept;
  void touchDown(Work& work) noexcept;
  Vec3 surfaceNormal(const BallCells& cells) noexcept;
  bool pushOut(const BallCells& cells) noexcept;
  bool isClear(const BallCells& cells) const noexcept { return cells.deepest(center_, kClear * scale_) < 0; }
  void gather(Work& work, double way) noexcept;

  Vec3 center_;
  double radius_ = 0.0;          ///< Radius of the touched point times the scale, metres.
  double scale_ = 1.0;           ///< Factor on all radii.
  Vec3 hip_;                     ///< The HIP as far as the ball has followed it.
  Vec3 heldAt_{ NAN, NAN, NAN }; ///< The HIP when gliding did not help; not finite: the ball is not held.
  FlatPlace flat_;
  bool isPlaced_ = false;
  bool isAmongOthers_ = false; ///< The points differ from those of the last step.
  bool hasSlid_ = false;
  bool hasRidden_ = false;
};

} // namespace pointhaptics
