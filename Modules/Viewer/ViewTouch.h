/// @file
/// Touch of `view` along a hand path, in virtual time: equal on every machine.
#pragma once

#include "CsvWriter.h"
#include "FeelScenes.h"
#include "HapticViewerOptions.h"

#include "Haptics/ServoLoop.h"
#include "Shapes/IdealForce.h"

#include <memory>
#include <string>
#include <vector>

namespace pointhaptics
{

class ViewScene;

/// Feels @p scene, which must be built, along HapticViewerOptions::path; writes trace and force chart where
/// they are asked for, and says where each is. @p shown is the tick for a picture. False: @p message says
/// what failed.
bool feelAlongPath(ViewScene& scene, const HapticViewerOptions& options, const HapticViewerObserver& observer,
  ServoSample& shown, std::string& message);

/// Finds the exact surface that --ideal names, or of which the cloud of @p scene is a sample. Null: none.
std::shared_ptr<IdealForce> idealFor(ViewScene& scene, const HapticViewerOptions& options);

/// Newtons where the model stands in @p scene at this moment, with stiffness and limit of @p contact; NaN:
/// not known.
double idealForce(IdealForce& ideal, ViewScene& scene, const Vec3& hip, const ContactParameters& contact);

/// Columns of a trace: those of `feel`, and the status of the tick.
std::string traceColumns();
/// Adds a row to the trace for each sample.
void addTrace(CsvWriter& trace, const std::vector<ServoSample>& samples);

} // namespace pointhaptics
