/// @file
/// The paper's spherical proxy, exact: a ball among the points that decides about contact.
#pragma once

#include "Core/Surface/FitCells.h"
#include "Haptics/Contact/BallCells.h"
#include "Haptics/Contact/FlatPlace.h"
#include "Haptics/HapticScene.h"

#include <cstdint>

namespace pointhaptics
{

/// A ball that never covers a point of the cloud and goes to the HIP unless something is in its way. Whether
/// there is contact hangs on nothing else: not on rims, edges, holes or sides. It is free exactly when its
/// center is the HIP.
///
/// Each tick it slides: the way to the HIP, with what points into the points it touches taken out (up to
/// three planes; Zilles and Salisbury 1995), cut where it would meet the next one. Where the bumps between
/// the points hold it although the pull leans, it glides: a slightly smaller ball goes along the smoothed
/// surface, and the ball follows where that brings it nearer to the HIP. Beside an edge the bumps would lead
/// it around: it does not leave the flat place that it lies on while that goes on under the HIP.
///
/// Its radius is the paper's r_p, less a fifth, but at least max(2 h, 2.4 s), h the index cell and s the
/// spacing of the points about it and ahead: a smaller one would fall through the gaps of a random sample. In
/// contact it changes by at most 2 % a tick, by 30 % where it is less than 0.8 of what it should be, and
/// grows only where there is room beside the points or above them. A ball that began among points without
/// room, as in a cloud of leaves, is on no side of them: where they hold it, it shrinks by 2 % a tick until
/// it is free. Lattice frame, metres. Plain state; no allocation; bounded work; one thread.
class ProxyBall
{
public:
  void reset() noexcept { *this = ProxyBall(); }
  /// The ball moves with the model: @p change takes a place of the old lattice frame into the new one.
  void carry(const AffineTransform& change, double scale) noexcept;

  /// The next step is in other cells of the same place: its radius is right for them at once, lest it fall
  /// between coarser ones.
  void changeCells() noexcept
  {
    isMeasured_ = false;
    adopts_ = true;
  }

  /// A patient ball lets bumps hold it back by up to half its radius: something else follows the surface.
  void setPatient(bool patient) noexcept { isPatient_ = patient; }

  /// @param fields the memory for the scene's fields. @param cells the memory of the points near the ball.
  /// @param hip finite. @param status receives bits.
  void step(const HapticScene& scene, FitCells& fields, BallCells& cells, const Vec3& hip,
    std::uint32_t& status) noexcept;

  /// In place of a step: rides above the bumps of a smooth surface to the foot @p foot of @p hip on it, with
  /// the unit normal @p up, where no point is in its way. False: it stays, and must step.
  bool ride(const HapticScene& scene, FitCells& fields, BallCells& cells, const Vec3& hip, const Vec3& foot,
    const Vec3& up, std::uint32_t& status) noexcept;

  /// Whether the face through @p foot with the unit normal @p up goes on around it: points within a radius
  /// lie on all sides.
  bool hasPointsAround(
    const HapticScene& scene, BallCells& cells, const Vec3& foot, const Vec3& up) const noexcept;

