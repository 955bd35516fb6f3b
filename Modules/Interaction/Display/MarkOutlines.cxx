#include "MarkOutlines.h"

#include "vtkProperty2D.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pointhaptics
{
namespace
{

/// Widths of lines, points.
constexpr double kEdgeWidth = 4.0;
constexpr double kLineWidth = 2.0;
constexpr unsigned char kLight[3] = { 255, 255, 255 };
constexpr unsigned char kDark[3] = { 12, 12, 16 };
/// Corners of the polygon that approximates a circle about each corner.
constexpr int kRoundCorners = 12;
/// Pixels: wide lines as short as this have gaps where they meet.
constexpr double kShortestEdge = 3.0;
constexpr double kTurn = 6.28318530717958648;

double cross(const std::array<double, 2>& a, const std::array<double, 2>& b, const std::array<double, 2>& c)
{
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Part of @p line within @p shape, from 0 to 1 along it; empty where the second number is not above the
/// first.
std::pair<double, double> partWithin(const ScreenSegment& line, const ScreenPolygon& shape)
{
  std::pair<double, double> part{ 0.0, 1.0 };
  for (std::size_t i = 0; i < shape.size(); ++i)
  {
    const std::array<double, 2>& corner = shape[i];
    const std::array<double, 2>& next = shape[(i + 1) % shape.size()];
    const double begin = cross(corner, next, line.begin);
    const double end = cross(corner, next, line.end);
    if (begin <= 0.0 && end <= 0.0)
    {
      return { 0.0, 0.0 };
    }
    if (begin <= 0.0)
    {
      part.first = std::max(part.first, begin / (begin - end));
    }
    else if (end <= 0.0)
    {
      part.second = std::min(part.second, begin / (begin - end));
    }
  }
  return part;
}

ScreenSegment partOf(const ScreenSegment& line, double from, double to)
{
  ScreenSegment part;
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    const double way = line.end[axis] - line.begin[axis];
    part.begin[axis] = line.begin[axis] + from * way;
    part.end[axis] = line.begin[axis] + to * way;
  }
  return part;
}

} // namespace

ScreenPolygon convexHull(ScreenPolygon points)
{
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3)
  {
    return points;
  }
  ScreenPolygon hull;
  // Goes along the lower side from left to right, then back along the upper one.
  for (int side = 0; side < 2; ++side)
  {
    const std::size_t first = hull.size();
    for (const std::array<double, 2>& point : points)
    {
      while (hull.size() >= first + 2 && cross(hull[hull.size() - 2], hull.back(), point) <= 0.0)
      {
        hull.pop_back();
      }
      hull.push_back(point);
    }
    hull.pop_back(); // the other side begins with it
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

ScreenPolygon hullAbout(const ScreenPolygon& points, double pixels)
{
  ScreenPolygon all;
  for (const std::array<double, 2>& point : points)
  {
    for (int i = 0; i < kRoundCorners; ++i)
    {
      const double angle = kTurn * i / kRoundCorners;
      all.push_back({ point[0] + pixels * std::cos(angle), point[1] + pixels * std::sin(angle) });
    }
  }
  ScreenPolygon hull;
  for (const std::array<double, 2>& corner : convexHull(std::move(all)))
  {
    const bool isFar =
      hull.empty() || std::hypot(corner[0] - hull.back()[0], corner[1] - hull.back()[1]) >= kShortestEdge;
    if (isFar)
    {
      hull.push_back(corner);
    }
  }
  return hull;
}

std::vector<ScreenSegment> outlineOf(const std::vector<ScreenPolygon>& shapes)
{
  std::vector<ScreenSegment> outline;
  for (const ScreenPolygon& shape : shapes)
  {
    for (std::size_t i = 0; i < shape.size(); ++i)
    {
      const ScreenSegment edge{ shape[i], shape[(i + 1) % shape.size()] };
      std::vector<std::pair<double, double>> hidden;
      for (const ScreenPolygon& other : shapes)
      {
        if (&other != &shape && other.size() > 2)
        {
          hidden.push_back(partWithin(edge, other));
        }
      }
      std::sort(hidden.begin(), hidden.end());
      double from = 0.0;
      for (const auto& [begin, end] : hidden)
      {
        if (begin > from && end > begin)
        {
          outline.push_back(partOf(edge, from, begin));
        }
        from = end > begin ? std::max(from, end) : from;
      }
      if (from < 1.0)
      {
        outline.push_back(partOf(edge, from, 1.0));
      }
    }
  }
  return outline;
}

MarkOutlines::MarkOutlines()
{
  edges_.actor()->PickableOff();
  lines_.actor()->PickableOff();
}

void MarkOutlines::addTo(vtkRenderer* renderer)
{
  renderer->AddActor2D(edges_.actor());
  renderer->AddActor2D(lines_.actor());
}

void MarkOutlines::removeFrom(vtkRenderer* renderer)
{
  renderer->RemoveActor2D(edges_.actor());
  renderer->RemoveActor2D(lines_.actor());
}

void MarkOutlines::clear(double pixels, double width)
{
  count_ = 0;
  edges_.clear();
  lines_.clear();
  edges_.actor()->GetProperty()->SetLineWidth(float(kEdgeWidth * pixels * width));
  lines_.actor()->GetProperty()->SetLineWidth(float(kLineWidth * pixels * width));
}

void MarkOutlines::add(const ScreenSegment& line, const unsigned char color[3])
{
  edges_.add(line.begin[0], line.begin[1], line.end[0], line.end[1], kDark);
  lines_.add(line.begin[0], line.begin[1], line.end[0], line.end[1], color);
  ++count_;
}

void MarkOutlines::addOutline(const std::vector<ScreenPolygon>& shapes)
{
  for (const ScreenSegment& line : outlineOf(shapes))
  {
    this->add(line, kLight);
  }
}

void MarkOutlines::finish()
{
  edges_.finish();
  lines_.finish();
  edges_.actor()->SetVisibility(count_ > 0);
  lines_.actor()->SetVisibility(count_ > 0);
}

} // namespace pointhaptics
