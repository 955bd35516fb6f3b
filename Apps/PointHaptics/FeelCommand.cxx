#include "Commands.h"

#include "CsvWriter.h"
#include "FeelLive.h"
#include "FeelOptions.h"
#include "Messages.h"
#include "PathTicks.h"
#include "Pipeline.h"
#include "ProgressBar.h"
#include "StopSignals.h"

#include "Devices/HipPath.h"
#include "Devices/SimulatedDevice.h"
#include "HapticSceneBuilder.h"
#include "Haptics/Proxy.h"
#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <vtkAlgorithm.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

namespace pointhaptics
{
namespace app
{
namespace
{

constexpr const char* kCommand = "feel";
constexpr const char* kHeader = "t,hip_x,hip_y,hip_z,proxy_x,proxy_y,proxy_z,normal_x,normal_y,normal_z,"
                                "force_x,force_y,force_z,radius,contact,update_us";
/// A day at 1 kHz; more is a mistake in the path's times.
constexpr double kMostTicks = 1e8;
/// Room about the path for a hand that yields, metres.
constexpr double kHandMargin = 0.1;

struct Summary
{
  std::int64_t ticks = 0;
  std::int64_t contactTicks = 0;
  double maximumForce = 0.0;
  double p50Microseconds = 0.0;
  double p99Microseconds = 0.0;
  double maximumMicroseconds = 0.0;
};

/// The points of @p cloud in the workspace frame that are inside --workspace where one is given.
vtkSmartPointer<vtkPolyData> rawPoints(const FeelOptions& options, vtkPolyData* cloud)
{
  std::int64_t invalid = 0;
  vtkSmartPointer<vtkPolyData> moved = transformedPoints(cloud, options.lattice.transform(), invalid);
  const std::vector<double>& box = options.lattice.workspace;
  if (box.empty())
  {
    return moved;
  }
  vtkNew<vtkPoints> inside;
  inside->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < moved->GetNumberOfPoints(); ++i)
  {
    double p[3];
    moved->GetPoint(i, p);
    if (p[0] >= box[0] && p[0] < box[1] && p[1] >= box[2] && p[1] < box[3] && p[2] >= box[4] && p[2] < box[5])
    {
      inside->InsertNextPoint(p);
    }
  }
  moved->SetPoints(inside);
  return moved;
}

/// The cloud as the proxy will feel it: resampled or raw.
vtkSmartPointer<vtkPolyData> preparedCloud(
  const FeelOptions& options, vtkPolyData* cloud, std::string& message)
{
  vtkSmartPointer<vtkPolyData> prepared;
  if (options.raw)
  {
    prepared = rawPoints(options, cloud);
  }
  else
  {
    vtkNew<vtkVoxelMeanResampler> resampler;
    resampler->SetInputData(cloud);
    resampler->SetPassAttributes(false);
    resampler->SetComputeCovariance(!options.noCovariance);
    resampler->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    options.lattice.configure(resampler);
    if (!updateFilter(resampler, "resampling", message))
    {
      return nullptr;
    }
    prepared = resampler->GetOutput();
  }
  if (prepared->GetNumberOfPoints() == 0)
  {
    message =
      options.file + ": no finite point lies in the workspace; leave out --workspace, or mend the transform";
    return nullptr;
  }
  return prepared;
}

double quantile(const std::vector<float>& sorted, double part)
{
  return sorted.empty() ? 0.0 : double(sorted[static_cast<std::size_t>(part * double(sorted.size() - 1))]);
}

/// One tick: the row of OUT.csv, in its order.
std::array<double, 16> rowOf(double time, const ProxyState& state, double microseconds)
{
  return { time, state.hip.x, state.hip.y, state.hip.z, state.proxy.x, state.proxy.y, state.proxy.z,
    state.normal.x, state.normal.y, state.normal.z, state.force.x, state.force.y, state.force.z, state.radius,
    state.contact ? 1.0 : 0.0, microseconds };
}

/// Rows and their summary.
class Rows
{
public:
  explicit Rows(CsvWriter& table)
    : table_(table)
  {
  }
  void add(double time, const ProxyState& state, double microseconds)
  {
    ++summary_.ticks;
    summary_.contactTicks += state.contact;
    summary_.maximumForce = std::max(summary_.maximumForce, norm(state.force));
    durations_.push_back(static_cast<float>(microseconds));
    const std::array<double, 16> row = rowOf(time, state, microseconds);
    table_.row(row.data(), row.size());
  }
  Summary summary()
  {
    std::sort(durations_.begin(), durations_.end());
    summary_.p50Microseconds = quantile(durations_, 0.50);
    summary_.p99Microseconds = quantile(durations_, 0.99);
    summary_.maximumMicroseconds = quantile(durations_, 1.0);
    return summary_;
  }

private:
  CsvWriter& table_;
  Summary summary_;
  std::vector<float> durations_;
};

/// A person pulled along @p path, who yields to the force; in virtual time.
bool walkYielding(const FeelOptions& options, const HapticScene& scene, const HipPath& path,
  std::int64_t ticks, Rows& rows, std::string& message)
{
  SimulatedHandSettings settings;
  for (const HipPathPoint& point : path.points)
  {
    settings.workspace.include(point.position);
  }
  // Forces may push the hand off its path.
  const Vec3 margin(kHandMargin, kHandMargin, kHandMargin);
  settings.workspace.minimum -= margin;
  settings.workspace.maximum += margin;
  SimulatedDevice hand(settings);
  hand.setPath(path);
  const ContactParameters& contact = options.parameters.contact;
  const HandLimits limits = hand.limits();
  if (checkPassive(limits, contact.stiffness, contact.damping, options.rateHz) != Status::Ok)
  {
    message =
      fmt::format("stiffness {} N/m with damping {} N s/m would make the hand shake at {} Hz; use at most "
                  "{:.0f} N/m beside this damping",
        contact.stiffness, contact.damping, options.rateHz,
        largestPassiveStiffness(limits, contact.damping, options.rateHz));
    return false;
  }
  if (const Status status = hand.open(); status != Status::Ok)
  {
    message = options.path + ": " + sentence(status);
    return false;
  }
  Proxy proxy(options.parameters);
  proxy.setScene(&scene);
  ProgressBar bar("feeling");
  for (std::int64_t tick = 0; tick < ticks && !stopIsRequested(); ++tick)
  {
    const double time = double(tick) / options.rateHz;
    HandState state;
    if (hand.read(std::min(time, path.duration()), state) != Status::Ok)
    {
      break;
    }
    const auto before = std::chrono::steady_clock::now();
    const ProxyState felt = proxy.step(state.position, 1.0 / options.rateHz);
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - before;
    static_cast<void>(hand.write(time, felt.force));
    rows.add(path.points.front().timeSeconds + time, felt, took.count());
    bar.show(double(tick) / double(ticks));
  }
  return true;
}

/// Moves the hand along @p path in virtual time.
void walk(
  const FeelOptions& options, const HapticScene& scene, const HipPath& path, std::int64_t ticks, Rows& rows)
{
  Proxy proxy(options.parameters);
  proxy.setScene(&scene);
  const double start = path.points.front().timeSeconds;
  const double end = path.points.back().timeSeconds;
  std::size_t hint = 0;
  ProgressBar bar("feeling");
  for (std::int64_t tick = 0; tick < ticks && !stopIsRequested(); ++tick)
  {
    const double time = std::min(start + double(tick) / options.rateHz, end);
    const Vec3 hip = path.position(time, hint);
    const auto before = std::chrono::steady_clock::now();
    const ProxyState state = proxy.step(hip, 1.0 / options.rateHz);
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - before;
    rows.add(time, state, took.count());
    bar.show(double(tick) / double(ticks));
  }
}

/// The hand in the device, until the time is over or the user ends it.
bool touch(
  const FeelOptions& options, std::shared_ptr<const HapticScene> scene, Rows& rows, std::string& message)
{
  LiveSettings live;
  live.falcon = options.falcon;
  live.parameters = options.parameters;
  live.rateHz = options.rateHz;
  live.seconds = options.seconds;
  ServoStatistics statistics;
  const auto row = [&rows](const ServoSample& sample)
  { rows.add(sample.timeSeconds, sample.state, 1e6 * sample.updateSeconds); };
  if (!feelLive(live, std::move(scene), row, statistics, message))
  {
    return false;
  }
  printNow(stderr,
    fmt::format("{:.0f} Hz, {} ticks missed, {} device faults, lateness p99 {:.0f} us\n", statistics.rateHz,
      statistics.missedTicks, statistics.deviceFaults, 1e6 * statistics.lateness.p99));
  return true;
}

bool feelAs(const FeelOptions& options, const std::shared_ptr<const HapticScene>& scene, const HipPath& path,
  std::int64_t ticks, Rows& rows, std::string& message)
{
  if (options.device == "falcon")
  {
    return touch(options, scene, rows, message);
  }
  if (options.device == "simulated" && !walkYielding(options, *scene, path, ticks, rows, message))
  {
    return false;
  }
  if (options.device != "simulated")
  {
    walk(options, *scene, path, ticks, rows);
  }
  if (stopIsRequested())
  {
    message = options.output + ": feeling was stopped on request; start it again";
  }
  return !stopIsRequested();
}

void print(const FeelOptions& options, const HapticScene& scene, const Summary& s)
{
  if (options.json)
  {
    const nlohmann::ordered_json result = { { "output", options.output },
      { "points_felt", scene.numberOfPoints() }, { "ticks", s.ticks }, { "contact_ticks", s.contactTicks },
      { "max_force_n", s.maximumForce },
      { "update_us",
        { { "p50", s.p50Microseconds }, { "p99", s.p99Microseconds }, { "max", s.maximumMicroseconds } } } };
    printJson(result);
    return;
  }
  fmt::print("{} ticks, {} in contact, max force {:.4g} N, update p50 {:.2f} p99 {:.2f} max {:.2f} us: {}\n",
    s.ticks, s.contactTicks, s.maximumForce, s.p50Microseconds, s.p99Microseconds, s.maximumMicroseconds,
    options.output);
}

int runFeel(const FeelOptions& options)
{
  std::string message;
  HipPath path;
  std::int64_t ticks = 0;
  const bool follows = options.device != "falcon";
  if (follows && readHipPath(options.path, path, message) != Status::Ok)
  {
    return fail(kCommand, message);
  }
  if (follows && !countTicks(path, options.path, options.rateHz, kMostTicks, ticks, message))
  {
    return fail(kCommand, message);
  }
  Cloud cloud;
  if (!readCloud(options.file, cloud, message))
  {
    return fail(kCommand, message);
  }
  const vtkSmartPointer<vtkPolyData> prepared = preparedCloud(options, cloud.points, message);
  showWarnings(kCommand);
  if (!prepared)
  {
    return fail(kCommand, message);
  }
  cloud = {};
  Status status = Status::Ok;
  // No picture is drawn: the scene computes the few radii it needs.
  vtkNew<vtkKernelBandwidthFilter> bandwidth;
  options.bandwidth.configure(bandwidth);
  const std::shared_ptr<const HapticScene> scene =
    makeHapticScene(prepared, status, !options.noCovariance, bandwidth->GetSettings());
  if (!scene)
  {
    return fail(kCommand, options.file + ": " + sentence(status));
  }
  rememberStopSignals(); // before there is an unfinished file
  CsvWriter table;
  if (!table.open(options.output, kHeader, message))
  {
    return fail(kCommand, message);
  }
  Rows rows(table);
  if (!feelAs(options, scene, path, ticks, rows, message) || !table.commit(message))
  {
    return fail(kCommand, message);
  }
  print(options, *scene, rows.summary());
  return kSuccess;
}

} // namespace

void addFeelCommand(CLI::App& program, int& exitCode)
{
  CLI::App* command =
    program.add_subcommand("feel", "Feel a point cloud along a path, in virtual time, or with a Falcon");
  auto options = std::make_shared<FeelOptions>();
  options->addTo(*command);
  command->callback(
    [options, &exitCode]
    {
      options->complete();
      exitCode = runFeel(*options);
    });
}

} // namespace app
} // namespace pointhaptics
