#include "CloudOrientation.h"

#include "CloudParts.h"
#include "SmpExecutor.h"
#include "UpEvidence.h"

#include "Core/Base/PointView.h"
#include "Core/Resample/TransformedBounds.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <vector>

namespace pointhaptics
{
namespace
{

/// Longest side, metres, of a thing in an E57 file that is no scan of surroundings.
constexpr double kLongestScannedObject = 2.0;
/// Largest ratio of an object's extents; and of its distance from the origin to its length.
constexpr double kLongestObject = 4.0;
constexpr double kFarthestObject = 10.0;

double fieldValue(vtkDataArray* array, int i)
{
  const int components = array->GetNumberOfComponents();
  return array->GetComponent(i / components, i % components);
}

/// True for a viewpoint (tx ty tz qw qx qy qz) other than the identity, or an organised frame of more than
/// one row.
bool comesFromCamera(vtkFieldData* field)
{
  vtkDataArray* dimensions = field->GetArray("OrganizedDimensions");
  if (dimensions && dimensions->GetNumberOfValues() == 2 && fieldValue(dimensions, 1) > 1.0)
  {
    return true;
  }
  vtkDataArray* viewpoint = field->GetArray("Viewpoint");
  bool moved = false;
  for (int i = 0; viewpoint && viewpoint->GetNumberOfValues() == 7 && i < 7; ++i)
  {
    moved = moved || (i != 3 && fieldValue(viewpoint, i) != 0.0);
  }
  return moved;
}

/// A depth camera's points are in its own frame, all in front of it: z forward and y down, or, as OpenGL has
/// it, z backward and y up; the viewpoint
/// places that frame in a world we do not show. Points behind the camera mean that they are in the world's
/// frame already.
bool sensorOrientation(vtkPolyData* cloud, const Bounds& bounds, CloudOrientation& orientation)
{
  const double ahead = bounds.minimum.z > 0.0 ? 1.0 : bounds.maximum.z < 0.0 ? -1.0 : 0.0;
  if (!comesFromCamera(cloud->GetFieldData()) || ahead == 0.0)
  {
    return false;
  }
  orientation.up = { 0.0, -ahead, 0.0 };
  orientation.front = { 0.0, 0.0, -ahead };
  orientation.fromSensor = true;
  return true;
}

bool isAnyOf(std::initializer_list<const char*> names, std::string format)
{
  std::transform(
    format.begin(), format.end(), format.begin(), [](unsigned char c) { return std::tolower(c); });
  return std::any_of(names.begin(), names.end(),
    [&format](const char* name) { return format.find(name) != std::string::npos; });
}

/// True for a scanned object that stands on y = 0 or is tallest along y, as model makers leave them; not for
/// a scene, which is wide, and low along z.
bool standsAlongY(const Bounds& bounds)
{
  const Vec3 extent = bounds.extent();
  const double longest = std::max({ extent.x, extent.y, extent.z });
  const double shortest = std::min({ extent.x, extent.y, extent.z });
  if (!(longest > 0.0) || shortest < longest / kLongestObject ||
    norm(bounds.center()) > kFarthestObject * longest)
  {
    return false;
  }
  const bool straddles =
    bounds.minimum.x < 0.0 && bounds.maximum.x > 0.0 && bounds.minimum.z < 0.0 && bounds.maximum.z > 0.0;
  const bool startsAtFloor =
    bounds.minimum.y > -0.3 * extent.y && straddles && bounds.minimum.z < -0.3 * extent.z;
  return extent.y >= longest || startsAtFloor;
}

/// True for a small object above y = 0 about the y axis: a scanner would stand within its scene, or in front
/// of it.
bool standsAboveFloor(const Bounds& bounds)
{
  const Vec3 extent = bounds.extent();
  return std::max({ extent.x, extent.y, extent.z }) < kLongestScannedObject && bounds.minimum.y >= 0.0 &&
    bounds.minimum.y < extent.y && standsAlongY(bounds);
}

} // namespace

CloudOrientation orientationForUpAxis(const std::string& axis)
{
  struct Named
  {
    const char* axis;
    Vec3 up;
    Vec3 front;
  };
  static const Named orientations[] = {
    { "x", { 1.0, 0.0, 0.0 }, { 0.0, 0.0, 1.0 } },
    { "-x", { -1.0, 0.0, 0.0 }, { 0.0, 0.0, 1.0 } },
    { "y", { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 } },
    { "-y", { 0.0, -1.0, 0.0 }, { 0.0, 0.0, -1.0 } }, // as a camera sees: y down, z away
    { "-z", { 0.0, 0.0, -1.0 }, { 0.0, 1.0, 0.0 } },
  };
  CloudOrientation orientation;
  for (const Named& each : orientations)
  {
    if (axis == each.axis)
    {
      orientation.up = each.up;
      orientation.front = each.front;
    }
  }
  return orientation;
}

std::string axisName(const Vec3& up)
{
  int axis = 2;
  for (const int other : { 1, 0 })
  {
    axis = std::abs(up[other]) > std::abs(up[axis]) ? other : axis;
  }
  return std::string(up[axis] < 0.0 ? "-" : "") + "xyz"[axis];
}

CloudOrientation guessCloudOrientation(vtkPolyData* cloud, const std::string& format)
{
  CloudOrientation orientation;
  if (!cloud || cloud->GetNumberOfPoints() == 0)
  {
    return orientation;
  }
  std::vector<Vec3> copy;
  const PointView points = viewOf(cloud, copy);
  const Bounds bounds = transformedBounds(points, AffineTransform(), SmpExecutor());
  if (sensorOrientation(cloud, bounds, orientation))
  {
    return orientation;
  }
  const bool standsUp = isAnyOf({ "ply", "obj", "stl", "off" }, format)
    ? standsAlongY(bounds)
    : isAnyOf({ "e57" }, format) && standsAboveFloor(bounds);
  if (standsUp)
  {
    orientation = orientationForUpAxis("y");
  }
  if (isAnyOf({ "las", "laz", "copc", "e57" }, format))
  {
    return orientation; // surveys say what is up
  }
  const std::optional<Vec3> up = upByShape(points, orientation.up, orientation.isGuess);
  if (up)
  {
    orientation = orientationForUpAxis(axisName(*up));
    orientation.isGuess = true;
  }
  return orientation;
}

} // namespace pointhaptics
