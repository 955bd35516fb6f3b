/// @file
/// The viewer's picture of a file, off the screen, under a camera that turns.
#pragma once

#include "ViewScene.h"

#include <vtkNew.h>
#include <vtkRenderWindow.h>

#include <cstdint>
#include <string>

namespace pointhaptics::bench::render
{

/// GUI thread only; needs a display.
class Turntable
{
public:
  Turntable() = default;
  ~Turntable();
  Turntable(const Turntable&) = delete;
  Turntable& operator=(const Turntable&) = delete;

  /// Reads and resamples @p file and draws it. False: @p message says why there is no picture. Call it once.
  bool open(const std::string& file, int width, int height, std::string& message);

  /// The kind of cloud as the viewer sees it: "object", "terrain", "sweep", "indoors" or "frame".
  std::string kind() const;
  /// Level of detail on or off, from the next frame on.
  void setDetail(bool on);
  /// Turns the camera and renders; returns when the frame is finished.
  void turn(double degrees);
  /// Renders without a motion, until nothing gets finer; returns the number of frames.
  int rest();
  /// Turns the camera and renders the picture of a camera at rest at once: all points, several samples a
  /// pixel.
  void turnToStill(double degrees);
  /// True if the last frame showed all that pixels can tell apart.
  bool showsAll() const;
  /// Points there are, and those of the last frame.
  std::int64_t allPoints() const;
  std::int64_t drawnPoints() const;

private:
  void render();

  ViewScene scene_;
  vtkNew<vtkRenderWindow> window_;
};

} // namespace pointhaptics::bench::render
