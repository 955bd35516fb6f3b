/// @file
/// Colours of a cloud where nobody chose any: decided from its arrays.
#pragma once

#include "CloudLook.h"
#include "Core/Neighbors/LocalShape.h"
#include "Core/Neighbors/NeighborQuery.h"

#include "PointHapticsRenderingModule.h" // For export macro

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkDataArray;
class vtkPolyData;
class vtkUnsignedCharArray;

namespace pointhaptics
{

enum class ColorRule
{
  Rgb,     ///< The cloud's own colours.
  Classes, ///< Colours of the ASPRS classes of LAS files.
  Clay,    ///< One light colour: the light shows the shape.
  Height,  ///< Along the up axis.
  Depth,   ///< The logarithm of the distance along the view of a depth camera.
};

/// Colouring of a cloud's points.
struct CloudColors
{
  ColorRule rule = ColorRule::Height;
  std::string array;          ///< Array of the classes.
  std::string intensity;      ///< Array whose rank makes the colours lighter and darker; empty: none does.
  double lightStrength = 1.0; ///< See SplatSettings::lightStrength.
  double low = 0.0;           ///< Height and Depth: where the map begins, along the axis or the view,
  double high = 1.0;          ///< and where it ends.
  std::vector<double> ranks;  ///< Sample of the intensities, ascending.
};

/// Name of ColorRule::Clay for users.
constexpr const char* kClayName = "Clay";
/// Red, green and blue of ColorRule::Clay, 0 to 1.
constexpr double kClayColor[3] = { 0.80, 0.76, 0.70 };

/// The point array of one component of @p cloud with that name in any case, "scalar_" before it or not; null:
/// there is none.
POINTHAPTICSRENDERING_EXPORT vtkDataArray* findArrayAnyCase(vtkPolyData* cloud, const std::string& name);

/// Part of the variance of @p values, by their ranks, that is between neighbourhoods rather than within them:
/// 1 for a pattern on the surface, about 0 for noise. At most about 5,000 flat points count.
POINTHAPTICSRENDERING_EXPORT double spatialCoherence(
  vtkDataArray* values, const NeighborQuery& query, const LocalShape& shape);

/// Chooses the first rule that fits: colours that differ, three classes and more, clay for an object of
/// smooth surfaces, height, or depth for a frame. An intensity that is coherent in space joins all but the
/// first. @param query of the points of @p cloud. @param shape of the same points, in their order.
POINTHAPTICSRENDERING_EXPORT CloudColors chooseColors(
  vtkPolyData* cloud, const NeighborQuery& query, const LocalShape& shape, const CloudLook& look);

/// Makes the colours of all points, each from its own place and values and @p colors alone: finer levels of a
/// cloud continue the colours of a coarse one. Null: the colours are the cloud's own (Rgb), or one colour
/// (Clay without intensity).
POINTHAPTICSRENDERING_EXPORT vtkSmartPointer<vtkUnsignedCharArray> makeColors(
  vtkPolyData* cloud, const CloudColors& colors, const CloudLook& look);

} // namespace pointhaptics
