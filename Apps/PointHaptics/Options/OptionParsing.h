/// @file
/// Numbers and choices on the command line: parsed whole, checked against a stated range, refused in one
/// line.
#pragma once

#include "Core/Base/SettingsMembers.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace CLI
{
class App;
class Option;
}

namespace pointhaptics::app
{

/// Stands for "any finite number" as a maximum.
constexpr double kUnbounded = 1e300;
constexpr const char* kMetres = "METRES"; ///< Form of an option that takes a length.

/// The whole of @p text as one decimal number, "inf" and "nan" included. False: it is not one.
bool parseNumber(const std::string& text, double& value);
/// Comma-separated numbers. False where one of them is none.
bool parseNumbers(const std::string& text, std::vector<double>& values);

/// Unless @p isRight, ends the parse with a usage error `OPTION VALUE: problem`. @p problem says what is
/// wrong and the cure.
void requireUsage(
  bool isRight, const std::string& option, const std::string& value, const std::string& problem);
/// The place of @p value among @p choices. Ends in a usage error for a word that is none of them.
std::size_t indexOfChoice(
  const std::string& option, const std::string& value, const std::vector<std::string>& choices);

/// The options of @p command by each of their long names, without the dashes, in their order.
std::vector<std::pair<std::string, const CLI::Option*>> longNames(const CLI::App& command);
/// The long names of the options given so far: on the command line, where no configuration was taken yet.
std::vector<std::string> givenOptions(const CLI::App& command);
/// Ends in a usage error for an option of @p given that the recording of --replay decides, which says where
/// the hand goes and what it feels: all but @p but.
void refuseRecorded(const CLI::App& command, const std::vector<std::string>& given,
  const std::string& recording, const std::string& but = {});
/// If @p areIdle, warns of those of @p given that are among @p names and have no effect, @p why: "without
/// --device falcon".
void warnIdle(bool areIdle, const std::vector<std::string>& given, std::initializer_list<const char*> names,
  const std::string& why);

///@{
/// Groups of the help, of options that decide what is felt.
constexpr const char* kTouchGroup = "Touch";
constexpr const char* kLatticeGroup = "Lattice and transform";
constexpr const char* kBandwidthGroup = "Bandwidth and proxy radius";
///@}

/// While it lives, options that are added to a command are in this group of the help.
class OptionGroup
{
public:
  OptionGroup(CLI::App& command, const std::string& name);
  ~OptionGroup();
  OptionGroup(const OptionGroup&) = delete;
  OptionGroup& operator=(const OptionGroup&) = delete;

private:
  CLI::App& command_;
};

/// Adds `--name` taking one number within @p range; @p unit is shown in the help and in the error.
CLI::Option* addNumber(CLI::App& command, const std::string& name, double& value, const NumberRange& range,
  const std::string& unit, const std::string& description);
///@{
/// Adds an option taking one whole number from @p minimum to @p maximum. Forms such as 1e6 are taken.
CLI::Option* addInteger(CLI::App& command, const std::string& name, std::function<void(std::int64_t)> keep,
  std::int64_t minimum, std::int64_t maximum, const std::string& description);
template <typename Integer, typename = std::enable_if_t<std::is_integral_v<Integer>>>
CLI::Option* addInteger(CLI::App& command, const std::string& name, Integer& value, std::int64_t minimum,
  std::int64_t maximum, const std::string& description)
{
  const auto keep = [&value](std::int64_t given) { value = static_cast<Integer>(given); };
  return addInteger(command, name, keep, minimum, maximum, description);
}
///@}
/// Adds an option taking a size in pixels, WxH, each from 16 to 16384.
CLI::Option* addSize(
  CLI::App& command, const std::string& name, int& width, int& height, const std::string& description);
/// Adds --clip: the box of a cloud that is shown and felt, six numbers in the coordinates of its file.
CLI::Option* addClip(CLI::App& command, std::vector<double>& box, const std::string& description);
/// Adds --columns and --salvage: what columns of a text are called, and whether a cut file is read as far as
/// it goes.
void addReading(CLI::App& command, std::vector<std::string>& columns, bool& salvage);
/// Adds --samples: points on the faces of a mesh in the place of its vertices.
void addSamples(CLI::App& command, std::int64_t& samples);
/// Adds --vertices: the vertices of a mesh in the place of samples of its faces.
void addVertices(CLI::App& command, bool& vertices);
/// Adds --resolution: how far a cloud optimised point cloud is read.
CLI::Option* addResolution(CLI::App& command, double& value);
/// Returns what is wrong with a list, and the cure, or an empty string.
using NumbersCheck = std::function<std::string(const std::vector<double>&)>;
/// Adds an option taking a comma-separated list with one of the @p counts of finite numbers. @p check may be
/// empty.
CLI::Option* addNumbers(CLI::App& command, const std::string& name, std::vector<double>& values,
  std::initializer_list<std::size_t> counts, NumbersCheck check, const std::string& form,
  const std::string& description);
/// As addNumbers() above; the list is passed to @p keep after the checks.
CLI::Option* addNumbers(CLI::App& command, const std::string& name,
  std::function<void(const std::vector<double>&)> keep, std::initializer_list<std::size_t> counts,
  NumbersCheck check, const std::string& form, const std::string& description);
/// Adds an option taking one of @p words.
CLI::Option* addWord(CLI::App& command, const std::string& name, std::string& value,
  const std::vector<std::string>& words, const std::string& description);
/// Adds an option taking some of @p words, separated by commas; where @p mayBeNone "none" gives an empty
/// list.
CLI::Option* addWords(CLI::App& command, const std::string& name, std::vector<std::string>& values,
  const std::vector<std::string>& words, bool mayBeNone, const std::string& description);
///@{
/// Adds an option taking one of the words in @p choices: @p keep gets its place, or @p value becomes what
/// stands beside it.
CLI::Option* addChoice(CLI::App& command, const std::string& name, std::function<void(std::size_t)> keep,
  std::vector<std::string> words, const std::string& description);
template <typename Value>
CLI::Option* addChoice(CLI::App& command, const std::string& name, Value& value,
  const std::vector<std::pair<std::string, Value>>& choices, const std::string& description)
{
  std::vector<std::string> words;
  for (const auto& choice : choices)
  {
    words.push_back(choice.first);
  }
  const auto keep = [&value, choices](std::size_t i) { value = choices[i].second; };
  return addChoice(command, name, std::function<void(std::size_t)>(keep), words, description);
}
///@}

} // namespace pointhaptics::app
