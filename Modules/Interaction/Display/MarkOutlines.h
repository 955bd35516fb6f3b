/// @file
/// Outlines in pixels about marks of the picture: a light line between dark ones is seen on every ground.
#pragma once

#include "ScreenMarks.h"

#include "PointHapticsInteractionModule.h" // For export macro

#include <array>
#include <vector>

class vtkRenderer;

namespace pointhaptics
{

/// Corners of a convex polygon, counterclockwise; pixels.
using ScreenPolygon = std::vector<std::array<double, 2>>;

/// Smallest convex polygon about @p points.
POINTHAPTICSINTERACTION_EXPORT ScreenPolygon convexHull(ScreenPolygon points);

/// Convex polygon about @p points with @p pixels of room on all sides.
POINTHAPTICSINTERACTION_EXPORT ScreenPolygon hullAbout(const ScreenPolygon& points, double pixels);

/// A line between two pixels.
struct ScreenSegment
{
  std::array<double, 2> begin;
  std::array<double, 2> end;
};

/// Visible edges of all @p shapes together: none lies within another shape.
POINTHAPTICSINTERACTION_EXPORT std::vector<ScreenSegment> outlineOf(const std::vector<ScreenPolygon>& shapes);

/// Lines of the picture as it is drawn next: light or coloured, with dark edges. GUI thread only.
class MarkOutlines
{
public:
  MarkOutlines();
  void addTo(vtkRenderer* renderer);
  void removeFrom(vtkRenderer* renderer);

  /// Begins a new picture, where a point has @p pixels; @p width is a factor on the lines.
  void clear(double pixels, double width);
  void add(const ScreenSegment& line, const unsigned char color[3]);
  /// Adds the outline about all @p shapes together.
  void addOutline(const std::vector<ScreenPolygon>& shapes);
  /// Completes the lines. Call it after the last add().
  void finish();

private:
  ScreenLines edges_{ 1.0F };
  ScreenLines lines_{ 1.0F };
  int count_ = 0;
};

} // namespace pointhaptics
