#include "PictureControls.h"

#include "StereoPicture.h"
#include "ViewScene.h"

#include "CloudAppearance.h"
#include "ColorMaps.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace pointhaptics
{
namespace
{

constexpr double kPointStep = 1.25;
constexpr double kLargestScale = 10.0;
constexpr double kDepthStep = 0.4;
constexpr double kStrongest = 10.0;
constexpr const char* kNoQuadBuffers =
  " needs a screen that shows two pictures, and to be asked for at the start; choose anaglyph or another by "
  "--stereo";
/// Speed of the turntable: a turn takes 12 seconds.
constexpr double kDegreesPerSecond = 30.0;
constexpr double kLongestStep = 0.2; // seconds
/// Angles from which a cube shows three equal faces.
constexpr double kIsometricAzimuth = 45.0;
constexpr double kIsometricElevation = 35.2643896828;

/// The dragged value stays at least this far from the fixed end: this bounds how far one drag stretches a
/// bar.
constexpr double kNearestToEnd = 0.05;

void takeNext(std::string& name, const std::vector<std::string>& names)
{
  const auto found = std::find(names.begin(), names.end(), name);
  name = found == names.end() || found + 1 == names.end() ? names.front() : *(found + 1);
}

struct AxisView
{
  const char* name;
  const char* keys;
  double azimuth;
  double elevation;
};

constexpr AxisView kViews[] = { { "view-front", "1 KP_1", 0.0, 0.0 }, { "view-back", "2 KP_2", 180.0, 0.0 },
  { "view-left", "3 KP_3", -90.0, 0.0 }, { "view-right", "4 KP_4", 90.0, 0.0 },
  { "view-top", "5 KP_5", 0.0, 90.0 }, { "view-bottom", "6 KP_6", 0.0, -90.0 },
  { "view-isometric", "7 KP_7", kIsometricAzimuth, kIsometricElevation } };

} // namespace

PictureControls::PictureControls(ViewScene& scene, HapticViewerOptions& options, vtkRenderWindow* window,
  std::function<void(const std::string&)> say)
  : scene_(scene)
  , options_(options)
  , fullScreen_(window)
  , say_(std::move(say))
{
}

void PictureControls::apply()
{
  scene_.setPicture(options_.picture);
}

void PictureControls::lookFrom(double azimuth, double elevation)
{
  scene_.lookFrom(azimuth, elevation);
}

void PictureControls::showFirstView()
{
  scene_.placeCamera();
  scene_.setCamera(options_.camera);
}

void PictureControls::fitView()
{
  scene_.fitView();
}

void PictureControls::toggleProjection()
{
  options_.picture.parallel = !options_.picture.parallel;
  this->apply();
  say_(options_.picture.parallel ? "parallel projection" : "perspective projection");
}

void PictureControls::toggleFullScreen()
{
  if (!fullScreen_.set(!fullScreen_.isFull()))
  {
    say_("full screen: this window system does not offer it; enlarge the window by its border");
  }
}

bool PictureControls::leaveFullScreen()
{
  return fullScreen_.isFull() && fullScreen_.set(false);
}

void PictureControls::toggleStereo()
{
  std::string& stereo = options_.picture.stereo;
  if (stereo == stereoNames().front())
  {
    stereo = stereo_.empty() ? kUsualStereo : stereo_;
  }
  else
  {
    stereo_ = stereo;
    stereo = stereoNames().front();
  }
  this->apply();
  const bool fails = stereo != stereoNames().front() && !scene_.isStereo();
  say_("stereo: " + stereo + (fails ? std::string(kNoQuadBuffers) : std::string()));
}

void PictureControls::toggleTurntable()
{
  turns_ = !turns_;
  turnedAt_ = -1.0;
  say_(turns_ ? "turntable: turning" : "turntable: stopped");
}

bool PictureControls::turnTable(double seconds)
{
  if (turns_)
  {
    // A frame that takes long must not make the view jump.
    const double since = turnedAt_ < 0.0 ? 0.0 : std::min(seconds - turnedAt_, kLongestStep);
    scene_.turnView(kDegreesPerSecond * since);
    turnedAt_ = seconds;
  }
  return turns_;
}

void PictureControls::scalePoints(int direction)
{
  double& scale = options_.picture.pointScale;
  scale = std::clamp(scale * std::pow(kPointStep, direction), 1.0 / kLargestScale, kLargestScale);
  scale = std::abs(scale - 1.0) < 1e-6 ? 1.0 : scale;
  this->apply();
  say_(fmt::format("point size: {:.3g} times", scale));
}

void PictureControls::changeDepthStrength(int direction)
{
  double& strength = options_.picture.depthStrength;
  strength = std::clamp(strength + direction * kDepthStep, 0.0, kStrongest);
  strength = 1e-6 * std::round(1e6 * strength);
  this->apply();
  say_(strength > 0.0 ? fmt::format("shading by depth: strength {:.2g}", strength) : "shading by depth: off");
}

void PictureControls::showNextBackground()
{
  takeNext(options_.picture.background, groundNames());
  this->apply();
  say_("background: " + options_.picture.background);
}

void PictureControls::showNextTheme()
{
  takeNext(options_.picture.theme, themeNames());
  this->apply();
  say_("theme: " + options_.picture.theme);
}

void PictureControls::showNextColorMap()
{
  takeNext(options_.picture.colorMap, colorMapNames());
  this->apply();
  say_("colours: " + options_.picture.colorMap +
    (scene_.isColoredByMap() ? "" : "; seen where numbers colour the cloud"));
}

void PictureControls::dragColorRange(std::array<double, 2> range, double from, double to)
{
  const double value = range[0] + from * (range[1] - range[0]);
  // The dragged value stays under the pointer; the end that is farther away stays.
  if (from > 0.5)
  {
    range[1] = range[0] + (value - range[0]) / std::clamp(to, kNearestToEnd, 1.0);
  }
  else
  {
    range[0] = range[1] - (range[1] - value) / std::clamp(1.0 - to, kNearestToEnd, 1.0);
  }
  options_.picture.colorRange = { range[0], range[1] };
  this->apply();
  say_(fmt::format("colours from {:.4g} to {:.4g}", range[0], range[1]));
}

void PictureControls::resetColorRange()
{
  options_.picture.colorRange.clear();
  this->apply();
  say_("colours over all values");
}

void PictureControls::addViewCommands(
  CommandRegistry& commands, const std::function<PictureControls*()>& controls)
{
  const auto isOpen = [controls] { return controls() != nullptr; };
  const auto call = [controls](void (PictureControls::*action)())
  {
    return [controls, action]
    {
      if (PictureControls* open = controls())
      {
        (open->*action)();
      }
    };
  };
  const char* const group = "Look";
  for (const AxisView& view : kViews)
  {
    const auto look = [controls, view]
    {
      if (PictureControls* open = controls())
      {
        open->lookFrom(view.azimuth, view.elevation);
      }
    };
    commands.add(
      { view.name, view.keys, group, "front, back, left, right, top, bottom, isometric", look, isOpen });
  }
  using Controls = PictureControls;
  commands.add({ "first-view", "e", group, "as it was first seen", call(&Controls::showFirstView), isOpen });
  commands.add(
    { "reset-view", "r", group, "fit the cloud, level the horizon", call(&Controls::fitView), isOpen });
  commands.add({ "projection", "P", group, "parallel or perspective projection",
    call(&Controls::toggleProjection), isOpen });
  commands.add(
    { "turntable", "T", group, "turn about the cloud, stop", call(&Controls::toggleTurntable), isOpen });
  commands.add(
    { "stereo", "S", group, "a picture for each eye, or one", call(&Controls::toggleStereo), isOpen });
  commands.add({ "full-screen", "F11", group, "full screen", call(&Controls::toggleFullScreen), isOpen });
}

void PictureControls::addCommands(CommandRegistry& commands, std::function<PictureControls*()> controls)
{
  addViewCommands(commands, controls);
  const auto isOpen = [controls] { return controls() != nullptr; };
  const auto step = [controls](void (PictureControls::*action)(int), int direction)
  {
    return [controls, action, direction]
    {
      if (PictureControls* open = controls())
      {
        (open->*action)(direction);
      }
    };
  };
  using Controls = PictureControls;
  const char* const group = "Show";
  commands.bind("scale-up", "Ctrl+plus Ctrl+Shift+plus Ctrl+equal Ctrl+KP_Add");
  commands.bind("scale-down", "Ctrl+minus Ctrl+KP_Subtract");
  commands.add({ "points-larger", "plus equal KP_Add", group, "larger, smaller points",
    step(&Controls::scalePoints, +1), isOpen });
  commands.add({ "points-smaller", "minus underscore KP_Subtract", group, "larger, smaller points",
    step(&Controls::scalePoints, -1), isOpen });
  commands.add({ "depth-stronger", "bracketright", group, "stronger, weaker shading by depth",
    step(&Controls::changeDepthStrength, +1), isOpen });
  commands.add({ "depth-weaker", "bracketleft", group, "stronger, weaker shading by depth",
    step(&Controls::changeDepthStrength, -1), isOpen });
  const auto call = [controls](void (PictureControls::*action)())
  {
    return [controls, action]
    {
      if (PictureControls* open = controls())
      {
        (open->*action)();
      }
    };
  };
  commands.add({ "background", "G", group, "background: dark, light, white, black",
    call(&Controls::showNextBackground), isOpen });
  commands.add({ "theme", "F9", group, "high contrast", call(&Controls::showNextTheme), isOpen });
  commands.add({ "color-map", "k", group, "next colour map", call(&Controls::showNextColorMap), isOpen });
  commands.add(
    { "color-range", "K", group, "colours over all values", call(&Controls::resetColorRange), isOpen });
  commands.addNote(group, "drag on the colour bar", "colours over fewer or more values");
}

} // namespace pointhaptics
