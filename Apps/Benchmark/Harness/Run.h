/// @file
/// One run of a task: what all tasks are asked for, and the rows that they find.
#pragma once

#include <nlohmann/json.hpp>

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace pointhaptics::bench
{

using Json = nlohmann::ordered_json;

/// A task fills it, study by study. Rows are objects of numbers in SI units, or in the unit that their key
/// ends in.
class Run
{
public:
  std::vector<int> threads{ 1 };                    ///< Ascending, each once; not empty.
  int repetitions = 1;                              ///< Rounds of each contestant.
  bool quick = false;                               ///< A second or two, to see that everything works.
  std::vector<std::string> studies;                 ///< Those that were asked for; empty: all.
  std::vector<std::string> rivals;                  ///< Those that run beside ours.
  std::function<void(const std::string&)> progress; ///< Told what is being measured; may be empty.
  std::function<void(const Json&)> print; ///< Given each row as it comes, with its study; may be empty.

  bool wants(const std::string& study) const;
  /// Returns @p given, or else @p few of a quick run, or else @p full.
  template <class Value>
  Value chosen(const Value& given, const Value& full, const Value& few) const
  {
    return given != Value() ? given : quick ? few : full;
  }

  void say(const std::string& what) const;
  void add(const std::string& study, Json row);
  /// Tells the reader of a study what was left out and why.
  void remark(const std::string& study, const std::string& text);
  /// An answer of ours is wrong, or nothing can be measured: the run fails.
  void fault(const std::string& what);

  /// Each study with its rows and remarks, in the order in which they came.
  const Json& parts() const { return parts_; }
  /// The last fault; empty: there was none.
  const std::string& faults() const { return faults_; }

private:
  Json& part(const std::string& study);

  Json parts_ = Json::object();
  std::string faults_;
};

/// Seconds of a steady clock.
double secondsNow();

} // namespace pointhaptics::bench
