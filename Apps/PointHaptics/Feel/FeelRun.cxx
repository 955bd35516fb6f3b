#include "Feel/FeelCommand.h"

#include "Feel/FeelReplay.h"
#include "Feel/FeltRows.h"
#include "Terminal/Messages.h"
#include "Terminal/ProgressBar.h"
#include "Terminal/StopSignals.h"

#include "ClippedCloud.h"

#include "Core/Base/Boxes.h"
#include "Core/Base/QuantityText.h"
#include "Devices/HipPath.h"
#include "Devices/SimulatedDevice.h"
#include "IO/Info/CloudExtent.h"
#include "IO/Info/LengthUnit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <vtkPolyData.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

namespace pointhaptics::app
{
namespace
{

/// Room about the path for a hand that yields, metres.
constexpr double kHandMargin = 0.1;

/// Limit of the force; in virtual time no servo loop has a limit of its own.
ForceLimit limitOf(const FeelCommand& options)
{
  ForceLimit limit;
  limit.user = options.touch.parameters.contact.forceLimit;
  const bool isFalcon = options.device == "falcon";
  limit.device = isFalcon           ? options.falcon.maximumForce
    : options.device == "simulated" ? SimulatedDevice().maximumForce()
                                    : limit.device;
  const bool isDefault = limit.user == ContactParameters().forceLimit;
  limit.program = isFalcon || isDefault ? kMostServoForce : limit.program;
  return limit;
}

/// Moves a person's hand along @p path that yields to the force, in virtual time.
void walkYielding(
  const FeelCommand& options, FeelScenes& scenes, const HipPath& path, std::int64_t ticks, FeltRows& rows)
{
  SimulatedHandSettings settings;
  for (const HipPathPoint& point : path.points)
  {
    settings.workspace.include(point.position);
  }
  settings.workspace = grown(settings.workspace, kHandMargin); // forces may push the hand off its path
  SimulatedDevice hand(settings);
  hand.setPath(path);
  const ContactParameters& contact = options.touch.parameters.contact;
  const HandLimits limits = hand.limits();
  require(checkPassive(limits, contact.stiffness, contact.damping, options.rateHz) == Status::Ok,
    fmt::format("stiffness {} N/m with damping {} N s/m would make the hand shake at {} Hz; use at most "
                "{:.0f} N/m beside this damping",
      contact.stiffness, contact.damping, options.rateHz,
      largestPassiveStiffness(limits, contact.damping, options.rateHz)));
  const Status status = hand.open();
  require(status == Status::Ok, options.viewer.path + ": " + pointhaptics::message(status));
  HapticParameters parameters = options.touch.parameters;
  parameters.contact.forceLimit = limitOf(options).newtons();
  VirtualTouch touch(parameters, scenes, options.rateHz);
  ProgressBar bar("feeling");
  for (std::int64_t tick = 0; tick < ticks && !stopIsRequested(); ++tick)
  {
    const double time = double(tick) / options.rateHz;
    HandState state;
    if (hand.read(std::min(time, path.duration()), state) != Status::Ok)
    {
      break;
    }
    static_cast<void>(hand.write(time, touch.step(state).state.force));
    rows.add(path.points.front().timeSeconds + time, touch);
    bar.show(double(tick) / double(ticks));
  }
}

void walk(
  const FeelCommand& options, FeelScenes& scenes, const HipPath& path, std::int64_t ticks, FeltRows& rows)
{
  ProgressBar bar("feeling");
  std::int64_t tick = 0;
  feelPath(options.touch.parameters, scenes, path, options.rateHz, ticks,
    [&](double time, const VirtualTouch& touch)
    {
      rows.add(time, touch);
      bar.show(double(tick++) / double(ticks));
      return !stopIsRequested();
    });
}

/// Feels with the hand in the device, until the time is over or the user ends it.
void touch(const FeelCommand& options, FeelScenes& scenes, FeltRows& rows)
{
  const ServoStatistics statistics = options.feelLive(
    scenes, rows.recording, [&rows](const ServoSample& sample) { rows.add(sample.timeSeconds, sample); });
  printNow(stderr,
    fmt::format("{:.0f} Hz, {} deadline misses, {} device faults, jitter p99 {:.0f} us\n", statistics.rateHz,
      statistics.deadlineMisses, statistics.deviceFaults, 1e6 * statistics.jitter.p99));
}

void feelAs(
  const FeelCommand& options, FeelScenes& scenes, const HipPath& path, std::int64_t ticks, FeltRows& rows)
{
  if (options.device == "falcon")
  {
    touch(options, scenes, rows);
    return;
  }
  options.device == "simulated" ? walkYielding(options, scenes, path, ticks, rows)
                                : walk(options, scenes, path, ticks, rows);
  require(!stopIsRequested(), options.output + ": feeling was stopped on request; start it again");
}

/// What lets a hand touch that came along @p path as near as @p nearest, metres; empty: nothing is known.
const char* cureOfNoContact(
  const FeelCommand& options, const FeelScenes& scenes, const HipPath& path, double nearest)
{
  const bool isPlaced =
    options.viewer.fitsWorkspace || options.lattice.hasTransform() || !options.lattice.workspace().empty();
  if (!isPlaced && nearest > kDefaultWorkspaceEdge)
  {
    return "; --fit brings the cloud into the 10 cm workspace";
  }
  return !path.points.empty() && contains(scenes.whole()->bounds(), path.points.front().position)
    ? "; the path begins among the points, and a hand inside a body feels nothing: begin it outside"
    : "";
}

/// Prints the summary. @p nearest: how near a hand that touched nothing came on @p path, metres.
void print(const FeelCommand& options, const FeelScenes& scenes, std::int64_t invalid, const FeltSummary& s,
  const HipPath& path, const std::optional<double>& nearest)
{
  std::string text = invalid == 0 ? std::string()
                                  : fmt::format("{}{} NaN or infinite and left out\n", countOfPoints(invalid),
                                      invalid == 1 ? " is" : " are");
  text +=
    fmt::format("{} ticks, {} in contact, max force {:.4g} N, update p50 {:.2f} p99 {:.2f} max {:.2f} us: {}",
      s.ticks, s.contactTicks, s.maximumForce, s.p50Microseconds, s.p99Microseconds, s.maximumMicroseconds,
      options.output);
  if (nearest)
  {
    text += fmt::format("\n{} of {} ticks in contact; nearest point {} away{}", s.contactTicks, s.ticks,
      lengthText(*nearest < 1e-9 ? 0.0 : *nearest, 2), // rounding errors
      cureOfNoContact(options, scenes, path, *nearest));
  }
  using Json = nlohmann::ordered_json;
  const ForceLimit limit = limitOf(options);
  const bool isLimited = std::isfinite(limit.newtons());
  printResult(options.json,
    { { "output", options.output }, { "points_invalid", invalid },
      { "points_felt", scenes.whole()->numberOfPoints() }, { "local_scenes", scenes.numberOfLocalScenes() },
      { "finest_cell_m", scenes.finestCell() }, { "ticks", s.ticks }, { "contact_ticks", s.contactTicks },
      { "max_force_n", s.maximumForce }, { "force_limit_n", isLimited ? Json(limit.newtons()) : Json() },
      { "force_limit_of", limit.name() },
      { "update_us",
        { { "p50", s.p50Microseconds }, { "p99", s.p99Microseconds }, { "max", s.maximumMicroseconds } } },
      { "nearest_point_m", nearest ? Json(*nearest) : Json() } },
    text);
}

int runReplay(const FeelCommand& options, Files& files)
{
  rememberStopSignals();
  const std::string& file = options.viewer.replay;
  const auto [recording, cloud] = openRecording(file, options.file, files);
  std::optional<ProxyMethod> method;
  if (options.methodIsGiven)
  {
    method = options.touch.parameters.method;
  }
  FeltRows rows(options, files);
  const ReplayDifference difference = feelAgain(file, recording, cloud, method, "feeling",
    [&rows](const RecordedTick& row, const ServoSample& sample) { rows.add(row.felt[0], sample); });
  rows.commit(files);
  const FeltSummary s = rows.summary();
  printResult(options.json,
    { { "output", options.output }, { "ticks", s.ticks }, { "contact_ticks", s.contactTicks },
      { "max_force_n", s.maximumForce }, { "same_ticks", difference.sameTicks },
      { "max_difference_n", difference.largest } },
    fmt::format("{} ticks, {} in contact, max force {:.4g} N: {}\n{}", s.ticks, s.contactTicks,
      s.maximumForce, options.output, difference.text()));
  return kSuccess;
}

void openRecordingOutput(
  const FeelCommand& options, vtkPolyData* cloud, Files& files, RecordingWriter& recording)
{
  if (options.viewer.record.empty())
  {
    return;
  }
  std::string message;
  const bool isCopied = files.isStream(options.file);
  const std::string felt = isCopied ? keptCloudName(options.viewer.record) : options.file;
  require(!isCopied || keepCloud(files.input(options.file), files.output(felt), message), message);
  RecordingHeader header = headerOf({ felt }, 0.0, cloud);
  header.program = "pointhaptics " POINTHAPTICS_VERSION;
  header.settings = options.settings;
  header.limit = limitOf(options);
  header.origin = std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
  header.step = VirtualTouch::settings(options.rateHz);
  PublishedParameters parameters{ 1, options.touch.parameters };
  parameters.parameters.contact.forceLimit = header.limit.newtons();
  recording.publish(parameters);
  require(recording.open(files.output(options.viewer.record), header, message), message);
}

/// Box about the cloud in the workspace frame; empty where the cloud is fitted.
Bounds feltBox(const FeelCommand& options, vtkPolyData* cloud)
{
  const AffineTransform transform = options.viewer.transform;
  const Bounds box = options.viewer.fitsWorkspace ? Bounds() : extentOf(cloud).all;
  return box.empty() ? box : boxOfCorners(box, [&](const Vec3& p) { return transform.apply(p); });
}

void readPath(const FeelCommand& options, Files& files, HipPath& path, std::int64_t& ticks)
{
  std::string message;
  require(readHipPath(files.input(options.viewer.path), path, message) == Status::Ok, message);
  applyUnits(options.viewer.pathUnits, path);
  require(countTicks(path, options.viewer.path, options.rateHz, kMostTicks, ticks, message, unitOptions()),
    message);
}

/// What the file says of its unit where that is not the one that is felt; empty: nothing.
std::string statedUnit(const FeelCommand& options, vtkPolyData* cloud)
{
  const LengthUnit unit = lengthUnitOf(cloud, Bounds());
  return options.viewer.unitIsChosen ? contradictedUnit(options.file, cloud, options.lattice.unit)
    : unit.name == "m" || options.lattice.isScaled()
    ? ""
    : fmt::format("{}: the file says that its unit is {}, and it is felt as metres: give --unit {}",
        options.file, unit.name, unit.name);
}

int runFeel(const FeelCommand& options, Files& files)
{
  HipPath path;
  std::int64_t ticks = 0;
  if (options.device != "falcon")
  {
    readPath(options, files, path, ticks);
  }
  const std::string& record = options.viewer.record;
  Cloud cloud = readCloud(record.empty() ? options.file : files.input(options.file), options.reading);
  cloud.name = options.file;
  showNotes(cloud);
  cloud.points = inLocalMetres(cloud.points, !options.viewer.unitIsChosen); // as view has them
  const std::string stated = statedUnit(options, cloud.points);
  const bool isKnown = options.viewer.unitIsChosen ||
    (stated.empty() && lengthUnitOf(cloud.points, Bounds()).evidence == UnitEvidence::File);
  const Bounds box = feltBox(options, cloud.points);
  FeelScenes scenes;
  options.makeScenes(cloud.points, scenes);
  showWarnings();
  rememberStopSignals(); // before there is an unfinished file
  FeltRows rows(options, files);
  openRecordingOutput(
    options, clippedCloud(cloud.points, clipBox(options.viewer.clip, cloud.points)), files, rows.recording);
  const std::int64_t invalid = extentOf(cloud.points).invalid;
  cloud = {};
  feelAs(options, scenes, path, ticks, rows);
  rows.commit(files);
  const std::string& problem = rows.recording.problem();
  warn(problem.empty() ? "" : fmt::format("{}: it ends early: {}", record, problem));
  const FeltSummary summary = rows.summary();
  warn(stated.empty() ? unlikelyUnits(path, box, unitOptions(), summary.contactTicks > 0, isKnown) : stated);
  print(options, scenes, invalid, summary, path,
    summary.contactTicks == 0 ? rows.approach().distance(*scenes.whole()) : std::nullopt);
  return kSuccess;
}

} // namespace

int FeelCommand::run(Files& files)
{
  return this->viewer.replay.empty() ? runFeel(*this, files) : runReplay(*this, files);
}

} // namespace pointhaptics::app
