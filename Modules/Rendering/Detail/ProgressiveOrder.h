/// @file
/// An order of points whose every beginning is a fair sample of all of space.
#pragma once

#include "Core/Base/PointView.h"

#include "PointHapticsRenderingModule.h" // For export macro

#include <cstdint>
#include <vector>

namespace pointhaptics
{

/// A permutation of the indices of @p points, of which there are fewer than 2^32. Its first m indices take
/// the fraction m / points.size() of the points in every cube of an octree (down to 1/64 of their extent),
/// give or take a few: dense parts stay dense, and no part is left out. Points that are not finite come
/// anywhere. Linear time: about 15 ns a point. The same for the same points.
POINTHAPTICSRENDERING_EXPORT std::vector<std::uint32_t> progressiveOrder(const PointView& points);

} // namespace pointhaptics
