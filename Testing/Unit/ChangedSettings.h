/// @file
/// A settings struct with one member that is not what it was, for each of its members.
#pragma once

#include "Core/Base/PointView.h"
#include "Core/Base/SettingsMembers.h"

#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <type_traits>

namespace pointhaptics
{

inline void change(bool& value)
{
  value = !value;
}
inline void change(int& value)
{
  value += 1;
}
inline void change(double& value)
{
  value = value == 0.0 ? 0.001 : 0.5 * value;
}
inline void change(std::array<std::int64_t, 3>& value)
{
  value = { 70, 80, 90 };
}
inline void change(Bounds& value)
{
  value = { { -0.03, -0.02, -0.01 }, { 0.02, 0.03, 0.04 } };
}
inline void change(std::set<std::string>& value)
{
  value.insert("Kind");
}
template <typename Enum, typename = std::enable_if_t<std::is_enum_v<Enum>>>
void change(Enum& value)
{
  value = Enum(static_cast<int>(value) == 0 ? 1 : static_cast<int>(value) - 1);
}

/// Calls visit(name, changed) once for each member, of all levels, with @p settings but for that member.
template <typename Settings, typename Visitor>
void forEachChange(const Settings& settings, Visitor&& visit)
{
  std::size_t count = 0;
  visitSettings(settings, [&](const std::string&, const auto&) { ++count; });
  for (std::size_t chosen = 0; chosen < count; ++chosen)
  {
    Settings changed = settings;
    std::size_t i = 0;
    std::string name;
    visitSettings(changed,
      [&](const std::string& memberName, auto& member)
      {
        if (i++ == chosen)
        {
          name = memberName;
          change(member);
        }
      });
    visit(name, changed);
  }
}

} // namespace pointhaptics
