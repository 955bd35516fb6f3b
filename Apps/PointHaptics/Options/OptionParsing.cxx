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
  const std::string shownUnit = unit.empty() ? "" : " (" + unit + ")";
  if (range.maximum >= kUnbounded)
  {
    return fmt::format(
      "give a number {} {}{}", range.openMinimum ? "above" : "from", range.minimum, shownUnit);
  }
  return fmt::format("give a number {} {} and at most {}{}", range.openMinimum ? "above" : "from",
    range.minimum, range.maximum, shownUnit);
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

void throwUsage(const std::string& option, const std::string& value, const std::string& problem)
{
  throw CLI::ValidationError(option + (value.empty() ? "" : " " + value), problem);
}

std::vector<std::string> givenOptions(const CLI::App& command)
{
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
  {
    if (option->count() > 0 && !option->get_lnames().empty())
    {
      names.push_back(option->get_lnames().front());
    }
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
    if (isDecided && name != but)
    {
      throwUsage("--replay", recording,
        fmt::format("the hand goes where it went, with the settings of then; leave out --{}", name));
    }
  }
}

void warnIdle(const CLI::App& command, const std::vector<std::string>& given,
  std::initializer_list<const char*> names, const std::string& why)
{
  for (const std::string name : names)
  {
    if (std::find(given.begin(), given.end(), name) != given.end())
    {
      warn(command.get_name(), fmt::format("--{} has no effect {}; leave it out", name, why));
    }
  }
}

CLI::Option* addNumber(CLI::App& command, const std::string& name, double& value, const NumberRange& range,
  const std::string& unit, const std::string& description)
{
  const auto store = [&value, range, unit, shown = shownName(name)](const std::string& text)
  {
    double number = 0.0;
    if (!parseNumber(text, number))
    {
      throwUsage(shown, text, "not a number; " + describe(range, unit));
    }
    const bool aboveMinimum = range.openMinimum ? number > range.minimum : number >= range.minimum;
    if (!(aboveMinimum && number <= range.maximum))
    {
      throwUsage(shown, text, "out of range; " + describe(range, unit));
    }
    value = number;
  };
  return command.add_option_function<std::string>(name, store, description)
    ->type_name(unit.empty() ? "NUMBER" : unit);
}

CLI::Option* addSize(CLI::App& command, const std::string& name, std::function<void(int, int)> keep,
  const std::string& description)
{
  static constexpr int kSmallest = 16;
  static constexpr int kLargest = 16384;
  const auto isSize = [](int pixels) { return pixels >= kSmallest && pixels <= kLargest; };
  const auto store = [keep = std::move(keep), isSize, name](const std::string& text)
  {
    int width = 0;
    int height = 0;
    char rest = 0;
    if (std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) != 2 || !isSize(width) ||
      !isSize(height))
    {
      throwUsage(name, text, fmt::format("give WIDTHxHEIGHT in pixels, {} to {}", kSmallest, kLargest));
    }
    keep(width, height);
  };
  return command.add_option_function<std::string>(name, store, description)->type_name("WxH");
}

