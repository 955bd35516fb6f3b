/// @file
/// The lines of a recording, each described once for those who write it and those who read it.
#pragma once

#include "Recording.h"
#include "SettingText.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <type_traits>

namespace pointhaptics
{
namespace keyed
{

/// Words "name=value", written or read: one description of a line, a sequence of calls, does both.
class Line
{
public:
  /// A line that is written; it begins with @p head.
  static Line startingWith(const std::string& head) { return Line(head, false); }
  /// A line that was read, without its head.
  static Line from(const std::string& words) { return Line(words, true); }

  /// The line; of one that was read the word that is wrong, where there is one.
  const std::string& text() const { return text_; }
  /// True where all words were there and right.
  bool isFine() const { return isFine_; }

  /// @p isRequired false: stays as it is where a line that is read has no such word.
  template <typename Value>
  void value(const std::string& name, Value& value, bool isRequired = true)
  {
    const auto word = words_.find(name);
    if (!isRead_)
    {
      text_ += " " + name + "=" + toText(value);
    }
    else if (word == words_.end() ? isRequired : !fromText(word->second, value))
    {
      text_ = isFine_ && word != words_.end() ? name + "=" + word->second : text_;
      isFine_ = false;
    }
  }
  /// All members of @p settings that what is felt depends on: not sets of names.
  template <typename Settings>
  void settings(Settings& settings, const std::string& prefix = {})
  {
    visitSettings(
      settings,
      [this](const std::string& name, auto& member)
      {
        if constexpr (!std::is_same_v<std::decay_t<decltype(member)>, std::set<std::string>>)
        {
          this->value(name, member, false);
        }
      },
      prefix);
  }
  /// As settings(), where the line may lack all of them.
  template <typename Settings>
  void settings(std::optional<Settings>& settings, const std::string& prefix)
  {
    const auto first = words_.lower_bound(prefix);
    if (first != words_.end() && first->first.rfind(prefix, 0) == 0)
    {
      settings.emplace();
    }
    if (settings)
    {
      this->settings(*settings, prefix);
    }
  }

private:
  Line(const std::string& text, bool isRead)
    : text_(text)
    , isRead_(isRead)
  {
    std::istringstream stream(isRead ? text : std::string());
    for (std::string word; stream >> word;)
    {
      const std::size_t equals = std::min(word.find('='), word.size());
      isFine_ = isFine_ && equals > 0 && equals < word.size();
      words_[word.substr(0, equals)] = word.substr(std::min(equals + 1, word.size()));
    }
  }

  std::string text_;
  std::map<std::string, std::string> words_;
  bool isRead_ = false;
  bool isFine_ = true;
};

} // namespace keyed

/// In the place of the number of ticks, for the last line of a recording.
constexpr const char* kRecordingEnd = "end";

/// A bit of RecordedEvent::flag in the file: "gate on", or where it lasts for a tick alone its name.
struct RecordedFlag
{
  const char* name;
  std::uint32_t bit;
  bool isOnWhereSet;
  bool isOnce;
};
constexpr std::array<RecordedFlag, 7> kRecordedFlags = { { { "begins", kTickBegins, true, true },
  { "clutch", kTickClutched, true, false }, { "gate", kTickGateClosed, false, false },
  { "reading", kTickStepped, true, false }, { "writing", kTickNotWritten, false, false },
  { "new-hand", kTickNewHand, true, true }, { "no-position", kTickNonFinite, true, true } } };
constexpr std::uint32_t kOnceFlags = kTickBegins | kTickNewHand | kTickNonFinite;

///@{
/// The words of a line.
inline void describe(keyed::Line& line, RecordedFiles& cloud)
{
  line.value("points", cloud.points);
  std::string checksum = fmt::format("{:016x}", cloud.checksum);
  line.value("checksum", checksum);
  const char* const end = checksum.data() + checksum.size();
  if (std::from_chars(checksum.data(), end, cloud.checksum, 16).ptr != end)
  {
    cloud.points = 0; // a header that names no cloud is refused
  }
  line.value("resolution", cloud.resolution);
}

inline void describe(keyed::Line& line, ServoStepSettings& step)
{
  line.value("rate", step.rateHz);
  line.value("maximumForce", step.limits.maximumForce);
  line.value("maximumSlewRate", step.limits.maximumSlewRate);
  line.value("rampDown", step.rampDownSeconds);
  line.value("rampUp", step.rampUpSeconds);
  line.value("clutchDown", step.clutchDownSeconds);
  line.value("clutchUp", step.clutchUpSeconds);
}

/// False: the kind is none.
inline bool describe(keyed::Line& line, SceneOrigin& origin)
{
  std::string kind = origin.isLocal() ? "fine" : "whole";
  line.value("kind", kind);
  line.value("model", origin.modelToWorkspace);
  const bool isRegion = kind == "region"; // of older builds: a part of a whole scene
  if (kind == "fine" || isRegion)
  {
    line.value("beside", origin.globalCloud);
    line.value("hand", origin.hand);
  }
  if (isRegion)
  {
    kind = "whole";
    origin.globalCloud = 0;
  }
  line.value("covariance", origin.useCovariance);
  kind == "fine" ? line.settings(origin.voxels.lattice, "lattice.") : line.settings(origin.voxels);
  line.settings(origin.bandwidth, "bandwidth.");
  return kind == "whole" || origin.isLocal();
}

/// A scene that there is.
inline void describe(keyed::Line& line, RecordedEvent& event)
{
  line.value("of", event.number);
  line.value("beyond", event.fallback);
  line.value("model", event.model);
}
///@}

/// @p value in a line that begins with @p head.
template <typename Value>
std::string lineOf(const std::string& head, Value value)
{
  keyed::Line line = keyed::Line::startingWith(head);
  describe(line, value);
  return line.text();
}

/// The first line: the columns.
std::string recordedColumns();

} // namespace pointhaptics
