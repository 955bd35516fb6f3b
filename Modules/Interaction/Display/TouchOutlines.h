/// @file
/// Where the marks of touch lie in the picture, so that their outlines can be drawn.
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
  Vec3 arrowNeck; ///< Where the tip begins.
  double shaftRadius = 0.0;
  double tipRadius = 0.0;
  /// From the hand to where it would touch, with a ring there.
  Vec3 hand;
  Vec3 nearest;
  double ringRadius = 0.0;
  double width = 1.0; ///< Factor on all lines.
};

/// Placed at the start of each render of the renderer. GUI thread only.
class TouchOutlines
{
public:
  /// @p marks is asked before each render.
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
