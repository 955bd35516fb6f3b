#include "Core/Base/QuantityText.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pointhaptics
{
namespace
{

struct Unit
{
  const char* name;
  double metres;
};
/// The first in which the length can be read is taken.
constexpr Unit kMetric[] = { { "m", 1.0 }, { "mm", 1e-3 }, { "um", 1e-6 }, { "nm", 1e-9 }, { "km", 1e3 } };

/// Between these a number needs neither an exponent nor leading zeros.
constexpr double kLeast = 0.0995;
constexpr double kMost = 999.5;
constexpr double kLargestWithCommas = 1e15;
constexpr double kLeastNewtons = 0.0995;

bool isReadable(double value)
{
  return value >= kLeast && value < kMost;
}

template <typename... Values>
std::string formatted(const char* form, Values... values)
{
  char text[64];
  std::snprintf(text, sizeof(text), form, values...);
  return text;
}

/// Without an exponent. @pre above 0.
std::string significant(double value, int digits)
{
  const int decimals = digits - 1 - int(std::floor(std::log10(value)));
  const double step = std::pow(10.0, -decimals);
  const double rounded = std::round(value / step) * step;
  // 1200 has four digits before the point, whatever their number is to be.
  const int whole = 1 + int(std::floor(std::log10(rounded * (1.0 + 1e-12))));
  return formatted("%.*g", std::max(digits, whole), rounded);
}

std::string withCommas(std::string digits)
{
  for (std::size_t place = digits.size(); place > 3; place -= 3)
  {
    digits.insert(place - 3, ",");
  }
  return digits;
}

} // namespace

std::string lengthText(double metres, int digits)
{
  if (!std::isfinite(metres))
  {
    return "unknown";
  }
  const double size = std::abs(metres);
  const std::string sign = metres < 0.0 ? "-" : "";
  if (size == 0.0)
  {
    return "0 mm";
  }
  for (const Unit& unit : kMetric)
  {
    if (isReadable(size / unit.metres))
    {
      return sign + significant(size / unit.metres, digits) + " " + unit.name;
    }
  }
  if (size > 1.0 && size < kLargestWithCommas)
  {
    return sign + withCommas(formatted("%.0f", 1e-3 * size)) + " km";
  }
  return sign + formatted("%.1e m", size);
}

std::string lengthText(double metres, const std::string& unitName, double metresPerUnit, int digits)
{
  const double value = std::abs(metres) / metresPerUnit;
  return std::isfinite(value) && isReadable(value)
    ? std::string(metres < 0.0 ? "-" : "") + significant(value, digits) + " " + unitName
    : lengthText(metres, digits);
}

std::string forceText(double newtons)
{
  if (!std::isfinite(newtons))
  {
    return "unknown";
  }
  if (std::abs(newtons) >= kLeastNewtons)
  {
    return formatted(std::abs(newtons) < 100.0 ? "%.2f N" : "%.0f N", newtons);
  }
  const double milli = std::round(1e3 * newtons);
  return milli == 0.0 ? "0 N" : formatted("%.0f mN", milli);
}

std::string ratioText(double ratio, int digits)
{
  if (!(ratio < kLargestWithCommas))
  {
    return formatted("%.2e", ratio);
  }
  const std::string text = significant(ratio, digits);
  return text.find_first_of(".e") == std::string::npos ? withCommas(text) : text;
}

std::string countText(std::int64_t count)
{
  return count < 0 ? "-" + withCommas(std::to_string(count).substr(1)) : withCommas(std::to_string(count));
}

} // namespace pointhaptics
