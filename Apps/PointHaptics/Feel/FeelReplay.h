/// @file
/// A recording and its cloud, for the commands that feel it again.
#pragma once

#include "Options/Files.h"

#include "HapticViewerOptions.h"
#include "Recording.h"
#include "Replay.h"

#include <vtkSmartPointer.h>

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

class vtkPolyData;

namespace pointhaptics::app
{

/// Adds the files that the recording @p fileName names to the inputs among @p files, or @p cloudFile in their
/// place. openRecording() reports faults of the recording.
void declareRecordedClouds(const std::string& fileName, const std::string& cloudFile, Files& files);
/// Reads @p fileName and the cloud that it was made with: @p cloudFile, or where that is empty the files that
/// its header names. Warns of a recording that ends early. @throws Failure
std::pair<Recording, vtkSmartPointer<vtkPolyData>> openRecording(
  const std::string& fileName, const std::string& cloudFile, Files& files);
/// Reads @p fileName, and takes for @p viewer how its cloud was read, cut and turned; and for @p files, where
/// they are empty, those that were felt. Warns of a recording that ends early. @throws Failure
Recording readRecordingFor(
  HapticViewerOptions& viewer, std::vector<std::string>& files, const std::string& fileName);

/// Feels @p recording of @p fileName again, by its method where there is no other. @p onTick gets each row
/// and what is felt now. @throws Failure, also where a signal ends it.
ReplayDifference feelAgain(const std::string& fileName, const Recording& recording, vtkPolyData* cloud,
  std::optional<ProxyMethod> method, const std::string& label,
  const std::function<void(const RecordedTick&, const ServoSample&)>& onTick);

} // namespace pointhaptics::app
