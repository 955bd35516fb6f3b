/// @file
/// What the shape of a cloud says about its up axis.
#pragma once

#include "Core/Base/PointView.h"

#include "PointHapticsRenderingModule.h" // For export macro

#include <array>
#include <optional>

namespace pointhaptics
{

/// The up axis that the shape of @p points (about 20,000 of them are looked at) speaks for against @p
/// expected, an axis of theirs; nothing where it does not. It speaks by a long axis with a foot at one end
/// only (statues, figures, trees), by floor, ceiling and walls of a room whose shortest axis is another, and
/// by the pyramid that one view of a camera fills (y down and z forward). @p isWeak tells that the foot of
/// another axis is much wider than that of
/// @p expected.
POINTHAPTICSRENDERING_EXPORT std::optional<Vec3> upByShape(
  const PointView& points, const Vec3& expected, bool& isWeak);

} // namespace pointhaptics
