/// @file
/// Settings and numbers as text: shortest digits that read back to the same doubles.
#pragma once

#include "Core/Base/AffineTransform.h"
#include "Core/Base/PointView.h"
#include "Core/Base/SettingsMembers.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <string>
#include <system_error>
#include <type_traits>

namespace pointhaptics
{
namespace keyed
{

template <typename Number>
std::string textOf(Number value)
{
  char digits[40];
  return std::string(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

/// All of @p text; no spaces.
template <typename Number>
bool parse(const std::string& text, Number& value)
{
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
  return parsed.ec == std::errc() && parsed.ptr == text.data() + text.size();
}

template <typename Number>
std::string joined(const Number* values, std::size_t count)
{
  std::string text;
  for (std::size_t i = 0; i < count; ++i)
  {
    text += (i > 0 ? "," : "") + textOf(values[i]);
  }
  return text;
}

/// Exactly @p count numbers, none of them NaN.
template <typename Number>
bool parseNumbers(const std::string& text, Number* values, std::size_t count)
{
  std::size_t begin = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::size_t end = i + 1 < count ? text.find(',', begin) : text.size();
    if (end == std::string::npos || !parse(text.substr(begin, end - begin), values[i]) ||
      std::isnan(values[i]))
    {
      return false;
    }
    begin = end + 1;
  }
  return true;
}

///@{
/// A value as text, and back. False: it is none.
template <typename Value>
std::string toText(const Value& value)
{
  if constexpr (std::is_same_v<Value, AffineTransform>)
  {
    return joined(&value.m[0][0], 12);
  }
  else if constexpr (std::is_same_v<Value, Bounds>)
  {
    const double b[6] = { value.minimum.x, value.maximum.x, value.minimum.y, value.maximum.y, value.minimum.z,
      value.maximum.z };
    return value.empty() ? std::string("none") : joined(b, 6);
  }
  else if constexpr (std::is_same_v<Value, std::array<std::int64_t, 3>>)
  {
    return joined(value.data(), 3);
  }
  else if constexpr (std::is_floating_point_v<Value>)
  {
    return textOf(value);
  }
  else if constexpr (std::is_same_v<Value, std::string>)
  {
    return value;
  }
  else if constexpr (std::is_same_v<Value, std::set<std::string>>)
  {
    std::string text;
    for (const std::string& name : value)
    {
      text += (text.empty() ? "" : ",") + name;
    }
    return text;
  }
  else
  {
    return textOf(static_cast<std::int64_t>(value)); // of a bool, a whole number, an enumeration
  }
}

template <typename Value>
bool fromText(const std::string& text, Value& value)
{
  if constexpr (std::is_same_v<Value, AffineTransform>)
  {
    return parseNumbers(text, &value.m[0][0], 12) && value.check() == Status::Ok;
  }
  else if constexpr (std::is_same_v<Value, Bounds>)
  {
    double b[6];
    value = Bounds();
    const bool isNone = text == "none";
    if (!isNone && parseNumbers(text, b, 6))
    {
      value = { { b[0], b[2], b[4] }, { b[1], b[3], b[5] } };
    }
    return isNone || (!value.empty() && isFinite(value.extent()));
  }
  else if constexpr (std::is_same_v<Value, std::array<std::int64_t, 3>>)
  {
    return parseNumbers(text, value.data(), 3) && *std::min_element(value.begin(), value.end()) >= 0;
  }
  else if constexpr (std::is_floating_point_v<Value>)
  {
    return parse(text, value) && !std::isnan(value);
  }
  else if constexpr (std::is_same_v<Value, std::string>)
  {
    return !(value = text).empty();
  }
  else
  {
    constexpr std::int64_t kMost = std::is_same_v<Value, bool> ? 1
      : std::is_enum_v<Value>                                  ? 15
      : sizeof(Value) > sizeof(int)                            ? std::numeric_limits<std::int64_t>::max()
                                                               : 1 << 30;
    std::int64_t number = 0;
    const bool isRead = parse(text, number) && number >= 0 && number <= kMost;
    value = isRead ? static_cast<Value>(number) : value;
    return isRead;
  }
}
///@}

/// A line for each member, through all levels: "RadiusScale: 4".
template <typename Stream, typename Indent, typename Settings>
void printSettings(Stream& os, const Indent& indent, const Settings& settings)
{
  visitSettings(settings,
    [&](const std::string& path, const auto& member)
    {
      std::string name = path.substr(path.rfind('.') + 1);
      name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
      os << indent << name << ": " << toText(member) << "\n";
    });
}

} // namespace keyed
} // namespace pointhaptics
