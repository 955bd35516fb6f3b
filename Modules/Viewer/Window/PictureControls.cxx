#include "PictureControls.h"

#include "StereoPicture.h"
#include "ViewScene.h"

#include "ClippedCloud.h"
#include "CloudAppearance.h"
#include "ColorMaps.h"

#include <fmt/format.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>

#include <algorithm>
#include <cmath>
#include <utility>

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
constexpr double kStepOfWalk = 0.02; ///< Step over the workspace's longest edge: 50 lead through a room.
constexpr double kDegreesPerPixel = 0.2;

/// The dragged value stays at least this far from the fixed end: this bounds how far one drag stretches a
/// bar.
constexpr double kNearestToEnd = 0.05;

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

struct WalkStep
{
  const char* name;
  const char* keys;
  double right, up, forward;
};

constexpr WalkStep kWalkSteps[] = { { "walk-forward", "Walk+w Walk+Up", 0.0, 0.0, 1.0 },
  { "walk-left", "Walk+a Walk+Left", -1.0, 0.0, 0.0 }, { "walk-back", "Walk+s Walk+Down", 0.0, 0.0, -1.0 },
  { "walk-right", "Walk+d Walk+Right", 1.0, 0.0, 0.0 }, { "walk-up", "Walk+Prior", 0.0, 1.0, 0.0 },
  { "walk-down", "Walk+Next", 0.0, -1.0, 0.0 } };

} // namespace

PictureControls::PictureControls(const ToolContext& context)
  : context_(context)
  , fullScreen_(context.window)
{
}

void PictureControls::apply()
{
  context_.scene.setPicture(context_.options.picture);
}

void PictureControls::showFirstView()
{
  context_.scene.placeCamera();
  context_.scene.setCamera(context_.options.camera);
}

void PictureControls::toggleProjection()
{
  context_.options.picture.parallel = !context_.options.picture.parallel;
  this->apply();
  context_.say(context_.options.picture.parallel ? "parallel projection" : "perspective projection");
}

void PictureControls::toggleFullScreen()
{
  if (!fullScreen_.set(!fullScreen_.isFull()))
  {
    context_.say("full screen: this window system does not offer it; enlarge the window by its border");
  }
}

void PictureControls::toggleStereo()
{
  std::string& stereo = context_.options.picture.stereo;
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
  const bool fails = stereo != stereoNames().front() && !context_.scene.isStereo();
  context_.say("stereo: " + stereo + (fails ? std::string(kNoQuadBuffers) : std::string()));
}

void PictureControls::toggleTurntable()
{
  turns_ = !turns_;
  turnedAt_ = -1.0;
  context_.say(turns_ ? "turntable: turning" : "turntable: stopped");
}

void PictureControls::setPivot()
{
  const int* at = context_.window->GetInteractor()->GetEventPosition();
  Vec3 place;
  if (context_.scene.placeAt(at[0], at[1], place))
  {
    context_.scene.centerView(place);
    context_.say("the view turns about the point in the middle");
  }
  else
  {
    context_.say("no point is there to turn about");
  }
}

void PictureControls::toggleWalk()
{
  walks_ = !walks_;
  context_.commands.setModifier(walks_ ? "Walk+" : "");
  context_.say(walks_
      ? "walking: w, a, s, d go, a drag looks around; " + context_.commands.label("walk") + " stops"
      : "walking: stopped");
}

bool PictureControls::endWalk()
{
  const bool walked = walks_;
  if (walked)
  {
    this->toggleWalk();
  }
  return walked;
}

void PictureControls::walk(double right, double up, double forward)
{
  const Vec3 extent = context_.scene.workspace().extent();
  const double step = kStepOfWalk * std::max({ extent.x, extent.y, extent.z });
  context_.scene.walk(step * right, step * up, step * forward);
}

void PictureControls::lookAround()
{
  const int* to = context_.window->GetInteractor()->GetEventPosition();
  const int* from = context_.window->GetInteractor()->GetLastEventPosition();
  context_.scene.lookAround(kDegreesPerPixel * (to[0] - from[0]), kDegreesPerPixel * (from[1] - to[1]));
}

bool PictureControls::turnTable(double seconds)
{
  if (turns_)
  {
    // A frame that takes long must not make the view jump.
    const double since = turnedAt_ < 0.0 ? 0.0 : std::min(seconds - turnedAt_, kLongestStep);
    context_.scene.turnView(kDegreesPerSecond * since);
    turnedAt_ = seconds;
  }
  return turns_;
}

