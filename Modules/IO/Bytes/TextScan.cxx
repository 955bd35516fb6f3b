#include "IO/Bytes/TextScan.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace pointhaptics::io
{

bool LineReader::next(std::string_view& line)
{
  if (position_ >= text_.size())
  {
    return false;
  }
  const std::size_t found = text_.find(end_, position_);
  const std::size_t end = found == std::string_view::npos ? text_.size() : found;
  line = text_.substr(position_, end - position_);
  if (!line.empty() && line.back() == '\r')
  {
    line.remove_suffix(1);
  }
  position_ = found == std::string_view::npos ? end : end + 1;
  ++lineNumber_;
  return true;
}

bool LineReader::nextFilled(std::string_view& line)
{
  while (next(line))
  {
    if (!trimmed(line).empty())
    {
      return true;
    }
  }
  return false;
}

std::string_view trimmed(std::string_view text)
{
  constexpr std::string_view kBlanks = " \t\r\v\f";
  const std::size_t first = std::min(text.find_first_not_of(kBlanks), text.size());
  return text.substr(first, text.find_last_not_of(kBlanks) + 1 - first);
}

std::string_view takeWord(std::string_view& line)
{
  std::size_t begin = 0;
  while (begin < line.size() && isBlank(line[begin]))
  {
    ++begin;
  }
  std::size_t end = begin;
  while (end < line.size() && !isBlank(line[end]))
  {
    ++end;
  }
  const std::string_view word = line.substr(begin, end - begin);
  line.remove_prefix(end);
  return word;
}

bool equalNoCase(std::string_view a, std::string_view b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

namespace
{

/// Powers of ten that are doubles.
constexpr double kPowersOfTen[] = { 1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13,
  1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22 };
constexpr int kMostPower = 22;
constexpr int kMostDigits = 18;                                ///< 10^18 fits 64 bits
constexpr std::uint64_t kMostExact = std::uint64_t{ 1 } << 53; ///< every integer up to it is a double
constexpr std::uint64_t kAboveFloatDigits = 1000000;

bool isDigit(char c)
{
  return static_cast<unsigned char>(c - '0') < 10;
}

/// True if a float keeps every number of these digits (kFloatDigits of them, trailing zeros aside).
bool fewDigits(std::uint64_t mantissa)
{
  while (mantissa >= kAboveFloatDigits && mantissa % 10 == 0)
  {
    mantissa /= 10;
  }
  return mantissa < kAboveFloatDigits;
}

bool inFloatRange(double value)
{
  const double size = std::abs(value);
  return (!(size > 1e37) || std::isinf(size)) && !(size > 0.0 && size < 1e-37);
}

/// Decimal digits from the first to the last one that is not 0: 2 for "-0.0120e5".
int significantDigits(std::string_view word)
{
  int digits = 0;
  int zeros = 0;
  for (const char c : word)
  {
    if (c == 'e' || c == 'E')
    {
      break;
    }
    if (c >= '1' && c <= '9')
    {
      digits += zeros + 1;
      zeros = 0;
    }
    else if (c == '0' && digits > 0)
    {
      ++zeros;
    }
  }
  return digits;
}

/// Every spelling the standard library knows, and numbers too small for a double.
const char* parseAnyNumber(const char* first, const char* last, double& value, NumberShape* shape) noexcept
{
  const std::from_chars_result result = std::from_chars(first, last, value);
  const std::string_view word(first, static_cast<std::size_t>(result.ptr - first));
  if (result.ec == std::errc::result_out_of_range)
  {
    const std::size_t exponent = word.find_first_of("eE");
    const bool tiny = exponent == std::string_view::npos
      ? word.find_first_of("123456789") > word.find('.')
      : word.substr(exponent).find('-') != std::string_view::npos;
    if (!tiny)
    {
      return nullptr;
    }
    value = 0.0;
  }
  else if (result.ec != std::errc())
  {
    return nullptr;
  }
  if (shape)
  {
    shape->isInteger = word.find_first_of(".eEnN") == std::string_view::npos;
    shape->fitsFloat = significantDigits(word) <= kFloatDigits && inFloatRange(value);
  }
  return result.ptr;
}

} // namespace

const char* parseNumber(const char* first, const char* last, double& value, NumberShape* shape) noexcept
{
  if (last - first > 1 && first[0] == '+' && first[1] != '-')
  {
    ++first;
  }
  // Up to 15 digits and a small power of ten: both are doubles, so one multiplication or division rounds
  // correctly (W. D. Clinger, 1990). Anything else goes the long way.
  const char* at = first;
  const bool negative = at < last && *at == '-';
  at += negative ? 1 : 0;
  std::uint64_t mantissa = 0;
  const char* const firstDigit = at;
  for (; at < last && isDigit(*at); ++at)
  {
    mantissa = 10 * mantissa + static_cast<std::uint64_t>(*at - '0');
  }
  std::ptrdiff_t digits = at - firstDigit;
  int exponent = 0;
  const bool hasPoint = at < last && *at == '.';
  if (hasPoint)
  {
    const char* const firstDecimal = ++at;
    for (; at < last && isDigit(*at); ++at)
    {
      mantissa = 10 * mantissa + static_cast<std::uint64_t>(*at - '0');
    }
    digits += at - firstDecimal;
    exponent = digits <= kMostDigits ? -static_cast<int>(at - firstDecimal) : 0;
  }
  const bool hasExponent = at < last && (*at == 'e' || *at == 'E');
  if (hasExponent)
  {
    int written = 0;
    const bool plus = last - at > 2 && at[1] == '+' && at[2] != '-';
    const std::from_chars_result result = std::from_chars(at + (plus ? 2 : 1), last, written);
    if (result.ec != std::errc() || std::abs(written) > kMostPower)
    {
      return parseAnyNumber(first, last, value, shape);
    }
    at = result.ptr;
    exponent += written;
  }
  if (digits == 0 || digits > kMostDigits || mantissa > kMostExact || std::abs(exponent) > kMostPower)
  {
    return parseAnyNumber(first, last, value, shape);
  }
  const double digitsAsDouble = static_cast<double>(mantissa);
  const double size =
    exponent < 0 ? digitsAsDouble / kPowersOfTen[-exponent] : digitsAsDouble * kPowersOfTen[exponent];
  value = negative ? -size : size;
  if (shape)
  {
    shape->isInteger = !hasPoint && !hasExponent;
    shape->fitsFloat = fewDigits(mantissa);
  }
  return at;
}

bool parseNumber(std::string_view word, double& value, NumberShape* shape) noexcept
{
  const char* last = word.data() + word.size();
  return !word.empty() && parseNumber(word.data(), last, value, shape) == last;
}

bool takeNumber(std::string_view& line, double& value, NumberShape* shape) noexcept
{
  const char* first = line.data();
  const char* const last = first + line.size();
  while (first < last && isBlank(*first))
  {
    ++first;
  }
  const char* const end = first < last ? parseNumber(first, last, value, shape) : nullptr;
  const bool isNumber = end && (end == last || isBlank(*end));
  const char* const rest = isNumber ? end : first;
  line = { rest, static_cast<std::size_t>(last - rest) };
  return isNumber;
}

bool parseCount(std::string_view word, unsigned long long& value) noexcept
{
  const char* last = word.data() + word.size();
  const std::from_chars_result result = std::from_chars(word.data(), last, value);
  return result.ec == std::errc() && result.ptr == last;
}

} // namespace pointhaptics::io
