#include "Commands.h"

#include "CsvWriter.h"
#include "FeelOptions.h"
#include "Messages.h"
#include "PathTicks.h"
#include "Pipeline.h"
#include "ProgressBar.h"

#include "Devices/HipPath.h"
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

/// Moves the hand along @p path in virtual time.
Summary walk(const FeelOptions& options, const HapticScene& scene, const HipPath& path, std::int64_t ticks,
  CsvWriter& table)
{
  Proxy proxy(options.parameters);
  proxy.setScene(&scene);
  Summary summary;
  summary.ticks = ticks;
  std::vector<float> durations(static_cast<std::size_t>(ticks));
  const double start = path.points.front().timeSeconds;
  const double end = path.points.back().timeSeconds;
  std::size_t hint = 0;
  ProgressBar bar("feeling");
  for (std::int64_t tick = 0; tick < ticks; ++tick)
  {
    const double time = std::min(start + double(tick) / options.rateHz, end);
    const Vec3 hip = path.position(time, hint);
    const auto before = std::chrono::steady_clock::now();
    const ProxyState state = proxy.step(hip, 1.0 / options.rateHz);
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - before;
    summary.contactTicks += state.contact;
    summary.maximumForce = std::max(summary.maximumForce, norm(state.force));
    durations[static_cast<std::size_t>(tick)] = static_cast<float>(took.count());
    const std::array<double, 16> row = rowOf(time, state, took.count());
    table.row(row.data(), row.size());
    bar.show(double(tick) / double(ticks));
  }
  std::sort(durations.begin(), durations.end());
  summary.p50Microseconds = quantile(durations, 0.50);
  summary.p99Microseconds = quantile(durations, 0.99);
  summary.maximumMicroseconds = quantile(durations, 1.0);
  return summary;
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
  if (readHipPath(options.path, path, message) != Status::Ok)
  {
    return fail(kCommand, message);
  }
  std::int64_t ticks = 0;
  if (!countTicks(path, options.path, options.rateHz, kMostTicks, ticks, message))
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
  CsvWriter table;
  if (!table.open(options.output, kHeader, message))
  {
    return fail(kCommand, message);
  }
  const Summary summary = walk(options, *scene, path, ticks, table);
  if (!table.commit(message))
  {
    return fail(kCommand, message);
  }
  print(options, *scene, summary);
  return kSuccess;
}

} // namespace

void addFeelCommand(CLI::App& program, int& exitCode)
{
  CLI::App* command = program.add_subcommand("feel", "Feel a point cloud along a path, in virtual time");
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