void PictureControls::scalePoints(int direction)
{
  double& scale = context_.options.picture.pointScale;
  scale = std::clamp(scale * std::pow(kPointStep, direction), 1.0 / kLargestScale, kLargestScale);
  scale = std::abs(scale - 1.0) < 1e-6 ? 1.0 : scale;
  this->apply();
  context_.say(fmt::format("point size: {:.3g} times", scale));
}

void PictureControls::changeDepthStrength(int direction)
{
  double& strength = context_.options.picture.depthStrength;
  strength = std::clamp(strength + direction * kDepthStep, 0.0, kStrongest);
  strength = 1e-6 * std::round(1e6 * strength);
  this->apply();
  context_.say(
    strength > 0.0 ? fmt::format("shading by depth: strength {:.2g}", strength) : "shading by depth: off");
}

/// Takes the next of @p names in the place of @p name, and draws it.
void PictureControls::takeNext(std::string& name, const std::vector<std::string>& names)
{
  const auto found = std::find(names.begin(), names.end(), name);
  name = found == names.end() || found + 1 == names.end() ? names.front() : *(found + 1);
  this->apply();
}

void PictureControls::showNextBackground()
{
  this->takeNext(context_.options.picture.background, groundNames());
  context_.say("background: " + context_.options.picture.background);
}

void PictureControls::showNextTheme()
{
  this->takeNext(context_.options.picture.theme, themeNames());
  context_.say("theme: " + context_.options.picture.theme);
}

void PictureControls::showNextColorMap()
{
  this->takeNext(context_.options.picture.colorMap, colorMapNames());
  context_.say("colour map: " + context_.options.picture.colorMap +
    (context_.scene.isColoredByMap() ? ""
                                     : "; " + context_.commands.label("colors") + " colours by an array"));
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
  context_.options.picture.colorRange = { range[0], range[1] };
  this->apply();
  context_.say("colours from " + rangeText(range[0], range[1]));
}

void PictureControls::resetColorRange()
{
  context_.options.picture.colorRange.clear();
  this->apply();
  context_.say("colour map over all values");
}

void PictureControls::hide(std::vector<HiddenValues> hidden)
{
  context_.options.picture.hidden = std::move(hidden);
  this->apply();
  context_.clipped(); // after what was said: a recording that ends says so
}

void PictureControls::forgetHeights(PictureSettings& picture) const
{
  picture.colorRange.resize(context_.scene.colorArray() == kHeightArrayName ? 0 : picture.colorRange.size());
  const auto isOfHeights = [](const HiddenValues& each) { return each.array == kHeightArrayName; };
  picture.hidden.erase(
    std::remove_if(picture.hidden.begin(), picture.hidden.end(), isOfHeights), picture.hidden.end());
}

void PictureControls::toggleLabel(double label)
{
  const HiddenValues values{ context_.scene.colorArray(), label, label };
  std::vector<HiddenValues> hidden;
  bool hides = true;
  for (const HiddenValues& each : context_.options.picture.hidden)
  {
    if (each.array != values.array || label < each.low || label > each.high)
    {
      hidden.push_back(each);
      continue;
    }
    hides = false; // labels are whole numbers: the others of the range stay hidden
    for (const HiddenValues& rest :
      { HiddenValues{ each.array, each.low, label - 1.0 }, { each.array, label + 1.0, each.high } })
    {
      rest.low <= rest.high ? hidden.push_back(rest) : void();
    }
  }
  hides ? hidden.push_back(values) : void();
  context_.say((hides ? "hidden: " : "shown: ") + textOf(values));
  this->hide(std::move(hidden));
}

void PictureControls::toggleOutside()
{
  if (!context_.options.picture.hidden.empty())
  {
    context_.say("nothing is hidden");
    this->hide({});
    return;
  }
  if (!context_.scene.isColoredByMap())
  {
    const bool hasClasses = holdsLabels(context_.scene.colorArray());
    context_.say(hasClasses ? "nothing is hidden; click on the name of a class to hide it"
                            : "hides values outside of the colour map; " + context_.commands.label("colors") +
          " colours by an array");
    return;
  }
  const std::array<double, 2> range = context_.scene.shownColorRange();
  const std::string array = context_.scene.colorArray();
  if (!context_.scene.canHideBy(array))
  {
    context_.say(
      array + " is computed for the picture and hides nothing; colour by heights or an array of the file");
    return;
  }
  context_.say(fmt::format("hidden: {} outside of {}", array, rangeText(range[0], range[1])));
  this->hide({ { array, -INFINITY, std::nextafter(range[0], -INFINITY) },
    { array, std::nextafter(range[1], INFINITY), INFINITY } });
}

