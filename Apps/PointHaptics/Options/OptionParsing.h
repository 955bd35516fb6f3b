/// @file
/// Numbers and choices on the command line: parsed whole, checked against a stated range, refused in one
/// line.
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace CLI
{
class App;
class Option;
}

namespace pointhaptics::app
{

/// Warning for --preset with another method than the one that has gains.
constexpr const char* kPresetIsIdle =
  "--preset has no effect on --method surface-fit; give --method gradient-steps too, or leave it out";

/// Stands for "any finite number" as a maximum.
constexpr double kUnbounded = 1e300;

/// A closed range of finite numbers; openMinimum takes the minimum itself out.
struct NumberRange
{
  double minimum;
  double maximum;
  bool openMinimum = false;
};

/// The whole of @p text as one decimal number, "inf" and "nan" included. False: it is not one.
bool parseNumber(const std::string& text, double& value);
/// Comma-separated numbers. False where one of them is none.
bool parseNumbers(const std::string& text, std::vector<double>& values);

/// Ends the parse with a usage error `OPTION VALUE: problem`. @p problem says what is wrong and the cure.
[[noreturn]] void throwUsage(const std::string& option, const std::string& value, const std::string& problem);
/// Ends in a usage error for a word that is none of @p choices.
[[noreturn]] void throwNoChoice(
  const std::string& option, const std::string& value, const std::vector<std::string>& choices);

/// The long names of the options given so far: on the command line, where no configuration was taken yet.
std::vector<std::string> givenOptions(const CLI::App& command);
/// Ends in a usage error for an option of @p given that the recording of --replay decides, which says where
/// the hand goes and what it feels: all but @p but.
void refuseRecorded(const CLI::App& command, const std::vector<std::string>& given,
  const std::string& recording, const std::string& but = {});
/// Warns of those of @p given that are among @p names and have no effect, @p why: "without --device falcon".
void warnIdle(const CLI::App& command, const std::vector<std::string>& given,
  std::initializer_list<const char*> names, const std::string& why);

/// Adds `--name` taking one number within @p range; @p unit is shown in the help and in the error.
CLI::Option* addNumber(CLI::App& command, const std::string& name, double& value, const NumberRange& range,
  const std::string& unit, const std::string& description);
///@{
/// Adds an option taking one whole number from @p minimum to @p maximum, which is stored or handed to @p
/// keep. Forms such as 1e6 are taken.
CLI::Option* addInteger(CLI::App& command, const std::string& name, std::int64_t& value, std::int64_t minimum,
  std::int64_t maximum, const std::string& description);
CLI::Option* addInteger(CLI::App& command, const std::string& name, std::function<void(std::int64_t)> keep,
  std::int64_t minimum, std::int64_t maximum, const std::string& description);
///@}
/// Adds an option taking a size in pixels, WxH, each from 16 to 16384, which is handed to @p keep.
CLI::Option* addSize(CLI::App& command, const std::string& name, std::function<void(int, int)> keep,
  const std::string& description);
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
/// Adds an option taking comma-separated whole numbers from 1 to @p maximum; stored ascending, each once.
CLI::Option* addWholeNumbers(CLI::App& command, const std::string& name, std::vector<double>& values,
  double maximum, const std::string& description);
/// Adds an option taking one of @p words.
CLI::Option* addWord(CLI::App& command, const std::string& name, std::string& value,
  std::vector<std::string> words, const std::string& description);
/// Adds an option taking some of @p words, separated by commas; where @p mayBeNone "none" gives an empty
/// list.
CLI::Option* addWords(CLI::App& command, const std::string& name, std::vector<std::string>& values,
  const std::vector<std::string>& words, bool mayBeNone, const std::string& description);
///@{
/// Adds an option taking one of the words in @p choices; @p value becomes the integer beside it, or @p keep
/// is called with it.
CLI::Option* addChoice(CLI::App& command, const std::string& name, int& value,
  std::vector<std::pair<std::string, int>> choices, const std::string& description);
CLI::Option* addChoice(CLI::App& command, const std::string& name, std::function<void(int)> keep,
  std::vector<std::pair<std::string, int>> choices, const std::string& description);
///@}

} // namespace pointhaptics::app
