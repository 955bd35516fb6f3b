#include "ScaleNote.h"

#include <fmt/format.h>
#include <vtkMatrix4x4.h>

#include <cmath>

namespace pointhaptics
{
namespace
{

struct Unit
{
  const char* name;
  double metres;
};
constexpr Unit kMetric[] = { { "km", 1e3 }, { "m", 1.0 }, { "mm", 1e-3 }, { "um", 1e-6 } };

/// Between these a length reads without an exponent.
constexpr double kLeast = 0.1;
constexpr double kMost = 999.5;

/// Three digits, in a unit that needs no exponent where there is one.
std::string lengthText(double metres, const Unit& preferred)
{
  const double inPreferred = metres / preferred.metres;
  if (inPreferred >= kLeast && inPreferred < kMost)
  {
    return fmt::format("{:.3g} {}", inPreferred, preferred.name);
  }
  for (const Unit& unit : kMetric)
  {
    if (metres >= kLeast * unit.metres)
    {
      return fmt::format("{:.3g} {}", metres / unit.metres, unit.name);
    }
  }
  return fmt::format("{:.3g} um", 1e6 * metres);
}

} // namespace

std::string describeScale(vtkMatrix4x4* modelMatrix, const std::string& unitName, double metresPerUnit)
{
  const Unit unit{ unitName.c_str(), metresPerUnit };
  const double metres = std::cbrt(std::abs(modelMatrix->Determinant())); // of one unit, in the hand
  return fmt::format("scale {:.3g} (1 {} of the cloud is {} in the hand)", metres / unit.metres, unit.name,
    lengthText(metres, unit));
}

} // namespace pointhaptics
