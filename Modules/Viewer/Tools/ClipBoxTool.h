/// @file
/// The clipping box under mouse and keys.
#pragma once

#include "LeftButton.h"
#include "ToolContext.h"

#include "Core/Base/PointView.h"

namespace pointhaptics
{

/// Shows the box; drags on a handle and keys move its faces. While a face is dragged the picture follows;
/// touch follows at its end. GUI thread only.
class ClipBoxTool
{
public:
  explicit ClipBoxTool(const ToolContext& context);

  /// Hides the box; what it clips stays clipped. False: it is not shown.
  bool hide();
  /// Forgets the box: another cloud is shown.
  void forget();

  /// Adds the commands of the result of @p tool, for as long as it exists.
  static void addCommands(CommandRegistry& commands, const std::function<ClipBoxTool*()>& tool);

private:
  void toggle();
  void clear();
  void chooseNextFace();
  void moveFace(int direction);
  bool takes(const LeftButton::Event& event);
  void move(int face, const Bounds& from, double way);
  void finish();

  const ToolContext& context_;
  int dragged_ = -1; ///< The dragged face; below 0: none.
  int fromX_ = 0;
  int fromY_ = 0;
  double perRight_ = 0.0; ///< Way of the dragged face for a pixel, measured when the drag began.
  double perUp_ = 0.0;
  Bounds from_;
  LeftButton button_; ///< Last member, as it calls this object.
};

} // namespace pointhaptics
