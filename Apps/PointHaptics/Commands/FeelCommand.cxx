#include "Commands/Commands.h"

#include "Clouds/Pipeline.h"
#include "Feel/ClosestApproach.h"
#include "Feel/FeelLive.h"
#include "Feel/FeelOptions.h"
#include "Feel/FeelReplay.h"
#include "Feel/FeltCloud.h"
#include "Feel/FeltSound.h"
#include "Feel/ForceFigure.h"
#include "Terminal/Messages.h"
#include "Terminal/ProgressBar.h"
#include "Terminal/StopSignals.h"

#include "ClippedCloud.h"
#include "CsvWriter.h"
#include "LoadedCloud.h"
#include "PathTicks.h"
#include "RecordingWriter.h"
#include "Replay.h"
#include "VirtualTouch.h"

#include "Core/Base/Boxes.h"
#include "Core/Base/QuantityText.h"
#include "Devices/HipPath.h"
#include "Devices/SimulatedDevice.h"
#include "IO/Info/LengthUnit.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <vtkPolyData.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <vector>

namespace pointhaptics::app
{
namespace
{

constexpr const char* kFeelCommand = "feel";
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

double quantile(const std::vector<float>& sorted, double part)
{
  return sorted.empty() ? 0.0 : double(sorted[static_cast<std::size_t>(part * double(sorted.size() - 1))]);
}

std::string header()
{
  std::string line;
  for (const char* column : kFeltColumns)
  {
    line += (line.empty() ? "" : ",") + std::string(column);
  }
  return line;
}

/// Limit of the force; in virtual time no servo loop has a limit of its own.
ForceLimit limitOf(const FeelOptions& options)
{
  ForceLimit limit;
  limit.user = options.touch.parameters.contact.forceLimit;
  const bool isFalcon = options.device == "falcon";
  limit.device = isFalcon           ? options.falcon.maximumForce
    : options.device == "simulated" ? SimulatedDevice().maximumForce()
                                    : limit.device;
  limit.program = isFalcon ? kMostServoForce : limit.program;
  return limit;
}

/// Writes rows and keeps their summary.
class Rows
{
public:
  /// @param recording gets each sample of add(), if it is open; @param sound plays the touch.
  Rows(CsvWriter& table, RecordingWriter& recording, FeltSound& sound)
    : table_(table)
    , recording_(recording)
    , sound_(sound)
  {
  }
  RecordingWriter& recording() { return recording_; }
  /// Adds a row with another time than the sample's, which counts from the first tick.
  void add(double time, const VirtualTouch& touch)
  {
    const ServoSample& sample = touch.sample();
    if (recording_.isOpen() && sample.scene != scene_)
    {
      recording_.publish(PublishedScene::of(touch.scene()));
      scene_ = sample.scene;
    }
    recording_.add(sample);
    this->add(time, sample.state, 1e6 * sample.updateSeconds);
  }
  void add(double time, const ProxyState& state, double microseconds)
  {
    ++summary_.ticks;
    if (summary_.contactTicks == 0)
    {
      approach_.add(state.hip);
    }
    summary_.contactTicks += state.contact;
    summary_.maximumForce = std::max(summary_.maximumForce, forceFigure(norm(state.force)));
    durations_.push_back(static_cast<float>(microseconds));
    sound_.add(time, state);
    const auto row = feltRow(time, state, microseconds);
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

  /// Nearest approach of a hand that has touched nothing.
  const ClosestApproach& approach() const { return approach_; }

private:
  CsvWriter& table_;
  RecordingWriter& recording_;
  FeltSound& sound_;
  ClosestApproach approach_;
  Summary summary_;
  std::vector<float> durations_;
  std::uint64_t scene_ = 0;
};

/// Moves a person's hand along @p path that yields to the force, in virtual time.
void walkYielding(
  const FeelOptions& options, FeelScenes& scenes, const HipPath& path, std::int64_t ticks, Rows& rows)
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
  const ContactParameters& contact = options.touch.parameters.contact;
  const HandLimits limits = hand.limits();
  require(checkPassive(limits, contact.stiffness, contact.damping, options.rateHz) == Status::Ok,
    fmt::format("stiffness {} N/m with damping {} N s/m would make the hand shake at {} Hz; use at most "
                "{:.0f} N/m beside this damping",
      contact.stiffness, contact.damping, options.rateHz,
      largestPassiveStiffness(limits, contact.damping, options.rateHz)));
  const Status status = hand.open();
  require(status == Status::Ok, options.path + ": " + pointhaptics::message(status));
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
    double microseconds = 0.0;
    const ProxyState& felt = touch.step(state.position, microseconds);
    static_cast<void>(hand.write(time, felt.force));
    rows.add(path.points.front().timeSeconds + time, touch);
    bar.show(double(tick) / double(ticks));
  }
}

/// Moves the hand along @p path in virtual time.
void walk(const FeelOptions& options, FeelScenes& scenes, const HipPath& path, std::int64_t ticks, Rows& rows)
{
  ProgressBar bar("feeling");
  std::int64_t tick = 0;
  feelPathWith(options.touch.parameters, scenes, path, options.rateHz, ticks,
    [&](double time, const VirtualTouch& touch)
    {
      rows.add(time, touch);
      bar.show(double(tick++) / double(ticks));
      return !stopIsRequested();
    });
}

/// Feels with the hand in the device, until the time is over or the user ends it.
void touch(const FeelOptions& options, FeelScenes& scenes, Rows& rows)
{
  LiveSettings live;
  live.falcon = options.falcon;
  live.parameters = options.touch.parameters;
  live.rateHz = options.rateHz;
  live.seconds = options.seconds;
  live.recording = &rows.recording();
  ServoStatistics statistics;
  const auto row = [&rows](const ServoSample& sample)
  { rows.add(sample.timeSeconds, sample.state, 1e6 * sample.updateSeconds); };
  std::string message;
  require(feelLive(live, scenes, row, statistics, message), message);
  printNow(stderr,
    fmt::format("{:.0f} Hz, {} deadline misses, {} device faults, jitter p99 {:.0f} us\n", statistics.rateHz,
      statistics.deadlineMisses, statistics.deviceFaults, 1e6 * statistics.jitter.p99));
}

void requireNoStop(const FeelOptions& options)
{
  require(!stopIsRequested(), options.output + ": feeling was stopped on request; start it again");
}

void feelAs(
  const FeelOptions& options, FeelScenes& scenes, const HipPath& path, std::int64_t ticks, Rows& rows)
{
  if (options.device == "falcon")
  {
    touch(options, scenes, rows);
    return;
  }
  options.device == "simulated" ? walkYielding(options, scenes, path, ticks, rows)
                                : walk(options, scenes, path, ticks, rows);
  requireNoStop(options);
}

/// The limit as JSON; null: there is none.
nlohmann::ordered_json limitJson(const ForceLimit& limit)
{
  return std::isfinite(limit.newtons()) ? nlohmann::ordered_json(limit.newtons()) : nlohmann::ordered_json();
}

/// What lets a hand touch that came along @p path as near as @p nearest, metres; empty: nothing is known.
const char* cureOfNoContact(
  const FeelOptions& options, const FeelScenes& scenes, const HipPath& path, double nearest)
{
  const bool isPlaced = options.fit || options.lattice.hasTransform() || !options.lattice.workspace().empty();
  if (!isPlaced && nearest > kDefaultWorkspaceEdge)
  {
    return "; --fit brings the cloud into the 10 cm workspace";
  }
  return !path.points.empty() && contains(scenes.whole()->bounds(), path.points.front().position)
    ? "; the path begins among the points, and a hand inside a body feels nothing: begin it outside"
    : "";
}

/// Prints the summary. @p nearest: how near a hand that touched nothing came on @p path, metres.
void print(const FeelOptions& options, const FeelScenes& scenes, std::int64_t invalid, const Summary& s,
  const HipPath& path, const std::optional<double>& nearest)
{
  if (options.json)
  {
    nlohmann::ordered_json result = { { "output", options.output }, { "points_invalid", invalid },
      { "points_felt", scenes.whole()->numberOfPoints() }, { "local_scenes", scenes.numberOfLocalScenes() },
      { "finest_cell_m", scenes.finestCell() }, { "ticks", s.ticks }, { "contact_ticks", s.contactTicks },
      { "max_force_n", s.maximumForce }, { "force_limit_n", limitJson(limitOf(options)) },
      { "force_limit_of", limitOf(options).name() },
      { "update_us",
        { { "p50", s.p50Microseconds }, { "p99", s.p99Microseconds }, { "max", s.maximumMicroseconds } } } };
    if (nearest)
    {
      result["nearest_point_m"] = *nearest;
    }
    printJson(result);
    return;
  }
  if (invalid > 0)
  {
    printSummary(fmt::format(
      "{}{} NaN or infinite and left out", countOfPoints(invalid), invalid == 1 ? " is" : " are"));
  }
  printSummary(
    fmt::format("{} ticks, {} in contact, max force {:.4g} N, update p50 {:.2f} p99 {:.2f} max {:.2f} us: {}",
      s.ticks, s.contactTicks, s.maximumForce, s.p50Microseconds, s.p99Microseconds, s.maximumMicroseconds,
      options.output));
  if (nearest)
  {
    printSummary(fmt::format("{} of {} ticks in contact; nearest point {} away{}", s.contactTicks, s.ticks,
      lengthText(*nearest < 1e-9 ? 0.0 : *nearest, 2), // rounding errors
      cureOfNoContact(options, scenes, path, *nearest)));
  }
}

void printReplay(const FeelOptions& options, const ReplayDifference& difference, const Summary& s)
{
  if (options.json)
  {
    printJson({ { "output", options.output }, { "ticks", s.ticks }, { "contact_ticks", s.contactTicks },
      { "max_force_n", s.maximumForce }, { "same_ticks", difference.sameTicks },
      { "max_difference_n", difference.largest } });
    return;
  }
  printSummary(fmt::format("{} ticks, {} in contact, max force {:.4g} N: {}\n{}", s.ticks, s.contactTicks,
    s.maximumForce, options.output, difference.text()));
}

void openOutputs(const FeelOptions& options, Files& files, CsvWriter& table, FeltSound& sound)
{
  std::string message;
  require(table.open(files.output(options.output), header(), message) &&
      (options.soundFile.empty() || sound.open(files.output(options.soundFile), message)),
    message);
}

/// Feels a recording again.
int runReplay(const FeelOptions& options, Files& files)
{
  std::string message;
  Recording recording;
  vtkSmartPointer<vtkPolyData> cloud;
  rememberStopSignals();
  require(openRecording(options.replay, options.file, files, recording, cloud, message), message);
  CsvWriter table;
  FeltSound sound;
  openOutputs(options, files, table, sound);
  std::optional<ProxyMethod> method;
  if (options.methodIsGiven)
  {
    method = options.touch.parameters.method;
  }
  Replay replay(recording, cloud, method);
  RecordingWriter none;
  Rows rows(table, none, sound);
  ProgressBar bar("feeling");
  while (!replay.isAtEnd() && !stopIsRequested())
  {
    const RecordedTick& row = replay.row();
    ServoSample sample;
    if (!replay.step(sample, message))
    {
      throw Failure(options.replay + ": " + message);
    }
    rows.add(row.felt[0], sample.state, 1e6 * sample.updateSeconds);
    bar.show(double(replay.difference().ticks) / double(recording.ticks.size()));
  }
  requireNoStop(options);
  require(table.commit(message) && sound.close(message) && files.commit(message), message);
  printReplay(options, replay.difference(), rows.summary());
  return kSuccess;
}

void openRecordingOutput(
  const FeelOptions& options, vtkPolyData* cloud, Files& files, RecordingWriter& recording)
{
  if (options.record.empty())
  {
    return;
  }
  std::string message;
  const bool isCopied = files.isStream(options.file);
  const std::string felt = isCopied ? keptCloudName(options.record) : options.file;
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
  require(recording.open(files.output(options.record), header, message), message);
}

/// Box about the cloud in the workspace frame; empty where the cloud is fitted.
Bounds feltBox(const FeelOptions& options, vtkPolyData* cloud)
{
  const AffineTransform transform = options.lattice.transform();
  const Bounds box = options.fit ? Bounds() : extentOf(cloud).all;
  return box.empty() ? box : boxOfCorners(box, [&](const Vec3& p) { return transform.apply(p); });
}

/// Reads the path of the hand in its units, and counts its ticks.
void readPath(const FeelOptions& options, Files& files, HipPath& path, std::int64_t& ticks)
{
  std::string message;
  require(readHipPath(files.input(options.path), path, message) == Status::Ok, message);
  applyUnits(options.pathUnits, path);
  require(countTicks(path, options.path, options.rateHz, kMostTicks, ticks, message, unitOptions()), message);
}

/// What the file says of its unit where that is not the one that is felt; empty: nothing.
std::string statedUnit(const FeelOptions& options, vtkPolyData* cloud)
{
  const LengthUnit unit = lengthUnitOf(cloud, Bounds());
  return unit.name == "m" || options.lattice.isScaled()
    ? std::string()
    : fmt::format("{}: the file says that its unit is {}, and it is felt as metres: give --unit {}",
        options.file, unit.name, unit.name);
}

int runFeel(const FeelOptions& options, Files& files)
{
  std::string message;
  HipPath path;
  std::int64_t ticks = 0;
  if (options.device != "falcon")
  {
    readPath(options, files, path, ticks);
  }
  Cloud cloud;
  const std::string input = options.record.empty() ? options.file : files.input(options.file);
  require(readCloud(input, cloud, message, options.reading), message);
  showNotes(kFeelCommand, options.file, cloud);
  cloud.points = inLocalMetres(cloud.points); // as view has them
  const std::string stated = statedUnit(options, cloud.points);
  const Bounds box = feltBox(options, cloud.points);
  FeelScenes scenes;
  require(makeFeelScenes(options, cloud.points, scenes, message), message);
  showWarnings(kFeelCommand);
  rememberStopSignals(); // before there is an unfinished file
  RecordingWriter recording;
  CsvWriter table;
  FeltSound sound;
  openRecordingOutput(
    options, clippedCloud(cloud.points, clipBox(options.clip, cloud.points)), files, recording);
  openOutputs(options, files, table, sound);
  const std::int64_t invalid = extentOf(cloud.points).invalid;
  cloud = {};
  Rows rows(table, recording, sound);
  feelAs(options, scenes, path, ticks, rows);
  require(table.commit(message) && recording.close(message) && sound.close(message) && files.commit(message),
    message);
  if (!recording.problem().empty())
  {
    warn(kFeelCommand, fmt::format("{}: it ends early: {}", options.record, recording.problem()));
  }
  const Summary summary = rows.summary();
  const std::string odd =
    stated.empty() ? unlikelyUnits(path, box, unitOptions(), summary.contactTicks > 0) : stated;
  if (!odd.empty())
  {
    warn(kFeelCommand, odd);
  }
  print(options, scenes, invalid, summary, path,
    summary.contactTicks == 0 ? rows.approach().distance(*scenes.whole()) : std::nullopt);
  return kSuccess;
}

} // namespace

void addFeelCommand(CLI::App& program, int& exitCode)
{
  CLI::App* command =
    program.add_subcommand("feel", "Feel a point cloud along a path, in virtual time, or with a Falcon");
  auto options = std::make_shared<FeelOptions>();
  options->addTo(*command);
  const auto run = [options](Files& files)
  { return options->replay.empty() ? runFeel(*options, files) : runReplay(*options, files); };
  runAs(*command, exitCode,
    { run, [command, options] { options->complete(*command); },
      [options](Files& files) { options->declareMore(files); } });
}

} // namespace pointhaptics::app
