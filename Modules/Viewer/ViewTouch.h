/// @file
/// Touch of `view` along a hand path, in virtual time: equal on every machine.
#pragma once

#include "CsvWriter.h"
#include "FeelScenes.h"

#include "Devices/HipPath.h"
#include "Haptics/Proxy.h"
#include "Haptics/ServoLoop.h"
#include "Shapes/IdealForce.h"

#include <memory>
#include <string>
#include <vector>

namespace pointhaptics
{

class ViewScene;
struct HapticViewerOptions;

/// One sample for each of the @p ticks of @p rateHz along @p path (see countTicks), as `feel` does it; its
/// time is that of the path. @pre path not empty.
std::vector<ServoSample> samplesAlong(const HipPath& path, std::int64_t ticks, FeelScenes& scenes,
  const HapticParameters& parameters, double rateHz);
/// Makes the scenes that the command `feel` makes of the cloud of @p scene with the same options. False: @p
/// message says why not.
bool makeFeelScenes(
  ViewScene& scene, const HapticViewerOptions& options, FeelScenes& scenes, std::string& message);

/// Judges the units of @p path and of the cloud, as it stands in @p scene, by unlikelyUnits().
std::string unlikelyUnitsIn(
  ViewScene& scene, const HapticViewerOptions& options, const HipPath& path, bool isTouched);

/// The tick to show: that of the largest force, or the last one where nothing was touched. @pre not empty.
const ServoSample& mostTelling(const std::vector<ServoSample>& samples);

/// Finds the exact surface that --ideal names, or of which the cloud of @p scene is a sample. Null: none.
std::shared_ptr<IdealForce> idealFor(ViewScene& scene, const HapticViewerOptions& options);

/// Newtons where the model stands, with stiffness and limit of @p contact; NaN: not known.
double idealForce(
  IdealForce& ideal, const AffineTransform& model, const Vec3& hip, const ContactParameters& contact);
/// As above, with the model where it stands in @p scene at this moment.
double idealForce(IdealForce& ideal, ViewScene& scene, const Vec3& hip, const ContactParameters& contact);

/// Columns of a trace: those of `feel`, and the status of the tick.
std::string traceColumns();
/// Adds a row to the trace for each sample.
void addTrace(CsvWriter& trace, const std::vector<ServoSample>& samples);

} // namespace pointhaptics
