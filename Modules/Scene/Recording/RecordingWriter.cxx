#include "RecordingWriter.h"

#include "VirtualTouch.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>

namespace pointhaptics
{
namespace
{

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

} // namespace

bool RecordingWriter::open(const std::string& fileName, const RecordingHeader& header, std::string& message)
{
  fileName_ = fileName;
  header_ = header;
  clouds_.clear();
  marks_.clear();
  labels_.clear();
  markers_ = 0;
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
  const std::uint64_t marked = this->isWaiting() ? 0 : tick;
  if (markers_ == 0 || marked > lastMark_) // a row has room for one
  {
    marks_.push_back(marked);
    lastMark_ = marked;
    ++markers_;
  }
  if (!text.empty())
  {
    labels_.push_back({ markers_, text });
  }
  return markers_;
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

void RecordingWriter::addEvent(std::uint64_t tick, RecordedEvent::Kind kind, bool on)
{
  RecordedEvent event;
  event.tick = tick;
  event.kind = kind;
  event.on = on;
  table_.comment(lineOf(event));
}

void RecordingWriter::addCloud(std::uint64_t number, const std::shared_ptr<const SceneOrigin>& origin)
{
  if (!origin)
  {
    this->end("a scene was felt of which nobody knows how it was made");
    return;
  }
  if (!clouds_.insert(number).second)
  {
    return;
  }
  if (origin->globalCloud != 0)
  {
    this->addCloud(origin->globalCloud, origin->global);
  }
  table_.comment(lineOf(number, *origin));
}

void RecordingWriter::addScene(const ServoSample& sample)
{
  RecordedEvent event;
  event.tick = sample.tick;
  if (sample.scene != 0)
  {
    const PublishedScene* scene = inUse(published_.scenes, sample.scene);
    if (!scene)
    {
      this->end("a scene was felt of which nobody knows how it was made");
      return;
    }
    this->addCloud(scene->cloud, scene->origin);
    event.number = scene->cloud;
    event.model = scene->modelToWorkspace;
    if (scene->fallbackCloud != 0)
    {
      this->addCloud(scene->fallbackCloud, scene->fallbackOrigin);
      event.fallback = scene->fallbackCloud;
    }
  }
  table_.comment(lineOf(event));
}

void RecordingWriter::addParameters(const ServoSample& sample)
{
  const PublishedParameters* parameters = inUse(published_.parameters, sample.parameters);
  if (!parameters)
  {
    this->end("parameters were in force that nobody knows");
    return;
  }
  table_.comment(lineOf(parameters->number, parameters->parameters));
  RecordedEvent event;
  event.tick = sample.tick;
  event.kind = RecordedEvent::Kind::Parameters;
  event.number = parameters->number;
  table_.comment(lineOf(event));
}

void RecordingWriter::addEvents(const ServoSample& sample)
{
  using Kind = RecordedEvent::Kind;
  const bool isFirst = numberOfTicks_ == 0;
  const std::uint32_t flags = sample.tickFlags;
  const bool writing = !(flags & kTickStepped) || sample.device == Status::Ok;
  if (isFirst)
  {
    lastFlags_ = kTickStepped;
    lastWriting_ = true;
  }
  else if (flags & kTickBegins)
  {
    this->addEvent(sample.tick, Kind::Begins);
  }
  const auto changes = [&](std::uint32_t bit) { return ((flags ^ lastFlags_) & bit) != 0; };
  if (changes(kTickClutched))
  {
    this->addEvent(sample.tick, Kind::Clutch, (flags & kTickClutched) != 0);
  }
  if (changes(kTickGateClosed))
  {
    this->addEvent(sample.tick, Kind::Gate, (flags & kTickGateClosed) == 0);
  }
  if (changes(kTickStepped))
  {
    this->addEvent(sample.tick, Kind::Reading, (flags & kTickStepped) != 0);
  }
  if (writing != lastWriting_)
  {
    this->addEvent(sample.tick, Kind::Writing, writing);
  }
  if (flags & kTickNewHand)
  {
    this->addEvent(sample.tick, Kind::NewHand);
  }
  if (flags & kTickNonFinite)
  {
    this->addEvent(sample.tick, Kind::NoPosition);
  }
  lastFlags_ = flags;
  lastWriting_ = writing;
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
  const auto felt = feltRow(sample.timeSeconds, sample.state, 1e6 * sample.updateSeconds);
  std::copy(felt.begin(), felt.end(), row_.begin());
  row_[kFelt] = double(sample.buttons);
  hasRow_ = true;
  ++numberOfTicks_;
}

/// The newest row, with the newest marker of those set until @p marksUntil.
void RecordingWriter::writeRow(std::uint64_t marksUntil)
{
  if (!hasRow_)
  {
    return;
  }
  hasRow_ = false;
  std::uint32_t marker = 0;
  for (; !marks_.empty() && marks_.front() <= marksUntil; marks_.pop_front())
  {
    marker = markers_ - std::uint32_t(marks_.size()) + 1;
  }
  for (; !labels_.empty() && labels_.front().marker <= marker; labels_.pop_front())
  {
    table_.comment(lineOf(labels_.front()));
  }
  row_[kFelt + 1] = double(marker);
  table_.row(row_.data(), row_.size());
}

bool RecordingWriter::close(std::string& message)
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
  this->writeRow(std::numeric_limits<std::uint64_t>::max());
  table_.comment(fmt::format("{}: {} ticks", kRecordingEnd, numberOfTicks_));
  return table_.commit(message);
}

} // namespace pointhaptics
