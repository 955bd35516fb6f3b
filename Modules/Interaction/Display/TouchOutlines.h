/// @file
/// Finds the marks of touch in the picture and draws their outlines.
#pragma once

#include "MarkOutlines.h"

#include "Core/Base/Vector3.h"

#include "vtkNew.h"
#include "vtkWeakPointer.h"

#include <functional>

class vtkCallbackCommand;
class vtkRenderer;

namespace pointhaptics
{

/// Marks of touch that get an outline; workspace, metres. A mark without a size is not shown.
struct TouchMarks
{
  Vec3 proxy;
  double proxyRadius = 0.0;
  Vec3 hip;
  double hipRadius = 0.0;
  Vec3 normalBegin;
  Vec3 normalEnd;
  Vec3 arrowBegin;
  Vec3 arrowEnd;
  Vec3 arrowNeck; ///< Place where the tip begins.
  double shaftRadius = 0.0;
  double tipRadius = 0.0;
  /// Line from the hand to the point that it would touch, with a ring there.
  Vec3 hand;
  Vec3 nearest;
  double ringRadius = 0.0;
  double width = 1.0; ///< Factor on all lines.
};

/// Draws the outlines at the start of each render of the renderer. GUI thread only.
class TouchOutlines
{
public:
  /// @p marks returns the marks before each render.
  explicit TouchOutlines(std::function<TouchMarks()> marks);
  ~TouchOutlines();
  TouchOutlines(const TouchOutlines&) = delete;
  TouchOutlines& operator=(const TouchOutlines&) = delete;

  void addTo(vtkRenderer* renderer);
  void removeFrom(vtkRenderer* renderer);

private:
  class Picture;
  void place();

  std::function<TouchMarks()> marks_;
  MarkOutlines outlines_;
  vtkNew<vtkCallbackCommand> onStart_;
  vtkWeakPointer<vtkRenderer> renderer_;
};

} // namespace pointhaptics
