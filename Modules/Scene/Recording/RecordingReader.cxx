#include "RecordingLines.h"
#include "VirtualTouch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace pointhaptics
{
namespace
{

/// Longest line: of the settings.
constexpr std::size_t kLongestLine = 1 << 20;
constexpr std::size_t kLongestQuote = 60;

std::string quote(const std::string& text)
{
  std::string result;
  for (const char c : text.substr(0, kLongestQuote))
  {
    result += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  }
  return "\"" + result + (text.size() > kLongestQuote ? "..." : "") + "\"";
}

/// Whether a scene of @p origin may have such a fallback: a part has one, unless it was made before there was
/// a whole.
bool mayEnd(const SceneOrigin& origin, std::uint64_t fallback)
{
  const bool isWhole = origin.kind == SceneOrigin::Kind::Whole;
  return isWhole ? fallback == 0 : fallback != 0 || origin.globalCloud == 0;
}

class Reader
{
public:
  explicit Reader(Recording& recording)
    : recording_(recording)
  {
  }
  /// False: problem() says why. An empty line ends the rows.
  bool take(const std::string& line);
  /// True if the file may be cut after the lines taken so far: it is one that was written as it was felt, has
  /// a tick, and no end.
  bool mayBeCut() const { return version_ > 1 && !isEnded_ && !recording_.ticks.empty(); }
  /// Once all lines were taken.
  bool finish();
  const std::string& problem() const { return problem_; }
  std::uint64_t line() const { return line_; }

private:
  bool fail(const std::string& problem)
  {
    problem_ = problem_.empty() ? problem : problem_;
    return false;
  }
  bool takeHeader(const std::string& text);
  bool takeMade(std::uint64_t number, const std::string& text);
  bool takeEvent(std::uint64_t tick, const std::string& text);
  bool takeRow(const std::string& text);

  Recording& recording_;
  std::string problem_;
  std::uint64_t line_ = 0;
  int version_ = 0; ///< 0: not known yet.
  bool hasColumns_ = false;
  bool isEnded_ = false;
};

bool Reader::take(const std::string& line)
{
  ++line_;
  if (line.size() > kLongestLine)
  {
    return this->fail("the line is too long: is this a text file?");
  }
  const bool isHeader = !line.empty() && line.front() == '#';
  if (version_ == 0 && (isHeader || hasColumns_ || line != recordedColumns()))
  {
    version_ = line == "# pointhaptics recording: 1" ? 1 : line == "# pointhaptics recording: 2" ? 2 : 0;
    return version_ > 0 ||
      this->fail(line.rfind("# pointhaptics recording", 0) == 0
          ? quote(line) + " is of another version: use the program that wrote it"
          : (hasColumns_ ? "the second line is " : "the first line is ") + quote(line) +
            ": this is no recording; give what --record wrote, or follow other tables by --path");
  }
  if (isHeader)
  {
    return this->takeHeader(line.substr(std::min(line.find_first_not_of("# "), line.size())));
  }
  if (!hasColumns_)
  {
    hasColumns_ = line == recordedColumns();
    return hasColumns_ ||
      this->fail("the columns are " + quote(line) + ": they must be " + recordedColumns());
  }
  return this->takeRow(line);
}

/// KEY: TEXT, or KEY NUMBER: TEXT.
bool Reader::takeHeader(const std::string& text)
{
  const std::size_t colon = text.find(": ");
  const std::string head = text.substr(0, colon);
  const std::string rest = colon == std::string::npos ? std::string() : text.substr(colon + 2);
  const std::size_t blank = head.find(' ');
  const std::string key = head.substr(0, blank);
  std::uint64_t number = 0;
  if (blank != std::string::npos && !keyed::parse(head.substr(blank + 1), number))
  {
    return this->fail(quote(text) + ": a number is missing; take the header as it was written");
  }
  RecordingHeader& header = recording_.header;
  isEnded_ = isEnded_ || key == kRecordingEnd;
  if (key == "file" || key == "marker" || key == "program" || key == "settings")
  {
    (key == "file"         ? header.cloud.files.emplace_back()
        : key == "marker"  ? recording_.labels[std::uint32_t(number)]
        : key == "program" ? header.program
                           : header.settings) = rest;
    return true;
  }
  keyed::Line line = keyed::Line::from(rest);
  if (key == "cloud")
  {
    describe(line, header.cloud);
    return line.isFine() ||
      this->fail(
        quote(text) + ": points, checksum or resolution is missing; take the header as it was written");
  }
  if (key == "servo")
  {
    const ServoStepSettings& step = header.step;
    describe(line, header.step);
    return (line.isFine() && step.rateHz >= 1.0 && step.rateHz <= 1e5 && step.limits.check() == Status::Ok) ||
      this->fail(
        quote(text) + ": a servo setting is missing or out of range; take the header as it was written");
  }
  if (key == "made")
  {
    return this->takeMade(number, rest);
  }
  if (key == "parameters")
  {
    HapticParameters& parameters = recording_.parameters[number];
    line.settings(parameters);
    return (line.isFine() && parameters.check() == Status::Ok) ||
      this->fail(quote(line.text()) + ": no such parameters; take them as they were written");
  }
  return key == "tick" ? this->takeEvent(number, rest) : true; // other lines are remarks
}

bool Reader::takeMade(std::uint64_t number, const std::string& text)
{
  keyed::Line line = keyed::Line::from(text);
  auto origin = std::make_shared<SceneOrigin>();
  bool isRead =
    describe(line, *origin) && line.isFine() && number > 0 && recording_.clouds.count(number) == 0;
  VoxelMeanSettings& voxels = origin->voxels;
  isRead = isRead && voxels.outputPointsPrecision <= PointsPrecision::OfInput &&
    voxels.representative == Representative::Mean;
  voxels.instructionSet = InstructionSet::Automatic; // the bits are the same
  voxels.computeVoxelIndex = voxels.keepOriginalPointIds = false;
  if (isRead && origin->kind != SceneOrigin::Kind::Whole)
  {
    const auto global = recording_.clouds.find(origin->globalCloud);
    const bool isAlone = origin->globalCloud == 0 && origin->kind == SceneOrigin::Kind::Region;
    isRead = !origin->hand.empty() &&
      (isAlone || (global != recording_.clouds.end() && global->second->kind == SceneOrigin::Kind::Whole));
    origin->global = isRead && !isAlone ? global->second : nullptr;
  }
  isRead = isRead &&
    (!origin->bandwidth ||
      (origin->bandwidth->rule <= BandwidthRule::SheatherJones && origin->bandwidth->check() == Status::Ok));
  recording_.clouds[number] = origin;
  return isRead || this->fail(quote(line.text()) + ": no such scene; take the header as it was written");
}

/// "scene", "parameters" or a flag, with what it says.
bool Reader::takeEvent(std::uint64_t tick, const std::string& text)
{
  const std::size_t blank = std::min(text.find(' '), text.size());
  const std::string name = text.substr(0, blank);
  const std::string rest = text.substr(std::min(blank + 1, text.size()));
  const auto flag = std::find_if(kRecordedFlags.begin(), kRecordedFlags.end(),
    [&name](const RecordedFlag& each) { return name == each.name; });
  const auto& clouds = recording_.clouds;
  RecordedEvent event;
  event.tick = tick;
  bool isRead = recording_.events.empty() || recording_.events.back().tick <= tick;
  if (name == "scene" && rest != "none")
  {
    keyed::Line line = keyed::Line::from(rest);
    describe(line, event);
    const auto cloud = clouds.find(event.number);
    const auto fallback = clouds.find(event.fallback);
    isRead = isRead && line.isFine() && cloud != clouds.end() && mayEnd(*cloud->second, event.fallback) &&
      (event.fallback == 0 ||
        (fallback != clouds.end() && fallback->second->kind == SceneOrigin::Kind::Whole));
  }
  else if (name == "parameters")
  {
    event.kind = RecordedEvent::Kind::Parameters;
    isRead = isRead && keyed::parse(rest, event.number) && recording_.parameters.count(event.number) == 1;
  }
  else if (name != "scene")
  {
    event.kind = RecordedEvent::Kind::Flag;
    isRead = isRead && flag != kRecordedFlags.end() && (flag->isOnce || rest == "on" || rest == "off");
    event.flag = isRead ? flag->bit : 0;
    event.isSet = isRead && (flag->isOnce || (rest == "on") == flag->isOnWhereSet);
  }
  recording_.events.push_back(event);
  return isRead ||
    this->fail(
      quote(text) + ": no such event, or not after the one before; take the header as it was written");
}

bool Reader::takeRow(const std::string& text)
{
  constexpr std::size_t kFelt = kFeltColumns.size();
  RecordedTick row;
  double numbers[kFelt + 2];
  if (!keyed::parseNumbers(text, numbers, kFelt + 2))
  {
    return this->fail(fmt::format("{}: {} numbers are needed, none of them NaN; was the end cut off? "
                                  "remove the rows that are not whole",
      quote(text), kFelt + 2));
  }
  std::copy(numbers, numbers + kFelt, row.felt.begin());
  const double tick = std::round(numbers[0] * recording_.header.step.rateHz) + 1.0;
  constexpr double kMostCount = 4294967295.0;
  const bool isFine = tick >= 1.0 && tick < 1e15 && isFinite(row.hip()) && isFinite(row.force()) &&
    numbers[kFelt] >= 0.0 && numbers[kFelt] <= kMostCount && numbers[kFelt + 1] >= 0.0 &&
    numbers[kFelt + 1] <= kMostCount;
  if (!isFine)
  {
    return this->fail(
      quote(text) + ": time, place, force, buttons or marker is out of range; remove the row");
  }
  const auto isParameters = [](const RecordedEvent& event)
  { return event.kind == RecordedEvent::Kind::Parameters; };
  if (recording_.ticks.empty() &&
    std::none_of(recording_.events.begin(), recording_.events.end(), isParameters))
  {
    return this->fail("no parameters are in force at the first row; take the header as it was written");
  }
  row.tick = std::uint64_t(tick);
  row.buttons = std::uint32_t(numbers[kFelt]);
  row.marker = std::uint32_t(numbers[kFelt + 1]);
  if (!recording_.ticks.empty() && row.tick <= recording_.ticks.back().tick)
  {
    return this->fail(fmt::format(
      "time {} is not after the one before it; sort the rows by time", keyed::textOf(numbers[0])));
  }
  recording_.ticks.push_back(row);
  return true;
}

bool Reader::finish()
{
  const RecordedFiles& cloud = recording_.header.cloud;
  const char* lack = recording_.ticks.empty() ? "there is no row; record some ticks"
    : cloud.files.empty() || cloud.points == 0
    ? "the header names no cloud; take the header as it was written"
    : recording_.parameters.empty() ? "the header has no parameters; take the header as it was written"
                                    : nullptr;
  if (lack)
  {
    return this->fail(lack);
  }
  if (this->mayBeCut())
  {
    recording_.note =
      fmt::format("it was not ended: the program stopped, or still writes it; its {} ticks until {:.3f} s "
                  "are taken",
        recording_.ticks.size(), recording_.ticks.back().felt[0]);
  }
  return true;
}

} // namespace

bool readRecording(
  const std::string& fileName, Recording& recording, std::string& message, bool isHeaderAlone)
{
  recording = Recording();
  std::error_code ignored;
  std::ifstream stream(fileName, std::ios::binary);
  if (!stream || std::filesystem::is_directory(fileName, ignored))
  {
    message = fileName + ": cannot be opened; check the name and its permissions";
    return false;
  }
  Reader reader(recording);
  std::string line;
  bool isFine = true;
  while (isFine && !(isHeaderAlone && !recording.ticks.empty()) && std::getline(stream, line))
  {
    if (stream.eof() && reader.mayBeCut())
    {
      break; // the line has no end
    }
    if (!line.empty() && line.back() == '\r')
    {
      line.pop_back();
    }
    isFine = reader.take(line);
  }
  isFine = isFine && (reader.line() > 0 || reader.take("")) && reader.finish();
  if (!isFine)
  {
    recording = Recording();
    message = fmt::format("{}:{}: {}", fileName, reader.line(), reader.problem());
  }
  return isFine;
}

} // namespace pointhaptics
