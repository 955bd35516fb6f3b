#include "Benchmark/Harness/Run.h"

#include <algorithm>
#include <chrono>

namespace pointhaptics::bench
{

bool Run::wants(const std::string& study) const
{
  return studies.empty() || std::find(studies.begin(), studies.end(), study) != studies.end();
}

void Run::say(const std::string& what) const
{
  if (progress)
  {
    progress(what);
  }
}

Json& Run::part(const std::string& study)
{
  Json& found = parts_[study];
  if (found.is_null())
  {
    found = { { "rows", Json::array() }, { "remarks", Json::array() } };
  }
  return found;
}

void Run::add(const std::string& study, Json row)
{
  if (print)
  {
    Json line{ { "study", study } };
    line.update(row);
    print(line);
  }
  this->part(study)["rows"].push_back(std::move(row));
}

void Run::remark(const std::string& study, const std::string& text)
{
  if (print)
  {
    print({ { "study", study }, { "remark", text } });
  }
  this->part(study)["remarks"].push_back(text);
}

void Run::fault(const std::string& what)
{
  faults_ = what;
}

double secondsNow()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

} // namespace pointhaptics::bench