  /// The ball is at the HIP.
  bool isFree() const noexcept { return free_; }
  /// Goes over the bumps between points and down to @p foot of a surface with the unit normal @p up, where no
  /// point is in its way and it comes no further from the HIP than bumps are high. False: it stays.
  bool goTo(const HapticScene& scene, FitCells& fields, BallCells& cells, const Vec3& foot, const Vec3& up,
    std::uint32_t& status) noexcept;
  /// Goes over the edge of what it lies on and down beside the surface through @p foot with the unit normal
  /// @p up, where no point is in its way and the HIP is then inside it: it came out there. False: it stays.
  bool goAround(const HapticScene& scene, FitCells& fields, BallCells& cells, const Vec3& foot,
    const Vec3& up, std::uint32_t& status) noexcept;
  /// False: the HIP went further than one step can follow; the ball is on its way.
  bool isThere() const noexcept { return there_; }
  /// Whether points were in its way in the last step; if not, it went straight with the HIP.
  bool hasSlid() const noexcept { return slid_; }
  /// Whether the last step took it over bumps, which may lift it.
  bool hasGlided() const noexcept { return glided_; }
  const Vec3& center() const noexcept { return center_; }
  double radius() const noexcept { return radius_; }
  /// The ball's point nearest to @p hip. @pre not free
  Vec3 nearestPoint(const Vec3& hip) const noexcept
  {
    const Vec3 pull = hip - center_;
    const double length = norm(pull);
    return length > 0.0 ? center_ + (radius_ / length) * pull : center_;
  }
  /// How deep the HIP is below that point, metres; negative: the HIP is inside the ball.
  double depth(const Vec3& hip) const noexcept { return norm(hip - center_) - radius_; }

private:
  /// The radius changes by at most this part a tick; smaller than that part of what it should be the ball is
  /// about to fall between the points; and it is measured so many radii ahead.
  static constexpr double kLargestGrowth = 1.02;
  static constexpr double kTooSmall = 0.8;
  static constexpr double kAhead = 1.0;
  /// Over the radius: how far a tick in contact looks, as far as a glide; how far around the ball its points
  /// are looked at mostly, as most moves are short; and the rounding that a covered point may be off by.
  static constexpr double kReachOfTick = 2.1;
  static constexpr double kFocus = 1.2;
  static constexpr double kRounding = 1e-9;
  /// Moves of one step: a hand at 1 m/s needs some ten.
  static constexpr int kMostRounds = 192;
  /// Reach of the points that decide whether the place is flat, over the radius. A flat place serves so many
  /// radii further.
  static constexpr double kPlaneReach = 1.4;
  static constexpr double kFlatNear = 2.0;

  /// What a step works with.
  struct Work
  {
    const HapticScene& scene;
    FitCells& fields;
    BallCells& cells;
    int rounds;
    std::uint32_t& status;
  };

  void place(Work& work, const Vec3& hip) noexcept;
  bool isMeasureDue(const HapticScene& scene) const noexcept;
  void measure(Work& work, const Vec3& hip) noexcept;
  void measureAhead(Work& work, const Vec3& hip, const Vec3& foot, const Vec3& up) noexcept;
  void updateRadius(Work& work, const Vec3& hip) noexcept;
  void walk(Work& work, const Vec3& hip) noexcept;
  double fly(Work& work, const Vec3& direction, double length) noexcept;
  double advance(Work& work, const Vec3& direction, double length) noexcept;
  void slide(Work& work, const Vec3& hip) noexcept;
  bool mayWait(const Vec3& hip) const noexcept;
  bool glide(Work& work, const Vec3& hip) noexcept;
  template <typename IsGood>
  bool moveAbove(Work& work, const Vec3& foot, const Vec3& up, IsGood&& isGood) noexcept;
  void touchDown(Work& work) noexcept;
  Vec3 surfaceNormal(const BallCells& cells) noexcept;
  bool pushOut(const BallCells& cells) noexcept;
  bool makeRoom(Work& work, const ProxyBall& before) noexcept;
  bool isPinched(const BallCells& cells) const noexcept;
  bool isWedged(Work& work) noexcept;
  void gather(Work& work, double reach) noexcept;

  Vec3 center_;
  double radius_ = 0.0;
  double wanted_ = 0.0;
  double wantedAhead_ = 0.0;
  Vec3 hip_; ///< As far as the ball has followed it.
  Vec3 measuredAt_;
  Vec3 heldAt_; ///< The HIP when gliding did not help.
  FlatPlace flat_;
  bool isHeld_ = false;
  bool isConfined_ = false; ///< Began where it has no room, and has not found any yet.
  bool isPatient_ = false;
  bool isMeasured_ = false;
  bool free_ = true;
  bool there_ = true;
  bool adopts_ = false;
  bool placed_ = false;
  bool slid_ = false;
  bool glided_ = false;
  bool rode_ = false; ///< And has not looked for its way among the points since.
};

} // namespace pointhaptics
