#include "Commands/Commands.h"

#include "Clouds/Pipeline.h"
#include "Options/OptionParsing.h"
#include "Terminal/Messages.h"
#include "Terminal/StopSignals.h"

#include "Core/Base/QuantityText.h"
#include "IO/Info/CloudSummary.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <vtkPolyData.h>

#include <memory>

namespace pointhaptics::app
{
namespace
{

constexpr const char* kInfoCommand = "info";

struct InfoOptions
{
  std::vector<std::string> files;
  ReadOptions reading;
  bool statistics = false;
  bool json = false;
};

std::vector<double> numbers(const Vec3& v)
{
  return { v.x, v.y, v.z };
}

nlohmann::ordered_json textOrNull(const std::string& text)
{
  return text.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(text);
}

/// JSON of a file with all keys; null where there is no value.
nlohmann::ordered_json toJson(const std::string& file, const CloudSummary& s)
{
  using Json = nlohmann::ordered_json;
  const auto ranges = [](const ArraySummary& array)
  {
    const auto listOrNull = [](const std::vector<double>& values)
    { return values.empty() ? Json() : Json(values); };
    return Json{ { "min", array.minima }, { "max", array.maxima }, { "mean", listOrNull(array.means) },
      { "deviation", listOrNull(array.deviations) } };
  };
  Json arrays = Json::array();
  for (const ArraySummary& array : s.arrays)
  {
    arrays.push_back({ { "name", array.name }, { "type", array.type }, { "components", array.components } });
    arrays.back().update(ranges(array));
  }
  Json scans = Json::array();
  for (const ScanSummary& scan : s.scans)
  {
    scans.push_back({ { "name", scan.name }, { "points", scan.points },
      { "translation", std::vector<double>(scan.pose.begin(), scan.pose.begin() + 3) },
      { "quaternion_wxyz", std::vector<double>(scan.pose.begin() + 3, scan.pose.end()) } });
  }
  const bool hasPlace = !s.bounds.empty();
  Json percentiles = Json::object();
  for (std::size_t i = 0; i < s.spacing.size() && hasPlace; ++i)
  {
    percentiles[std::to_string(kSpacingPercents[i])] = s.spacing[i];
  }
  const auto ifPlaced = [hasPlace](const Json& value) { return hasPlace ? value : Json(); };
  return { { "file", file }, { "error", nullptr }, { "format", s.format }, { "points", s.points },
    { "points_invalid", s.invalid }, { "points_duplicate", s.duplicates },
    { "generator", textOrNull(s.generator) }, { "chunks", s.chunks > 0 ? Json(s.chunks) : Json() },
    { "scans", scans }, { "notes", s.notes }, { "far_points", textOrNull(s.farPoints) },
    { "bounds", ifPlaced({ { "min", numbers(s.bounds.minimum) }, { "max", numbers(s.bounds.maximum) } }) },
    { "spacing", ifPlaced(s.spacing[2]) }, { "spacing_percentiles", ifPlaced(percentiles) },
    { "density_variation", ifPlaced(s.densityVariation) }, { "suggested_voxel", ifPlaced(s.suggestedVoxel) },
    { "unit", ifPlaced(s.unit) }, { "unit_is_guess", ifPlaced(s.unitIsGuess) },
    { "coordinate_system", textOrNull(s.coordinateSystem) }, { "arrays", arrays },
    { "coordinates", s.coordinates.means.empty() ? Json() : ranges(s.coordinates) },
    { "hint", textOrNull(s.hint) }, { "suggested_scale", s.hint.empty() ? Json() : Json(s.suggestedScale) } };
}

/// JSON of a file that cannot be read: all keys but two are null.
nlohmann::ordered_json toJson(const std::string& file, const std::string& error)
{
  nlohmann::ordered_json result = toJson(file, CloudSummary());
  for (auto& item : result.items())
  {
    item.value() = nullptr;
  }
  result["file"] = file;
  result["error"] = error;
  return result;
}

void printOrigin(const CloudSummary& s)
{
  if (!s.generator.empty())
  {
    fmt::print("  written  by {}\n", s.generator);
  }
  if (s.chunks > 0)
  {
    fmt::print("  chunks   {}\n", s.chunks);
  }
  for (std::size_t i = 0; i < s.scans.size(); ++i)
  {
    const ScanSummary& scan = s.scans[i];
    const std::array<double, 7>& p = scan.pose;
    fmt::print("  scan {:<3} {}: {}, scanner at {} {} {}, quaternion {} {} {} {}\n", i + 1, scan.name,
      countOfPoints(scan.points), p[0], p[1], p[2], p[3], p[4], p[5], p[6]);
  }
}

/// Text of a coordinate with the digits that a float, or a double, has for certain: a multiple of 0.01 ends
/// there, too.
std::string coordinate(const CloudSummary& s, double value)
{
  return s.isFloat ? fmt::format("{}", float(value)) : fmt::format("{:.15g}", value);
}

void printSpacing(const CloudSummary& s)
{
  if (!(s.spacing[2] > 0.0))
  {
    fmt::print("  spacing  none: all points are at one place\n");
    return;
  }
  fmt::print(
    "  spacing  {:.4g} (median distance to the nearest other point; 5 % {:.4g}, 25 % {:.4g}, 75 % {:.4g}, "
    "95 % {:.4g})\n",
    s.spacing[2], s.spacing[0], s.spacing[1], s.spacing[3], s.spacing[4]);
  fmt::print(
    "  density  spacing varies {:.3g} : 1 (medians from place to place; 95 % over 5 % of the surface)\n",
    s.densityVariation);
  fmt::print("  voxel    {:.3g} holds a few points of a surface (--voxel)\n", s.suggestedVoxel);
}

void printArrays(const CloudSummary& s)
{
  for (std::size_t axis = 0; axis < s.coordinates.means.size(); ++axis)
  {
    fmt::print("  {}        mean {:.6g}, deviation {:.6g}\n", "xyz"[axis], s.coordinates.means[axis],
      s.coordinates.deviations[axis]);
  }
  for (const ArraySummary& array : s.arrays)
  {
    std::string ranges;
    for (std::size_t i = 0; i < array.minima.size(); ++i)
    {
      ranges += fmt::format(" [{:.6g}, {:.6g}]", array.minima[i], array.maxima[i]);
      ranges += array.means.empty()
        ? std::string()
        : fmt::format(" mean {:.6g}, deviation {:.6g}", array.means[i], array.deviations[i]);
    }
    fmt::print("  array    {}: {} x {}{}\n", array.name, array.type, array.components, ranges);
  }
}

void print(const std::string& file, const CloudSummary& s)
{
  fmt::print("{}\n  format   {}\n  points   {}{}{}\n", file, s.format, s.points, ofThemInvalid(s.invalid),
    s.duplicates > 0 ? fmt::format(", {} at the place of another", s.duplicates) : "");
  printOrigin(s);
  if (!s.bounds.empty())
  {
    const Vec3 low = s.bounds.minimum, high = s.bounds.maximum, size = s.bounds.extent();
    fmt::print("  bounds  ");
    for (int axis = 0; axis < 3; ++axis)
    {
      fmt::print(" {}{} {} .. {}", axis > 0 ? " " : "", "xyz"[axis], coordinate(s, low[axis]),
        coordinate(s, high[axis]));
    }
    fmt::print("\n");
    fmt::print("  size     {:.6g} x {:.6g} x {:.6g}\n", size.x, size.y, size.z);
    fmt::print("  unit     {} ({})\n", s.unit,
      !s.unitIsGuess   ? "the file says so"
        : s.unitIsTold ? "a guess by size and arrays"
                       : "nothing tells the unit; --unit of view, feel and resample does");
    printSpacing(s);
  }
  if (!s.coordinateSystem.empty())
  {
    fmt::print("  system   {}\n", s.coordinateSystem);
  }
  printArrays(s);
  for (const std::string& note : s.notes)
  {
    fmt::print("  note     {}\n", note);
  }
  if (!s.farPoints.empty())
  {
    fmt::print("  note     {}\n", s.farPoints);
  }
  if (s.noReturns > 0)
  {
    fmt::print("  note     {} are felt, but view draws them with --felt alone\n", noReturnsText(s.noReturns));
  }
  if (s.points > 0 && s.bounds.empty())
  {
    fmt::print(
      "  note     no point is finite: view, feel, resample and bandwidth refuse it; mend the file\n");
  }
  if (!s.hint.empty())
  {
    fmt::print("  hint     {}\n", s.hint);
  }
}

/// Removes the name, with which the reader's message begins.
std::string withoutFileName(const std::string& message, const std::string& file)
{
  return message.compare(0, file.size() + 2, file + ": ") == 0 ? message.substr(file.size() + 2) : message;
}

int runInfo(const InfoOptions& options)
{
  rememberStopSignals();
  int exitCode = kSuccess;
  nlohmann::ordered_json files = nlohmann::ordered_json::array();
  for (const std::string& file : options.files)
  {
    Cloud cloud;
    std::string message;
    const bool hasPoints = readCloud(file, cloud, message, options.reading);
    if (cloud.isValidWithoutPoints)
    {
      cloud.notes.push_back(withoutFileName(message, file));
    }
    else if (!hasPoints)
    {
      exitCode = fail(kInfoCommand, message);
      files.push_back(toJson(file, message));
      continue;
    }
    showWarnings(kInfoCommand);
    CloudSummary summary = summarize(cloud.points, cloud.format, options.statistics);
    summary.notes = cloud.notes;
    if (options.json)
    {
      files.push_back(toJson(file, summary));
    }
    else
    {
      print(file, summary);
    }
  }
  if (options.json)
  {
    const nlohmann::ordered_json result = { { "files", files } };
    printJson(result);
  }
  return exitCode;
}

} // namespace

void addInfoCommand(CLI::App& program, int& exitCode)
{
  CLI::App* command = program.add_subcommand("info", "Say what is in point cloud files");
  auto options = std::make_shared<InfoOptions>();
  addInput(*command, "FILE", options->files, "Point clouds to look at; - is standard input")->required();
  addResolution(*command, options->reading.resolution);
  addReading(*command, options->reading.columns, options->reading.salvage);
  addSamples(*command, options->reading.samples);
  command->add_flag("--statistics", options->statistics,
    "Also the mean and the standard deviation of each array, and of the coordinates: x, y, z");
  command->add_flag("--json", options->json, "Print all of it as JSON");
  runAs(*command, exitCode, { [options](Files&) { return runInfo(*options); } });
}

} // namespace pointhaptics::app
