/// @file
/// The lines of a recording, each described once for those who write it and those who read it.
#pragma once

#include "KeyedText.h"
#include "Recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

namespace pointhaptics
{

/// In the place of the number of ticks, for the last line of a recording.
constexpr const char* kRecordingEnd = "end";
/// Words for SceneOrigin::Kind, in their order.
constexpr std::array<const char*, 3> kSceneOrigins = { "whole", "region", "fine" };

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
  std::string name = kSceneOrigins[std::size_t(origin.kind)];
  line.value("kind", name);
  const auto kind = std::find(kSceneOrigins.begin(), kSceneOrigins.end(), name);
  if (kind == kSceneOrigins.end())
  {
    return false;
  }
  origin.kind = SceneOrigin::Kind(kind - kSceneOrigins.begin());
  line.value("model", origin.modelToWorkspace);
  if (origin.kind != SceneOrigin::Kind::Whole)
  {
    line.value("beside", origin.globalCloud);
    line.value("hand", origin.hand);
  }
  line.value("covariance", origin.useCovariance);
  if (origin.kind == SceneOrigin::Kind::Fine)
  {
    line.settings(origin.voxels.lattice, "lattice.");
  }
  else
  {
    line.settings(origin.voxels);
  }
  line.settings(origin.bandwidth, "bandwidth.");
  return true;
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
/// The lines of a header, without their "# ".
std::vector<std::string> linesOf(const RecordingHeader& header);

} // namespace pointhaptics
