/// @file
/// The accurate proxy: a ball decides about contact, a local surface fit refines where it is.
#pragma once

#include "Haptics/Contact/FrictionCone.h"
#include "Haptics/Contact/ProxyBall.h"
#include "Haptics/Contact/SurfaceSearch.h"
#include "Haptics/Proxy.h"

namespace pointhaptics
{

/// The ball among the points says whether there is contact. While the surface that is fitted to the points
/// agrees with the ball, contact point and normal are the fit's; else they are the ball's, and the fit is
/// sought again. One thread; no allocation; bounded work.
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
    /// Keeps what was gathered in @p shared, where the next scene @p scene has the same cells as the last
    /// one. The radii of its contact points may differ.
    void carryOver(const HapticScene& scene, const Bounds& shared) noexcept
    {
      scene.carryOver(fit, shared);
      ball.invalidate();
    }
  };

  /// A contact moves with the model from one transform to another.
  void carry(const AffineTransform& from, const AffineTransform& to) noexcept;
  /// The scene is another of the same model, finer or coarser.
  void changeCells() noexcept
  {
    ball_.changeCells();
    tracker_.changeCells();
    search_.giveUp();
  }
  /// The scene is another part of the same model with the same cells.
  void changeRadii() noexcept { ball_.changeCells(); }
  void reset() noexcept { *this = SurfaceFitProxy(); }
  /// @pre hip finite. Fills all of the state but force. @param refines false: the ball alone is felt.
  void step(const HapticScene& scene, Memory& memory, const ContactParameters& parameters, const Vec3& hip,
    bool refines, ProxyState& state) noexcept;

  /// The ball after the last step, for pictures.
  const ProxyBall& ball() const noexcept { return ball_; }
  /// The fit after the last step, for pictures; null where the ball alone is felt.
  const SurfaceTracker* fit() const noexcept { return hasFit_ ? &tracker_ : nullptr; }

private:
  /// Where the ball is free: the next contact looks for a fit anew.
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
  double fitWeight(const HapticScene& scene, Memory& memory, const Vec3& hip, TrackResult followed,
    std::uint32_t& status) noexcept;
  Contact blended(const Vec3& hip, double weight) const noexcept;
  bool comesOut(const HapticScene& scene, Memory& memory, const Vec3& hip, std::uint32_t& status) noexcept;
  bool isSmooth() const noexcept;
  bool isPlain() const noexcept;

  ProxyBall ball_;
  SurfaceTracker tracker_;
  SurfaceSearch search_; ///< For the next one.
  FrictionCone friction_;
  Vec3 normal_{ 0.0, 0.0, 1.0 };
  bool hasFit_ = false;
  bool isAlone_ = false;   ///< The fit alone was felt.
  bool isPatient_ = false; ///< The fit followed a smooth surface that goes on all around.
  Vec3 roughAt_;           ///< The HIP when the surface beside it was last seen to be no flat face.
  bool isRough_ = false;
  int ticksWithoutFit_ = 0;
};

} // namespace pointhaptics
