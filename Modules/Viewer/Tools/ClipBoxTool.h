/// @file
/// The clipping box under mouse and keys.
#pragma once

#include "LeftButton.h"

#include "Core/Base/PointView.h"

#include <functional>
#include <string>

class vtkRenderWindowInteractor;

namespace pointhaptics
{

class CommandRegistry;
class ViewScene;
struct HapticViewerOptions;

/// Shows the box; drags on a handle and keys move its faces. While a face is dragged the picture follows;
/// touch follows at its end. GUI thread only.
class ClipBoxTool
{
public:
  /// @p scene and @p options, whose clip is kept up to date, must outlive this. @p clipped is called when the
  /// box has changed and touch must follow.
  ClipBoxTool(ViewScene& scene, HapticViewerOptions& options, vtkRenderWindowInteractor* interactor,
    std::function<void()> clipped, std::function<void(const std::string&)> say);

  /// Shows or hides the box; what it clips stays clipped.
  void toggle();
  /// Hides the box. False: it is not shown.
  bool hide();
  /// The whole cloud again; the box goes.
  void clear();
  /// Lets keys work on the next face.
  void chooseNextFace();
  /// @p direction 1: outward, -1: inward.
  void moveFace(int direction);
  /// Forgets the box: another cloud is shown.
  void forget();

  /// Adds the commands of the result of @p tool, for as long as it exists.
  static void addCommands(CommandRegistry& commands, const std::function<ClipBoxTool*()>& tool);

private:
  bool takes(const LeftButton::Event& event);
  void move(int face, const Bounds& from, double way);
  void finish();

  ViewScene& scene_;
  HapticViewerOptions& options_;
  std::function<void()> clipped_;
  std::function<void(const std::string&)> say_;
  int dragged_ = -1; ///< The dragged face; below 0: none.
  int fromX_ = 0;
  int fromY_ = 0;
  double perRight_ = 0.0; ///< Way of the dragged face for a pixel, measured when the drag began.
  double perUp_ = 0.0;
  Bounds from_;
  LeftButton button_; ///< Last member, as it calls this object.
};

} // namespace pointhaptics
