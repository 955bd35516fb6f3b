/// @file
/// Names of the fields of point clouds, in every format and for every filter.
#pragma once

#include <string_view>

namespace pointhaptics
{

/// The fields of LAS points; arrays of these names become them again.
constexpr std::string_view kPointFields[] = { "Intensity", "ReturnNumber", "NumberOfReturns",
  "Classification", "ClassificationFlags", "ScannerChannel", "ScanDirection", "EdgeOfFlightLine", "ScanAngle",
  "UserData", "PointSourceId", "GpsTime", "Color16", "RGB", "NearInfrared" };

/// Whether two names mean one field: in upper or lower case, with or without '_', ' ' and '-' between words.
/// "gps_time" is "GpsTime".
constexpr bool isSameField(std::string_view a, std::string_view b) noexcept
{
  const auto isFiller = [](char c) { return c == '_' || c == ' ' || c == '-'; };
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  std::size_t i = 0;
  std::size_t j = 0;
  for (;; ++i, ++j)
  {
    while (i < a.size() && isFiller(a[i]))
    {
      ++i;
    }
    while (j < b.size() && isFiller(b[j]))
    {
      ++j;
    }
    if (i == a.size() || j == b.size())
    {
      return i == a.size() && j == b.size();
    }
    if (lower(a[i]) != lower(b[j]))
    {
      return false;
    }
  }
}

/// Whether @p name is one of kPointFields.
constexpr bool isPointField(std::string_view name) noexcept
{
  for (const std::string_view field : kPointFields)
  {
    if (isSameField(field, name))
    {
      return true;
    }
  }
  return false;
}

} // namespace pointhaptics
