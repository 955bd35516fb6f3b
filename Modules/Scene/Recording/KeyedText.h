/// @file
/// Lines of words "name=value": shortest digits that read back to the same doubles.
#pragma once

#include "Core/Base/AffineTransform.h"
#include "Core/Base/PointView.h"
#include "Core/Base/SettingsMembers.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <sstream>
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

/// Words "name=value", written or read: one description of a line, a sequence of calls, does both.
class Line
{
public:
  /// A line that is written; it begins with @p head.
  static Line startingWith(const std::string& head) { return Line(head, false); }
  /// A line that was read, without its head.
  static Line from(const std::string& words) { return Line(words, true); }

  /// The line; of one that was read the word that is wrong, where there is one.
  const std::string& text() const { return text_; }
  /// True where all words were there and right.
  bool isFine() const { return isFine_; }

  /// @p isRequired false: stays as it is where a line that is read has no such word.
  template <typename Value>
  void value(const std::string& name, Value& value, bool isRequired = true)
  {
    const auto word = words_.find(name);
    if (!isRead_)
    {
      text_ += " " + name + "=" + toText(value);
    }
    else if (word == words_.end() ? isRequired : !fromText(word->second, value))
    {
      text_ = isFine_ && word != words_.end() ? name + "=" + word->second : text_;
      isFine_ = false;
    }
  }
  /// All members of @p settings that what is felt depends on: not sets of names.
  template <typename Settings>
  void settings(Settings& settings, const std::string& prefix = {})
  {
    visitSettings(
      settings,
      [this](const std::string& name, auto& member)
      {
        if constexpr (!std::is_same_v<std::decay_t<decltype(member)>, std::set<std::string>>)
        {
          this->value(name, member, false);
        }
      },
      prefix);
  }
  /// As settings(), where the line may lack all of them.
  template <typename Settings>
  void settings(std::optional<Settings>& settings, const std::string& prefix)
  {
    const auto first = words_.lower_bound(prefix);
    if (first != words_.end() && first->first.rfind(prefix, 0) == 0)
    {
      settings.emplace();
    }
    if (settings)
    {
      this->settings(*settings, prefix);
    }
  }

private:
  Line(const std::string& text, bool isRead)
    : text_(text)
    , isRead_(isRead)
  {
    std::istringstream stream(isRead ? text : std::string());
    for (std::string word; stream >> word;)
    {
      const std::size_t equals = std::min(word.find('='), word.size());
      isFine_ = isFine_ && equals > 0 && equals < word.size();
      words_[word.substr(0, equals)] = word.substr(std::min(equals + 1, word.size()));
    }
  }

  std::string text_;
  std::map<std::string, std::string> words_;
  bool isRead_ = false;
  bool isFine_ = true;
};

} // namespace keyed
} // namespace pointhaptics
