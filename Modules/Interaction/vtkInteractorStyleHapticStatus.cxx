// What vtkInteractorStyleHaptic says in words: status line, servo panel, picked point.
#include "vtkInteractorStyleHapticInternals.h"

#include "PointPicking.h"

#include "vtkPolyData.h"
#include "vtkRenderer.h"

#include <cstdio>
#include <string>

using pointhaptics::ServoSample;
using pointhaptics::style::now;

namespace
{

constexpr double kStatusPeriodSeconds = 0.25;
/// While nothing moves: a line of text costs a frame.
constexpr double kRestingPeriodSeconds = 4.0;
constexpr double kPickPixels = 8.0;

} // namespace

bool vtkInteractorStyleHaptic::UpdateStatus()
{
  Internals& parts = *this->Parts;
  const double time = now();
  const bool rests = time - parts.touchMoved > kRestingPeriodSeconds && !this->IsModelChanged();
  const double period = rests ? kRestingPeriodSeconds : kStatusPeriodSeconds;
  if (!parts.overlay || time - parts.lastStatus < period)
  {
    return false;
  }
  parts.lastStatus = time;
  char text[320];
  std::snprintf(text, sizeof(text), "%lld points in %lld active voxels%s",
    static_cast<long long>(parts.numberOfPoints), static_cast<long long>(parts.numberOfVoxels),
    parts.sceneEmpty ? " (nothing in the workspace: key 0 resets the model)" : "");
  std::string status = text;
  if (parts.servo)
  {
    const ServoSample latest = parts.servo->latest();
    const pointhaptics::ServoStatistics statistics = parts.servo->statistics();
    std::snprintf(text, sizeof(text),
      "\nproxy radius %.2f mm    force %.2f N%s\nservo %.0f Hz, %llu ticks missed%s",
      1e3 * latest.state.radius, norm(latest.state.force), latest.state.contact ? "    in contact" : "",
      statistics.rateHz, static_cast<unsigned long long>(statistics.deadlineMisses),
      parts.hold != pointhaptics::HapticAction::None ? "    the hand holds the model"
        : !parts.handMode                            ? ""
        : parts.pushesPointer                        ? "    hand follows the mouse, touch pushes it"
                                                     : "    hand follows the mouse");
    status += text;
  }
  if (!parts.note.empty())
  {
    status += "\n" + parts.note;
  }
  const bool panelChanged = parts.overlay->SetPanel(parts.servoPanel ? this->ServoPanelText() : "");
  return parts.overlay->SetStatus(status + "\nH: help") || panelChanged;
}

std::string vtkInteractorStyleHaptic::ServoPanelText()
{
  const Internals& parts = *this->Parts;
  const std::string device = parts.deviceNote.empty() ? "none" : parts.deviceNote;
  if (!parts.servo)
  {
    return "servo loop: none\ndevice: " + device;
  }
  const pointhaptics::ServoStatistics statistics = parts.servo->statistics();
  const auto count = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
  char text[640];
  std::snprintf(text, sizeof(text),
    "servo loop: %s%s\n"
    "rate: %.1f Hz\n"
    "late: p50 %.0f us, p99 %.0f us, most %.0f us\n"
    "work of a tick: p50 %.0f us, p99 %.0f us, most %.0f us\n"
    "ticks: %llu, missed: %llu, rested: %llu\n"
    "device faults: %llu, waiting: %llu\n"
    "device: %s",
    parts.servo->running() ? "running" : "stopped", statistics.realtime ? ", SCHED_FIFO" : "",
    statistics.rateHz, 1e6 * statistics.jitter.p50, 1e6 * statistics.jitter.p99,
    1e6 * statistics.jitter.maximum, 1e6 * statistics.update.p50, 1e6 * statistics.update.p99,
    1e6 * statistics.update.maximum, count(statistics.ticks), count(statistics.deadlineMisses),
    count(statistics.idleTicks), count(statistics.deviceFaults), count(statistics.waitingTicks),
    device.substr(0, 200).c_str());
  return text;
}

void vtkInteractorStyleHaptic::SetServoPanelVisibility(bool visible)
{
  this->Parts->servoPanel = visible;
  this->Parts->lastStatus = -1e9;
}

bool vtkInteractorStyleHaptic::GetServoPanelVisibility() const
{
  return this->Parts->servoPanel;
}

void vtkInteractorStyleHaptic::SetDeviceNote(const std::string& note)
{
  this->Parts->deviceNote = note;
  this->Parts->lastStatus = -1e9;
}

bool vtkInteractorStyleHaptic::PickAt(int x, int y)
{
  Internals& parts = *this->Parts;
  vtkRenderer* renderer = this->MainRenderer();
  vtkPolyData* cloud = parts.bandwidth ? parts.bandwidth->GetOutput()
    : parts.resampler                  ? parts.resampler->GetOutput()
                                       : nullptr;
  pointhaptics::PickedPoint picked;
  const bool found = renderer && cloud && pointhaptics::pickPoint(cloud, renderer, x, y, kPickPixels, picked);
  if (!found)
  {
    this->ForgetPicked();
    return false;
  }
  // A neighbourhood that has no bandwidth leaves it at 0, which is not shown.
  static_cast<void>(parts.bandwidth
      ? pointhaptics::measurePicked(cloud, parts.bandwidth->GetSettings(), picked)
      : pointhaptics::Status::Ok);
  double voxel[6];
  for (int axis = 0; picked.voxelBounds && axis < 3; ++axis)
  {
    voxel[2 * axis] = picked.voxelBounds->minimum[axis];
    voxel[2 * axis + 1] = picked.voxelBounds->maximum[axis];
  }
  parts.marker->AddTo(renderer);
  parts.marker->Mark(&picked.inWorkspace.x, picked.voxelBounds ? voxel : nullptr, picked.bandwidth);
  if (parts.overlay)
  {
    parts.overlay->SetDetail(pointhaptics::describePicked(cloud, picked));
  }
  parts.rendersWanted = true;
  return true;
}

/// Voxel and bandwidth are those of one resampling: the next one has others.
void vtkInteractorStyleHaptic::ForgetPicked()
{
  Internals& parts = *this->Parts;
  parts.rendersWanted = parts.rendersWanted || parts.marker->GetVisibility();
  parts.marker->SetVisibility(false);
  if (parts.overlay)
  {
    parts.overlay->SetDetail("");
  }
}

void vtkInteractorStyleHaptic::SetStatusNote(const std::string& note)
{
  this->Parts->note = note;
  this->Parts->lastStatus = -1e9;
}

void vtkInteractorStyleHaptic::SetChartVisibility(bool visible)
{
  if (this->Parts->chart && this->Parts->chart->GetVisibility() != visible)
  {
    this->ToggleChart();
  }
}

void vtkInteractorStyleHaptic::ToggleChart()
{
  vtkHapticChart* chart = this->Parts->chart;
  vtkRenderer* renderer = this->MainRenderer();
  if (chart && renderer)
  {
    chart->SetVisibility(!chart->GetVisibility());
    this->Parts->chartChanged = true;
    double viewport[4] = { 0.0, 0.0, 1.0, 1.0 };
    chart->GetRenderer()->GetViewport(viewport);
    // The chart is a strip along the lower edge; the picture takes the rest of the window.
    renderer->SetViewport(0.0, chart->GetVisibility() ? viewport[3] : 0.0, 1.0, 1.0);
    this->Parts->rendersWanted = true;
  }
}
