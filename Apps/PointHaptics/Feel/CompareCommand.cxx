#include "Commands/Commands.h"

#include "Feel/FeelReplay.h"
#include "Feel/ForceFigure.h"
#include "Options/OptionParsing.h"
#include "Terminal/Messages.h"
#include "Terminal/ProgressBar.h"
#include "Terminal/StopSignals.h"

#include "CsvWriter.h"
#include "Replay.h"
#include "ViewDisplay.h"
#include "vtkHapticChart.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace pointhaptics::app
{
namespace
{

constexpr const char* kCompareCommand = "compare";
constexpr int kChartWidth = 1400;
constexpr int kChartHeight = 560;

const std::vector<std::pair<std::string, ProxyMethod>>& methods()
{
  static const std::vector<std::pair<std::string, ProxyMethod>> table = { { "surface-fit",
                                                                            ProxyMethod::SurfaceFit },
    { "sphere", ProxyMethod::Sphere }, { "gradient-steps", ProxyMethod::GradientSteps } };
  return table;
}

ProxyMethod methodOf(const std::string& name)
{
  for (const auto& [known, method] : methods())
  {
    if (known == name)
    {
      return method;
    }
  }
  return ProxyMethod::SurfaceFit;
}

struct CompareOptions
{
  std::string recording;
  std::string cloud;
  std::vector<std::string> methods = { "surface-fit", "gradient-steps" };
  std::string chart;
  std::string table;
  bool json = false;
};

/// A tick of one method.
struct Felt
{
  Vec3 force;
  float radius = 0.0F;
  bool contact = false;
};

/// Figures of the two curves and of their difference.
struct Comparison
{
  std::int64_t ticks = 0;
  std::array<std::int64_t, 2> contacts{};
  std::array<double, 2> largest{};
  std::int64_t oneAlone = 0;  ///< Ticks in which one of them has contact.
  double rmsDifference = 0.0; ///< RMS difference of the forces as vectors, in ticks in which either has
                              ///< contact; newtons.
  double largestDifference = 0.0;
  double largestAt = 0.0; ///< Seconds.
};

Comparison compared(const Recording& recording, const std::array<std::vector<Felt>, 2>& felt)
{
  Comparison result;
  double sum = 0.0;
  std::int64_t touched = 0;
  for (std::size_t i = 0; i < recording.ticks.size(); ++i)
  {
    const Felt& a = felt[0][i];
    const Felt& b = felt[1][i];
    ++result.ticks;
    for (std::size_t side = 0; side < 2; ++side)
    {
      result.contacts[side] += felt[side][i].contact;
      result.largest[side] = std::max(result.largest[side], forceFigure(norm(felt[side][i].force)));
    }
    result.oneAlone += a.contact != b.contact;
    touched += a.contact || b.contact;
    const double difference = forceFigure(norm(a.force - b.force));
    sum += difference * difference;
    if (difference > result.largestDifference)
    {
      result.largestDifference = difference;
      result.largestAt = recording.ticks[i].felt[0];
    }
  }
  result.rmsDifference = touched > 0 ? std::sqrt(sum / double(touched)) : 0.0;
  return result;
}

bool replayBy(const std::string& method, const Recording& recording, vtkPolyData* cloud,
  std::vector<Felt>& felt, std::string& message)
{
  Replay replay(recording, cloud, methodOf(method));
  ProgressBar bar("feeling by " + method);
  felt.reserve(recording.ticks.size());
  while (!replay.isAtEnd())
  {
    ServoSample sample;
    if (!replay.step(sample, message))
    {
      return false;
    }
    felt.push_back({ sample.state.force, float(sample.state.radius), sample.state.contact });
    bar.show(double(felt.size()) / double(recording.ticks.size()));
    if (stopIsRequested())
    {
      message = "feeling was stopped on request; start it again";
      return false;
    }
  }
  return true;
}

bool drawChart(const CompareOptions& options, const std::string& fileName, const Recording& recording,
  const std::array<std::vector<Felt>, 2>& felt, std::string& message)
{
  vtkNew<vtkHapticChart> chart;
  chart->SetForceNames((options.methods[0] + " (N)").c_str(), (options.methods[1] + " (N)").c_str());
  for (std::size_t i = 0; i < recording.ticks.size(); ++i)
  {
    chart->AddSample(
      recording.ticks[i].felt[0], norm(felt[0][i].force), double(felt[0][i].radius), norm(felt[1][i].force));
  }
  if (!chart->WriteImage(fileName.c_str(), kChartWidth, kChartHeight))
  {
    message = chart->GetErrorMessage();
  }
  static_cast<void>(takeVtkErrors());
  return message.empty();
}

bool writeTable(const std::string& fileName, const Recording& recording,
  const std::array<std::vector<Felt>, 2>& felt, std::string& message)
{
  CsvWriter table;
  if (!table.open(fileName,
        "t,hip_x,hip_y,hip_z,first_x,first_y,first_z,first_contact,second_x,second_y,second_z,second_contact",
        message))
  {
    return false;
  }
  for (std::size_t i = 0; i < recording.ticks.size(); ++i)
  {
    const Vec3 hip = recording.ticks[i].hip();
    const Felt& a = felt[0][i];
    const Felt& b = felt[1][i];
    const double row[] = { recording.ticks[i].felt[0], hip.x, hip.y, hip.z, a.force.x, a.force.y, a.force.z,
      double(a.contact), b.force.x, b.force.y, b.force.z, double(b.contact) };
    table.row(row, std::size(row));
  }
  return table.commit(message);
}

void print(const CompareOptions& options, const Comparison& c)
{
  if (options.json)
  {
    printJson({ { "ticks", c.ticks }, { "methods", options.methods }, { "contact_ticks", c.contacts },
      { "max_force_n", c.largest }, { "one_alone_ticks", c.oneAlone },
      { "rms_difference_n", c.rmsDifference }, { "max_difference_n", c.largestDifference },
      { "max_difference_at_s", c.largestAt } });
    return;
  }
  printSummary(
    fmt::format("{} ticks; {}: {} in contact, max force {:.4g} N; {}: {} in contact, max force {:.4g} N; "
                "difference rms {:.3g} N, max {:.3g} N at {:.3f} s; {} ticks one touches alone",
      c.ticks, options.methods[0], c.contacts[0], c.largest[0], options.methods[1], c.contacts[1],
      c.largest[1], c.rmsDifference, c.largestDifference, c.largestAt, c.oneAlone));
}

int runCompare(const CompareOptions& options, Files& files)
{
  std::string message;
  Recording recording;
  vtkSmartPointer<vtkPolyData> cloud;
  rememberStopSignals();
  const bool canDraw = options.chart.empty() || displayIsAvailable(message);
  if (!canDraw && !options.table.empty())
  {
    warn(kCompareCommand, "the chart is left out: " + message, options.chart);
    files.dropOutput(options.chart);
  }
  require((canDraw || !options.table.empty()) &&
      openRecording(options.recording, options.cloud, files, recording, cloud, message),
    message);
  std::array<std::vector<Felt>, 2> felt;
  for (std::size_t side = 0; side < 2; ++side)
  {
    if (!replayBy(options.methods[side], recording, cloud, felt[side], message))
    {
      return fail(kCompareCommand, options.recording + ": " + message);
    }
  }
  message.clear();
  require((options.chart.empty() || !canDraw ||
            drawChart(options, files.output(options.chart), recording, felt, message)) &&
      (options.table.empty() || writeTable(files.output(options.table), recording, felt, message)) &&
      files.commit(message),
    message);
  print(options, compared(recording, felt));
  return kSuccess;
}

void addOptions(CLI::App& command, CompareOptions& options)
{
  addInput(command, "REC", options.recording, "What view --record, its key or feel --record wrote")
    ->required();
  addInput(command, "FILE", options.cloud, "The cloud; default: the one that was recorded");
  std::vector<std::string> names;
  for (const auto& method : methods())
  {
    names.push_back(method.first);
  }
  addWords(command, "--methods", options.methods, names, false,
    "The two methods; default surface-fit,gradient-steps");
  addOutput(command, "-o,--output", options.chart, { "png" }, "Chart of both forces over time")
    ->type_name("OUT.png");
  addOutput(command, "--csv", options.table, { "csv" }, "Both forces, one row a tick")->type_name("OUT.csv");
  command.add_flag("--json", options.json, "Print the figures as JSON");
}

} // namespace

void addCompareCommand(CLI::App& program, int& exitCode)
{
  CLI::App* command =
    program.add_subcommand("compare", "Feel a recording by two methods, and draw both forces side by side");
  auto options = std::make_shared<CompareOptions>();
  addOptions(*command, *options);
  const auto complete = [options]
  {
    if (options->methods.size() != 2 || options->methods[0] == options->methods[1])
    {
      throwUsage("--methods", fmt::format("{}", fmt::join(options->methods, ",")), "give two methods");
    }
  };
  runAs(*command, exitCode,
    { [options](Files& files) { return runCompare(*options, files); }, complete,
      [options](Files& files) { declareRecordedClouds(options->recording, options->cloud, files); } });
}

} // namespace pointhaptics::app
