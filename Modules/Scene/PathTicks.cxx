#include "PathTicks.h"

#include "Devices/HipPath.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

namespace pointhaptics
{

std::string pathProblem(const HipPath& path)
{
  if (path.points.empty())
  {
    return "path: it has no rows; give at least one";
  }
  const HipPathPoint* before = nullptr;
  for (const HipPathPoint& point : path.points)
  {
    const std::ptrdiff_t row = &point - path.points.data();
    const Vec3& p = point.position;
    if (!std::isfinite(point.timeSeconds) || !isFinite(p))
    {
      return fmt::format("path: row {} is {}, {}, {}, {}; leave rows out that are not finite", row,
        point.timeSeconds, p.x, p.y, p.z);
    }
    if (before && !(point.timeSeconds > before->timeSeconds))
    {
      return fmt::format("path: row {}: time {} is not after the time before it, {}; sort the rows by time "
                         "and remove duplicates",
        row, point.timeSeconds, before->timeSeconds);
    }
    before = &point;
  }
  return {};
}

bool countTicks(const HipPath& path, const std::string& fileName, double rateHz, double most,
  std::int64_t& ticks, std::string& message, const UnitNames& units)
{
  // The last point counts even if rounding puts it just before its tick.
  const double count = std::floor(path.duration() * rateHz + 1e-6) + 1.0;
  if (!(count <= most))
  {
    message =
      fmt::format("{}: {} s at {} Hz are more than {} ticks; check that t is in seconds, or cut the path",
        fileName, path.duration(), rateHz, most);
    const std::string odd = unlikelyUnits(path, Bounds(), units);
    message += odd.empty() ? "" : "; " + odd;
    return false;
  }
  ticks = static_cast<std::int64_t>(count);
  return true;
}

} // namespace pointhaptics
