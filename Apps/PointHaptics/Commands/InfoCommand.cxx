#include "Commands/Commands.h"

#include "Clouds/Pipeline.h"
#include "Options/Files.h"
#include "Options/OptionParsing.h"
#include "Terminal/Messages.h"
#include "Terminal/StopSignals.h"

#include "Core/Base/QuantityText.h"
#include "IO/Info/CloudSummary.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <vtkPolyData.h>

#include <array>
#include <cmath>
#include <vector>

namespace pointhaptics::app
{
namespace
{

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

void printLine(const std::string& name, const std::string& text)
{
  if (!text.empty())
  {
    fmt::print("  {:<8} {}\n", name, text);
  }
}

std::string rangeText(const ArraySummary& array, std::size_t i)
{
  return fmt::format("mean {:.6g}, deviation {:.6g}", array.means[i], array.deviations[i]);
}

void printOrigin(const CloudSummary& s)
{
  printLine("written", s.generator.empty() ? "" : "by " + s.generator);
  printLine("chunks", s.chunks > 0 ? std::to_string(s.chunks) : "");
  for (std::size_t i = 0; i < s.scans.size(); ++i)
  {
    const ScanSummary& scan = s.scans[i];
    const std::array<double, 7>& p = scan.pose;
    fmt::print("  scan {:<3} {}: {}, scanner at {} {} {}, quaternion {} {} {} {}\n", i + 1, scan.name,
      countOfPoints(scan.points), p[0], p[1], p[2], p[3], p[4], p[5], p[6]);
  }
}

/// The end @p value of a box, so that --clip with this text keeps the point there: with the digits that a
/// double has for certain, where these end @p outward of it, as a multiple of 0.01 mostly does. The ends of
/// floats are floats.
std::string outwardText(double value, double outward, bool isFloat)
{
  const std::string text = isFloat ? fmt::format("{}", float(value)) : fmt::format("{:.15g}", value);
  double read = value;
  const bool isInward = !isFloat && parseNumber(text, read) && (read - value) * outward < 0.0;
  return isInward ? fmt::format("{}", value) : text;
}

void printPlace(const CloudSummary& s)
{
  const Vec3 low = s.bounds.minimum, high = s.bounds.maximum, size = s.bounds.extent();
  std::string bounds;
  for (int axis = 0; axis < 3; ++axis)
  {
    bounds += fmt::format("{}{} {} .. {}", axis == 0 ? "" : "  ", "xyz"[axis],
      outwardText(low[axis], -INFINITY, s.isFloat), outwardText(high[axis], INFINITY, s.isFloat));
  }
  printLine("bounds", bounds);
  printLine("size", fmt::format("{:.6g} x {:.6g} x {:.6g}", size.x, size.y, size.z));
  printLine("unit",
    fmt::format("{} ({})", s.unit,
      !s.unitIsGuess   ? "the file says so"
        : s.unitIsTold ? "a guess by size and arrays"
                       : "nothing tells the unit; --unit of view, feel and resample does"));
  if (!(s.spacing[2] > 0.0))
  {
    printLine("spacing", "none: all points are at one place");
    return;
  }
  printLine("spacing",
    fmt::format("{:.4g} (median distance to the nearest other point; 5 % {:.4g}, 25 % {:.4g}, 75 % {:.4g}, "
                "95 % {:.4g})",
      s.spacing[2], s.spacing[0], s.spacing[1], s.spacing[3], s.spacing[4]));
  printLine("density",
    fmt::format("spacing varies {:.3g} : 1 (medians from place to place; 95 % over 5 % of the surface)",
      s.densityVariation));
  printLine("voxel", fmt::format("{:.3g} holds a few points of a surface (--voxel)", s.suggestedVoxel));
}

void printArrays(const CloudSummary& s)
{
  for (std::size_t axis = 0; axis < s.coordinates.means.size(); ++axis)
  {
    printLine(std::string(1, "xyz"[axis]), rangeText(s.coordinates, axis));
  }
  for (const ArraySummary& array : s.arrays)
  {
    std::string ranges;
    for (std::size_t i = 0; i < array.minima.size(); ++i)
    {
      ranges += fmt::format(" [{:.6g}, {:.6g}]", array.minima[i], array.maxima[i]);
      ranges += array.means.empty() ? std::string() : " " + rangeText(array, i);
    }
    printLine("array", fmt::format("{}: {} x {}{}", array.name, array.type, array.components, ranges));
  }
}

void print(const std::string& file, const CloudSummary& s)
{
  fmt::print("{}\n", file);
  printLine("format", s.format);
  printLine("points",
    fmt::format("{}{}{}", s.points, ofThemInvalid(s.invalid),
      s.duplicates > 0 ? fmt::format(", {} at the place of another", s.duplicates) : ""));
  printOrigin(s);
  if (!s.bounds.empty())
  {
    printPlace(s);
  }
  printLine("system", s.coordinateSystem);
  printArrays(s);
  for (const std::string& note : s.notes)
  {
    printLine("note", note);
  }
  printLine("note", s.farPoints);
  printLine("note",
    s.noReturns > 0 ? noReturnsText(s.noReturns) + " are felt, but view draws them with --felt alone" : "");
  printLine("note",
    s.points > 0 && s.bounds.empty()
      ? "no point is finite: view, feel, resample and bandwidth refuse it; mend the file"
      : "");
  printLine("hint", s.hint);
}

struct InfoCommand : Command
{
  std::vector<std::string> files;
  ReadOptions reading;
  bool statistics = false;
  bool json = false;

  void addTo(CLI::App& command) override
  {
    addInput(command, "FILE", this->files, "Point clouds to look at; - is standard input")->required();
    addResolution(command, this->reading.resolution);
    addReading(command, this->reading.columns, this->reading.salvage);
    addSamples(command, this->reading.samples);
    command.add_flag("--statistics", this->statistics,
      "Also the mean and the standard deviation of each array, and of the coordinates: x, y, z");
    command.add_flag("--json", this->json, "Print all of it as JSON");
  }

  int run(Files&) override
  {
    rememberStopSignals();
    int exitCode = kSuccess;
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    this->reading.mayBeEmpty = true;
    for (const std::string& file : this->files)
    {
      try
      {
        const Cloud cloud = readCloud(file, this->reading);
        showWarnings();
        CloudSummary summary = summarize(cloud.points, cloud.format, this->statistics);
        summary.notes = cloud.notes;
        this->json ? all.push_back(toJson(file, summary)) : print(file, summary);
      }
      catch (const Failure& failure)
      {
        exitCode = fail(failure.what());
        all.push_back(toJson(file, failure.what()));
      }
    }
    if (this->json)
    {
      printJson({ { "files", all } });
    }
    return exitCode;
  }
};

} // namespace

Command* infoCommand()
{
  return new InfoCommand;
}

} // namespace pointhaptics::app
