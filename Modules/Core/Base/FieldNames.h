/// @file
/// Names of the fields of point clouds, in every format and for every filter.
#pragma once

#include <cstddef>
#include <string_view>

namespace pointhaptics
{

/// The fields of LAS points; arrays of these names become them again.
constexpr std::string_view kPointFields[] = { "Intensity", "ReturnNumber", "NumberOfReturns",
  "Classification", "ClassificationFlags", "ScannerChannel", "ScanDirection", "EdgeOfFlightLine", "ScanAngle",
  "UserData", "PointSourceId", "GpsTime", "Color16", "RGB", "NearInfrared" };

/// Whether two names mean one field: in upper or lower case, with or without '_', ' ', '-' and '.' between
/// words. "gps_time" is "GpsTime".
constexpr bool isSameField(std::string_view a, std::string_view b) noexcept
{
  const auto isFiller = [](char c) { return c == '_' || c == ' ' || c == '-' || c == '.'; };
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

/// Fields of labels, whose numbers have no mean.
constexpr const char* kLabelFields[] = { "Class", "Classification", "Instance", "Label", "Segment" };

/// Whether @p name is the field of labels @p label: the same name, or for one of kLabelFields one that ends
/// with it, but for a plural and an id. "scalar_Label", "semantic-class", "labels" and "instanceId" are;
/// "label_quality" is not.
constexpr bool isLabelField(std::string_view name, std::string_view label) noexcept
{
  const auto without = [&name](std::string_view end)
  {
    std::size_t stem = name.size() - (end.size() < name.size() ? end.size() : name.size());
    stem = isSameField(name.substr(stem), end) ? stem : name.size();
    while (stem > 0 && isSameField(name.substr(stem - 1, 1), ""))
    {
      --stem;
    }
    return name.substr(0, stem);
  };
  if (isSameField(name, label))
  {
    return true;
  }
  bool isKnown = false;
  for (const std::string_view field : kLabelFields)
  {
    isKnown = isKnown || field == label;
  }
  name = without("ids");
  name = without("id");
  for (const std::string_view plural : { "es", "s", "" })
  {
    const std::string_view stem = without(plural);
    const std::size_t begin = stem.size() > label.size() ? stem.size() - label.size() : 0;
    if (isKnown && isSameField(stem.substr(begin), label))
    {
      return true;
    }
  }
  return false;
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
