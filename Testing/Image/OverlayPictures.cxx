#include "OverlayPictures.h"

#include "CloudAppearance.h"
#include "vtkHapticChart.h"
#include "vtkHapticOverlay.h"
#include "vtkHapticProgress.h"
#include "vtkHapticProps.h"
#include "vtkHapticSliders.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <cmath>
#include <vector>

namespace pointhaptics
{
namespace testing
{
namespace
{

/// The one object of its type, until the program ends.
template <typename Type>
Type* lasting()
{
  static const vtkSmartPointer<Type> object = vtkSmartPointer<Type>::New();
  return object;
}

} // namespace

void buildHelpOverlay(const std::string& fault, vtkRenderer* renderer)
{
  applyBackground(renderer);
  auto* overlay = lasting<vtkHapticOverlay>();
  const std::string last = fault == "missing-line" ? "" : "\n         U      undo";
  overlay->SetHelp("Look     left   turn the view\nModel    0      back" + last);
  overlay->SetHelpVisibility(true);
  overlay->AddTo(renderer);
}

void buildStatusOverlay(const std::string& fault, vtkRenderer* renderer)
{
  applyBackground(renderer);
  auto* overlay = lasting<vtkHapticOverlay>();
  overlay->SetStatus("20000 points\nH: help");
  overlay->SetPanel(fault == "wrong-number" ? "rate: 961.5 Hz\nmissed: 38" : "rate: 1000.0 Hz\nmissed: 0");
  overlay->SetDetail("voxel  12  40  7\nbandwidth 0.31 mm");
  overlay->AddTo(renderer);
}

void buildSliders(const std::string& fault, vtkRenderer* renderer)
{
  applyBackground(renderer);
  auto* interactor = lasting<vtkRenderWindowInteractor>();
  interactor->SetRenderWindow(renderer->GetRenderWindow());
  auto* sliders = lasting<vtkHapticSliders>();
  sliders->SetInteractor(interactor);
  sliders->SetValue(vtkHapticSliders::Friction, fault == "wrong-value" ? 0.65 : 0.3);
  sliders->SetVisibility(true);
}

void buildChart(const std::string& fault, vtkRenderer* renderer)
{
  auto* chart = lasting<vtkHapticChart>();
  const double peak = fault == "wrong-force" ? 1.8 : 1.5;
  for (int i = 0; i <= 2000; ++i)
  {
    const double seconds = 0.001 * i;
    const double newtons = peak * std::max(0.0, std::sin(3.0 * seconds));
    chart->AddSample(seconds, newtons, 0.002 + 0.0005 * std::sin(2.0 * seconds));
  }
  chart->Update();
  renderer->DrawOff();
  renderer->GetRenderWindow()->AddRenderer(chart->GetRenderer());
}

void buildIdealChart(const std::string& fault, vtkRenderer* renderer)
{
  auto* chart = lasting<vtkHapticChart>();
  const double part = fault == "wrong-ideal" ? 0.8 : 0.9;
  for (int i = 0; i <= 2000; ++i)
  {
    const double seconds = 0.001 * i;
    const double newtons = 1.5 * std::max(0.0, std::sin(3.0 * seconds));
    chart->AddSample(seconds, newtons, 0.002, part * newtons);
  }
  chart->Update();
  renderer->DrawOff();
  renderer->GetRenderWindow()->AddRenderer(chart->GetRenderer());
}

/// All keys in a window that is small for them.
void buildHelpFits(const std::string& fault, vtkRenderer* renderer)
{
  applyBackground(renderer);
  auto* overlay = lasting<vtkHapticOverlay>();
  std::string lines;
  for (int i = 0; i < 24; ++i)
  {
    lines += std::string(i ? "\n" : "") + "Group    Shift+left drag, x, X     what it does";
  }
  overlay->SetHelp(lines);
  overlay->SetHelpVisibility(true);
  overlay->AddTo(renderer);
  if (fault == "large-font")
  {
    renderer->RemoveObservers(vtkCommand::StartEvent);
  }
}

/// Draws the window's message of a failure.
void buildErrorOverlay(const std::string& fault, vtkRenderer* renderer)
{
  applyBackground(renderer);
  auto* overlay = lasting<vtkHapticOverlay>();
  const std::string message = fault == "no-message" ? "" : "\nbroken.ply: row 7 has 2 values";
  overlay->SetStatus("20000 points in 1 active voxels" + message + "\nH: help");
  overlay->AddTo(renderer);
}

/// While a file with a long name is read.
void buildProgress(const std::string& fault, vtkRenderer* renderer)
{
  applyBackground(renderer);
  auto* progress = lasting<vtkHapticProgress>();
  progress->SetProgress(
    "reading a-name-that-is-too-long-for-the-plate-001.ply", fault == "wrong-part" ? 0.47 : 0.42);
  progress->AddTo(renderer);
}

/// A touch on grounds that are as the marks are: of the colour of arrow and sphere, black and white, the last
/// two in high contrast too.
void buildMarks(const std::string& fault, vtkRenderer* renderer)
{
  static std::vector<vtkSmartPointer<vtkHapticProps>> all;
  renderer->DrawOff();
  const double grounds[6][3] = { { 0.0, 0.0, 0.0 }, { 1.0, 1.0, 1.0 }, { 0.95, 0.42, 0.02 },
    { 1.0, 0.30, 0.62 }, { 0.0, 0.0, 0.0 }, { 1.0, 1.0, 1.0 } };
  for (int i = 0; i < 6; ++i)
  {
    vtkNew<vtkRenderer> part;
    const double left = (i / 2) / 3.0;
    part->SetViewport(left, 0.5 * (i % 2), left + 1.0 / 3.0, 0.5 * (i % 2) + 0.5);
    part->SetBackground(grounds[i][0], grounds[i][1], grounds[i][2]);
    renderer->GetRenderWindow()->AddRenderer(part);
    all.push_back(vtkSmartPointer<vtkHapticProps>::New());
    all.back()->AddTo(part);
    all.back()->GetWorkspaceActor()->VisibilityOff();
    all.back()->GetGauge()->RemoveFrom(part);
    all.back()->SetOutlineVisibility(fault != "no-outline");
    all.back()->SetHighContrast(i > 3 && fault != "usual-colors");
    const bool isFree = i == 3;
    ProxyState state;
    state.contact = !isFree;
    state.proxy = { -0.02, 0.0, 0.0 };
    state.normal = { 0.0, 0.0, 1.0 };
    state.radius = 0.004;
    state.sphereCenter = { -0.02, 0.0, 0.004 };
    state.hip = isFree ? state.sphereCenter : Vec3{ -0.022, 0.0, -0.008 };
    state.force = isFree ? Vec3() : Vec3{ 3.0, 0.0, 4.0 };
    all.back()->Update(state);
    const Vec3 nearest{ 0.012, 0.0, -0.02 };
    if (isFree && fault != "no-ring")
    {
      all.back()->ShowNearest(&state.hip.x, &nearest.x);
    }
    vtkCamera* camera = part->GetActiveCamera();
    camera->SetPosition(0.025, -0.10, 0.03);
    camera->SetFocalPoint(-0.006, 0.0, 0.004);
    camera->SetViewUp(0.0, 0.0, 1.0);
    part->ResetCameraClippingRange();
  }
}

} // namespace testing
} // namespace pointhaptics