CLI::Option* addClip(CLI::App& command, std::vector<double>& box, const std::string& description)
{
  const auto check = [](const std::vector<double>& ends)
  {
    return ends[0] < ends[1] && ends[2] < ends[3] && ends[4] < ends[5]
      ? ""
      : "no box; each minimum must be less than its maximum";
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

CLI::Option* addInteger(CLI::App& command, const std::string& name, std::int64_t& value, std::int64_t minimum,
  std::int64_t maximum, const std::string& description)
{
  return addInteger(
    command, name, [&value](std::int64_t given) { value = given; }, minimum, maximum, description);
}

CLI::Option* addInteger(CLI::App& command, const std::string& name, std::function<void(std::int64_t)> keep,
  std::int64_t minimum, std::int64_t maximum, const std::string& description)
{
  const auto store = [keep = std::move(keep), minimum, maximum, shown = shownName(name)](
                       const std::string& text)
  {
    double number = 0.0;
    if (!parseNumber(text, number) || number != std::floor(number) ||
      !(number >= double(minimum) && number <= double(maximum)))
    {
      throwUsage(
        shown, text, fmt::format("not a whole number in range; give one from {} to {}", minimum, maximum));
    }
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
    if (!parseNumbers(text, numbers))
    {
      throwUsage(
        shown, text, "not a list of numbers; give " + howMany + " separated by commas, without blanks");
    }
    if (std::find(allowed.begin(), allowed.end(), numbers.size()) == allowed.end())
    {
      throwUsage(
        shown, text, fmt::format("{} numbers; give {} separated by commas", numbers.size(), howMany));
    }
    if (!std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); }))
    {
      throwUsage(shown, text, "NaN or infinity; give finite numbers");
    }
    const std::string problem = check ? check(numbers) : std::string();
    if (!problem.empty())
    {
      throwUsage(shown, text, problem);
    }
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

CLI::Option* addWholeNumbers(CLI::App& command, const std::string& name, std::vector<double>& values,
  double maximum, const std::string& description)
{
  const auto store = [&values, maximum, shown = shownName(name)](const std::string& text)
  {
    const auto isFit = [maximum](double x) { return x == std::floor(x) && x >= 1.0 && x <= maximum; };
    if (!parseNumbers(text, values) || !std::all_of(values.begin(), values.end(), isFit))
    {
      throwUsage(
        shown, text, fmt::format("give whole numbers from 1 to {:.0f}, separated by commas", maximum));
    }
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
  };
  return command.add_option_function<std::string>(name, store, description)->type_name("N,...");
}

void throwNoChoice(
  const std::string& option, const std::string& value, const std::vector<std::string>& choices)
{
  throwUsage(option, value,
    fmt::format("no such choice{}; give one of {}", didYouMean(value, choices), fmt::join(choices, ", ")));
}

CLI::Option* addWord(CLI::App& command, const std::string& name, std::string& value,
  std::vector<std::string> words, const std::string& description)
{
  const std::string form = fmt::format("{}", fmt::join(words, "|"));
  const auto store = [&value, words = std::move(words), shown = shownName(name)](const std::string& text)
  {
    if (std::find(words.begin(), words.end(), text) == words.end())
    {
      throwNoChoice(shown, text, words);
    }
    value = text;
  };
  return command.add_option_function<std::string>(name, store, description)->type_name(form);
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
      if (std::find(words.begin(), words.end(), word) == words.end())
      {
        throwNoChoice(shown, word, words);
      }
      values.push_back(word);
    }
  };
  return command.add_option_function<std::string>(name, store, description)
    ->type_name(fmt::format("{}", fmt::join(words, ",")));
}

CLI::Option* addChoice(CLI::App& command, const std::string& name, int& value,
  std::vector<std::pair<std::string, int>> choices, const std::string& description)
{
  return addChoice(
    command, name, [&value](int chosen) { value = chosen; }, std::move(choices), description);
}

CLI::Option* addChoice(CLI::App& command, const std::string& name, std::function<void(int)> keep,
  std::vector<std::pair<std::string, int>> choices, const std::string& description)
{
  std::vector<std::string> words;
  for (const auto& choice : choices)
  {
    words.push_back(choice.first);
  }
  const auto store = [keep = std::move(keep), choices = std::move(choices), words, shown = shownName(name)](
                       const std::string& text)
  {
    const auto found = std::find(words.begin(), words.end(), text);
    if (found == words.end())
    {
      throwNoChoice(shown, text, words);
    }
    keep(choices[static_cast<std::size_t>(found - words.begin())].second);
  };
  return command.add_option_function<std::string>(name, store, description)
    ->type_name(fmt::format("{}", fmt::join(words, "|")));
}

CLI::Option* addSetting(CLI::App& command, const SettingOption& row, int& member)
{
  return addInteger(
    command, row.option, [&member](std::int64_t value) { member = static_cast<int>(value); },
    static_cast<std::int64_t>(row.range.minimum), static_cast<std::int64_t>(row.range.maximum), row.text);
}

CLI::Option* addSetting(CLI::App& command, const SettingOption& row, bool& member)
{
  const auto store = [&member, given = !member](std::int64_t count) { member = (count > 0) == given; };
  return command.add_flag_function(row.option, store, row.text);
}

} // namespace pointhaptics::app
