#include "RecordingLines.h"
#include "VirtualTouch.h"

#include "Core/Base/OutputFile.h"

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
  std::string result = text.substr(0, kLongestQuote);
  std::replace_if(
    result.begin(), result.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
  return "\"" + result + (text.size() > kLongestQuote ? "..." : "") + "\"";
}

/// Takes the lines of a file, one after the other, into a recording.
struct Reader
{
  Recording& recording;
  std::string problem = {}; ///< Why a function returned false.
  std::uint64_t lines = 0;
  int version = 0; ///< 0: not known yet.
  bool hasColumns = false;
  bool isEnded = false;

  /// An empty line ends the rows.
  bool take(const std::string& line);
  /// True if the file may be cut after the lines taken so far: it is one that was written as it was felt, has
  /// a tick, and no end.
  bool mayBeCut() const { return version > 1 && !isEnded && !recording.ticks.empty(); }
  /// Once all lines were taken.
  bool finish();

private:
  bool fail(const std::string& why)
  {
    problem = problem.empty() ? why : problem;
    return false;
  }
  /// Refuses a header that somebody has changed.
  bool failUnless(bool isRead, const std::string& text, const char* why)
  {
    return isRead || this->fail(quote(text) + ": " + why + "; take the header as it was written");
  }
  bool takeHeader(const std::string& text);
  bool takeMade(std::uint64_t number, const std::string& text);
  bool takeEvent(std::uint64_t tick, const std::string& text);
  bool takeRow(const std::string& text);
};

bool Reader::take(const std::string& line)
{
  ++lines;
  if (line.size() > kLongestLine)
  {
    return this->fail("the line is too long: is this a text file?");
  }
  const bool isHeader = !line.empty() && line.front() == '#';
  if (version == 0 && (isHeader || hasColumns || line != recordedColumns()))
  {
    version = line == "# pointhaptics recording: 1" ? 1 : line == "# pointhaptics recording: 2" ? 2 : 0;
    return version > 0 ||
      this->fail(line.rfind("# pointhaptics recording", 0) == 0
          ? quote(line) + " is of another version: use the program that wrote it"
          : (hasColumns ? "the second line is " : "the first line is ") + quote(line) +
            ": this is no recording; give what --record wrote, or follow other tables by --path");
  }
  if (isHeader)
  {
    return this->takeHeader(line.substr(std::min(line.find_first_not_of("# "), line.size())));
  }
  if (hasColumns)
  {
    return this->takeRow(line);
  }
  hasColumns = line == recordedColumns();
  return hasColumns || this->fail("the columns are " + quote(line) + ": they must be " + recordedColumns());
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
    return this->failUnless(false, text, "a number is missing");
  }
  RecordingHeader& header = recording.header;
  isEnded = isEnded || key == kRecordingEnd;
  if (key == "file" || key == "program" || key == "settings")
  {
    (key == "file"         ? header.cloud.files.emplace_back()
        : key == "program" ? header.program
                           : header.settings) = rest;
  }
  keyed::Line line = keyed::Line::from(rest);
  if (key == "cloud")
  {
    describe(line, header.cloud);
    return this->failUnless(line.isFine(), text, "points, checksum or resolution is missing");
  }
  if (key == "servo")
  {
    const ServoStepSettings& step = header.step;
    describe(line, header.step);
    return this->failUnless(
      line.isFine() && step.rateHz >= 1.0 && step.rateHz <= 1e5 && step.limits.check() == Status::Ok, text,
      "a servo setting is missing or out of range");
  }
  if (key == "parameters")
  {
    HapticParameters& parameters = recording.parameters[number];
    line.settings(parameters);
    return this->failUnless(
      line.isFine() && parameters.check() == Status::Ok, line.text(), "no such parameters");
  }
  return key == "made" ? this->takeMade(number, rest)
    : key == "tick"    ? this->takeEvent(number, rest)
                       : true; // other lines are remarks
}

bool Reader::takeMade(std::uint64_t number, const std::string& text)
{
  keyed::Line line = keyed::Line::from(text);
  auto origin = std::make_shared<SceneOrigin>();
  bool isRead = describe(line, *origin) && line.isFine() && number > 0 && recording.clouds.count(number) == 0;
  VoxelMeanSettings& voxels = origin->voxels;
  isRead = isRead && voxels.outputPointsPrecision <= PointsPrecision::OfInput &&
    voxels.representative == Representative::Mean;
  voxels.instructionSet = InstructionSet::Automatic; // the bits are the same
  voxels.computeVoxelIndex = voxels.keepOriginalPointIds = false;
  if (isRead && origin->isLocal())
  {
    const auto global = recording.clouds.find(origin->globalCloud);
    isRead = !origin->hand.empty() && global != recording.clouds.end() && !global->second->isLocal();
    origin->global = isRead ? global->second : nullptr;
  }
  const auto& bandwidth = origin->bandwidth;
  isRead = isRead &&
    (!bandwidth || (bandwidth->rule <= BandwidthRule::SheatherJones && bandwidth->check() == Status::Ok));
  recording.clouds[number] = origin;
  return this->failUnless(isRead, line.text(), "no such scene");
}

