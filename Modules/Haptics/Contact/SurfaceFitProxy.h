/// @file
/// The accurate proxy: a ball decides about contact, a local surface fit refines where it is.
#pragma once

#include "Haptics/Contact/FrictionCone.h"
#include "Haptics/Contact/ProxyBall.h"
#include "Haptics/Contact/SurfaceSearch.h"
#include "Haptics/Proxy.h"

namespace pointhaptics
{

/// The ball among the points decides about contact. Contact point and normal are the fit's while the fitted
/// surface agrees with the ball; else they are the ball's, and the fit is sought again. One thread; no
/// allocation; bounded work.
class SurfaceFitProxy
{
public:
  /// Cells and points gathered near the proxy; serves one proxy at a time.
  struct Memory
  {
    explicit Memory(InstructionSet wanted)
      : fit(wanted)
      , ball(wanted)
    {
    }

    FitCells fit;
    BallCells ball;

    void invalidate() noexcept
    {
      fit.invalidate();
      ball.invalidate();
    }
    /// Keeps the cells gathered in @p shared, where the next scene @p scene has the same cells as the last
    /// one. The radii of its contact points may differ.
    void carryOver(const HapticScene& scene, const Bounds& shared) noexcept
    {
      scene.carryOver(fit, shared);
      ball.invalidate();
    }
  };

  /// Moves a contact with the model from one transform to another.
  void carry(const AffineTransform& from, const AffineTransform& to) noexcept;
  /// Announces another scene of the same model, finer or coarser.
  void changeCells() noexcept
  {
    ball_.changeCells();
    tracker_.changeCells();
    search_.giveUp();
  }
  /// Announces another part of the same model with the same cells.
  void changeRadii() noexcept { ball_.changeCells(); }
  void reset() noexcept { *this = SurfaceFitProxy(); }
  /// Fills all of the state but force. @pre hip finite. @param refines false: the ball alone is felt.
  void step(const HapticScene& scene, Memory& memory, const ContactParameters& parameters, const Vec3& hip,
    bool refines, ProxyState& state) noexcept;

  /// The ball after the last step, for pictures.
  const ProxyBall& ball() const noexcept { return ball_; }
  /// The fit after the last step, for pictures; null where the ball alone is felt.
  const SurfaceTracker* fit() const noexcept { return weight_ > 0.0 ? &tracker_ : nullptr; }

private:
  /// Drops the fit where the ball is free: the next contact looks for a fit anew.
  void forgetFit() noexcept;
  /// A point of the surface nearest to the HIP, the unit normal there, and whether the HIP is below it.
  struct Contact
  {
    Vec3 point;
    Vec3 normal;
    bool pressed = false;
  };

  bool seek(const HapticScene& scene, Memory& memory, const Vec3& hip) noexcept;
  bool ride(const HapticScene& scene, Memory& memory, const Vec3& hip, std::uint32_t& status) noexcept;
  void updateFit(const HapticScene& scene, Memory& memory, const Vec3& hip, TrackResult followed,
    std::uint32_t& status) noexcept;
  Contact blended(const HapticScene& scene, Memory& memory, const Vec3& hip) const noexcept;
  bool comesOut(const HapticScene& scene, Memory& memory, const Vec3& hip, std::uint32_t& status) noexcept;
  bool isSmooth() const noexcept;
  double uncertainty(const HapticScene& scene) const noexcept;
  bool hasSurfaceAround(const HapticScene& scene, Memory& memory) const noexcept;

  ProxyBall ball_;
  SurfaceTracker tracker_;
  SurfaceSearch search_; ///< Search for the next fit.
  FrictionCone friction_;
  Vec3 normal_{ 0.0, 0.0, 1.0 };
  double weight_ = 0.0; ///< The fit's part of the last contact, 0 to 1.
  /// The HIP when the surface beside it was last found not to be a flat face; not finite: it was not.
  Vec3 roughAt_{ NAN, NAN, NAN };
  int searchTicks_ = 0; ///< Ticks of the search since the fit alone was felt.
};

} // namespace pointhaptics
