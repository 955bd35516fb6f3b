/// @file
/// What keys do to the picture: from where it is taken, and how it is drawn.
#pragma once

#include "CommandRegistry.h"
#include "FullScreen.h"
#include "HapticViewerOptions.h"

#include <array>
#include <functional>
#include <string>

namespace pointhaptics
{

class ViewScene;

/// GUI thread only.
class PictureControls
{
public:
  /// Changes @p scene and the picture of @p options, which must outlive this, and @p window. @p say tells the
  /// person what was done.
  PictureControls(ViewScene& scene, HapticViewerOptions& options, vtkRenderWindow* window,
    std::function<void(const std::string&)> say);

  void lookFrom(double azimuth, double elevation);
  /// As the cloud was first seen.
  void showFirstView();
  void fitView();
  void toggleProjection();
  void toggleFullScreen();
  /// False: the window does not fill the screen.
  bool leaveFullScreen();
  /// Pictures for two eyes, as they were asked for last, or one.
  void toggleStereo();
  /// The view turns about the cloud, or stops.
  void toggleTurntable();
  /// Turns it on to what it is at @p seconds of a steady clock. False: it stands still.
  bool turnTable(double seconds);
  FullScreen& fullScreen() { return fullScreen_; }
  /// @p direction 1: larger, -1: smaller.
  void scalePoints(int direction);
  /// @p direction 1: stronger, -1: weaker.
  void changeDepthStrength(int direction);
  void showNextBackground();
  void showNextTheme();
  void showNextColorMap();
  /// Takes the value that was @p from up a colour bar of that @p range, 0 to 1, to @p to; the end farther
  /// away stays.
  void dragColorRange(std::array<double, 2> range, double from, double to);
  void resetColorRange();

  /// Adds what the result of @p controls can do, as long as there is one.
  static void addCommands(CommandRegistry& commands, std::function<PictureControls*()> controls);

private:
  static void addViewCommands(CommandRegistry& commands, const std::function<PictureControls*()>& controls);
  void apply();

  ViewScene& scene_;
  HapticViewerOptions& options_;
  FullScreen fullScreen_;
  std::function<void(const std::string&)> say_;
  std::string stereo_; ///< The one that was shown last; empty: none was.
  bool turns_ = false;
  double turnedAt_ = -1.0; ///< Seconds; below 0: not yet.
};

} // namespace pointhaptics
