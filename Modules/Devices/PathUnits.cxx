#include "Devices/PathUnits.h"

#include "Core/Base/QuantityText.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace
{

constexpr double kReach = 2.0;          ///< Reach of a hand, metres.
constexpr double kUsualReach = 0.1;     ///< Reach of a desktop device, metres.
constexpr double kNear = 5.0;           ///< Ratio of two sizes that may belong to the same thing.
constexpr double kSlow = 1e-3;          ///< Metres a second, of a path whose rows are kSparse apart.
constexpr double kSlowest = 1e-4;       ///< Least speed of any path, metres a second.
constexpr double kFastest = 5.0;        ///< Metres a second.
constexpr double kSparse = 0.5;         ///< Seconds from row to row.
constexpr double kLong = 60.0;          ///< Seconds.
constexpr std::size_t kFewestRows = 10; ///< Fewest rows whose spacing in time counts.
constexpr double kLeastTravel = 1e-3;   ///< A hand that rests has no speed.

bool areNear(double a, double b)
{
  return a < kNear * b && b < kNear * a;
}

double sizeOf(const Bounds& box)
{
  return box.empty() ? 0.0 : norm(box.extent());
}

Bounds boxOf(const HipPath& path)
{
  Bounds box;
  for (const HipPathPoint& point : path.points)
  {
    box.include(point.position);
  }
  return box;
}

/// The unit in which a length, taken for metres, is the nearest to a usual one.
const char* likelyUnit(double length, double usual)
{
  const double ratio = length / usual;
  return ratio > 0.03e6 ? "um" : ratio > 300.0 ? "mm" : ratio > 50.0 ? "cm" : "mm";
}

std::string unlikelyLengths(double path, double cloud, const UnitNames& names)
{
  const bool isLarge = cloud > kReach;
  if (path > kReach)
  {
    const std::string unit = likelyUnit(path, isLarge || cloud == 0.0 ? kUsualReach : cloud);
    const std::string cure = names.path + " " + unit;
    return isLarge && areNear(path, cloud) ? "the path spans " + lengthText(path, 2) + " and the cloud " +
        lengthText(cloud, 2) + ", more than a hand reaches; give " + names.cloud + " " + unit + " " + cure +
        " if both are in " + unit
                                           : "the path spans " + lengthText(path, 2) +
        ", more than a hand reaches; give " + cure + " if it is in " + unit;
  }
  return {};
}

std::string unlikelyTimes(const HipPath& path, const UnitNames& names)
{
  const std::vector<HipPathPoint>& points = path.points;
  double travel = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i)
  {
    travel += norm(points[i].position - points[i - 1].position);
  }
  const double duration = path.duration();
  const double speed = duration > 0.0 ? travel / duration : 0.0;
  const bool isSparse =
    points.size() >= kFewestRows && duration / double(points.size() - 1) >= kSparse && speed < kSlow;
  // Two rows are a line that somebody drew, not a hand's path.
  const bool isSlow = points.size() > 2 && duration >= kLong && speed < kSlowest;
  if (travel < kLeastTravel || !(isSparse || isSlow) || speed * 1e3 > kFastest)
  {
    return {};
  }
  const char* unit = speed * 1e3 < kSlow ? "us" : "ms";
  return "the path takes " + ratioText(duration) + " s, at " + lengthText(speed, 2) +
    " a second on average; give " + names.time + " " + unit + " if its times are in " + unit;
}

} // namespace

void applyUnits(const PathUnits& units, HipPath& path)
{
  for (HipPathPoint& point : path.points)
  {
    point.timeSeconds *= units.seconds;
    point.position *= units.metres;
  }
}

std::string unlikelyCloudUnit(const HipPath& path, const Bounds& cloud, const UnitNames& names)
{
  const double size = sizeOf(boxOf(path));
  const double whole = sizeOf(cloud);
  const std::string unit = likelyUnit(whole, std::max(size, kLeastTravel));
  const double metres = unit == "um" ? 1e-6 : unit == "cm" ? 1e-2 : 1e-3;
  return whole > kReach && size > kLeastTravel && areNear(metres * whole, size)
    ? "the cloud spans " + lengthText(whole, 2) + " and the path " + lengthText(size, 2) + "; give " +
      names.cloud + " " + unit + " if the cloud is in " + unit
    : std::string();
}

std::string unlikelyUnits(const HipPath& path, const Bounds& cloud, const UnitNames& names)
{
  const std::string lengths = unlikelyLengths(sizeOf(boxOf(path)), sizeOf(cloud), names);
  // Speeds are wrong where lengths are.
  return lengths.empty() ? unlikelyTimes(path, names) : lengths;
}

} // namespace pointhaptics
