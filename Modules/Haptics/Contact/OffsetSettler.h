/// @file
/// Spreads sudden changes of the surface over time: the force follows the hand at once, and other changes no
/// faster than a limit.
#pragma once

#include "Core/Base/Vector3.h"

namespace pointhaptics
{

/// Returns @p after, the offset to feel now, without the part of it that pulls against @p wanted, unless @p
/// before pulled so already. A hand that leaves faster than the settled offset shrinks is not pulled back.
inline Vec3 withoutReversal(const Vec3& before, const Vec3& after, const Vec3& wanted) noexcept
{
  const double along = dot(after, wanted);
  return along < 0.0 && dot(before, wanted) >= 0.0 ? after - (along / norm2(wanted)) * wanted : after;
}

/// Smooths the offset of the contact point from the HIP. A tick in which the HIP moves by d may change the
/// offset by kFreeSteps d; such changes pass untouched, bit for bit. If the surface was zoomed or swapped, or
/// the nearest point jumped at a ridge, the offset changes by more. Then the felt offset lags, and approaches
/// the real one by at most a given length a tick. It turns between directions less than a right angle apart,
/// so the force gets no weaker on the way. Where contact ends the caller calls reset(), and the force is gone
/// in one step. One thread; no allocation.
class OffsetSettler
{
public:
  /// On a smooth surface the offset changes by up to 1 d where it is flat or convex, by more in a hollow.
  static constexpr double kFreeSteps = 2.0;

  /// Out of contact: the next offset grows from nothing.
  void reset() noexcept { *this = OffsetSettler(); }
  /// @param offset contact point - HIP, metres. @param moved metres the HIP went since
  /// the last call. @param shrink metres by which the felt offset may come nearer in this call, at least 0.
  /// @return the offset to feel, metres.
  Vec3 settle(const Vec3& offset, double moved, double shrink) noexcept;
  /// Continues from @p felt after ticks without a call, as after a fade.
  void resumeFrom(const Vec3& felt) noexcept;
  /// Notes that only @p felt was felt: the next call goes on from there.
  void hold(const Vec3& felt) noexcept
  {
    felt_ = felt;
    isSettling_ = true;
  }
  bool settling() const noexcept { return isSettling_; }

private:
  Vec3 last_; ///< The offset of the last call, unsmoothed.
  Vec3 felt_;
  bool isSettling_ = false;
};

} // namespace pointhaptics
