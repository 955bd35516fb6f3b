/// @file
/// How a vtkSplatMapper draws its splats.
#pragma once

#include <array>
#include <cmath>
#include <string>

namespace pointhaptics
{

/// Diameter of discs over the edge of cells, of which each has one, that close what discs about all points
/// would.
inline constexpr double kClosingCells = 2.2;

/// Changing a number is free; another array, light or surfaces upload the points again.
struct SplatSettings
{
  /// Point array of one component with a length for each point. Below 0: the point is hidden.
  std::string sizeArray = "Bandwidth";
  /// Diameter of a splat over its length in the array. At this value voxel means close to a surface: 2.5
  /// times their spacing for the bandwidths of 16 neighbours.
  double sizeScale = 3.6;
  /// A length counts for no more than so many times the median of all: single points far from all others
  /// would be drawn as balls.
  double largestRatio = 2.5;
  ///@{
  /// Bounds of a diameter, pixels; with surfaces those of what is flat may be larger.
  double smallestPixels = 2.0;
  double largestPixels = 64.0;
  ///@}
  /// Diameter of all splats in pixels, whatever the array says; 0: the array rules, and 3 pixels where there
  /// is none.
  double fixedPixels = 0.0;
  /// Shade the splats by their normals, where the input has them.
  bool ambientLight = false;
  /// Point array of three components with a unit normal of each point, on either side; zero: the splat has
  /// the middle light.
  std::string normalArray = "SurfaceNormal";
  double normalUnit = 1.0;    ///< Length of a normal of 1 in the array: 32767 for short integers.
  double lightStrength = 1.0; ///< How much of the light is seen, 0 (the colours themselves) to 1.
  std::array<double, 3> sky = { 0.0, 0.0, 1.0 }; ///< Where the sky is, in the frame of the scene.
  /// Draw what is flat as surfaces, by the length of the normals; needs the light.
  bool surfaces = false;
  /// Discs that tilt away get narrow, as the spacing of points on a surface does. Off: they stay round, for
  /// points that are evenly apart on the screen as those of a camera are.
  bool foreshortens = true;
  /// Splats that are not flat close like a surface, too; their discs still face the camera.
  bool closesAll = false;
  double pointPixels = 4.0; ///< Largest diameter, pixels, of a splat whose neighbourhood is not flat at all.
  /// Largest diameter, pixels, of a splat whose neighbourhood is flat: as large as its length says.
  double surfacePixels = INFINITY;
  /// Edge of cells of which one point each is drawn: no splat is smaller than closes it. 0: all are drawn.
  double gap = 0.0;
  /// Leave out what looks away from the viewer, where the normals are on the side that was seen: a room
  /// without its near walls. Splats with a normal shorter than 0.02 stay.
  bool hidesBackFaces = false;
  /// Only what lies in this box is drawn, xmin, xmax, ymin ... zmax, in the frame of the input.
  std::array<double, 6> clipBox = { -INFINITY, INFINITY, -INFINITY, INFINITY, -INFINITY, INFINITY };
};

} // namespace pointhaptics
