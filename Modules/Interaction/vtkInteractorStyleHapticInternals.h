/// @file
/// Private state of vtkInteractorStyleHaptic, shared by its two source files.
#pragma once

#include "vtkInteractorStyleHaptic.h"

#include "ScenePublisher.h"
#include "SceneWorker.h"
#include "vtkHapticChart.h"
#include "vtkHapticOverlay.h"
#include "vtkHapticProps.h"
#include "vtkHapticSliders.h"
#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include "Devices/SimulatedDevice.h"
#include "Devices/SpaceMouse/SpaceMouse.h"
#include "Haptics/ServoLoop.h"

#include "vtkActor.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkTransform.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <deque>
#include <vector>

namespace pointhaptics
{
namespace style
{

/// Seconds of a steady clock.
inline double now()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Work that may take long leaves as much time to events as it took itself.
struct FairShare
{
  double last = 0.0;
  double finished = -1e9;

  bool due() const { return now() - this->finished >= this->last; }
  template <typename Work>
  void run(Work&& work)
  {
    const double begin = now();
    work();
    this->finished = now();
    this->last = this->finished - begin;
  }
};

} // namespace style
} // namespace pointhaptics

struct vtkInteractorStyleHaptic::Internals
{
  pointhaptics::ServoLoop* servo = nullptr;
  pointhaptics::SimulatedDevice* device = nullptr;
  pointhaptics::SpaceMouse* mouse = nullptr;
  double mouseRead = -1e9;
  std::uint32_t mouseButtons = 0;
  vtkSmartPointer<vtkVoxelMeanResampler> resampler;
  vtkSmartPointer<vtkKernelBandwidthFilter> bandwidth;
  vtkSmartPointer<vtkActor> cloudActor;
  vtkSmartPointer<vtkHapticProps> props;
  vtkSmartPointer<vtkHapticChart> chart;
  vtkSmartPointer<vtkHapticOverlay> overlay;
  vtkSmartPointer<vtkHapticSliders> sliders;
  pointhaptics::HapticBindings bindings;

  vtkNew<vtkTransform> model;     // what the user sees
  vtkNew<vtkTransform> resampled; // what the resampler runs with
  vtkNew<vtkMatrix4x4> initial;
  vtkNew<vtkMatrix4x4> preview;
  /// Matrices before the last changes, oldest first. A gesture of many steps is one change.
  std::deque<std::array<double, 16>> history;
  bool inGesture = false;
  bool gestureRemembered = false;
  bool modelChanged = true;
  bool sceneEmpty = true;
  bool rendersWanted = false;
  bool chartChanged = true;         // since it was drawn
  std::vector<double> chartPicture; // what else its picture depends on
  double touchMoved = -1e9;
  std::uint64_t requested = 0; // the newest request for a scene, and the one that is shown
  std::uint64_t shown = 0;
  const void* sentCloud = nullptr;
  vtkMTimeType sentCloudTime = 0;
  pointhaptics::style::FairShare renderShare;

  std::array<double, 6> workspace{ -0.05, 0.05, -0.05, 0.05, -0.05, 0.05 };
  pointhaptics::HapticAction drag = pointhaptics::HapticAction::None;
  bool handMode = false;
  int timer = -1;
  double lastStatus = -1e9;
  std::string note;
  std::string deviceNote;
  bool servoPanel = false;
  vtkIdType numberOfPoints = 0;
  vtkIdType numberOfVoxels = 0;
  std::vector<pointhaptics::ServoSample> samples;

  pointhaptics::ScenePublisher publisher;
  pointhaptics::SceneWorker worker; // last: it ends first

  pointhaptics::Vec3 center() const
  {
    return { 0.5 * (workspace[0] + workspace[1]), 0.5 * (workspace[2] + workspace[3]),
      0.5 * (workspace[4] + workspace[5]) };
  }
  double edge() const
  {
    return std::max(
      { workspace[1] - workspace[0], workspace[3] - workspace[2], workspace[5] - workspace[4] });
  }
};
