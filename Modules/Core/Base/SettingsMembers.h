/// @file
/// Settings as plain structs that list their members once: filters, scenes, options and tests walk that list.
///
/// A settings struct is an aggregate with defaults and
/// @code
/// static constexpr auto members()
/// {
///   using S = BallSettings;
///   return std::make_tuple(settingsMember("radius", &S::radius), settingsMember("filled", &S::filled));
/// }
/// @endcode
/// followed by `static_assert(listsEveryMember<BallSettings>())`, which fails where a member is missing.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>

namespace pointhaptics
{

/// A closed range of numbers; openMinimum takes the minimum itself out. Default: all numbers.
struct NumberRange
{
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  bool openMinimum = false;

  /// False for NaN.
  constexpr bool holds(double value) const
  {
    return (openMinimum ? value > minimum : value >= minimum) && value <= maximum;
  }
};

/// A setting on the command line, and by the option's name in a configuration file.
struct SettingOption
{
  const char* name = nullptr; ///< Such as "--beta"; null: the setting is for programs, or another option's.
  const char* help = "";
  const char* form = "";  ///< Unit or form of the value, for the help.
  NumberRange range = {}; ///< Range of numbers.
};

/// A member of the settings struct @p Owner.
template <typename Owner, typename Value>
struct SettingsMember
{
  const char* name;
  Value Owner::*pointer;
  SettingOption option;
};

template <typename Owner, typename Value>
constexpr SettingsMember<Owner, Value> settingsMember(
  const char* name, Value Owner::*pointer, SettingOption option = {})
{
  return { name, pointer, option };
}

namespace detail
{

/// Initializes a member of any type.
struct AnyValue
{
  template <typename Value>
  operator Value() const;
};

template <typename Struct, typename Indices, typename = void>
struct TakesValues : std::false_type
{
};
template <typename Struct, std::size_t... I>
struct TakesValues<Struct, std::index_sequence<I...>,
  std::void_t<decltype(Struct{ (static_cast<void>(I), AnyValue{})... })>> : std::true_type
{
};

template <typename Struct, std::size_t Count = 0>
constexpr std::size_t countMembers()
{
  if constexpr (TakesValues<Struct, std::make_index_sequence<Count + 1>>::value)
  {
    return countMembers<Struct, Count + 1>();
  }
  else
  {
    return Count;
  }
}

template <typename Struct, typename = void>
struct HasMembers : std::false_type
{
};
template <typename Struct>
struct HasMembers<Struct, std::void_t<decltype(Struct::members())>> : std::true_type
{
};

} // namespace detail

/// True if @p Struct is a settings struct.
template <typename Struct>
constexpr bool isSettings = detail::HasMembers<Struct>::value;

/// How many members @p Settings lists.
template <typename Settings>
constexpr std::size_t numberOfMembers = std::tuple_size_v<decltype(Settings::members())>;

/// True if @p Settings lists as many members as it has. @p Base: the settings struct it derives from, if any,
/// whose members come first in its list.
template <typename Settings, typename Base = void>
constexpr bool listsEveryMember()
{
  static_assert(std::is_aggregate_v<Settings>, "settings are plain values");
  constexpr std::size_t count = detail::countMembers<Settings>(); // a base is one of them
  if constexpr (std::is_void_v<Base>)
  {
    return count == numberOfMembers<Settings>;
  }
  else
  {
    return count - 1 + numberOfMembers<Base> == numberOfMembers<Settings>;
  }
}

/// Calls visit(name, member) for each member of @p settings, which may be const, in the order of the list.
template <typename Settings, typename Visitor>
void visitMembers(Settings& settings, Visitor&& visit)
{
  std::apply([&](const auto&... member) { (visit(member.name, settings.*(member.pointer)), ...); },
    std::remove_const_t<Settings>::members());
}

/// Visits the members of all levels: the members of a settings struct within another have names such as
/// "lattice.voxelSize".
template <typename Settings, typename Visitor>
void visitSettings(Settings& settings, Visitor&& visit, const std::string& prefix = {})
{
  visitMembers(settings,
    [&](const char* name, auto& member)
    {
      if constexpr (isSettings<std::remove_const_t<std::remove_reference_t<decltype(member)>>>)
      {
        visitSettings(member, visit, prefix + name + ".");
      }
      else
      {
        visit(prefix + name, member);
      }
    });
}

/// The first number of @p settings, of all levels, that is out of its range; no name: none is.
struct NumberOutOfRange
{
  const char* name = nullptr;
  double value = 0.0;
  NumberRange range = {};
};
template <typename Settings>
NumberOutOfRange firstOutOfRange(const Settings& settings)
{
  NumberOutOfRange first;
  const auto look = [&](const char* name, const auto& value, const NumberRange& range)
  {
    using Value = std::decay_t<decltype(value)>;
    if constexpr (isSettings<Value>)
    {
      first = first.name ? first : firstOutOfRange(value);
    }
    else if constexpr (std::is_arithmetic_v<Value>)
    {
      first =
        first.name || range.holds(double(value)) ? first : NumberOutOfRange{ name, double(value), range };
    }
  };
  std::apply([&](const auto&... member)
    { (look(member.name, settings.*(member.pointer), member.option.range), ...); },
    Settings::members());
  return first;
}

/// True if all members are equal. NaN is not equal to itself.
template <typename Settings>
bool equalSettings(const Settings& a, const Settings& b)
{
  const auto equal = [](const auto& left, const auto& right)
  {
    if constexpr (isSettings<std::remove_const_t<std::remove_reference_t<decltype(left)>>>)
    {
      return equalSettings(left, right);
    }
    else
    {
      return left == right;
    }
  };
  return std::apply([&](const auto&... member)
    { return (equal(a.*(member.pointer), b.*(member.pointer)) && ...); },
    Settings::members());
}

} // namespace pointhaptics
