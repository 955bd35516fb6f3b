/// @file
/// An order of points in which those close to each other in space are close to each other in memory.
#pragma once

#include "Core/Base/Executor.h"
#include "Core/Base/PointView.h"

#include <cstdint>
#include <vector>

namespace pointhaptics
{

/// Most points that spatialOrder takes.
constexpr std::int64_t kMostOrderedPoints = (std::int64_t(1) << 31) - 1;

/// Indices of the finite points along Hilbert's curve through their bounding cube. Where more than
/// @p mostPerCell points share one of the 2^30 cells of the cube, they are ordered along a curve of their
/// own, recursively: any density and extent works. Equal points are in the order of their indices. The result
/// depends on the points' values alone, not on their type, nor on @p executor.
///
/// Cost: O(n), 16 bytes a point while it runs; in the worst case, a cloud that shrinks towards a point by
/// powers of a thousand, a few hundred times that. Empty for more than kMostOrderedPoints points.
/// Source of the curve: Skilling 2004, Programming the Hilbert curve.
std::vector<std::uint32_t> spatialOrder(
  const PointView& points, std::int64_t mostPerCell, const Executor& executor = {});

} // namespace pointhaptics
