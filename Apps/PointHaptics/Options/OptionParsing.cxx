#include "Options/OptionParsing.h"

#include "Options/SettingOptions.h"
#include "Terminal/Messages.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <set>

namespace pointhaptics::app
{
namespace
{

// "--voxel,-v" is called "--voxel" in messages.
std::string shownName(const std::string& name)
{
  const std::size_t longName = name.find("--");
  return longName == std::string::npos ? name : name.substr(longName, name.find(',', longName) - longName);
}

std::string describe(const NumberRange& range, const std::string& unit)
{
  return fmt::format("give a number {} {}{}{}", range.openMinimum ? "above" : "from", range.minimum,
    range.maximum < kUnbounded ? fmt::format(" and at most {}", range.maximum) : "",
    unit.empty() ? "" : " (" + unit + ")");
}

std::string describe(std::initializer_list<std::size_t> counts)
{
  return fmt::format("{}", fmt::join(counts, " or "));
}

} // namespace

bool parseNumber(const std::string& text, double& value)
{
  const char* begin = text.data();
  const char* const end = begin + text.size();
  if (begin != end && *begin == '+')
  {
    ++begin;
  }
  const std::from_chars_result result = std::from_chars(begin, end, value);
  return result.ec == std::errc() && result.ptr == end;
}

bool parseNumbers(const std::string& text, std::vector<double>& values)
{
  values.clear();
  for (std::size_t begin = 0; begin <= text.size();)
  {
    const std::size_t comma = std::min(text.find(',', begin), text.size());
    double value = 0.0;
    if (!parseNumber(text.substr(begin, comma - begin), value))
    {
      return false;
    }
    values.push_back(value);
    begin = comma + 1;
  }
  return true;
}

void requireUsage(
  bool isRight, const std::string& option, const std::string& value, const std::string& problem)
{
  if (!isRight)
  {
    throw CLI::ValidationError(option + (value.empty() ? "" : " " + value), problem);
  }
}

std::vector<std::pair<std::string, const CLI::Option*>> longNames(const CLI::App& command)
{
  std::vector<std::pair<std::string, const CLI::Option*>> names;
  for (const CLI::Option* option : command.get_options())
  {
    for (const std::string& name : option->get_lnames())
    {
      names.emplace_back(name, option);
    }
  }
  return names;
}

std::vector<std::string> givenOptions(const CLI::App& command)
{
  std::vector<std::string> names;
  for (const auto& [name, option] : longNames(command))
  {
    names.insert(names.end(), option->count() > 0 ? 1 : 0, name);
  }
  return names;
}

void refuseRecorded(const CLI::App& command, const std::vector<std::string>& given,
  const std::string& recording, const std::string& but)
{
  static const std::set<std::string> decided = { kTouchGroup, kLatticeGroup, kBandwidthGroup, "path",
    "path-unit", "path-time-unit", "record", "marker-text", "marker-socket", "device", "seconds", "max-force",
    "falcon-firmware", "rate", "fit", "raw", "no-covariance", "clip", "hide", "vertices", "columns",
    "salvage" };
  for (const std::string& name : given)
  {
    const bool isDecided =
      decided.count(name) > 0 || decided.count(command.get_option("--" + name)->get_group()) > 0;
    requireUsage(!isDecided || name == but, "--replay", recording,
      fmt::format("the hand goes where it went, with the settings of then; leave out --{}", name));
  }
}

void warnIdle(bool areIdle, const std::vector<std::string>& given, std::initializer_list<const char*> names,
  const std::string& why)
{
  for (const std::string name : names)
  {
    if (areIdle && std::find(given.begin(), given.end(), name) != given.end())
    {
      warn(fmt::format("--{} has no effect {}; leave it out", name, why));
    }
  }
}

OptionGroup::OptionGroup(CLI::App& command, const std::string& name)
  : command_(command)
{
  command_.option_defaults()->group(name);
}

OptionGroup::~OptionGroup()
{
  command_.option_defaults()->group("Options");
}

CLI::Option* addNumber(CLI::App& command, const std::string& name, double& value, const NumberRange& range,
  const std::string& unit, const std::string& description)
{
  const auto store = [&value, range, unit, shown = shownName(name)](const std::string& text)
  {
    double number = 0.0;
    requireUsage(parseNumber(text, number), shown, text, "not a number; " + describe(range, unit));
    requireUsage(range.holds(number), shown, text, "out of range; " + describe(range, unit));
    value = number;
  };
  return command.add_option_function<std::string>(name, store, description)
    ->type_name(unit.empty() ? "NUMBER" : unit);
}

CLI::Option* addSize(
  CLI::App& command, const std::string& name, int& width, int& height, const std::string& description)
{
  static constexpr int kSmallest = 16;
  static constexpr int kLargest = 16384;
  const auto isSize = [](int pixels) { return pixels >= kSmallest && pixels <= kLargest; };
  const auto store = [&width, &height, isSize, name](const std::string& text)
  {
    int given[2] = {};
    char rest = 0;
    const bool areTwo = std::sscanf(text.c_str(), "%dx%d%c", &given[0], &given[1], &rest) == 2;
    requireUsage(areTwo && isSize(given[0]) && isSize(given[1]), name, text,
      fmt::format("give WIDTHxHEIGHT in pixels, {} to {}", kSmallest, kLargest));
    width = given[0];
    height = given[1];
  };
  return command.add_option_function<std::string>(name, store, description)->type_name("WxH");
}

CLI::Option* addClip(CLI::App& command, std::vector<double>& box, const std::string& description)
{
  const auto check = [](const std::vector<double>& ends) // those of a flat cloud, too
  {
    const bool isBox = ends[0] <= ends[1] && ends[2] <= ends[3] && ends[4] <= ends[5];
    return isBox ? "" : "no box; a minimum must not be above its maximum";
  };
  return addNumbers(command, "--clip", box, { 6 }, check, "XMIN,XMAX,YMIN,YMAX,ZMIN,ZMAX", description);
}

void addReading(CLI::App& command, std::vector<std::string>& columns, bool& salvage)
{
  const auto keep = [&columns](const std::string& list) { columns = CLI::detail::split(list, ','); };
  command
    .add_option_function<std::string>("--columns", keep,
      "What the columns of a text are, such as id,x,y,z,-,intensity; - leaves one out. Default: what its "
      "header says, else a guess")
    ->type_name("NAMES");
  command.add_flag("--salvage", salvage, "Read a file that is cut as far as it goes");
}

void addSamples(CLI::App& command, std::int64_t& samples)
{
  addInteger(command, "--samples", samples, 1, 100000000,
    "Take so many points evenly on the faces of a mesh; default: its vertices");
}

void addVertices(CLI::App& command, bool& vertices)
{
  command.add_flag("--vertices", vertices,
    "Take the vertices of a mesh; default: 200,000 to 2,000,000 points on its faces, a quarter of an edge "
    "apart");
}

CLI::Option* addResolution(CLI::App& command, double& value)
{
  return addNumber(command, "--resolution", value, { 0.0, 1e30, true }, "UNITS",
    "Read a COPC file no finer than this distance between points; others are read whole");
}

CLI::Option* addInteger(CLI::App& command, const std::string& name, std::function<void(std::int64_t)> keep,
  std::int64_t minimum, std::int64_t maximum, const std::string& description)
{
  const auto store = [keep = std::move(keep), minimum, maximum, shown = shownName(name)](
                       const std::string& text)
  {
    double number = 0.0;
    const bool isWhole = parseNumber(text, number) && number == std::floor(number);
    requireUsage(isWhole && number >= double(minimum) && number <= double(maximum), shown, text,
      fmt::format("not a whole number in range; give one from {} to {}", minimum, maximum));
    keep(static_cast<std::int64_t>(number));
  };
  return command.add_option_function<std::string>(name, store, description)->type_name("N");
}

CLI::Option* addNumbers(CLI::App& command, const std::string& name,
  std::function<void(const std::vector<double>&)> keep, std::initializer_list<std::size_t> counts,
  NumbersCheck check, const std::string& form, const std::string& description)
{
  const auto store = [keep = std::move(keep), allowed = std::vector<std::size_t>(counts),
                       howMany = describe(counts), check = std::move(check),
                       shown = shownName(name)](const std::string& text)
  {
    std::vector<double> numbers;
    requireUsage(parseNumbers(text, numbers), shown, text,
      "not a list of numbers; give " + howMany + " separated by commas, without blanks");
    requireUsage(std::find(allowed.begin(), allowed.end(), numbers.size()) != allowed.end(), shown, text,
      fmt::format("{} numbers; give {} separated by commas", numbers.size(), howMany));
    const bool areFinite =
      std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
    requireUsage(areFinite, shown, text, "NaN or infinity; give finite numbers");
    const std::string problem = check ? check(numbers) : std::string();
    requireUsage(problem.empty(), shown, text, problem);
    keep(numbers);
  };
  return command.add_option_function<std::string>(name, store, description)->type_name(form);
}

CLI::Option* addNumbers(CLI::App& command, const std::string& name, std::vector<double>& values,
  std::initializer_list<std::size_t> counts, NumbersCheck check, const std::string& form,
  const std::string& description)
{
  return addNumbers(
    command, name, [&values](const std::vector<double>& numbers) { values = numbers; }, counts,
    std::move(check), form, description);
}

std::size_t indexOfChoice(
  const std::string& option, const std::string& value, const std::vector<std::string>& choices)
{
  const auto found = std::find(choices.begin(), choices.end(), value);
  requireUsage(found != choices.end(), option, value,
    fmt::format("no such choice{}; give one of {}", didYouMean(value, choices), fmt::join(choices, ", ")));
  return std::size_t(found - choices.begin());
}

CLI::Option* addWord(CLI::App& command, const std::string& name, std::string& value,
  const std::vector<std::string>& words, const std::string& description)
{
  const auto keep = [&value, words](std::size_t i) { value = words[i]; };
  return addChoice(command, name, std::function<void(std::size_t)>(keep), words, description);
}

CLI::Option* addWords(CLI::App& command, const std::string& name, std::vector<std::string>& values,
  const std::vector<std::string>& words, bool mayBeNone, const std::string& description)
{
  const auto store = [&values, words, mayBeNone, shown = shownName(name)](const std::string& text)
  {
    values.clear();
    for (const std::string& word : CLI::detail::split(mayBeNone && text == "none" ? "" : text, ','))
    {
      if (word.empty() && mayBeNone)
      {
        continue;
      }
      values.push_back(words[indexOfChoice(shown, word, words)]);
    }
  };
  return command.add_option_function<std::string>(name, store, description)
    ->type_name(fmt::format("{}", fmt::join(words, ",")));
}

CLI::Option* addChoice(CLI::App& command, const std::string& name, std::function<void(std::size_t)> keep,
  std::vector<std::string> words, const std::string& description)
{
  const std::string form = fmt::format("{}", fmt::join(words, "|"));
  const auto store = [keep = std::move(keep), words = std::move(words), shown = shownName(name)](
                       const std::string& text) { keep(indexOfChoice(shown, text, words)); };
  return command.add_option_function<std::string>(name, store, description)->type_name(form);
}

CLI::Option* addSetting(CLI::App& command, const SettingOption& row, int& member)
{
  return addInteger(command, row.name, member, static_cast<std::int64_t>(row.range.minimum),
    static_cast<std::int64_t>(row.range.maximum), row.help);
}

CLI::Option* addSetting(CLI::App& command, const SettingOption& row, bool& member)
{
  const auto store = [&member, given = !member](std::int64_t count) { member = (count > 0) == given; };
  return command.add_flag_function(row.name, store, row.help);
}

} // namespace pointhaptics::app
