#include "Commands/Commands.h"

#include "Feel/FeelReplay.h"
#include "Feel/FeltRows.h"
#include "Options/Files.h"
#include "Options/OptionParsing.h"
#include "Options/SharedOptions.h"
#include "Terminal/Messages.h"
#include "Terminal/StopSignals.h"

#include "CsvWriter.h"
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
#include <utility>
#include <vector>

namespace pointhaptics::app
{
namespace
{

constexpr int kChartWidth = 1400;
constexpr int kChartHeight = 560;

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

void drawChart(const std::vector<std::string>& methods, const std::string& fileName,
  const Recording& recording, const std::array<std::vector<Felt>, 2>& felt)
{
  vtkNew<vtkHapticChart> chart;
  chart->SetForceNames((methods[0] + " (N)").c_str(), (methods[1] + " (N)").c_str());
  for (std::size_t i = 0; i < recording.ticks.size(); ++i)
  {
    chart->AddSample(
      recording.ticks[i].felt[0], norm(felt[0][i].force), double(felt[0][i].radius), norm(felt[1][i].force));
  }
  const bool isWritten = chart->WriteImage(fileName.c_str(), kChartWidth, kChartHeight);
  static_cast<void>(takeVtkErrors());
  require(isWritten, chart->GetErrorMessage());
}

void writeTable(
  const std::string& fileName, const Recording& recording, const std::array<std::vector<Felt>, 2>& felt)
{
  CsvWriter table;
  std::string message;
  require(table.open(fileName,
            "t,hip_x,hip_y,hip_z,first_x,first_y,first_z,first_contact,second_x,second_y,second_z,"
            "second_contact",
            message),
    message);
  for (std::size_t i = 0; i < recording.ticks.size(); ++i)
  {
    const Vec3 hip = recording.ticks[i].hip();
    const Felt& a = felt[0][i];
    const Felt& b = felt[1][i];
    const double row[] = { recording.ticks[i].felt[0], hip.x, hip.y, hip.z, a.force.x, a.force.y, a.force.z,
      double(a.contact), b.force.x, b.force.y, b.force.z, double(b.contact) };
    table.row(row, std::size(row));
  }
  require(table.commit(message), message);
}

struct CompareCommand : Command
{
  std::string file;
  std::string cloud;
  std::vector<std::string> methods = { "surface-fit", "gradient-steps" };
  std::string chart;
  std::string table;
  bool json = false;

  void addTo(CLI::App& command) override
  {
    addInput(command, "REC", this->file, "What view --record, its key or feel --record wrote")->required();
    addInput(command, "FILE", this->cloud, "The cloud; default: the one that was recorded");
    std::vector<std::string> names;
    for (const auto& method : proxyMethods())
    {
      names.push_back(method.first);
    }
    addWords(
      command, "--methods", this->methods, names, false, "Two of them; default surface-fit,gradient-steps");
    addOutput(command, "-o,--output", this->chart, { "png" }, "Chart of both forces over time", "OUT.png");
    addOutput(command, "--csv", this->table, { "csv" }, "Both forces, one row a tick", "OUT.csv");
    command.add_flag("--json", this->json, "Print the figures as JSON");
  }

  void complete(CLI::App&, Files& files) override
  {
    requireUsage(this->methods.size() == 2 && this->methods[0] != this->methods[1], "--methods",
      fmt::format("{}", fmt::join(this->methods, ",")), "give two methods");
    declareRecordedClouds(this->file, this->cloud, files);
  }

  int run(Files& files) override
  {
    std::string message;
    rememberStopSignals();
    const bool canDraw = !this->chart.empty() && displayIsAvailable(message);
    require(canDraw || this->chart.empty() || !this->table.empty(), message);
    if (!canDraw && !this->chart.empty())
    {
      warn("the chart is left out: " + message, this->chart);
      files.dropOutput(this->chart);
    }
    const auto [recording, points] = openRecording(this->file, this->cloud, files);
    std::array<std::vector<Felt>, 2> felt;
    for (std::size_t side = 0; side < 2; ++side)
    {
      const std::string& name = this->methods[side];
      const auto named = std::find_if(
        proxyMethods().begin(), proxyMethods().end(), [&](const auto& one) { return one.first == name; });
      std::vector<Felt>& all = felt[side];
      feelAgain(this->file, recording, points, named->second, "feeling by " + name,
        [&all](const RecordedTick&, const ServoSample& sample) {
          all.push_back({ sample.state.force, float(sample.state.radius), sample.state.contact });
        });
    }
    if (canDraw)
    {
      drawChart(this->methods, files.output(this->chart), recording, felt);
    }
    if (!this->table.empty())
    {
      writeTable(files.output(this->table), recording, felt);
    }
    files.commit();
    const Comparison c = compared(recording, felt);
    printResult(this->json,
      { { "ticks", c.ticks }, { "methods", this->methods }, { "contact_ticks", c.contacts },
        { "max_force_n", c.largest }, { "one_alone_ticks", c.oneAlone },
        { "rms_difference_n", c.rmsDifference }, { "max_difference_n", c.largestDifference },
        { "max_difference_at_s", c.largestAt } },
      fmt::format("{} ticks; {}: {} in contact, max force {:.4g} N; {}: {} in contact, max force {:.4g} N; "
                  "difference rms {:.3g} N, max {:.3g} N at {:.3f} s; {} ticks one touches alone",
        c.ticks, this->methods[0], c.contacts[0], c.largest[0], this->methods[1], c.contacts[1], c.largest[1],
        c.rmsDifference, c.largestDifference, c.largestAt, c.oneAlone));
    return kSuccess;
  }
};

} // namespace

Command* compareCommand()
{
  return new CompareCommand;
}

} // namespace pointhaptics::app
