/// @file
/// Bounds and counts of the points of a cloud that have a place.
#pragma once

#include "Core/Base/AffineTransform.h"
#include "Core/Base/Executor.h"
#include "Core/Base/PointView.h"

#include "PointHapticsIOModule.h" // For export macro

#include <cstdint>

class vtkPolyData;

namespace pointhaptics
{

/// Bounds after a transform. The corners of a box would be too wide for a turned cloud.
struct CloudExtent
{
  Bounds all;                 ///< Bounds of the finite points.
  Bounds returned;            ///< Bounds without rays that did not return.
  std::int64_t finite = 0;    ///< Points.
  std::int64_t invalid = 0;   ///< The others.
  std::int64_t atZero = 0;    ///< Points at (0, 0, 0),
  std::int64_t noReturns = 0; ///< the same where areNoReturns(), else 0.
};

/// The step between neighbouring floats on each axis, where @p box, which is not empty, is farthest.
Vec3 floatSteps(const Bounds& box);

/// Independent of @p executor.
POINTHAPTICSIO_EXPORT CloudExtent extentOf(vtkPolyData* cloud,
  const AffineTransform& transform = AffineTransform(), const Executor& executor = Executor());

} // namespace pointhaptics
