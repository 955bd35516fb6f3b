/// @file
/// The bounds of a transformed cloud.
#pragma once

#include "Core/Base/AffineTransform.h"
#include "Core/Base/Executor.h"
#include "Core/Base/PointView.h"
#include "Core/Base/ProgressObserver.h"

namespace pointhaptics
{

/// Bounds of the transformed points that are finite before and after the transform. Not valid
/// where @p observer has ended the work.
Bounds transformedBounds(const PointView& points, const AffineTransform& transform,
  const Executor& executor = {}, ProgressObserver* observer = nullptr);

} // namespace pointhaptics
