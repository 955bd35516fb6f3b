#include "Devices/PathUnits.h"

#include "Core/Base/QuantityText.h"

#include <algorithm>
#include <cmath>
#include <vector>

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
constexpr double kOfMaps = 1e5;         ///< Metres from the origin: map coordinates.

bool areNear(double a, double b)
{
  return a < kNear * b && b < kNear * a;
}

double sizeOf(const Bounds& box)
{
  return box.empty() ? 0.0 : norm(box.extent());
}

/// The farthest that @p box goes from the origin, about which a unit scales, on an axis.
double reachOf(const Bounds& box)
{
  double reach = 0.0;
  for (int axis = 0; axis < 3 && !box.empty(); ++axis)
  {
    reach = std::max({ reach, std::abs(box.minimum[axis]), std::abs(box.maximum[axis]) });
  }
  return reach;
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

/// The units in which a length, taken for metres, is not far from a usual one; the most usual unit first.
std::vector<Unit> likelyUnits(double length, double usual)
{
  constexpr double kMostInCentimetres = 400.0;
  constexpr double kLeastInMicrometres = 3e4;
  const double ratio = length / usual;
  std::vector<Unit> units = { ratio > kLeastInMicrometres ? Unit{ "um", 1e-6 } : Unit{ "mm", 1e-3 } };
  if (ratio < kMostInCentimetres)
  {
    units.push_back({ "cm", 1e-2 });
  }
  return units;
}

/// For each of the @p units: give @p options, or where there are none multiply @p numbers, if @p what in it.
std::string cure(const std::vector<std::string>& options, const std::string& numbers, const std::string& what,
  const std::vector<Unit>& units)
{
  std::string text;
  for (const Unit& unit : units)
  {
    std::string words;
    for (const std::string& option : options)
    {
      words += option.empty() ? std::string() : " " + option + " " + unit.name;
    }
    text += (text.empty() ? "" : ", or ") +
      (words.empty() ? "multiply " + numbers + " by " + ratioText(unit.factor) : "give" + words) + " if " +
      what + " in " + unit.name;
  }
  return text;
}

std::string unlikelyLengths(
  const Bounds& pathBox, const Bounds& cloudBox, const UnitNames& names, bool isCloudKnown)
{
  const double path = sizeOf(pathBox);
  const double cloud = sizeOf(cloudBox);
  const bool isLarge = cloud > kReach;
  if (path <= kReach || (isCloudKnown && isLarge && areNear(reachOf(pathBox), reachOf(cloudBox))))
  {
    return {};
  }
  const std::vector<Unit> units = likelyUnits(path, isLarge || cloud == 0.0 ? kUsualReach : cloud);
  const std::string spans = "the path spans " + lengthText(path, 2);
  if (isLarge && areNear(reachOf(pathBox), reachOf(cloudBox)))
  {
    return spans + " and the cloud " + lengthText(cloud, 2) + ", more than a hand reaches; " +
      cure({ names.cloud, names.path }, "the points and the places of the path", "both are", units);
  }
  return spans + ", more than a hand reaches; " +
    cure({ names.path }, "the places of the path", "it is", units);
}

/// Places of a path and a cloud that it passed, one of which would be where the other is in another unit.
std::string unlikelyPlaces(const Bounds& path, const Bounds& cloud, const UnitNames& names)
{
  const double ofPath = reachOf(path);
  const double ofCloud = reachOf(cloud);
  const bool isCloud = ofCloud > ofPath;
  const double far = std::max(ofPath, ofCloud);
  const double near = std::min(ofPath, ofCloud);
  std::vector<Unit> units = likelyUnits(far, std::max(near, kLeastTravel));
  units.erase(
    std::remove_if(units.begin(), units.end(),
      [&](const Unit& unit) { return unit.factor * far > kReach || kNear * unit.factor * far < near; }),
    units.end());
  return far > kReach && far < kOfMaps && near > kLeastTravel && !units.empty() ? "the cloud reaches " +
      lengthText(ofCloud, 2) + " from the origin and the path " + lengthText(ofPath, 2) + "; " +
      (isCloud ? cure({ names.cloud }, "the points", "the cloud is", units)
               : cure({ names.path }, "the places of the path", "it is", units))
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
    " a second on average; " + cure({ names.time }, "its times", "they are", { unit });
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

std::string unlikelyUnits(
  const HipPath& path, const Bounds& cloud, const UnitNames& names, bool isTouched, bool isCloudKnown)
{
  const Bounds box = boxOf(path);
  std::string odd = unlikelyLengths(box, cloud, names, isCloudKnown);
  // Speeds are wrong where lengths are.
  odd = odd.empty() ? unlikelyTimes(path, names) : odd;
  return odd.empty() && !isTouched && !isCloudKnown ? unlikelyPlaces(box, cloud, names) : odd;
}

} // namespace pointhaptics
