/// @file
/// Values as words of a line, "key=value": shortest digits that read back to the same doubles.
#pragma once

#include "Core/Base/AffineTransform.h"
#include "Core/Base/PointView.h"
#include "Core/Base/SettingsMembers.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <system_error>
#include <type_traits>
#include <vector>

namespace pointhaptics
{
namespace keyed
{

inline std::string textOf(double value)
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

inline std::string joined(const double* values, std::size_t count)
{
  std::string text;
  for (std::size_t i = 0; i < count; ++i)
  {
    text += (i > 0 ? "," : "") + textOf(values[i]);
  }
  return text;
}

/// Exactly @p count numbers, none of them NaN.
inline bool parseNumbers(const std::string& text, double* values, std::size_t count)
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
    return std::to_string(value[0]) + "," + std::to_string(value[1]) + "," + std::to_string(value[2]);
  }
  else if constexpr (std::is_floating_point_v<Value>)
  {
    return textOf(value);
  }
  else
  {
    return std::to_string(static_cast<std::int64_t>(value)); // of a bool, a whole number, an enumeration
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
    double n[3];
    constexpr double kMost = 1e15;
    const bool isRead = parseNumbers(text, n, 3) && n[0] >= 0.0 && n[1] >= 0.0 && n[2] >= 0.0 &&
      n[0] < kMost && n[1] < kMost && n[2] < kMost;
    value = isRead ? Value{ std::int64_t(n[0]), std::int64_t(n[1]), std::int64_t(n[2]) } : value;
    return isRead;
  }
  else if constexpr (std::is_floating_point_v<Value>)
  {
    return parse(text, value) && !std::isnan(value);
  }
  else
  {
    constexpr std::int64_t kMost = std::is_same_v<Value, bool> ? 1 : std::is_enum_v<Value> ? 15 : 1 << 30;
    std::int64_t number = 0;
    const bool isRead = parse(text, number) && number >= 0 && number <= kMost;
    value = isRead ? static_cast<Value>(number) : value;
    return isRead;
  }
}
///@}

/// The words of a line, by their keys.
using Words = std::map<std::string, std::string>;

/// False: a word is not KEY=VALUE.
inline bool split(const std::string& text, Words& words)
{
  std::size_t begin = text.find_first_not_of(' ');
  while (begin != std::string::npos)
  {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos || equals == 0)
    {
      return false;
    }
    words[word.substr(0, equals)] = word.substr(equals + 1);
    begin = text.find_first_not_of(' ', end);
  }
  return true;
}

/// Whether what is felt depends on a member of this type: not on names.
template <typename Member>
constexpr bool matters = !std::is_same_v<std::remove_const_t<Member>, std::set<std::string>>;

/// All members of @p settings as words " PREFIXname=value".
template <typename Settings>
std::string wordsOf(const Settings& settings, const std::string& prefix = {})
{
  std::string text;
  visitSettings(
    settings,
    [&text](const std::string& name, const auto& member)
    {
      if constexpr (matters<std::remove_reference_t<decltype(member)>>)
      {
        text += " " + name + "=" + toText(member);
      }
    },
    prefix);
  return text;
}

/// Takes the members that @p words have; the others stay. False: @p problem names a word with another value
/// than its member can have.
template <typename Settings>
bool takeWords(const Words& words, Settings& settings, std::string& problem, const std::string& prefix = {})
{
  visitSettings(
    settings,
    [&](const std::string& name, auto& member)
    {
      if constexpr (matters<std::remove_reference_t<decltype(member)>>)
      {
        const auto word = words.find(name);
        if (word != words.end() && !fromText(word->second, member))
        {
          problem = name + "=" + word->second;
        }
      }
    },
    prefix);
  return problem.empty();
}

} // namespace keyed
} // namespace pointhaptics
