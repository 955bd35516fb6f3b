/// @file
/// Coordinates and lengths of a file in words: as finely as the file has them, and no finer.
#pragma once

#include "Core/Base/Vector3.h"

#include "PointHapticsInteractionModule.h" // For export macro

#include <string>
#include <vector>

class vtkPolyData;

namespace pointhaptics
{

/// Text of @p value with @p decimals; a number that is rounded to zero has no sign.
std::string fixedText(double value, int decimals);

/// Text of a number of a file: six digits, but whole numbers whole, and large ones, such as coordinates of
/// maps, with three decimals and without an exponent.
POINTHAPTICSINTERACTION_EXPORT std::string valueText(double value);

/// Text of @p value with decimals down to @p step, at least three where that is 0, and no more digits than a
/// double has.
std::string coordinateText(double value, double step);

/// Decimals of the grid of a LAS file (field data "LasScale") along @p axis, for coordinates as large as @p
/// largest; below 0: @p cloud has no grid.
int gridDecimals(vtkPolyData* cloud, int axis, double largest);

/// Text of the distance from @p from to @p to, both in the frame of the file @p cloud, in its @p unit; a
/// second line has the distance along each axis. Decimals are those of the file's grid. Without a grid they
/// go down to @p spacing, that of the points, as a click is no more exact: two to four digits of the
/// distance, and no more than single precision coordinates have. @param spacing 0: not known; three digits.
POINTHAPTICSINTERACTION_EXPORT std::vector<std::string> distanceText(
  vtkPolyData* cloud, const Vec3& from, const Vec3& to, const std::string& unit, double spacing);

} // namespace pointhaptics
