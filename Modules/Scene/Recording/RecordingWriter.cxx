#include "RecordingWriter.h"

#include "VirtualTouch.h"

#include "Core/Base/OutputFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <limits>

namespace pointhaptics
{
namespace
{

constexpr std::size_t kCopied = 1 << 20;

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

template <typename Number>
void appendCell(std::string& row, Number value)
{
  char text[40];
  row.append(text, std::to_chars(text, text + sizeof text, value).ptr);
  row += ',';
}

} // namespace

bool RecordingWriter::open(const std::string& fileName, const RecordingHeader& header, std::string& message)
{
  OutputFile file; // whether it can be written is to be known before
  if (file.open(fileName) != Status::Ok)
  {
    message = fmt::format("{}: cannot be created: {}; {}", fileName, file.reason(), file.cure());
    return false;
  }
  rows_.reset(std::tmpfile());
  if (!rows_)
  {
    message =
      fmt::format("{}: no temporary file can be made; free some space in the temporary folder", fileName);
    return false;
  }
  fileName_ = fileName;
  header_ = header;
  lines_.clear();
  clouds_.clear();
  row_.clear();
  marks_.clear();
  markers_ = 0;
  numberOfTicks_ = 0;
  problem_.clear();
  return true;
}

std::uint32_t RecordingWriter::mark(std::uint64_t tick)
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
  lines_ += "# " + lineOf(event) + "\n";
}

void RecordingWriter::addCloud(std::uint64_t number, const std::shared_ptr<const SceneOrigin>& origin)
{
  if (!origin)
  {
    this->end("a scene was felt of which nobody knows how it was made");
    return;
  }
  if (clouds_[number])
  {
    return;
  }
  clouds_[number] = true;
  if (origin->globalCloud != 0)
  {
    this->addCloud(origin->globalCloud, origin->global);
  }
  lines_ += "# " + lineOf(number, *origin) + "\n";
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
  lines_ += "# " + lineOf(event) + "\n";
}

void RecordingWriter::addParameters(const ServoSample& sample)
{
  const PublishedParameters* parameters = inUse(published_.parameters, sample.parameters);
  if (!parameters)
  {
    this->end("parameters were in force that nobody knows");
    return;
  }
  lines_ += "# " + lineOf(parameters->number, parameters->parameters) + "\n";
  RecordedEvent event;
  event.tick = sample.tick;
  event.kind = RecordedEvent::Kind::Parameters;
  event.number = parameters->number;
  lines_ += "# " + lineOf(event) + "\n";
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
  this->addEvents(sample);
  if (!problem_.empty())
  {
    return;
  }
  this->writeRow(last_.tick);
  const auto felt = feltRow(sample.timeSeconds, sample.state, 1e6 * sample.updateSeconds);
  for (const double value : felt)
  {
    appendCell(row_, value);
  }
  appendCell(row_, sample.buttons);
  ++numberOfTicks_;
}

/// The newest row, with the newest marker of those set until @p marksUntil.
void RecordingWriter::writeRow(std::uint64_t marksUntil)
{
  if (row_.empty())
  {
    return;
  }
  std::uint32_t marker = 0;
  for (; !marks_.empty() && marks_.front() <= marksUntil; marks_.pop_front())
  {
    marker = markers_ - std::uint32_t(marks_.size()) + 1;
  }
  appendCell(row_, marker);
  row_.back() = '\n';
  std::fwrite(row_.data(), 1, row_.size(), rows_.get()); // close() looks whether it failed
  row_.clear();
}

bool RecordingWriter::close(std::string& message)
{
  if (!this->isOpen())
  {
    return true;
  }
  this->writeRow(std::numeric_limits<std::uint64_t>::max());
  const std::unique_ptr<std::FILE, CloseFile> rows = std::move(rows_);
  if (numberOfTicks_ == 0)
  {
    message = fmt::format("{}: nothing was recorded: the hand did not let go of what it touched{}", fileName_,
      problem_.empty() ? "" : "; " + problem_);
    return false;
  }
  OutputFile file;
  if (file.open(fileName_) == Status::Ok)
  {
    for (const std::string& line : linesOf(header_))
    {
      static_cast<void>(file.write("# " + line + "\n"));
    }
    static_cast<void>(file.write(lines_ + recordedColumns() + "\n"));
    std::vector<char> bytes(kCopied);
    bool isWhole = std::fflush(rows.get()) == 0 && !std::ferror(rows.get());
    std::rewind(rows.get());
    while (const std::size_t count = std::fread(bytes.data(), 1, bytes.size(), rows.get()))
    {
      static_cast<void>(file.write({ bytes.data(), count }));
    }
    if (!isWhole || std::ferror(rows.get()))
    {
      message =
        fmt::format("{}: not all ticks could be kept: free some space in the temporary folder", fileName_);
      return false;
    }
  }
  if (file.commit() != Status::Ok)
  {
    message = fmt::format("{}: cannot be written: {}; {}", fileName_, file.reason(), file.cure());
    return false;
  }
  return true;
}

} // namespace pointhaptics
