/// @file
/// Reports of a 3Dconnexion SpaceMouse, and the motion they stand for.
#pragma once

#include "Core/Base/Vector3.h"

#include <cstdint>

namespace pointhaptics
{

/// Push and turn of the puck, each axis from -1 to 1 (after the dead zone). Workspace frame: x right, y up, z
/// towards the person; turns are right-handed about these axes.
struct SpaceMouseMotion
{
  Vec3 shift;
  Vec3 turn;
  std::uint32_t buttons = 0; ///< Bit i: button i pressed.
  bool connected = false;
  bool resting() const noexcept { return shift == Vec3() && turn == Vec3(); }
};

/// Limits between motion and rest of the puck.
struct SpaceMouseSettings
{
  double deadZone = 0.06; ///< Part of the range that counts as rest, 0 to 0.9; beyond it motion begins at 0.
  double staleSeconds = 0.1; ///< After so long without a report the puck counts as at rest: a last report may
                             ///< get lost.
  double retrySeconds = 0.5; ///< Between two looks for a device that is gone.
};

/// True for products with these reports. The vendor number alone would also match ordinary mice.
bool isSpaceMouse(std::uint16_t vendor, std::uint16_t product) noexcept;

/// Keeps the newest values of each kind of report. One thread; no allocation.
///
/// Report 1 holds the shift (7 bytes) or shift and turn (13 bytes or more), report 2 the turn, report 3 the
/// buttons. Numbers are little-endian 16 bit, +-350, absolute. The device's axes are
/// X right, Y towards the person, Z down. Anything else is ignored.
class SpaceMouseDecoder
{
public:
  explicit SpaceMouseDecoder(const SpaceMouseSettings& settings = {});
  /// Takes a report. @return true where @p bytes are a known and whole one.
  bool take(const std::uint8_t* bytes, int count, double timeSeconds) noexcept;
  /// The motion at @p timeSeconds; buttons do not become stale.
  SpaceMouseMotion motion(double timeSeconds) const noexcept;

private:
  SpaceMouseSettings settings_;
  Vec3 shift_;
  Vec3 turn_;
  double shiftTime_ = -1e9;
  double turnTime_ = -1e9;
  std::uint32_t buttons_ = 0;
};

} // namespace pointhaptics
