#include "Core/Base/QuantityText.h"

#include <algorithm>
#include <charconv>
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
/// The first in which the length can be read is taken.
constexpr Unit kMetric[] = { { "m", 1.0 }, { "mm", 1e-3 }, { "um", 1e-6 }, { "nm", 1e-9 }, { "pm", 1e-12 },
  { "km", 1e3 } };

/// Between these a number needs neither an exponent nor leading zeros.
constexpr double kLeast = 0.0995;
constexpr double kMost = 999.5;
constexpr double kLargestWithCommas = 1e15;

bool isReadable(double value)
{
  return value >= kLeast && value < kMost;
}

/// As printf writes it: %.Nf, %.Ne or %.Ng, N the @p precision.
std::string formatted(double value, std::chars_format format, int precision)
{
  char text[400]; // the longest double has 309 digits before its point
  return { text, std::to_chars(text, text + sizeof(text), value, format, precision).ptr };
}

std::string fixed(double value, int decimals)
{
  return formatted(value, std::chars_format::fixed, decimals);
}

/// Without an exponent. @pre above 0.
std::string significant(double value, int digits)
{
  const int decimals = digits - 1 - int(std::floor(std::log10(value)));
  const double step = std::pow(10.0, -decimals);
  const double rounded = std::round(value / step) * step;
  // 1200 has four digits before the point, whatever their number is to be.
  const int whole = 1 + int(std::floor(std::log10(rounded * (1.0 + 1e-12))));
  return formatted(rounded, std::chars_format::general, std::max(digits, whole));
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
    return sign + withCommas(fixed(1e-3 * size, 0)) + " km";
  }
  return sign + formatted(size, std::chars_format::scientific, 1) + " m";
}

std::string lengthText(double metres, const std::string& unitName, double metresPerUnit, int digits)
{
  const double value = std::abs(metres) / metresPerUnit;
  return std::isfinite(value) && isReadable(value)
    ? std::string(metres < 0.0 ? "-" : "") + significant(value, digits) + " " + unitName
    : lengthText(metres, digits);
}

std::string ratioText(double ratio, int digits)
{
  if (!(ratio < kLargestWithCommas))
  {
    return formatted(ratio, std::chars_format::scientific, 2);
  }
  const std::string text = significant(ratio, digits);
  return text.find_first_of(".e") == std::string::npos ? withCommas(text) : text;
}

std::string countText(std::int64_t count)
{
  return count < 0 ? "-" + withCommas(std::to_string(count).substr(1)) : withCommas(std::to_string(count));
}

std::string noReturnsText(std::int64_t count)
{
  return countText(count) + " points at (0, 0, 0), which scanners write for rays without return,";
}

} // namespace pointhaptics
