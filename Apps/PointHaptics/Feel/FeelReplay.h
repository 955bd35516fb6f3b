/// @file
/// A recording and its cloud, for the commands that feel it again.
#pragma once

#include "Options/Files.h"
#include "Recording.h"

#include <vtkSmartPointer.h>

#include <string>

class vtkPolyData;

namespace pointhaptics
{
namespace app
{

/// Adds the files that the recording @p fileName names to the inputs among @p files, or @p cloudFile in their
/// place. openRecording() reports faults of the recording.
void declareRecordedClouds(const std::string& fileName, const std::string& cloudFile, Files& files);
/// Reads @p fileName and the cloud that it was made with: @p cloudFile, or where that is empty the files that
/// its header names. Warns of a recording that ends early. False: @p message says what is wrong, and the
/// cure.
bool openRecording(const std::string& fileName, const std::string& cloudFile, Files& files,
  Recording& recording, vtkSmartPointer<vtkPolyData>& cloud, std::string& message);

} // namespace app
} // namespace pointhaptics
