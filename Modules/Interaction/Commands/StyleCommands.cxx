#include "StyleCommands.h"

#include "ScreenMarks.h"
#include "vtkHapticChart.h"
#include "vtkHapticSliders.h"
#include "vtkInteractorStyleHaptic.h"

#include "vtkCamera.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace pointhaptics
{
namespace
{

using Camera = vtkInteractorStyleTrackballCamera;

constexpr const char* kTranslateHelp = "translate; in hand mode keys move the hand";
constexpr double kDegreesPerPixel = 0.4;
constexpr double kDegreesPerKey = 5.0;
constexpr double kScalePerStep = 1.1;
/// Steps of keys, over the workspace's longest edge.
constexpr double kTranslationPerKey = 0.02;
constexpr double kDepthPerKey = 0.02;
constexpr double kDepthPerWheelStep = 0.01;
/// In hand mode a step covers this part of the distance to the cloud, within the two limits below.
constexpr double kStepOfDistance = 0.3;
constexpr double kShortestStep = 0.002;
constexpr double kShortestStepToTouch = 0.01; ///< Two steps touch from where hand mode begins.
constexpr double kShortestStepAside = 0.01;   ///< Least step along a surface that is touched.
constexpr double kLongestStep = 0.05;
/// Radius of the ball that the hand rolls, and the way that scales by e.
constexpr double kBallRadius = 0.25;
constexpr double kWayPerScale = 0.25;

/// Length of a step of the hand, metres, of at least @p shortest edges of the workspace; @p usual edges where
/// the distance to the cloud is not known.
double handStep(vtkInteractorStyleHaptic& style, double usual, double shortest)
{
  const std::optional<double> distance = style.GetDistance().distance();
  const double edge = style.GetModel().edge();
  shortest = distance && *distance > 0.0 ? std::max(shortest, kShortestStepToTouch) : shortest;
  return distance ? std::clamp(kStepOfDistance * *distance, shortest * edge, kLongestStep * edge)
                  : usual * edge;
}

void addCameraCommands(CommandRegistry& commands, vtkInteractorStyleHaptic& style)
{
  const auto drag = [&style](void (vtkInteractorStyle::*begin)(), void (vtkInteractorStyle::*end)()) {
    return DragAction{ [&style, begin] { (style.*begin)(); }, {}, [&style, end] { (style.*end)(); } };
  };
  const auto dolly = [&style](int direction)
  {
    if (style.GetHand().followsMouse())
    {
      style.GetHand().moveInDepth(direction * handStep(style, kDepthPerWheelStep, kShortestStep));
    }
    else
    {
      direction > 0 ? style.Camera::OnMouseWheelForward() : style.Camera::OnMouseWheelBackward();
    }
  };
  const auto showAll = [&style]
  {
    if (vtkRenderer* renderer = style.GetScreen().renderer())
    {
      renderer->ResetCamera(style.GetModel().workspaceBounds().data());
    }
  };
  const char* const group = "Look";
  commands.add({ "rotate-view-drag", "left", group, "rotate the view",
    drag(&vtkInteractorStyle::StartRotate, &vtkInteractorStyle::EndRotate) });
  commands.add({ "pan-view-drag", "middle", group, "pan",
    drag(&vtkInteractorStyle::StartPan, &vtkInteractorStyle::EndPan) });
  commands.add({ "dolly-view-drag", "right", group, "nearer, farther",
    drag(&vtkInteractorStyle::StartDolly, &vtkInteractorStyle::EndDolly) });
  commands.add({ "dolly-view-wheel", "wheel", group, "nearer, farther", WheelAction{ dolly } });
  commands.add({ "reset-view", "r", group, "whole workspace", showAll });
}

/// Rotates the model as if the mouse rolled a ball: the axis lies in the view plane, across the motion.
void rotateByMouse(vtkInteractorStyleHaptic& style)
{
  if (style.GetScreen().renderer())
  {
    const int* to = style.GetInteractor()->GetEventPosition();
    const int* from = style.GetInteractor()->GetLastEventPosition();
    const ScreenAxes screen = style.GetScreen().axes();
    const double dx = to[0] - from[0];
    const double dy = to[1] - from[1];
    style.GetModel().rotate(kDegreesPerPixel * std::hypot(dx, dy), dx * screen.up - dy * screen.right);
  }
}

void translateByMouse(vtkInteractorStyleHaptic& style)
{
  if (style.GetScreen().renderer())
  {
    style.GetModel().translate(style.GetScreen().mouseMotion(style.GetModel().center()));
  }
}

/// Translates the hand in hand mode, else the model.
void translateOnScreen(vtkInteractorStyleHaptic& style, double right, double up)
{
  if (style.GetHand().followsMouse() && style.GetHand().hasDevice())
  {
    const double step = handStep(style, kTranslationPerKey, kShortestStepAside);
    style.GetHand().moveOnScreen(step * right, step * up);
    return;
  }
  if (style.GetScreen().renderer())
  {
    const ScreenAxes screen = style.GetScreen().axes();
    const double step = kTranslationPerKey * style.GetModel().edge();
    style.GetModel().translate(step * (right * screen.right + up * screen.up));
  }
}

void addModelCommands(CommandRegistry& commands, vtkInteractorStyleHaptic& style)
{
  ModelTransform& model = style.GetModel();
  const auto drag = [&style, &model](void (*move)(vtkInteractorStyleHaptic&))
  {
    return DragAction{ [&model] { model.beginGesture(); }, [&style, move] { move(style); },
      [&model] { model.endGesture(); } };
  };
  const auto rotate = [&model](double degrees, const Vec3& axis)
  { return [&model, degrees, axis] { model.rotate(degrees, axis); }; };
  const auto translate = [&style](double right, double up)
  { return [&style, right, up] { translateOnScreen(style, right, up); }; };
  const auto scale = [&model](int direction) { model.scale(std::pow(kScalePerStep, direction)); };
  const char* const group = "Model";
  commands.add({ "rotate-model-drag", "Shift+left", group, "rotate", drag(rotateByMouse) });
  commands.add({ "rotate-x", "x", group, "rotate", rotate(kDegreesPerKey, { 1.0, 0.0, 0.0 }) });
  commands.add({ "rotate-back-x", "X", group, "rotate", rotate(-kDegreesPerKey, { 1.0, 0.0, 0.0 }) });
  commands.add({ "rotate-y", "y", group, "rotate", rotate(kDegreesPerKey, { 0.0, 1.0, 0.0 }) });
  commands.add({ "rotate-back-y", "Y", group, "rotate", rotate(-kDegreesPerKey, { 0.0, 1.0, 0.0 }) });
  commands.add({ "rotate-z", "z", group, "rotate", rotate(kDegreesPerKey, { 0.0, 0.0, 1.0 }) });
  commands.add({ "rotate-back-z", "Z", group, "rotate", rotate(-kDegreesPerKey, { 0.0, 0.0, 1.0 }) });
  commands.add({ "translate-model-drag", "Shift+middle Ctrl+Shift+left", group, kTranslateHelp,
    drag(translateByMouse) });
  commands.add({ "translate-left", "Left", group, kTranslateHelp, translate(-1.0, 0.0) });
  commands.add({ "translate-right", "Right", group, kTranslateHelp, translate(1.0, 0.0) });
  commands.add({ "translate-up", "Up", group, kTranslateHelp, translate(0.0, 1.0) });
  commands.add({ "translate-down", "Down", group, kTranslateHelp, translate(0.0, -1.0) });
  commands.add({ "scale-model-wheel", "Shift+wheel", group, "scale", WheelAction{ scale } });
  commands.add({ "scale-up", "plus equal KP_Add", group, "scale", [scale] { scale(+1); } });
  commands.add({ "scale-down", "minus underscore KP_Subtract", group, "scale", [scale] { scale(-1); } });
  commands.add({ "undo-model", "u Ctrl+z", group, "undo the last move", [&model] { model.undo(); } });
  commands.add(
    { "reset-model", "0 Home KP_0 KP_Home", group, "back to the start", [&model] { model.reset(); } });
}

/// Hand mode begins above the surface under the pointer.
void toggleHandMode(vtkInteractorStyleHaptic& style)
{
  MouseHand& hand = style.GetHand();
  hand.setFollowsMouse(!hand.followsMouse());
  if (hand.followsMouse())
  {
    style.HoverHand();
  }
}

void addHandCommands(CommandRegistry& commands, vtkInteractorStyleHaptic& style)
{
  MouseHand& hand = style.GetHand();
  const auto hasHand = [&hand] { return hand.hasDevice(); };
  const auto depth = [&style, &hand](int direction, double usual)
  { hand.moveInDepth(direction * handStep(style, usual, kShortestStep)); };
  const auto wheel = [depth](int direction) { depth(direction, kDepthPerWheelStep); };
  const auto follow = [&style] { toggleHandMode(style); };
  const auto push = [&hand] { hand.setPushesPointer(!hand.pushesPointer()); };
  const char* const group = "Hand";
  const auto beginDrag = [&style]
  {
    if (!style.GetHand().isUnderPointer())
    {
      style.HoverHand();
    }
    style.GetHand().setDragged(true);
  };
  commands.add({ "move-hand-drag", "Ctrl+left", group, "comes to a click, moves in the view plane",
    DragAction{ beginDrag, [&hand] { hand.drag(); }, [&hand] { hand.setDragged(false); } }, hasHand });
  commands.add({ "hand-depth-wheel", "Ctrl+wheel", group, "depth", WheelAction{ wheel }, hasHand });
  commands.add(
    { "hand-away", "Prior KP_Prior Page_Up", group, "depth", [depth] { depth(+1, kDepthPerKey); }, hasHand });
  commands.add(
    { "hand-back", "Next KP_Next Page_Down", group, "depth", [depth] { depth(-1, kDepthPerKey); }, hasHand });
  commands.add({ "hand-mode", "f space", group, "hand follows the mouse", follow, hasHand });
  commands.add({ "push-pointer", "g", group, "touch pushes the mouse pointer", push, hasHand });
}

/// Rotates the model as if a ball of a quarter of the workspace were rolled under the hand.
void rotateByHand(vtkInteractorStyleHaptic& style, const Vec3& way)
{
  const ScreenAxes screen = style.GetScreen().axes();
  const Vec3 inPlane = way - dot(way, screen.forward) * screen.forward;
  const double degrees = norm(inPlane) / (kBallRadius * style.GetModel().edge()) * 180.0 / std::acos(-1.0);
  style.GetModel().rotate(degrees, -1.0 * cross(screen.forward, inPlane));
}

/// Moves the workspace over the model. The camera goes with the model, which stays where it is on the screen.
void moveWorkspace(vtkInteractorStyleHaptic& style, const Vec3& way)
{
  vtkCamera* camera = style.GetScreen().renderer()->GetActiveCamera();
  const CameraView view(camera);
  const Vec3 eye = view.eye + way;
  const Vec3 focus = view.focus + way;
  camera->SetPosition(&eye.x);
  camera->SetFocalPoint(&focus.x);
  style.GetModel().translate(way);
}

void addClutchCommands(CommandRegistry& commands, vtkInteractorStyleHaptic& style)
{
  const auto hasServo = [&style] { return style.GetServoLoop() != nullptr; };
  const auto translate = [&style](const Vec3& way) { style.GetModel().translate(way); };
  const auto rotate = [&style](const Vec3& way) { rotateByHand(style, way); };
  const auto index = [&style](const Vec3& way) { moveWorkspace(style, way); };
  // The pointer drives the hand: put it on the hand, which moved under a picture that stayed.
  const auto indexed = [&style] { style.GetHand().putPointerOnHand(); };
  const auto scale = [&style](const Vec3& way)
  {
    const double forward = dot(way, style.GetScreen().axes().forward);
    style.GetModel().scale(std::exp(-forward / (kWayPerScale * style.GetModel().edge())));
  };
  const char* const group = "Hand";
  commands.add({ "translate-model-by-hand", "hand1", group, "held: hand translates the model",
    GripAction{ translate }, hasServo });
  commands.add({ "rotate-model-by-hand", "hand2", group, "held: hand rotates the model", GripAction{ rotate },
    hasServo });
  commands.add({ kIndexByHand, "hand3", group, "held: workspace moves over the model",
    GripAction{ index, indexed }, hasServo });
  commands.add(
    { "scale-model-by-hand", "hand4", group, "held: hand scales the model", GripAction{ scale }, hasServo });
  for (int i = 0; i < 4; ++i)
  {
    const std::string number = std::to_string(i + 1);
    commands.add({ "hand-button-" + number, "F" + number, group, "buttons of the simulated hand",
      HoldAction{ [&style, i](bool isDown) { style.GetHand().holdButton(i, isDown); } },
      [&style] { return style.GetHand().hasDevice(); } });
  }
}

void addShowCommands(CommandRegistry& commands, vtkInteractorStyleHaptic& style)
{
  StatusText& status = style.GetStatus();
  TouchDisplay& display = style.GetDisplay();
  const auto help = [&status] { status.turnHelp(); };
  const auto pick = [&style]
  {
    if (vtkRenderWindowInteractor* interactor = style.GetInteractor())
    {
      style.GetPicker().pickAt(interactor->GetEventPosition()[0], interactor->GetEventPosition()[1]);
    }
  };
  const auto sliders = [&style]
  {
    if (style.GetSliders())
    {
      style.GetSliders()->SetVisibility(!style.GetSliders()->GetVisibility());
    }
  };
  const auto panel = [&status] { status.setPanelVisibility(!status.panelVisibility()); };
  const auto hasChart = [&display] { return display.chart() != nullptr; };
  const auto chart = [&display, hasChart] { display.setChartVisibility(!display.wantsChart()); };
  const auto pause = [&display]
  {
    if (display.chart())
    {
      display.chart()->SetPaused(!display.chart()->GetPaused());
    }
  };
  const auto hasOverlay = [&status] { return status.overlay() != nullptr; };
  const auto hasCloud = [&style] { return style.GetScenes().hasCloud(); };
  const auto hasSliders = [&style] { return style.GetSliders() != nullptr; };
  const char* const group = "Show";
  commands.add(
    { "help", "h question", group, "this help; P means Shift+P where p is listed, too", help, hasOverlay });
  commands.add({ "pick", "p", group, "the point under the mouse", pick, hasCloud });
  commands.add({ "sliders", "v", group, "sliders of the touch", sliders, hasSliders });
  commands.add({ "servo-panel", "i", group, "servo loop and device", panel, hasOverlay });
  commands.add({ "chart", "c", group, "chart, pause the chart", chart, hasChart });
  commands.add({ "pause-chart", "t", group, "chart, pause the chart", pause, hasChart });
}

} // namespace

void addStyleCommands(vtkInteractorStyleHaptic& style)
{
  CommandRegistry& commands = style.GetCommands();
  addCameraCommands(commands, style);
  addModelCommands(commands, style);
  addHandCommands(commands, style);
  addClutchCommands(commands, style);
  addShowCommands(commands, style);
  const auto quit = [&style]
  {
    if (style.GetInteractor())
    {
      style.GetInteractor()->ExitCallback();
    }
  };
  commands.add({ "quit", "q", "Program", "quit", quit });
  // A program that has something to leave before replaces this one.
  commands.add({ "leave", "Escape", "Program", "quit", quit });
}

} // namespace pointhaptics
