/// @file
/// `pointhaptics bench render`: how fast the viewer's picture turns, and how soon there is one.
#pragma once

#include "Benchmark/Report/Report.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace pointhaptics
{
namespace bench
{
namespace render
{

constexpr double kDegreesPerFrame = 2.0;

/// What a picture is drawn with, each with all before it.
enum class Effect
{
  Discs,   ///< Of 3 pixels each.
  Sizes,   ///< As large as the spacing says.
  Tilt,    ///< With light and depth by their normals, blended at rest.
  Shading, ///< Eye-dome light: all that the viewer draws.
};

/// The viewer's picture of a file, off the screen. GUI thread only.
class Turntable
{
public:
  virtual ~Turntable() = default;
  /// What the viewer takes the file for: "object", "terrain", "sweep", "indoors" or "frame".
  virtual std::string kind() const = 0;
  /// Effects up to @p last, from the next frame on; all at first.
  virtual void setEffects(Effect last) = 0;
  /// Level of detail on or off, from the next frame on.
  virtual void setDetail(bool on) = 0;
  /// Turns the camera and renders; returns when the frame is finished.
  virtual void turn(double degrees) = 0;
  /// Renders without a motion, until nothing gets finer; returns the number of frames.
  virtual int rest() = 0;
  /// Turns the camera and renders the picture of a camera at rest at once: all points, several samples a
  /// pixel. With all effects only.
  virtual void turnToStill(double degrees) = 0;
  /// Points there are, and those of the last frame.
  virtual std::int64_t allPoints() const = 0;
  virtual std::int64_t drawnPoints() const = 0;
};

/// Null: @p message says why there is no picture.
using MakeTurntable = std::function<std::unique_ptr<Turntable>(
  const std::string& file, int width, int height, std::string& message)>;

/// The viewer with a servo loop and a still hand that touches the cloud.
class ModelMover
{
public:
  /// From a key's event until the servo loop had a scene of it; below 0: it did not come.
  struct Response
  {
    double movedSeconds; ///< The old voxels where the model is now.
    double nearSeconds;  ///< New voxels, resampled there, within reach of the hand.
    double wholeSeconds; ///< New voxels of the whole cloud.
  };

  virtual ~ModelMover() = default;
  /// Presses @p key, which moves the model, and goes on as the viewer's window does until both came.
  virtual Response press(const char* key) = 0;
};

/// Null: @p message says why there is none.
using MakeModelMover = std::function<std::unique_ptr<ModelMover>(
  const std::string& file, int width, int height, std::string& message)>;

struct RenderBenchmarkOptions
{
  std::vector<std::int64_t> points = { 543652, 5000000 };
  std::vector<std::string> files; ///< Measured in the place of made points, where there are any.
  int width = 1280;
  int height = 720;
  int fileHeight = 800; ///< Of the pictures of files.
  int frames = 60;      ///< Of a turn; half as many come before, untimed, for the budget to settle.
  int repetitions = 5;
  bool withF3d = true;
  int presses = 30; ///< Of each key.
  MakeTurntable makeTurntable;
  MakeModelMover makeModelMover;

  /// A second or two: to see that everything works. The figures mean little.
  void makeQuick();
};

/// Needs a display. @param wrong what could not be measured; empty: nothing.
Report benchmarkRender(const RenderBenchmarkOptions& options, const Progress& progress, std::string& wrong);

} // namespace render
} // namespace bench
} // namespace pointhaptics