void PictureControls::showAlone(std::size_t file)
{
  const std::vector<std::string> names = context_.scene.fileNames();
  const bool isOne = file < names.size();
  const double number = double(file);
  std::vector<HiddenValues> hidden = context_.options.picture.hidden;
  hidden.erase(std::remove_if(hidden.begin(), hidden.end(),
                 [](const HiddenValues& each) { return each.array == kFileArrayName; }),
    hidden.end());
  if (isOne)
  {
    hidden.push_back({ kFileArrayName, -INFINITY, number - 1.0 });
    hidden.push_back({ kFileArrayName, number + 1.0, INFINITY });
  }
  context_.say(
    isOne ? fmt::format("file {} of {}, alone: {}", file + 1, names.size(), names[file]) : "all files");
  this->hide(std::move(hidden));
}

void PictureControls::addViewCommands(CommandRegistry& commands, const Getter& controls)
{
  using Controls = PictureControls;
  CommandGroup<Controls> look(commands, "Look", controls);
  for (const AxisView& view : kViews)
  {
    look.add(view.name, view.keys, "front, back, left, right, top, bottom, isometric",
      [view](Controls& self) { self.context_.scene.lookFrom(view.azimuth, view.elevation); });
  }
  look.add("first-view", "e", "as it was first seen", &Controls::showFirstView);
  look.add("reset-view", "r", "fit the cloud, level the horizon",
    [](Controls& self) { self.context_.scene.fitView(); });
  look.add("projection", "P", "parallel or perspective projection", &Controls::toggleProjection);
  look.add("turntable", "T", "turn about the cloud, stop", &Controls::toggleTurntable);
  look.add("stereo", "S", "a picture for each eye, or one", &Controls::toggleStereo);
  look.add("walk", "F5", "walk through the cloud, stop", &Controls::toggleWalk);
  for (const WalkStep& step : kWalkSteps)
  {
    look.add(step.name, step.keys, "of the walk: forward, left, back, right, up, down", &Controls::walk,
      step.right, step.up, step.forward);
  }
  look.add("look-around-drag", "Walk+left", "of the walk: look around",
    DragAction{ {}, look.call(&Controls::lookAround), {} });
  look.add("walk-wheel", "Walk+wheel", "of the walk: forward, back",
    WheelAction{ look.call(&Controls::walk, 0.0, 0.0) });
  look.add("full-screen", "F11", "full screen", &Controls::toggleFullScreen);
}

void PictureControls::addCommands(CommandRegistry& commands, const Getter& controls)
{
  using Controls = PictureControls;
  addViewCommands(commands, controls);
  commands.bind("scale-up", "Ctrl+plus Ctrl+Shift+plus Ctrl+equal Ctrl+KP_Add");
  commands.bind("scale-down", "Ctrl+minus Ctrl+KP_Subtract");
  CommandGroup<Controls> show(commands, "Show", controls);
  const char* const sizes = "larger, smaller points";
  const char* const shading = "stronger, weaker shading by depth";
  show.add("points-larger", "plus equal KP_Add", sizes, &Controls::scalePoints, +1);
  show.add("points-smaller", "minus underscore KP_Subtract", sizes, &Controls::scalePoints, -1);
  show.add("depth-stronger", "bracketright", shading, &Controls::changeDepthStrength, +1);
  show.add("depth-weaker", "bracketleft", shading, &Controls::changeDepthStrength, -1);
  show.add("background", "G", "background: dark, light, white, black", &Controls::showNextBackground);
  show.add("theme", "F9", "high contrast", &Controls::showNextTheme);
  show.add("color-map", "k", "next colour map", &Controls::showNextColorMap);
  show.add("color-range", "K", "colour map over all values", &Controls::resetColorRange);
  show.add(
    "hide-outside", "F10", "hide values outside of the colour map, show all", &Controls::toggleOutside);
  commands.addNote("Show", "click on a class or file", "hide, show; beside the colours");
  commands.addNote("Show", "drag on the colour bar", "colours over fewer or more values");
}

} // namespace pointhaptics
