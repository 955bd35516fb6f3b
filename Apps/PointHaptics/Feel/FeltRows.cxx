#include "Feel/FeltRows.h"

#include "Terminal/Messages.h"

#include "Core/Neighbors/NeighborQuery.h"
#include "Haptics/HapticScene.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace pointhaptics::app
{
namespace
{

constexpr double kLongestPause = 1.0; // s

double quantile(const std::vector<float>& sorted, double part)
{
  return sorted.empty() ? 0.0 : double(sorted[static_cast<std::size_t>(part * double(sorted.size() - 1))]);
}

} // namespace

void ClosestApproach::add(const Vec3& hip)
{
  if (added_++ % stride_ != 0 || !isFinite(hip))
  {
    return;
  }
  if (places_.size() == kMostPlaces)
  {
    for (std::size_t i = 0; i < kMostPlaces / 2; ++i)
    {
      places_[i] = places_[2 * i];
    }
    places_.resize(kMostPlaces / 2);
    stride_ *= 2;
  }
  places_.push_back(hip);
}

std::optional<double> ClosestApproach::distance(const HapticScene& scene) const
{
  std::vector<Vec3> points;
  for (const Cell& cell : scene.pyramid().level(0).cells)
  {
    points.push_back(cell.mean);
  }
  NeighborQuery query;
  query.build(PointView(points.data(), std::int64_t(points.size())));
  double least = INFINITY;
  for (const Vec3& place : places_)
  {
    Neighbor neighbor;
    if (query.nearest(scene.toLattice(place), 1, &neighbor) == 1)
    {
      least = std::min(least, neighbor.squaredDistance);
    }
  }
  return std::isfinite(least) ? std::optional<double>(scene.latticeScale() * std::sqrt(least)) : std::nullopt;
}

bool FeltSound::open(const std::string& fileName, std::string& message)
{
  isOpen_ = file_.open(fileName, message);
  return isOpen_;
}

/// Plays the touch for @p seconds more. Samples are counted from the first tick, so that ticks add up.
void FeltSound::play(double seconds)
{
  wanted_ += std::clamp(seconds, 0.0, kLongestPause);
  const double samples = std::floor(wanted_ * ContactTone::kSamplesPerSecond + 0.5);
  samples_.resize(static_cast<std::size_t>(samples) - file_.numberOfSamples());
  tone_.render(touch_, samples_.data(), samples_.size());
  if (problem_.empty() && !file_.write(samples_.data(), samples_.size(), problem_))
  {
    isOpen_ = false;
  }
}

void FeltSound::add(double time, const ProxyState& state)
{
  if (!isOpen_)
  {
    return;
  }
  if (hasBegun_)
  {
    step_ = time - time_;
    this->play(step_);
  }
  hasBegun_ = true;
  time_ = time;
  touch_ = { norm(state.force), state.contact };
}

bool FeltSound::close(std::string& message)
{
  if (isOpen_ && hasBegun_)
  {
    this->play(step_); // the last tick is as long as the one before
  }
  if (!problem_.empty())
  {
    message = problem_;
    return false;
  }
  return !isOpen_ || file_.close(message);
}

FeltRows::FeltRows(const FeelCommand& options, Files& files)
{
  std::string message;
  require(
    table_.open(files.output(options.output), fmt::format("{}", fmt::join(kFeltColumns, ",")), message) &&
      (options.soundFile.empty() || sound_.open(files.output(options.soundFile), message)),
    message);
}

void FeltRows::commit(Files& files)
{
  std::string message;
  require(table_.commit(message) && recording.close(message) && sound_.close(message), message);
  files.commit();
}

void FeltRows::add(double time, const VirtualTouch& touch)
{
  const ServoSample& sample = touch.sample();
  if (recording.isOpen() && sample.scene != scene_)
  {
    recording.publish(PublishedScene::of(touch.scene()));
    scene_ = sample.scene;
  }
  recording.add(sample);
  this->add(time, sample.state, 1e6 * sample.updateSeconds);
}

void FeltRows::add(double time, const ProxyState& state, double microseconds)
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

FeltSummary FeltRows::summary()
{
  std::sort(durations_.begin(), durations_.end());
  summary_.p50Microseconds = quantile(durations_, 0.50);
  summary_.p99Microseconds = quantile(durations_, 0.99);
  summary_.maximumMicroseconds = quantile(durations_, 1.0);
  return summary_;
}

} // namespace pointhaptics::app
