/// @file
/// A recording of touch: what a servo loop was given, tick by tick, and what it answered. As a file it is a
/// table of felt forces with a header (Documentation/Recordings.md).
#pragma once

#include "Devices/HipPath.h"
#include "Haptics/HapticParameters.h"
#include "Haptics/SceneOrigin.h"
#include "Haptics/Servo/ForceLimit.h"
#include "Haptics/Servo/ServoStep.h"

#include "PointHapticsSceneModule.h" // For export macro

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

class vtkPointSet;

namespace pointhaptics
{

/// The cloud that was felt.
struct RecordedFiles
{
  std::vector<std::string> files; ///< Read as one cloud where there are several.
  double resolution = 0.0;        ///< How far cloud optimised files were read; 0: all points.
  std::int64_t points = 0;
  std::uint64_t checksum = 0; ///< checksumOf() its points.
};

/// Checksum of the coordinates of @p cloud, in their order and type.
POINTHAPTICSSCENE_EXPORT std::uint64_t checksumOf(vtkPointSet* cloud);

/// Beside TickFlags: the device did not take the force.
constexpr std::uint32_t kTickNotWritten = 1u << 31;

/// What changes before a tick is felt.
struct RecordedEvent
{
  enum class Kind
  {
    Scene,      ///< Another scene: number, fallback, model.
    Parameters, ///< Others: number.
    Flag,       ///< A bit of TickFlags, or kTickNotWritten.
  };

  std::uint64_t tick = 0;
  Kind kind = Kind::Scene;
  std::uint32_t flag = 0;
  bool isSet = false;         ///< The flag.
  std::uint64_t number = 0;   ///< Of parameters, or of the cloud of a scene; 0: there is no scene.
  std::uint64_t fallback = 0; ///< Cloud of what is felt where a local scene ends; 0: the scene is global.
  AffineTransform model;      ///< From the file to the workspace.
};

/// A row of the table.
struct RecordedTick
{
  std::uint64_t tick = 0;        ///< Number of the servo loop's tick: time * rate + 1.
  std::array<double, 16> felt{}; ///< kFeltColumns.
  std::uint32_t buttons = 0;
  std::uint32_t marker = 0; ///< Number of the newest that was set in this tick, 1, 2, ...; else 0.

  Vec3 hip() const { return { felt[1], felt[2], felt[3] }; }
  Vec3 force() const { return { felt[10], felt[11], felt[12] }; }
};

/// Contents of the file's header.
struct RecordingHeader
{
  std::string program;  ///< Name and version.
  std::string settings; ///< A configuration of `view` in one line of JSON; empty: not known.
  RecordedFiles cloud;
  ServoStepSettings step;
  ForceLimit limit;
  std::int64_t origin = 0; ///< Nanoseconds of the steady clock at which the time of the table is 0.
};

/// All of a header but program, settings, step and limit: of @p cloud, read from @p files.
POINTHAPTICSSCENE_EXPORT RecordingHeader headerOf(
  const std::vector<std::string>& files, double resolution, vtkPointSet* cloud);

struct Recording
{
  RecordingHeader header;
  std::map<std::uint64_t, std::shared_ptr<const SceneOrigin>> clouds;
  std::map<std::uint64_t, HapticParameters> parameters;
  std::vector<RecordedEvent> events; ///< By tick.
  std::vector<RecordedTick> ticks;   ///< Ascending; not empty.
  std::string note;                  ///< That the recording was not ended, in a sentence; empty: it was.
};

/// Reads a recording. False: @p message says file, line, value and cure. What it accepts can be replayed:
/// ticks ascend, each event names clouds and parameters that are there, all numbers that matter are finite.
/// The end of one that was not ended may be cut. @param isHeaderAlone only what comes before the second tick.
POINTHAPTICSSCENE_EXPORT bool readRecording(
  const std::string& fileName, Recording& recording, std::string& message, bool isHeaderAlone = false);
/// True where @p cloud is the one that was felt. False: @p message says what differs.
POINTHAPTICSSCENE_EXPORT bool isOf(const Recording& recording, vtkPointSet* cloud, std::string& message);
/// Where a copy of the cloud of a recording lies that came as a stream: rec.cloud beside rec.csv.
POINTHAPTICSSCENE_EXPORT std::string keptCloudName(const std::string& recording);
/// Copies a cloud. False: @p message says why not.
POINTHAPTICSSCENE_EXPORT bool keepCloud(const std::string& from, const std::string& to, std::string& message);

} // namespace pointhaptics
