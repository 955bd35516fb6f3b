#include "InteractionPictures.h"

#include "CloudAppearance.h"
#include "CloudOrientation.h"
#include "Pictures.h"
#include "vtkHapticChart.h"
#include "vtkHapticOverlay.h"
#include "vtkHapticProps.h"
#include "vtkHapticSliders.h"
#include "vtkInteractorStyleHaptic.h"
#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include "Devices/SimulatedDevice.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkInteractorEventRecorder.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkTransform.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>

namespace pointhaptics
{
namespace testing
{
namespace
{

/// Everything under the style; lives until the program ends.
struct Stage
{
  vtkNew<vtkPolyData> cloud;
  vtkNew<vtkVoxelMeanResampler> resampler;
  vtkNew<vtkKernelBandwidthFilter> bandwidth;
  vtkNew<vtkPolyDataMapper> mapper;
  vtkNew<vtkActor> actor;
  vtkNew<vtkHapticProps> props;
  vtkNew<vtkHapticOverlay> overlay;
  vtkNew<vtkHapticSliders> sliders;
  vtkNew<vtkRenderWindowInteractor> interactor;
  vtkNew<vtkInteractorStyleHaptic> style;
  vtkNew<vtkInteractorEventRecorder> recorder;
  SimulatedDevice hand;
  vtkRenderer* renderer = nullptr;
};

Stage& stage()
{
  static auto* only = new Stage; // VTK's globals may go first
  return *only;
}

/// A plane of 7 cm with a hill to the right of its middle: no two of its views are the same.
void makeCloud(vtkPolyData* cloud)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int i = -50; i <= 50; ++i)
  {
    for (int j = -50; j <= 50; ++j)
    {
      const double x = 0.0007 * i;
      const double y = 0.0007 * j;
      const double fromHill = std::hypot(x - 0.012, y - 0.006) / 0.012;
      points->InsertNextPoint(x, y, 0.02 * std::exp(-fromHill * fromHill));
    }
  }
  cloud->SetPoints(points);
  addHeightArray(cloud, { 0, 0, 1 });
}

void build(vtkRenderer* renderer)
{
  Stage& s = stage();
  s.renderer = renderer;
  makeCloud(s.cloud);
  s.resampler->SetInputData(s.cloud);
  s.resampler->SetWorkspaceBounds(-0.05, 0.05, -0.05, 0.05, -0.05, 0.05);
  s.resampler->SetVoxelSize(0.001);
  s.bandwidth->SetInputConnection(s.resampler->GetOutputPort());
  s.mapper->SetInputConnection(s.bandwidth->GetOutputPort());
  s.actor->SetMapper(s.mapper);
  s.interactor->SetRenderWindow(renderer->GetRenderWindow());
  s.style->SetResampler(s.resampler);
  s.style->SetBandwidthFilter(s.bandwidth);
  s.style->SetCloudActor(s.actor);
  s.style->SetProps(s.props);
  s.style->SetOverlay(s.overlay);
  s.style->SetDevice(&s.hand);
  s.style->SetDefaultRenderer(renderer);
  s.style->UpdateModel();
  applyCloudAppearance(s.bandwidth->GetOutput(), s.mapper, s.actor, kHeightArrayName, 3.0);
  applyBackground(renderer);
  renderer->AddActor(s.actor);
  s.props->AddTo(renderer);
  s.overlay->AddTo(renderer);
  s.sliders->SetInteractor(s.interactor);
  s.style->SetSliders(s.sliders);
  static_cast<void>(s.hand.open());
  CloudOrientation orientation;
  placeCamera(renderer->GetActiveCamera(), orientation, 0.1, 28.0, 18.0);
  renderer->ResetCameraClippingRange();
  s.interactor->SetInteractorStyle(s.style);
  renderer->GetRenderWindow()->Render();
}

/// All actions of a kind one further: what was bound to turning shifts, and so on.
void mixBindings()
{
  vtkInteractorStyleHaptic* style = stage().style;
  const char* const swapped[][2] = { { "rotate-model-drag", "translate-model-drag" },
    { "rotate-view-drag", "pan-view-drag" }, { "hand-away", "hand-back" }, { "help", "sliders" } };
  for (const auto& pair : swapped)
  {
    const std::string first = style->GetCommands().bindings(pair[0]);
    style->GetCommands().bind(pair[0], style->GetCommands().bindings(pair[1]));
    style->GetCommands().bind(pair[1], first);
  }
}

/// The recorded events; without the last press of a key or button where one is to be lost.
std::string eventsOf(const std::string& fileName, bool losesPress)
{
  std::ifstream file(fileName);
  std::string text;
  std::size_t lastPress = std::string::npos;
  for (std::string line; std::getline(file, line);)
  {
    lastPress = line.find("PressEvent") != std::string::npos ? text.size() : lastPress;
    text += line + "\n";
  }
  return losesPress && lastPress != std::string::npos
    ? text.erase(lastPress, text.find('\n', lastPress) + 1 - lastPress)
    : text;
}

void addNumbers(std::string& text, const char* name, const double* numbers, int count)
{
  text += name;
  for (int i = 0; i < count; ++i)
  {
    char number[40];
    std::snprintf(number, sizeof(number), " %.9f", numbers[i]);
    text += number;
  }
  text += "\n";
}

} // namespace

void buildInteraction(const std::string& events, const std::string& fault, vtkRenderer* renderer)
{
  build(renderer);
  Stage& s = stage();
  if (fault == "other-bindings")
  {
    mixBindings();
  }
  const std::string replayed = eventsOf(events, fault == "lost-press");
  s.recorder->SetInteractor(s.interactor);
  s.recorder->ReadFromInputStringOn();
  s.recorder->SetInputString(replayed.c_str());
  s.recorder->Play();
  s.style->UpdateModel();
}

std::string interactionState()
{
  Stage& s = stage();
  if (!s.renderer)
  {
    return {};
  }
  std::string text;
  vtkCamera* camera = s.renderer->GetActiveCamera();
  addNumbers(text, "model", s.style->GetModelTransform()->GetMatrix()->GetData(), 16);
  addNumbers(text, "camera", camera->GetPosition(), 3);
  addNumbers(text, "focus", camera->GetFocalPoint(), 3);
  addNumbers(text, "up", camera->GetViewUp(), 3);
  const Vec3 hand = s.hand.target();
  addNumbers(text, "hand", &hand.x, 3);
  const double shown[] = { double(s.overlay->GetHelpVisibility()), double(s.sliders->GetVisibility()),
    double(s.style->GetStatus().panelVisibility()), double(s.style->GetHand().followsMouse()),
    double(!s.overlay->GetDetail().empty()) };
  addNumbers(text, "shown", shown, 5);
  return text;
}

void recordInteraction(const std::string& fileName, vtkRenderer* renderer)
{
  renderer->GetRenderWindow()->SetOffScreenRendering(0);
  renderer->GetRenderWindow()->SetWindowName("PointHaptics: recording");
  build(renderer);
  Stage& s = stage();
  s.recorder->SetInteractor(s.interactor);
  s.recorder->SetFileName(fileName.c_str());
  s.recorder->KeyPressActivationOff(); // its key is one of the style's
  s.recorder->EnabledOn();
  s.interactor->Initialize();
  s.style->StartUpdates();
  s.recorder->Record();
  s.interactor->Start();
  s.recorder->Stop();
}

} // namespace testing
} // namespace pointhaptics
