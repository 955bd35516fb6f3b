/// @file
/// Keys for the picture: its camera, and how it is drawn.
#pragma once

#include "CommandRegistry.h"
#include "FullScreen.h"
#include "HapticViewerOptions.h"

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace pointhaptics
{

class ViewScene;

/// GUI thread only.
class PictureControls
{
public:
  /// Changes @p scene and the picture of @p options, which must outlive this, @p window and the modifier of
  /// @p commands. @p clipped is called when other
  /// points are to be felt; @p say reports each change to the person.
  PictureControls(ViewScene& scene, HapticViewerOptions& options, vtkRenderWindow* window,
    CommandRegistry& commands, std::function<void()> clipped, std::function<void(const std::string&)> say);

  /// Restores the first view of the cloud.
  void showFirstView();
  void toggleProjection();
  void toggleFullScreen();
  /// False: the window does not fill the screen.
  bool leaveFullScreen() { return fullScreen_.isFull() && fullScreen_.set(false); }
  /// Pictures for two eyes, as they were asked for last, or one.
  void toggleStereo();
  /// Lets the view turn about the cloud, or stops it.
  void toggleTurntable();
  /// Makes the point under the mouse the one that the view turns about, in the middle of the picture.
  void setPivot();
  /// Lets keys walk through the cloud and drags look around, or stops it.
  void toggleWalk();
  /// False: nobody walks.
  bool endWalk();
  /// A step of the walk, in the directions of the screen.
  void walk(double right, double up, double forward);
  void lookAround();
  /// Turns the view to its place at @p seconds of a steady clock. False: it stands still.
  bool turnTable(double seconds);
  FullScreen& fullScreen() { return fullScreen_; }
  /// Makes points larger (@p direction 1) or smaller (-1).
  void scalePoints(int direction);
  /// Makes the shading by depth stronger (@p direction 1) or weaker (-1).
  void changeDepthStrength(int direction);
  void showNextBackground();
  void showNextTheme();
  void showNextColorMap();
  /// Drags the value at @p from on a colour bar of that @p range, 0 to 1 upwards, to @p to; the end farther
  /// away stays.
  void dragColorRange(std::array<double, 2> range, double from, double to);
  void resetColorRange();
  /// Hides or shows the points of a class or file, by its number.
  void toggleLabel(double label);
  /// Hides the points with values outside of the colours' range; shows all where some are hidden.
  void toggleOutside();
  /// Shows one of several files alone; all behind the last.
  void showAlone(std::size_t file);

  /// Adds the commands of the result of @p controls, for as long as it exists.
  using Getter = std::function<PictureControls*()>;
  static void addCommands(CommandRegistry& commands, const Getter& controls);

private:
  static void addViewCommands(CommandRegistry& commands, const Getter& controls);
  void takeNext(std::string& name, const std::vector<std::string>& names);
  void apply();
  void hide(std::vector<HiddenValues> hidden);

  ViewScene& scene_;
  HapticViewerOptions& options_;
  vtkRenderWindow* window_;
  FullScreen fullScreen_;
  CommandRegistry& commands_;
  std::function<void()> clipped_;
  std::function<void(const std::string&)> say_;
  std::string stereo_; ///< Stereo mode that was shown last; empty: none was.
  bool turns_ = false;
  bool walks_ = false;
  double turnedAt_ = -1.0; ///< Seconds; below 0: not yet.
};

} // namespace pointhaptics
