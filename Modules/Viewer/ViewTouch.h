/// @file
/// Touch of `view` along a hand path, in virtual time: equal on every machine.
#pragma once

#include "CsvWriter.h"
#include "FeelScenes.h"
#include "HapticViewerOptions.h"

#include "vtkHapticChart.h"

#include "Haptics/ServoLoop.h"
#include "Shapes/IdealForce.h"

#include <vtkNew.h>

#include <cstddef>
#include <functional>
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

/// The trace and the force chart that the options ask for, of what is felt along a path or in the window.
class TouchFiles
{
public:
  /// Begins the trace. @param isLive of a session that cannot be felt again (CsvWriter::open()). False:
  /// @p message says why it cannot be created.
  bool open(const HapticViewerOptions& options, bool isLive, std::string& message);
  /// Adds a row of `feel`, with the status of the tick, for each sample; @p ideal newtons of a sample, NaN:
  /// not known. False: the trace cannot go on, @p message says why.
  bool add(const std::vector<ServoSample>& samples, const std::function<double(const ServoSample&)>& ideal,
    std::string& message);
  /// Ends the files, and says where each is. One that cannot be written takes the other not with it. False:
  /// @p message says what failed.
  bool commit(const HapticViewerObserver& observer, std::string& message);

private:
  std::string traceName_;
  std::string chartName_;
  std::size_t ticks_ = 0;
  CsvWriter trace_;
  vtkNew<vtkHapticChart> chart_;
};

} // namespace pointhaptics
