#include "ClipBoxTool.h"

#include "ClippedCloud.h"
#include "CommandRegistry.h"
#include "CoordinateText.h"
#include "HapticViewerOptions.h"
#include "ViewScene.h"

#include <fmt/format.h>

#include <algorithm>

namespace pointhaptics
{
namespace
{

constexpr float kBoxBeforeTheStyle = 1.0F;
constexpr int kFaces = 6;
/// Step of a face by key, and least thickness of the box, over the cloud's extent.
constexpr double kStep = 0.02;
constexpr double kThinnest = 1e-3;
/// Names of the faces by number: even numbers are lower faces.
constexpr const char* kFaceNames[kFaces] = { "xmin", "xmax", "ymin", "ymax", "zmin", "zmax" };

} // namespace

ClipBoxTool::ClipBoxTool(const ToolContext& context)
  : context_(context)
  , button_(context.interactor, kBoxBeforeTheStyle,
      [this](const LeftButton::Event& event) { return this->takes(event); })
{
}

void ClipBoxTool::toggle()
{
  ClipBoxMark& mark = context_.scene.clipMark();
  mark.setBox(context_.scene.shownBox());
  mark.setVisible(!mark.isVisible());
  context_.say(mark.isVisible() ? "clipping box: drag its handles" : "clipping box: hidden");
}

bool ClipBoxTool::hide()
{
  const bool isShown = context_.scene.clipMark().isVisible();
  if (isShown)
  {
    this->toggle();
  }
  return isShown;
}

void ClipBoxTool::clear()
{
  const bool wasClipped = !context_.options.clip.empty();
  this->forget();
  context_.scene.setClip({});
  context_.say("clipping box: none, the whole cloud is shown");
  if (wasClipped)
  {
    context_.clipped();
  }
}

void ClipBoxTool::forget()
{
  context_.options.clip.clear();
  dragged_ = -1;
  context_.scene.clipMark().setVisible(false);
}

void ClipBoxTool::chooseNextFace()
{
  ClipBoxMark& mark = context_.scene.clipMark();
  if (mark.isVisible())
  {
    mark.setActiveFace((mark.activeFace() + 1) % kFaces);
  }
  else
  {
    this->toggle();
  }
  context_.say(std::string("clipping box: keys move ") + kFaceNames[mark.activeFace()]);
}

void ClipBoxTool::moveFace(int direction)
{
  ClipBoxMark& mark = context_.scene.clipMark();
  if (!mark.isVisible())
  {
    this->toggle();
  }
  const int face = mark.activeFace();
  this->move(
    face, context_.scene.shownBox(), direction * kStep * context_.scene.cloudBounds().extent()[face / 2]);
  this->finish();
}

/// Sets the box to @p from with face @p face moved outward by @p way. The face stops before the opposite one,
/// where the box is thinnest, and at the end of the cloud, or where it is if it lies outside already.
void ClipBoxTool::move(int face, const Bounds& from, double way)
{
  const int axis = face / 2;
  const Bounds cloud = context_.scene.cloudBounds();
  const double thinnest = kThinnest * cloud.extent()[axis];
  Bounds box = from;
  if (face % 2 == 0)
  {
    const double least = std::min(cloud.minimum[axis], from.minimum[axis]);
    const double most = std::max(least, from.maximum[axis] - thinnest);
    box.minimum[axis] = std::clamp(from.minimum[axis] - way, least, most);
  }
  else
  {
    const double most = std::max(cloud.maximum[axis], from.maximum[axis]);
    const double least = std::min(most, from.minimum[axis] + thinnest);
    box.maximum[axis] = std::clamp(from.maximum[axis] + way, least, most);
  }
  context_.options.clip = clipNumbers(box, context_.scene.cloud());
  context_.scene.setClip(context_.options.clip);
  context_.scene.clipMark().setBox(box);
}

/// Publishes the new box to touch: the felt points are those that are shown.
void ClipBoxTool::finish()
{
  const int face = context_.scene.clipMark().activeFace();
  const std::vector<double>& clip = context_.options.clip;
  context_.say(fmt::format("clipping box: {} {} {}", kFaceNames[face], valueText(clip[std::size_t(face)]),
    context_.scene.unit().name));
  context_.clipped(); // after what was said: a recording that ends says so
}

bool ClipBoxTool::takes(const LeftButton::Event& event)
{
  ClipBoxMark& mark = context_.scene.clipMark();
  if (event.kind == LeftButton::Kind::Press)
  {
    dragged_ = event.isPlain ? mark.faceAt(event.x, event.y).value_or(-1) : -1;
    if (dragged_ >= 0)
    {
      mark.setActiveFace(dragged_);
      from_ = context_.scene.shownBox();
      fromX_ = event.x;
      fromY_ = event.y;
      perRight_ = mark.wayOf(dragged_, 1.0, 0.0);
      perUp_ = mark.wayOf(dragged_, 0.0, 1.0);
    }
    return dragged_ >= 0;
  }
  if (dragged_ < 0)
  {
    return false;
  }
  this->move(dragged_, from_, perRight_ * (event.x - fromX_) + perUp_ * (event.y - fromY_));
  if (event.kind == LeftButton::Kind::Release)
  {
    dragged_ = -1;
    this->finish();
  }
  button_.render();
  return true;
}

void ClipBoxTool::addCommands(CommandRegistry& commands, const std::function<ClipBoxTool*()>& tool)
{
  const char* const faces = "next face of the box; inward, outward";
  CommandGroup<ClipBoxTool> show(commands, "Show", tool);
  show.add("clip-box", "C", "clipping box: drag its handles", &ClipBoxTool::toggle);
  show.add("clip-face", "Tab", faces, &ClipBoxTool::chooseNextFace);
  show.add("clip-inward", "comma less", faces, &ClipBoxTool::moveFace, -1);
  show.add("clip-outward", "period greater", faces, &ClipBoxTool::moveFace, +1);
  show.add("clip-nothing", "Delete", "clip nothing", &ClipBoxTool::clear);
}

} // namespace pointhaptics
