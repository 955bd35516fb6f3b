#include "ClipBoxTool.h"

#include "ClippedCloud.h"
#include "CommandRegistry.h"
#include "HapticViewerOptions.h"
#include "ViewScene.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

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

ClipBoxTool::ClipBoxTool(ViewScene& scene, HapticViewerOptions& options,
  vtkRenderWindowInteractor* interactor, std::function<void()> clipped,
  std::function<void(const std::string&)> say)
  : scene_(scene)
  , options_(options)
  , clipped_(std::move(clipped))
  , say_(std::move(say))
  , button_(
      interactor, kBoxBeforeTheStyle, [this](const LeftButton::Event& event) { return this->takes(event); })
{
}

void ClipBoxTool::toggle()
{
  ClipBoxMark& mark = scene_.clipMark();
  mark.setBox(scene_.shownBox());
  mark.setVisible(!mark.isVisible());
  say_(mark.isVisible() ? "clipping box: drag its handles" : "clipping box: hidden");
}

bool ClipBoxTool::hide()
{
  const bool isShown = scene_.clipMark().isVisible();
  if (isShown)
  {
    this->toggle();
  }
  return isShown;
}

void ClipBoxTool::clear()
{
  const bool wasClipped = !options_.clip.empty();
  this->forget();
  scene_.setClip({});
  say_("clipping box: none, the whole cloud is shown");
  if (wasClipped)
  {
    clipped_();
  }
}

void ClipBoxTool::forget()
{
  options_.clip.clear();
  dragged_ = -1;
  scene_.clipMark().setVisible(false);
}

void ClipBoxTool::chooseNextFace()
{
  ClipBoxMark& mark = scene_.clipMark();
  if (mark.isVisible())
  {
    mark.setActiveFace((mark.activeFace() + 1) % kFaces);
  }
  else
  {
    this->toggle();
  }
  say_(std::string("clipping box: keys move ") + kFaceNames[mark.activeFace()]);
}

void ClipBoxTool::moveFace(int direction)
{
  ClipBoxMark& mark = scene_.clipMark();
  if (!mark.isVisible())
  {
    this->toggle();
  }
  const int face = mark.activeFace();
  this->move(face, scene_.shownBox(), direction * kStep * scene_.cloudBounds().extent()[face / 2]);
  this->finish();
}

/// Sets the box to @p from with face @p face moved outward by @p way. The face stops before the opposite one,
/// where the box is thinnest, and at the end of the cloud, or where it is if it lies outside already.
void ClipBoxTool::move(int face, const Bounds& from, double way)
{
  const int axis = face / 2;
  const Bounds cloud = scene_.cloudBounds();
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
  options_.clip = clipNumbers(box, scene_.cloud());
  scene_.setClip(options_.clip);
  scene_.clipMark().setBox(box);
}

/// Publishes the new box to touch: the felt points are those that are shown.
void ClipBoxTool::finish()
{
  const int face = scene_.clipMark().activeFace();
  const std::vector<double>& clip = options_.clip;
  say_(
    fmt::format("clipping box: {} {:.6g} {}", kFaceNames[face], clip[std::size_t(face)], scene_.unit().name));
  clipped_(); // after what was said: a recording that ends says so
}

bool ClipBoxTool::takes(const LeftButton::Event& event)
{
  ClipBoxMark& mark = scene_.clipMark();
  if (event.kind == LeftButton::Kind::Press)
  {
    dragged_ = event.isPlain ? mark.faceAt(event.x, event.y).value_or(-1) : -1;
    if (dragged_ >= 0)
    {
      mark.setActiveFace(dragged_);
      from_ = scene_.shownBox();
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
