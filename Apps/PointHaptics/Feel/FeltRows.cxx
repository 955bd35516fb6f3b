#include "Feel/FeltRows.h"

#include "Terminal/Messages.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace pointhaptics::app
{
namespace
{

double quantile(const std::vector<float>& sorted, double part)
{
  return sorted.empty() ? 0.0 : double(sorted[static_cast<std::size_t>(part * double(sorted.size() - 1))]);
}

} // namespace

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
  this->add(time, sample);
}

void FeltRows::add(double time, const ServoSample& sample)
{
  const ProxyState& state = sample.state;
  ++summary_.ticks;
  if (summary_.contactTicks == 0)
  {
    approach_.add(state.hip);
  }
  summary_.contactTicks += state.contact;
  summary_.maximumForce = std::max(summary_.maximumForce, forceFigure(norm(state.force)));
  durations_.push_back(static_cast<float>(1e6 * sample.updateSeconds));
  sound_.add(time, { norm(state.force), state.contact });
  const auto row = feltRow(time, sample);
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
