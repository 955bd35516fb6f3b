/// @file
/// Splats in bricks, of which only those in view are drawn.
#pragma once

#include "Core/Base/PointView.h"

#include "PointHapticsRenderingModule.h" // For export macro

#include "vtkType.h"

#include <array>
#include <cstdint>
#include <vector>

class vtkMatrix4x4;

namespace pointhaptics
{

/// The half space where x a + y b + z c + d is not below 0.
using HalfSpace = std::array<double, 4>;

/// Neighbouring points in a row, and the box about their splats.
struct SplatBrick
{
  std::int64_t begin = 0;
  std::int64_t end = 0;
  Bounds box;
};

/// Cuts all @p points, in the order they have, into bricks of @p size; those with points that are not finite
/// are always drawn.
POINTHAPTICSRENDERING_EXPORT std::vector<SplatBrick> makeRows(
  const PointView& points, std::int64_t size = 64);

/// Parts of the row with splats in all @p halfSpaces, grown by @p margin; adjacent bricks are one part. @p
/// toWorld, which may be null, maps the points' frame to that of the half spaces; @p margin is in the points'
/// frame.
POINTHAPTICSRENDERING_EXPORT std::vector<std::array<vtkIdType, 2>> visibleRanges(
  const std::vector<SplatBrick>& bricks, const std::vector<HalfSpace>& halfSpaces, vtkMatrix4x4* toWorld,
  double margin);

} // namespace pointhaptics
