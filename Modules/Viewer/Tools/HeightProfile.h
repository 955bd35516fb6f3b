/// @file
/// The heights of a cloud along the measured line, in a chart.
#pragma once

#include "ToolContext.h"

#include <vtkNew.h>

class vtkChartXY;
class vtkContextActor;
class vtkRenderer;
class vtkTable;

namespace pointhaptics
{

/// The chart takes the upper edge of the window from the picture. GUI thread only.
class HeightProfile
{
public:
  /// @p context must outlive this.
  explicit HeightProfile(const ToolContext& context);
  ~HeightProfile();
  HeightProfile(const HeightProfile&) = delete;
  HeightProfile& operator=(const HeightProfile&) = delete;

  void toggle();
  /// Hides the chart. False: it was hidden.
  bool end();
  /// Shows the profile of the present line, where the chart is shown; hides it where there is none.
  void follow();

private:
  void endPictureAt(double top);

  const ToolContext& context_;
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkContextActor> actor_;
  vtkNew<vtkChartXY> chart_;
  vtkNew<vtkTable> table_;
};

} // namespace pointhaptics
