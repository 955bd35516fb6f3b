/// @file
/// Spreads what the surface does at once over time: in contact the spring's force changes with the hand, and
/// otherwise no faster than a limit.
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

/// The offset of the contact point from the HIP follows the hand: a tick in which the HIP moves by d may
/// change it by kFreeSteps d, and such changes pass untouched, bit for bit. Where the offset changes by more
/// (the surface was zoomed or swapped, or the nearest point jumped at a ridge) the felt one lags, and comes
/// nearer by at most a given length a tick until it is the offset again. So it changes by at most kFreeSteps
/// d plus that length. It turns from one direction to another less than a right angle away: the force gets no
/// weaker on the way. Where contact ends nothing is to settle: who asks calls reset(), and the force is gone
/// in one step. One thread; no allocation.
class OffsetSettler
{
public:
  /// The spring's own step on a smooth surface is up to 1 where it is flat or convex, more in a hollow.
  static constexpr double kFreeSteps = 2.0;

  /// Out of contact: the next offset grows from nothing.
  void reset() noexcept { *this = OffsetSettler(); }
  /// @param offset contact point - HIP, metres. @param moved metres the HIP went since
  /// the last call. @param shrink metres by which the felt offset may come nearer in this call, at least 0.
  /// @return the offset to feel, metres.
  Vec3 settle(const Vec3& offset, double moved, double shrink) noexcept;
  /// The offset was taken back to @p felt without a call, as after a fade.
  void resumeFrom(const Vec3& felt) noexcept;
  /// Less was felt, @p felt: the next call goes on from there.
  void hold(const Vec3& felt) noexcept
  {
    felt_ = felt;
    isSettling_ = true;
  }
  bool settling() const noexcept { return isSettling_; }

private:
  Vec3 last_; ///< The offset itself.
  Vec3 felt_;
  bool isSettling_ = false;
};

} // namespace pointhaptics
