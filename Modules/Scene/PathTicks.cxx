#include "PathTicks.h"

#include "Devices/HipPath.h"

#include <fmt/format.h>

#include <cmath>

namespace pointhaptics
{

bool countTicks(const HipPath& path, const std::string& fileName, double rateHz, double most,
  std::int64_t& ticks, std::string& message)
{
  // The last point counts also where rounding puts it just before its tick.
  const double count = std::floor(path.duration() * rateHz + 1e-6) + 1.0;
  if (!(count <= most))
  {
    message =
      fmt::format("{}: {} s at {} Hz are more than {} ticks; check that t is in seconds, or cut the path",
        fileName, path.duration(), rateHz, most);
    return false;
  }
  ticks = static_cast<std::int64_t>(count);
  return true;
}

} // namespace pointhaptics