/// "scene", "parameters" or a flag, with what it says.
bool Reader::takeEvent(std::uint64_t tick, const std::string& text)
{
  const std::size_t blank = std::min(text.find(' '), text.size());
  const std::string name = text.substr(0, blank);
  const std::string rest = text.substr(std::min(blank + 1, text.size()));
  RecordedEvent event;
  event.tick = tick;
  bool isRead = recording.events.empty() || recording.events.back().tick <= tick;
  if (name == "scene" && rest != "none")
  {
    keyed::Line line = keyed::Line::from(rest);
    describe(line, event);
    const auto cloud = recording.clouds.find(event.number);
    isRead = isRead && line.isFine() && cloud != recording.clouds.end();
    event.fallback = isRead && !cloud->second->isLocal() ? 0 : event.fallback; // a region had one
    isRead = isRead && cloud->second->globalCloud == event.fallback;
  }
  else if (name == "parameters")
  {
    event.kind = RecordedEvent::Kind::Parameters;
    isRead = isRead && keyed::parse(rest, event.number) && recording.parameters.count(event.number) == 1;
  }
  else if (name != "scene")
  {
    const auto flag = std::find_if(kRecordedFlags.begin(), kRecordedFlags.end(),
      [&name](const RecordedFlag& each) { return name == each.name; });
    event.kind = RecordedEvent::Kind::Flag;
    isRead = isRead && flag != kRecordedFlags.end() && (flag->isOnce || rest == "on" || rest == "off");
    event.flag = isRead ? flag->bit : 0;
    event.isSet = isRead && (flag->isOnce || (rest == "on") == flag->isOnWhereSet);
  }
  recording.events.push_back(event);
  return this->failUnless(isRead, text, "no such event, or not after the one before");
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
  const double tick = std::round(numbers[0] * recording.header.step.rateHz) + 1.0;
  const auto isCount = [](double number) { return number >= 0.0 && number <= 4294967295.0; };
  if (!(tick >= 1.0 && tick < 1e15 && isFinite(row.hip()) && isFinite(row.force()) &&
        isCount(numbers[kFelt]) && isCount(numbers[kFelt + 1])))
  {
    return this->fail(
      quote(text) + ": time, place, force, buttons or marker is out of range; remove the row");
  }
  if (recording.ticks.empty() &&
    std::none_of(recording.events.begin(), recording.events.end(),
      [](const RecordedEvent& event) { return event.kind == RecordedEvent::Kind::Parameters; }))
  {
    return this->fail("no parameters are in force at the first row; take the header as it was written");
  }
  row.tick = std::uint64_t(tick);
  row.buttons = std::uint32_t(numbers[kFelt]);
  row.marker = std::uint32_t(numbers[kFelt + 1]);
  if (!recording.ticks.empty() && row.tick <= recording.ticks.back().tick)
  {
    return this->fail(
      "time " + keyed::textOf(numbers[0]) + " is not after the one before it; sort the rows by time");
  }
  recording.ticks.push_back(row);
  return true;
}

bool Reader::finish()
{
  const RecordedFiles& cloud = recording.header.cloud;
  const char* lack = recording.ticks.empty() ? "there is no row; record some ticks"
    : cloud.files.empty() || cloud.points == 0
    ? "the header names no cloud; take the header as it was written"
    : nullptr;
  if (this->mayBeCut())
  {
    recording.note = fmt::format(
      "it was not ended: the program stopped, or still writes it; its {} ticks until {:.3f} s are taken",
      recording.ticks.size(), recording.ticks.back().felt[0]);
  }
  return !lack || this->fail(lack);
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
    const std::string missed = OutputFile::missedPart(fileName);
    message =
      fileName + ": " + (missed.empty() ? "cannot be opened; check the name and its permissions" : missed);
    return false;
  }
  Reader reader{ recording };
  std::string line;
  bool isFine = true;
  while (isFine && !(isHeaderAlone && !recording.ticks.empty()) && std::getline(stream, line) &&
    !(stream.eof() && reader.mayBeCut())) // a line without an end is left out
  {
    line.erase(line.size() - (!line.empty() && line.back() == '\r' ? 1 : 0));
    isFine = reader.take(line);
  }
  isFine = isFine && (reader.lines > 0 || reader.take("")) && reader.finish();
  if (!isFine)
  {
    recording = Recording();
    message = fmt::format("{}:{}: {}", fileName, reader.lines, reader.problem);
  }
  return isFine;
}

} // namespace pointhaptics
