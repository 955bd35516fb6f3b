/// @file
/// How near a hand came to a cloud.
#pragma once

#include "Core/Base/Vector3.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace pointhaptics
{

class HapticScene;

/// Least distance to the cloud of a hand that touches nothing. Keeps at most kMostPlaces places of the hand,
/// evenly in time.
class ClosestApproach
{
public:
  static constexpr std::size_t kMostPlaces = 4096;

  void add(const Vec3& hip);
  /// Distance from the nearest kept place to a point of @p scene, metres; nothing: there is no place. 0.1 us
  /// per point, and some us per place.
  std::optional<double> distance(const HapticScene& scene) const;

private:
  std::vector<Vec3> places_;
  std::size_t stride_ = 1;
  std::size_t added_ = 0;
};

} // namespace pointhaptics
