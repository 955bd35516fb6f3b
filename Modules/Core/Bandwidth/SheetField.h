/// @file
/// The sheet that each point of a cloud is on: normal, spacing, and the radius of the ball that feels it.
#pragma once

#include "Core/Base/Executor.h"
#include "Core/Base/PointView.h"

#include <vector>

namespace pointhaptics
{

/// The sheet about one point.
struct SheetPoint
{
  /// Radius of a ball that does not fall through the sheet here; unit of the coordinates.
  float radius = 0.0F;
  /// Spacing of the neighbours on the sheet, as if they lay in a square grid; 0: the point is on no sheet.
  float spacing = 0.0F;
  float normal[3] = { 0.0F, 0.0F, 0.0F }; ///< Unit, to either side; zero where there are too few neighbours.
};

/// Bounds of the radii, unit of the coordinates.
struct SheetFieldSettings
{
  double leastRadius = 0.0; ///< Also of points on no sheet, where their neighbours are no farther apart.
  double mostRadius = 0.0;  ///< Largest radius of balls that are larger than their spacing asks for; 0: none.
};

/// One entry for each of @p points. The normal is that of the plane through the nearest neighbours, where
/// those off the plane count less and less: beside an edge it is that of one face. The spacing counts the
/// neighbours near that plane whose own normals agree; where they lie on one side, as at a rim, only the part
/// of the disk that they fill. The radius is 2.4 spacings: a smaller ball falls through the gaps of a random
/// sample. Within a sheet it falls off by at most a quarter of the way from point to point, so that the
/// sparser side of a step in density reaches into the denser one before the ball is there.
/// Points must be finite and distinct. Independent of @p executor. Cost: O(n log n), about 1.5 us a point on
/// one core; 150 bytes a point while it runs.
std::vector<SheetPoint> sheetField(
  const PointView& points, const SheetFieldSettings& settings, const Executor& executor = {});

} // namespace pointhaptics
