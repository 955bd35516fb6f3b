/// @file
/// The touch in the picture: the props, the chart of the force, and the decision to draw a frame.
#pragma once

#include "vtkHapticChart.h"
#include "vtkHapticProps.h"

#include "Core/Base/Vector3.h"
#include "Haptics/ServoLoop.h"

#include "PointHapticsInteractionModule.h" // For export macro

#include "vtkSmartPointer.h"

#include <functional>
#include <utility>
#include <vector>

namespace pointhaptics
{

class HandDistance;
class ScreenView;

/// Draws a frame only where something has changed, and leaves at least half of the time to events. GUI thread
/// only.
class POINTHAPTICSINTERACTION_EXPORT TouchDisplay
{
public:
  /// @p screen must outlive this.
  explicit TouchDisplay(const ScreenView& screen)
    : screen_(screen)
  {
  }
  TouchDisplay(const TouchDisplay&) = delete;
  TouchDisplay& operator=(const TouchDisplay&) = delete;

  ///@{
  /// Null takes one away.
  void setProps(vtkHapticProps* props) { props_ = props; }
  void setChart(vtkHapticChart* chart);
  vtkHapticChart* chart() const { return chart_; }
  ///@}
  /// What an exact surface would answer the hand of a tick, in newtons, for the chart; NaN: not known. Called
  /// for every tick in the order of time. Empty (default): none.
  void setIdealForce(std::function<double(const ServoSample&)> ideal) { idealForce_ = std::move(ideal); }
  /// Whether the user wants the chart, a strip along the lower edge; the picture takes the room that it
  /// leaves.
  void setChartVisibility(bool visible);
  bool wantsChart() const { return wish_ == Wish::On; }
  /// A figure has no chart.
  void setFigure(bool on);
  /// Hides the chart, which no picture has made room for yet, until a force is felt or the user asks for it.
  void hideChartUntilTouch();
  /// Shows the chart that was hidden until a force is felt; while the hand @p isDragged the picture stays
  /// where it is. True: the picture gave it room just now.
  bool showChartIfFelt(const std::vector<ServoSample>& samples, bool isDragged);

  /// Takes the new ticks, and the newest one. True: the picture has changed.
  bool update(const std::vector<ServoSample>& samples, const ServoSample& latest);

  /// Shows the point that the hand of @p distance would touch. True: the picture has changed.
  bool showDistance(const HandDistance& distance);

  /// Makes the next renderIfDue() draw a frame.
  void requestRender() { isRequested_ = true; }
  void renderIfDue();

private:
  /// Whether a chart is wanted: no, once a force is felt, as soon as the hand that felt it rests, or yes.
  enum class Wish
  {
    Off,
    UntilTouch,
    Touched,
    On,
  };
  void placeChart();
  bool isDue() const;
  void render();

  const ScreenView& screen_;
  vtkSmartPointer<vtkHapticProps> props_;
  vtkSmartPointer<vtkHapticChart> chart_;
  std::function<double(const ServoSample&)> idealForce_;
  bool isRequested_ = false;
  Wish wish_ = Wish::Off;
  bool isFigure_ = false;
  bool chartChanged_ = true;       ///< True if the chart changed since it was drawn.
  std::vector<double> chartPlace_; ///< Where the chart was drawn; empty: it was not.
  double frameSeconds_ = 0.0;      ///< Duration of the last frame.
  double frameEnd_ = -1e9;
};

} // namespace pointhaptics
