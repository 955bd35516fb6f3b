#include "KeyedText.h"
#include "Recording.h"
#include "VirtualTouch.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

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

bool startsWith(const std::string& text, const std::string& with)
{
  return text.rfind(with, 0) == 0;
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
  bool takeCloud(const std::string& text);
  bool takeServo(const std::string& text);
  bool takeMade(std::uint64_t number, const std::string& text);
  bool takeVoxels(const keyed::Words& words, SceneOrigin& origin, std::string& wrong);
  bool takeEvent(std::uint64_t tick, const std::string& text);
  bool takeRow(const std::string& text);

  Recording& recording_;
  std::map<std::uint64_t, std::shared_ptr<SceneOrigin>> made_;
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
  const bool isHeader = startsWith(line, "#");
  if (version_ == 0 && (isHeader || hasColumns_ || line != recordedColumns()))
  {
    version_ = line == "# pointhaptics recording: 1" ? 1 : line == "# pointhaptics recording: 2" ? 2 : 0;
    return version_ > 0 ||
      this->fail(startsWith(line, "# pointhaptics recording")
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
  if (key == "file")
  {
    recording_.header.cloud.files.push_back(rest);
    return true;
  }
  if (key == "marker")
  {
    recording_.labels.push_back({ std::uint32_t(number), rest });
    return true;
  }
  isEnded_ = isEnded_ || key == kRecordingEnd;
  if (key == "program" || key == "settings")
  {
    (key == "program" ? recording_.header.program : recording_.header.settings) = rest;
    return true;
  }
  if (key == "cloud" || key == "servo")
  {
    return key == "cloud" ? this->takeCloud(rest) : this->takeServo(rest);
  }
  if (key == "made")
  {
    return this->takeMade(number, rest);
  }
  if (key == "parameters")
  {
    keyed::Words words;
    HapticParameters& parameters = recording_.parameters[number];
    std::string wrong;
    return (keyed::split(rest, words) && keyed::takeWords(words, parameters, wrong) &&
             parameters.check() == Status::Ok) ||
      this->fail(
        quote(wrong.empty() ? text : wrong) + ": no such parameters; take them as they were written");
  }
  return key == "tick" ? this->takeEvent(number, rest) : true; // other lines are remarks
}

bool Reader::takeCloud(const std::string& text)
{
  keyed::Words words;
  RecordedFiles& cloud = recording_.header.cloud;
  const bool isSplit = keyed::split(text, words);
  const std::string& sum = words["checksum"];
  const auto end = std::from_chars(sum.data(), sum.data() + sum.size(), cloud.checksum, 16);
  return (isSplit && end.ec == std::errc() && end.ptr == sum.data() + sum.size() &&
           keyed::parse(words["points"], cloud.points) &&
           keyed::fromText(words["resolution"], cloud.resolution)) ||
    this->fail(
      quote(text) + ": points, checksum or resolution is missing; take the header as it was written");
}

bool Reader::takeServo(const std::string& text)
{
  keyed::Words words;
  ServoStepSettings& step = recording_.header.step;
  const bool isRead = keyed::split(text, words) && keyed::fromText(words["rate"], step.rateHz) &&
    keyed::fromText(words["maximumForce"], step.limits.maximumForce) &&
    keyed::fromText(words["maximumSlewRate"], step.limits.maximumSlewRate) &&
    keyed::fromText(words["rampDown"], step.rampDownSeconds) &&
    keyed::fromText(words["rampUp"], step.rampUpSeconds) &&
    keyed::fromText(words["clutchDown"], step.clutchDownSeconds) &&
    keyed::fromText(words["clutchUp"], step.clutchUpSeconds);
  return (isRead && step.rateHz >= 1.0 && step.rateHz <= 1e5 && step.limits.check() == Status::Ok) ||
    this->fail(
      quote(text) + ": a servo setting is missing or out of range; take the header as it was written");
}

/// What a scene is made of: means, and one level of them.
bool Reader::takeVoxels(const keyed::Words& words, SceneOrigin& origin, std::string& wrong)
{
  VoxelMeanSettings& voxels = origin.voxels;
  if (words.at("kind") == kSceneOrigins[std::size_t(SceneOrigin::Kind::Fine)])
  {
    return keyed::takeWords(words, voxels.lattice, wrong, "lattice.");
  }
  const bool isRead = keyed::takeWords(words, voxels, wrong) &&
    voxels.outputPointsPrecision <= PointsPrecision::OfInput && voxels.representative == Representative::Mean;
  voxels.instructionSet = InstructionSet::Automatic; // the bits are the same
  voxels.computeVoxelIndex = voxels.keepOriginalPointIds = false;
  return isRead;
}

bool Reader::takeMade(std::uint64_t number, const std::string& text)
{
  keyed::Words words;
  auto origin = std::make_shared<SceneOrigin>();
  std::string wrong;
  bool isRead = keyed::split(text, words) && number > 0 && made_.count(number) == 0;
  const auto kind = std::find(std::begin(kSceneOrigins), std::end(kSceneOrigins), words["kind"]);
  isRead = isRead && kind != std::end(kSceneOrigins) &&
    keyed::fromText(words["model"], origin->modelToWorkspace) &&
    keyed::fromText(words["covariance"], origin->useCovariance) && this->takeVoxels(words, *origin, wrong);
  origin->kind = isRead ? SceneOrigin::Kind(kind - std::begin(kSceneOrigins)) : SceneOrigin::Kind::Whole;
  if (isRead && origin->kind != SceneOrigin::Kind::Whole)
  {
    isRead = keyed::parse(words["beside"], origin->globalCloud) &&
      keyed::fromText(words["hand"], origin->hand) && !origin->hand.empty();
    const bool isAlone = origin->globalCloud == 0 && origin->kind == SceneOrigin::Kind::Region;
    isRead = isRead && (isAlone || made_.count(origin->globalCloud) == 1);
    origin->global = isRead && !isAlone ? made_[origin->globalCloud] : nullptr;
    isRead = isRead && (isAlone || origin->global->kind == SceneOrigin::Kind::Whole);
  }
  if (isRead && words.lower_bound("bandwidth.") != words.lower_bound("bandwidth/"))
  {
    origin->bandwidth.emplace();
    isRead = keyed::takeWords(words, *origin->bandwidth, wrong, "bandwidth.") &&
      origin->bandwidth->rule <= BandwidthRule::SheatherJones && origin->bandwidth->check() == Status::Ok;
  }
  made_[number] = origin;
  recording_.clouds[number] = origin;
  return isRead ||
    this->fail(quote(wrong.empty() ? text : wrong) + ": no such scene; take the header as it was written");
}

bool Reader::takeEvent(std::uint64_t tick, const std::string& text)
{
  using Kind = RecordedEvent::Kind;
  const std::size_t blank = std::min(text.find(' '), text.size());
  const auto kind = std::find(std::begin(kEventKinds), std::end(kEventKinds), text.substr(0, blank));
  const std::string rest = text.substr(std::min(blank + 1, text.size()));
  if (kind == std::end(kEventKinds))
  {
    return this->fail(quote(text) + ": no such event; take the header as it was written");
  }
  RecordedEvent event;
  event.tick = tick;
  event.kind = Kind(kind - std::begin(kEventKinds));
  bool isRead = recording_.events.empty() || recording_.events.back().tick <= tick;
  if (event.kind == Kind::Scene && rest != "none")
  {
    keyed::Words words;
    isRead = isRead && keyed::split(rest, words) && keyed::parse(words["of"], event.number) &&
      keyed::parse(words["beyond"], event.fallback) && keyed::fromText(words["model"], event.model) &&
      recording_.clouds.count(event.number) == 1 &&
      mayEnd(*recording_.clouds[event.number], event.fallback) &&
      (event.fallback == 0 ||
        (recording_.clouds.count(event.fallback) == 1 &&
          recording_.clouds[event.fallback]->kind == SceneOrigin::Kind::Whole));
  }
  else if (event.kind == Kind::Parameters)
  {
    isRead = isRead && keyed::parse(rest, event.number) && recording_.parameters.count(event.number) == 1;
  }
  else if (event.kind >= Kind::Clutch && event.kind <= Kind::Writing)
  {
    event.on = rest == "on";
    isRead = isRead && (event.on || rest == "off");
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
  if (recording_.ticks.empty())
  {
    return this->fail("there is no row; record some ticks");
  }
  if (recording_.header.cloud.files.empty() || recording_.header.cloud.points == 0)
  {
    return this->fail("the header names no cloud; take the header as it was written");
  }
  if (recording_.parameters.empty())
  {
    return this->fail("the header has no parameters; take the header as it was written");
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

namespace
{

/// Takes all lines, or where @p isHeaderAlone those before the first tick.
bool readLines(const std::string& fileName, bool isHeaderAlone, Recording& recording, std::string& message)
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

} // namespace

bool readRecording(const std::string& fileName, Recording& recording, std::string& message)
{
  return readLines(fileName, false, recording, message);
}

bool readRecordingHeader(const std::string& fileName, RecordingHeader& header, std::string& message)
{
  Recording recording;
  const bool isRead = readLines(fileName, true, recording, message);
  header = recording.header;
  return isRead;
}

} // namespace pointhaptics
