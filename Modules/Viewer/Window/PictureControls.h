/// @file
/// Keys for the picture: its camera, and how it is drawn.
#pragma once

#include "CommandRegistry.h"
#include "FullScreen.h"
#include "HapticViewerOptions.h"
#include "ToolContext.h"

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace pointhaptics
{

/// GUI thread only.
class PictureControls
{
public:
  /// @p context must outlive this.
  explicit PictureControls(const ToolContext& context);

  FullScreen& fullScreen() { return fullScreen_; }
  /// False: the window does not fill the screen.
  bool leaveFullScreen() { return fullScreen_.isFull() && fullScreen_.set(false); }
  void toggleFullScreen();
  /// Forgets ranges of heights, which will be along another axis.
  void forgetHeights(PictureSettings& picture) const;
  /// Makes the point under the mouse the one that the view turns about, in the middle of the picture.
  void setPivot();
  /// False: nobody walks.
  bool endWalk();
  /// Turns the view to its place at @p seconds of a steady clock. False: it stands still.
  bool turnTable(double seconds);
  /// Drags the value at @p from on a colour bar of that @p range, 0 to 1 upwards, to @p to; the end farther
  /// away stays.
  void dragColorRange(std::array<double, 2> range, double from, double to);
  /// Hides or shows the points of a class or file, by its number.
  void toggleLabel(double label);
  /// Shows one of several files alone; all behind the last.
  void showAlone(std::size_t file);

  /// Adds the commands of the result of @p controls, for as long as it exists.
  using Getter = std::function<PictureControls*()>;
  static void addCommands(CommandRegistry& commands, const Getter& controls);

private:
  static void addViewCommands(CommandRegistry& commands, const Getter& controls);
  void showFirstView();
  void toggleProjection();
  void toggleStereo();
  void toggleTurntable();
  void toggleWalk();
  void walk(double right, double up, double forward);
  void lookAround();
  void scalePoints(int direction);
  void changeDepthStrength(int direction);
  void showNextBackground();
  void showNextTheme();
  void showNextColorMap();
  void resetColorRange();
  void toggleOutside();
  void takeNext(std::string& name, const std::vector<std::string>& names);
  void apply();
  void hide(std::vector<HiddenValues> hidden);

  const ToolContext& context_;
  FullScreen fullScreen_;
  std::string stereo_; ///< Stereo mode that was shown last; empty: none was.
  bool turns_ = false;
  bool walks_ = false;
  double turnedAt_ = -1.0; ///< Seconds; below 0: not yet.
};

} // namespace pointhaptics
