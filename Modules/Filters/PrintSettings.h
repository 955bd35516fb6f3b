/// @file
/// Settings in the PrintSelf() of a filter. Private to Filters.
#pragma once

#include "Core/Base/PointView.h"
#include "Core/Base/SettingsMembers.h"

#include "vtkIndent.h"

#include <array>
#include <cctype>
#include <set>
#include <string>

namespace pointhaptics
{

template <typename Stream, typename Value>
void printSetting(Stream& os, const Value& value)
{
  if constexpr (std::is_enum_v<Value>)
  {
    os << " " << static_cast<int>(value);
  }
  else
  {
    os << " " << value;
  }
}

template <typename Stream, typename Value, std::size_t Count>
void printSetting(Stream& os, const std::array<Value, Count>& values)
{
  for (const Value& value : values)
  {
    os << " " << value;
  }
}

template <typename Stream>
void printSetting(Stream& os, const std::set<std::string>& names)
{
  for (const std::string& name : names)
  {
    os << " " << name;
  }
}

/// As VTK writes bounds.
template <typename Stream>
void printSetting(Stream& os, const Bounds& box)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    os << " " << box.minimum[axis] << " " << box.maximum[axis];
  }
}

/// A line for each member, through all levels: "RadiusScale: 4".
template <typename Stream, typename Settings>
void printSettings(Stream& os, vtkIndent indent, const Settings& settings)
{
  visitMembers(settings,
    [&](std::string name, const auto& member)
    {
      if constexpr (isSettings<std::decay_t<decltype(member)>>)
      {
        printSettings(os, indent, member);
      }
      else
      {
        name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
        os << indent << name << ":";
        printSetting(os, member);
        os << "\n";
      }
    });
}

} // namespace pointhaptics
