/// @file
/// Splats of a cloud: from the surface about each point follow their sizes, normals and light.
#pragma once

#include "CloudLook.h"
#include "Core/Base/ProgressObserver.h"
#include "Core/Neighbors/LocalShape.h"
#include "Core/Neighbors/NeighborQuery.h"

#include "PointHapticsRenderingModule.h" // For export macro

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

class vtkPolyData;
class vtkSplatMapper;

namespace pointhaptics
{

/// Names of the point arrays of a picture.
constexpr const char* kSplatLengthName =
  "SplatLength"; ///< Diameter of each splat, unit of the file; hidden: < 0.
constexpr const char* kSplatNormalName = "SplatNormal"; ///< Short integers: kSplatNormalUnit is flat.
constexpr const char* kSplatGrowthName = "SplatGrowth"; ///< Diameter over that of the spacing, logarithmic.
constexpr const char* kLookColorName = "LookColor";
/// All arrays of the picture: texts at a point leave them out.
constexpr std::array<const char*, 4> kArraysOfPicture = { kSplatLengthName, kSplatNormalName,
  kSplatGrowthName, kLookColorName };
constexpr double kSplatNormalUnit = 32767.0;

/// Surface about each point of a cloud, and the look that follows from it.
struct MeasuredCloud
{
  NeighborQuery query;
  LocalShape shape;
  CloudLook look;
  std::vector<float> diameters; ///< As the file says; none or 0: the shape tells.
};

/// Measures @p cloud, of which all points are finite. Of more than three million points those within half a
/// pixel of the first view share one measurement. @param kind kind in place of cloudKind(), where the user
/// chose it. @return false: @p observer aborted, or there is no point.
POINTHAPTICSRENDERING_EXPORT bool measureCloud(const PointView& cloud, const CloudOrientation& orientation,
  const std::optional<CloudKind>& kind, MeasuredCloud& measured, ProgressObserver* observer = nullptr);

/// Gives a frame the spacing of its rays: the distance along the view times the median angle between rays
/// that follow each other. No gaps are left by discs that are not foreshortened.
POINTHAPTICSRENDERING_EXPORT void spaceByRays(const PointView& cloud, LocalShape& shape);

/// Takes what @p cloud says of its points in place of what was measured: its normals, and of Gaussian splats,
/// which have the arrays "scale" and "rot" (as trainers write them) or "rotation" (.splat), sizes and tilts.
/// Splats close what is a surface, and are no larger than the widest reach of PointShape. Those whose
/// "opacity" (a logit) or alpha ("RGBA") is below a half have the size of points.
/// @param drawn indices of the measured points in @p cloud; empty: all were measured.
POINTHAPTICSRENDERING_EXPORT void takeOwnShapes(
  vtkPolyData* cloud, const std::vector<std::uint32_t>& drawn, MeasuredCloud& measured);

/// Adds the arrays kSplatLengthName, kSplatNormalName and kSplatGrowthName to @p points, 12 bytes a point.
POINTHAPTICSRENDERING_EXPORT void addSplats(vtkPolyData* points, const MeasuredCloud& measured);

/// Lets @p mapper draw the arrays of addSplats(): sizes, normals and light. Input, colours and strength of
/// the light are the caller's.
POINTHAPTICSRENDERING_EXPORT void setUpSplats(vtkSplatMapper* mapper, const CloudLook& look);

/// Adds "Density" to the points, where they were measured: points in a square of one unit of the file.
POINTHAPTICSRENDERING_EXPORT void addDensity(vtkPolyData* points);

} // namespace pointhaptics
