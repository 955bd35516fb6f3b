/// @file
/// The part of a cloud in a box.
#pragma once

#include "Core/Base/PointView.h"

#include "PointHapticsViewerModule.h" // For export macro

#include <vtkSmartPointer.h>

#include <optional>
#include <vector>

class vtkPolyData;

namespace pointhaptics
{

/// HapticViewerOptions::clip as a box; nothing: there is none.
POINTHAPTICSVIEWER_EXPORT std::optional<Bounds> clipBox(const std::vector<double>& clip);
/// HapticViewerOptions::clip of a box.
std::vector<double> clipNumbers(const Bounds& box);

bool isWithin(const Bounds& box, const Vec3& place);

/// The points of @p cloud in @p box, the faces included, with all arrays, in their order; @p cloud itself
/// where all are. Points that are not finite lie in no box. Cost: about 10 ns a point.
POINTHAPTICSVIEWER_EXPORT vtkSmartPointer<vtkPolyData> clippedCloud(
  vtkPolyData* cloud, const std::optional<Bounds>& box);

} // namespace pointhaptics
