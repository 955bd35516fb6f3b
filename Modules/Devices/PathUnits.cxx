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

struct Unit
{
  const char* name;
  double factor; ///< To metres or seconds.
};

/// The unit in which a length, taken for metres, is the nearest to a usual one.
Unit likelyUnit(double length, double usual)
{
  const double ratio = length / usual;
  return ratio > 0.03e6 ? Unit{ "um", 1e-6 }
    : ratio > 300.0     ? Unit{ "mm", 1e-3 }
    : ratio > 50.0      ? Unit{ "cm", 1e-2 }
                        : Unit{ "mm", 1e-3 };
}

/// @p option, or where there is none what @p numbers are to be multiplied by.
std::string cure(const std::string& option, const char* numbers, const Unit& unit)
{
  return option.empty() ? "multiply " + std::string(numbers) + " by " + ratioText(unit.factor)
                        : "give " + option + " " + unit.name;
}

std::string unlikelyLengths(double path, double cloud, const UnitNames& names)
{
  if (path <= kReach)
  {
    return {};
  }
  const bool isLarge = cloud > kReach;
  const Unit unit = likelyUnit(path, isLarge || cloud == 0.0 ? kUsualReach : cloud);
  const std::string spans = "the path spans " + lengthText(path, 2);
  if (isLarge && areNear(path, cloud))
  {
    const std::string both = names.path.empty() ? "" : names.cloud + " " + unit.name + " " + names.path;
    return spans + " and the cloud " + lengthText(cloud, 2) + ", more than a hand reaches; " +
      cure(both, "the points and the places of the path", unit) + " if both are in " + unit.name;
  }
  return spans + ", more than a hand reaches; " + cure(names.path, "the places of the path", unit) +
    " if it is in " + unit.name;
}

/// A cloud that would be as large as a path which passed it.
std::string unlikelyCloud(double path, double cloud, const UnitNames& names)
{
  const Unit unit = likelyUnit(cloud, std::max(path, kLeastTravel));
  return cloud > kReach && path > kLeastTravel && areNear(unit.factor * cloud, path)
    ? "the cloud spans " + lengthText(cloud, 2) + " and the path " + lengthText(path, 2) + "; " +
      cure(names.cloud, "the points", unit) + " if the cloud is in " + unit.name
    : std::string();
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
  const Unit unit = speed * 1e3 < kSlow ? Unit{ "us", 1e-6 } : Unit{ "ms", 1e-3 };
  return "the path takes " + ratioText(duration) + " s, at " + lengthText(speed, 2) +
    " a second on average; " + cure(names.time, "its times", unit) + " if they are in " + unit.name;
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

std::string unlikelyUnits(const HipPath& path, const Bounds& cloud, const UnitNames& names, bool isTouched)
{
  const double size = sizeOf(boxOf(path));
  std::string odd = unlikelyLengths(size, sizeOf(cloud), names);
  // Speeds are wrong where lengths are.
  odd = odd.empty() ? unlikelyTimes(path, names) : odd;
  return odd.empty() && !isTouched ? unlikelyCloud(size, sizeOf(cloud), names) : odd;
}

} // namespace pointhaptics
