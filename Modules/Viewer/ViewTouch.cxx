#include "ViewTouch.h"

#include "Replay.h"
#include "ViewScene.h"
#include "VirtualTouch.h"

#include "PolyDataAccess.h"
#include "vtkVoxelMeanResampler.h"

#include "Core/Base/Boxes.h"
#include "Devices/HipPath.h"

#include <fmt/format.h>
#include <vtkPointSet.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pointhaptics
{
namespace
{

constexpr double kRateHz = 1000.0;
/// Samples of a path are kept for the picture: about 200 bytes each.
constexpr double kMostSamples = 2e6;

/// Makes the scenes that the command `feel` makes of the cloud of @p scene with the same options. False: @p
/// message says why not.
bool makeFeelScenes(
  ViewScene& scene, const HapticViewerOptions& options, FeelScenes& scenes, std::string& message)
{
  Status status = Status::Ok;
  auto whole = scene.makeScene(options.voxels.computeCovariance, status);
  if (!whole)
  {
    message = std::string("the cloud cannot be felt: ") + pointhaptics::message(status);
    return false;
  }
  const bool refines = !options.hasVoxels() && options.voxels.computeCovariance;
  auto* cloud = vtkPointSet::SafeDownCast(scene.resampler()->GetInputDataObject(0, 0));
  scenes.adopt(std::move(whole), cloud && refines ? cloud->GetPoints() : nullptr);
  return true;
}

/// The tick to show: that of the largest force, or the last one where nothing was touched. @pre not empty.
const ServoSample& mostTelling(const std::vector<ServoSample>& samples)
{
  const ServoSample* best = &samples.back();
  double largest = 0.0;
  for (const ServoSample& sample : samples)
  {
    const double force = norm(sample.state.force);
    if (sample.state.contact && force > largest)
    {
      largest = force;
      best = &sample;
    }
  }
  return *best;
}

/// Newtons where @p model puts the shape.
double idealForce(
  IdealForce& ideal, const AffineTransform& model, const Vec3& hip, const ContactParameters& contact)
{
  return std::min(ideal.at(hip, model, contact.stiffness), contact.forceLimit);
}

/// Moves a hand along HapticViewerOptions::path.
bool feelPathOf(ViewScene& scene, const HapticViewerOptions& options, const HapticViewerObserver& observer,
  std::vector<ServoSample>& samples, std::string& message)
{
  HipPath path;
  std::int64_t ticks = 0;
  FeelScenes scenes;
  if (readHipPath(options.path, path, message) != Status::Ok)
  {
    return false;
  }
  applyUnits(options.pathUnits, path);
  if (!countTicks(path, options.path, kRateHz, kMostSamples, ticks, message, options.names.units) ||
    !makeFeelScenes(scene, options, scenes, message))
  {
    return false;
  }
  samples.reserve(std::size_t(ticks));
  feelPath(options.haptics, scenes, path, kRateHz, ticks,
    [&samples](double time, const VirtualTouch& touch)
    {
      samples.push_back(touch.sample());
      samples.back().timeSeconds = time;
      return true;
    });
  const bool isTouched = std::any_of(
    samples.begin(), samples.end(), [](const ServoSample& sample) { return sample.state.contact; });
  AffineTransform model;
  const Bounds& box = scene.cloudBounds();
  const bool isPlaced = !box.empty() && affineFromTransform(scene.resampler()->GetTransform(), model);
  const std::string odd = unlikelyUnits(path,
    isPlaced ? boxOfCorners(box, [&model](const Vec3& p) { return model.apply(p); }) : Bounds(),
    options.names.units, isTouched || options.unitIsChosen);
  if (!odd.empty())
  {
    observer.say(HapticViewerObserver::Kind::Warning, options.path + ": " + odd);
  }
  return true;
}

/// Feels the recording in HapticViewerOptions::replay again.
bool feelReplay(ViewScene& scene, const HapticViewerOptions& options, const HapticViewerObserver& observer,
  IdealForce* ideal, std::vector<ServoSample>& samples, std::vector<double>& ideals, std::string& message)
{
  Recording recording;
  auto* cloud = vtkPointSet::SafeDownCast(scene.resampler()->GetInputDataObject(0, 0));
  if (!readRecording(options.replay, recording, message))
  {
    return false;
  }
  if (!isOf(recording, cloud, message))
  {
    message.insert(0, scene.title() + ": ");
    return false;
  }
  Replay replay(recording, cloud);
  while (!replay.isAtEnd())
  {
    samples.emplace_back();
    if (!replay.step(samples.back(), message))
    {
      message.insert(0, options.replay + ": ");
      return false;
    }
    if (ideal && replay.scene())
    {
      const AffineTransform& model = replay.scene()->modelToWorkspace();
      ideals.push_back(idealForce(*ideal, model, samples.back().state.hip, replay.contact()));
    }
    ideals.resize(samples.size(), NAN);
    if (observer.stops())
    {
      message = options.replay + ": the replay was stopped on request";
      return false;
    }
  }
  observer.say(HapticViewerObserver::Kind::Note, "replay: " + replay.difference().text());
  return true;
}

} // namespace

std::shared_ptr<IdealForce> idealFor(ViewScene& scene, const HapticViewerOptions& options)
{
  Shape shape = Shape::Plane;
  vtkPointSet* cloud = vtkPointSet::SafeDownCast(scene.resampler()->GetInputDataObject(0, 0));
  if (options.ideal == "none" || !cloud || !cloud->GetPoints())
  {
    return nullptr;
  }
  const bool known = options.ideal == "auto" ? recognizeShape(PointAccess(cloud->GetPoints()).view(), shape)
                                             : shapeFromName(options.ideal, shape);
  return known ? std::make_shared<IdealForce>(shape) : nullptr;
}

double idealForce(IdealForce& ideal, ViewScene& scene, const Vec3& hip, const ContactParameters& contact)
{
  AffineTransform model;
  const bool isAffine = affineFromTransform(scene.resampler()->GetTransform(), model);
  return isAffine ? idealForce(ideal, model, hip, contact) : NAN;
}

bool TouchFiles::open(const HapticViewerOptions& options, bool isLive, std::string& message)
{
  traceName_ = options.trace;
  chartName_ = options.forceChart;
  std::string columns;
  for (const char* column : kFeltColumns)
  {
    // The time of a tick stays the last column.
    columns += column == kFeltColumns.back() ? ",status" : "";
    columns += (columns.empty() ? "" : ",") + std::string(column);
  }
  return traceName_.empty() || trace_.open(traceName_, columns, message, isLive);
}

bool TouchFiles::add(const std::vector<ServoSample>& samples,
  const std::function<double(const ServoSample&)>& ideal, std::string& message)
{
  ticks_ += samples.size();
  for (const ServoSample& sample : samples)
  {
    const auto felt = feltRow(sample.timeSeconds, sample);
    std::array<double, kFeltColumns.size() + 1> row;
    std::copy(felt.begin(), felt.end() - 1, row.begin());
    row[felt.size() - 1] = double(sample.state.status);
    row.back() = felt.back();
    trace_.isOpen() ? trace_.row(row.data(), row.size()) : void();
    if (!chartName_.empty())
    {
      chart_->AddSample(sample.timeSeconds, norm(sample.state.force), sample.state.radius, ideal(sample));
    }
  }
  return !trace_.isOpen() || trace_.isFine() || trace_.commit(message);
}

bool TouchFiles::commit(const HapticViewerObserver& observer, std::string& message)
{
  const bool hasTrace = trace_.isOpen();
  bool areWritten = !hasTrace || trace_.commit(message);
  if (hasTrace && areWritten)
  {
    observer.say(HapticViewerObserver::Kind::Note, fmt::format("trace: {} ({} ticks)", traceName_, ticks_));
  }
  if (!chartName_.empty() && !chart_->WriteImage(chartName_.c_str()))
  {
    message = chart_->GetErrorMessage();
    return false;
  }
  if (!chartName_.empty())
  {
    observer.say(HapticViewerObserver::Kind::Note, "force chart: " + chartName_);
  }
  return areWritten;
}

bool feelAlongPath(ViewScene& scene, const HapticViewerOptions& options, const HapticViewerObserver& observer,
  ServoSample& shown, std::string& message)
{
  std::vector<ServoSample> samples;
  std::vector<double> ideals; // of a replay
  const std::shared_ptr<IdealForce> ideal = options.forceChart.empty() ? nullptr : idealFor(scene, options);
  if (!(options.replay.empty() ? feelPathOf(scene, options, observer, samples, message)
                               : feelReplay(scene, options, observer, ideal.get(), samples, ideals, message)))
  {
    return false;
  }
  shown = mostTelling(samples);
  TouchFiles files;
  const auto idealOf = [&](const ServoSample& sample)
  {
    return !ideals.empty() ? ideals[std::size_t(&sample - samples.data())]
      : ideal              ? idealForce(*ideal, scene, sample.state.hip, options.haptics.contact)
                           : NAN;
  };
  return files.open(options, false, message) && files.add(samples, idealOf, message) &&
    files.commit(observer, message);
}

} // namespace pointhaptics
