#include "RecordingWriter.h"

#include "RecordingLines.h"
#include "VirtualTouch.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <iterator>
#include <limits>

namespace pointhaptics
{
namespace
{

constexpr std::size_t kLongestLabel = 1000;

/// Forgets what was published before the input @p number, which is in use.
template <typename Input>
const Input* inUse(std::vector<Input>& inputs, std::uint64_t number)
{
  const auto used = std::find_if(
    inputs.rbegin(), inputs.rend(), [number](const Input& input) { return input.number == number; });
  if (used == inputs.rend())
  {
    return nullptr;
  }
  inputs.erase(inputs.begin(), std::prev(used.base()));
  return &inputs.front();
}

/// The lines of a header, without their "# ".
std::vector<std::string> linesOf(const RecordingHeader& header)
{
  const auto sinceOrigin =
    std::chrono::steady_clock::now().time_since_epoch() - std::chrono::nanoseconds(header.origin);
  const auto started =
    std::chrono::time_point_cast<std::chrono::microseconds>(std::chrono::system_clock::now() - sinceOrigin);
  const std::time_t seconds = std::chrono::system_clock::to_time_t(started);
  const std::int64_t microseconds = started.time_since_epoch().count() % 1000000;
  std::vector<std::string> lines = { "pointhaptics recording: 2", "program: " + header.program,
    fmt::format("started: {:%Y-%m-%dT%H:%M:%S}.{:06}Z", fmt::gmtime(seconds), microseconds),
    fmt::format("monotonic: {}.{:09}", header.origin / 1000000000, header.origin % 1000000000) };
  for (const std::string& file : header.cloud.files)
  {
    lines.push_back("file: " + file);
  }
  lines.push_back(lineOf("cloud:", header.cloud));
  if (!header.settings.empty())
  {
    lines.push_back("settings: " + header.settings);
  }
  lines.push_back(lineOf("servo:", header.step));
  const ForceLimit& limit = header.limit;
  lines.push_back(
    fmt::format("limits: force={} of={} device={} user={} program={}", keyed::textOf(limit.newtons()),
      limit.name(), keyed::textOf(limit.device), keyed::textOf(limit.user), keyed::textOf(limit.program)));
  return lines;
}

} // namespace

bool RecordingWriter::open(const std::string& fileName, const RecordingHeader& header, std::string& message)
{
  fileName_ = fileName;
  header_ = header;
  clouds_.clear();
  marks_.clear();
  markers_ = 0;
  lastMark_ = 0;
  numberOfTicks_ = 0;
  hasRow_ = false;
  problem_.clear();
  return table_.open(fileName, recordedColumns(), message, true);
}

std::uint32_t RecordingWriter::mark(std::uint64_t tick, const std::string& text)
{
  if (!this->isOpen() || !problem_.empty())
  {
    return 0;
  }
  lastMark_ = std::max(lastMark_, this->isWaiting() ? 0 : tick);
  marks_.push_back({ lastMark_, text.substr(0, kLongestLabel) });
  return ++markers_;
}

void RecordingWriter::end(const std::string& problem)
{
  problem_ = problem_.empty() ? problem : problem_;
}

void RecordingWriter::add(ServoLoop& loop, const std::vector<ServoSample>& samples)
{
  loop.takeInputs(published_);
  const std::uint64_t lost = loop.statistics().lostTraceSamples;
  if (this->isWaiting())
  {
    lost_ = lost;
    header_.step = loop.stepSettings();
    header_.limit = loop.forceLimit();
    header_.origin = loop.origin();
  }
  for (const MarkerSocket::Marker& marker : socket_ ? socket_->take() : std::vector<MarkerSocket::Marker>())
  {
    this->mark(marker.tick, marker.text);
  }
  for (const ServoSample& sample : samples)
  {
    this->add(sample);
  }
  if (this->isOpen() && lost > lost_)
  {
    this->end(fmt::format("{} ticks were lost while the window did not answer", lost - lost_));
  }
}

void RecordingWriter::add(const ServoSample& sample)
{
  if (this->isOpen() && problem_.empty() && (numberOfTicks_ > 0 || (sample.tickFlags & kTickBegins)))
  {
    this->addRow(sample);
  }
  inUse(published_.scenes, sample.scene);
  inUse(published_.parameters, sample.parameters);
  last_ = sample;
}

void RecordingWriter::addEvent(std::uint64_t tick, const std::string& event)
{
  table_.comment(fmt::format("tick {}: {}", tick, event));
}

void RecordingWriter::addCloud(std::uint64_t number, const std::shared_ptr<const SceneOrigin>& origin)
{
  if (!origin)
  {
    this->end("a scene was felt of which nobody knows how it was made");
  }
  else if (clouds_.insert(number).second)
  {
    if (origin->isLocal())
    {
      this->addCloud(origin->globalCloud, origin->global);
    }
    table_.comment(lineOf(fmt::format("made {}:", number), *origin));
  }
}

void RecordingWriter::addScene(const ServoSample& sample)
{
  if (sample.scene == 0)
  {
    this->addEvent(sample.tick, "scene none");
    return;
  }
  const PublishedScene* known = inUse(published_.scenes, sample.scene);
  const PublishedScene scene = known ? *known : PublishedScene();
  this->addCloud(scene.cloud, scene.origin);
  const RecordedEvent event{ sample.tick, RecordedEvent::Kind::Scene, 0, false, scene.cloud,
    scene.origin ? scene.origin->globalCloud : 0, scene.modelToWorkspace };
  this->addEvent(sample.tick, lineOf("scene", event));
}

void RecordingWriter::addParameters(const ServoSample& sample)
{
  const PublishedParameters* parameters = inUse(published_.parameters, sample.parameters);
  if (!parameters)
  {
    this->end("parameters were in force that nobody knows");
    return;
  }
  keyed::Line line = keyed::Line::startingWith(fmt::format("parameters {}:", parameters->number));
  HapticParameters values = parameters->parameters;
  line.settings(values);
  table_.comment(line.text());
  this->addEvent(sample.tick, fmt::format("parameters {}", parameters->number));
}

void RecordingWriter::addEvents(const ServoSample& sample)
{
  const bool isFirst = numberOfTicks_ == 0;
  const bool isWritten = !(sample.tickFlags & kTickStepped) || sample.device == Status::Ok;
  const std::uint32_t flags = sample.tickFlags | (isWritten ? 0u : kTickNotWritten);
  const std::uint32_t before = isFirst ? kTickStepped | kTickBegins : lastFlags_;
  for (const RecordedFlag& flag : kRecordedFlags)
  {
    const bool isSet = (flags & flag.bit) != 0;
    if (isSet != ((before & flag.bit) != 0) && (isSet || !flag.isOnce))
    {
      this->addEvent(sample.tick,
        flag.name +
          std::string(flag.isOnce          ? ""
              : isSet == flag.isOnWhereSet ? " on"
                                           : " off"));
    }
  }
  lastFlags_ = flags & ~kOnceFlags;
  if (isFirst || sample.parameters != last_.parameters)
  {
    this->addParameters(sample);
  }
  if (isFirst || sample.scene != last_.scene)
  {
    this->addScene(sample);
  }
}

void RecordingWriter::addRow(const ServoSample& sample)
{
  if (numberOfTicks_ > 0 && sample.tick <= last_.tick)
  {
    this->end("the servo loop was started again");
    return;
  }
  this->writeRow(last_.tick);
  for (const std::string& line : numberOfTicks_ == 0 ? linesOf(header_) : std::vector<std::string>())
  {
    table_.comment(line);
  }
  this->addEvents(sample);
  if (!table_.isFine())
  {
    this->end("the disk is full or gone");
  }
  if (!problem_.empty())
  {
    return;
  }
  const auto felt = feltRow(sample.timeSeconds, sample);
  std::copy(felt.begin(), felt.end(), row_.begin());
  row_[kFelt] = double(sample.buttons);
  hasRow_ = true;
  ++numberOfTicks_;
}

/// The newest row, with the markers set until @p marksUntil.
void RecordingWriter::writeRow(std::uint64_t marksUntil)
{
  if (!hasRow_)
  {
    return;
  }
  hasRow_ = false;
  std::uint32_t marker = 0;
  for (; !marks_.empty() && marks_.front().tick <= marksUntil; marks_.pop_front())
  {
    std::string& text = marks_.front().text;
    marker = markers_ - std::uint32_t(marks_.size()) + 1;
    std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
    if (!text.empty())
    {
      table_.comment(fmt::format("marker {}: {}", marker, text));
    }
  }
  row_[kFelt + 1] = double(marker);
  table_.row(row_.data(), row_.size());
}

bool RecordingWriter::close(std::string& message, const std::string& why)
{
  if (!this->isOpen())
  {
    return true;
  }
  if (numberOfTicks_ == 0)
  {
    this->end("nothing was recorded: the hand did not let go of what it touched");
    table_.abandon();
    return true;
  }
  this->end(why);
  this->writeRow(std::numeric_limits<std::uint64_t>::max());
  table_.comment(fmt::format(
    "{}: {} ticks{}", kRecordingEnd, numberOfTicks_, problem_.empty() ? "" : "; it ends early: " + problem_));
  return table_.commit(message);
}

} // namespace pointhaptics
