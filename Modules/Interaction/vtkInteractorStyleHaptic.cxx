#include "vtkInteractorStyleHaptic.h"

#include "vtkInteractorStyleHapticInternals.h"

#include "vtkCamera.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkRendererCollection.h"
#include "vtkStringArray.h"

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

using pointhaptics::ServoSample;
using pointhaptics::Vec3;

namespace
{

constexpr std::size_t kLongestHistory = 100;

/// While it lives, a chart that did not change is not drawn: the window keeps what it shows of it.
class ChartPause
{
public:
  ChartPause(vtkRenderer* chart, bool changed, std::vector<double>& picture)
  {
    const int* size = chart->GetVTKWindow() ? chart->GetVTKWindow()->GetActualSize() : nullptr;
    std::vector<double> wanted(4);
    chart->GetViewport(wanted.data());
    wanted.push_back(size ? size[0] : 0);
    wanted.push_back(size ? size[1] : 0);
    if (chart->GetDraw() && !changed && wanted == picture)
    {
      chart_ = chart;
      chart_->DrawOff();
    }
    picture = chart->GetDraw() || chart_ ? wanted : std::vector<double>();
  }
  ~ChartPause()
  {
    if (chart_)
    {
      chart_->DrawOn();
    }
  }
  ChartPause(const ChartPause&) = delete;
  ChartPause& operator=(const ChartPause&) = delete;

private:
  vtkRenderer* chart_ = nullptr;
};

} // namespace

vtkStandardNewMacro(vtkInteractorStyleHaptic);

vtkInteractorStyleHaptic::vtkInteractorStyleHaptic()
  : Parts(new Internals)
{
  this->Parts->model->PostMultiply();
}

vtkInteractorStyleHaptic::~vtkInteractorStyleHaptic() = default;

void vtkInteractorStyleHaptic::SetServoLoop(pointhaptics::ServoLoop* servo)
{
  if (this->Parts->clutched)
  {
    this->Parts->servo->setClutched(false);
  }
  this->Parts->clutched = false;
  this->Parts->hold = pointhaptics::HapticAction::None;
  this->StopBuilding();
  this->Parts->servo = servo;
  this->Parts->publisher.setSink(
    [servo](std::shared_ptr<const pointhaptics::HapticScene> scene)
    {
      if (servo)
      {
        servo->publishScene(std::move(scene));
      }
    });
  this->Parts->modelChanged = true;
}

void vtkInteractorStyleHaptic::SetDevice(pointhaptics::SimulatedDevice* device)
{
  this->Parts->device = device;
}

void vtkInteractorStyleHaptic::SetSpaceMouse(pointhaptics::SpaceMouse* mouse)
{
  this->Parts->mouse = mouse;
}

void vtkInteractorStyleHaptic::SetResampler(vtkVoxelMeanResampler* resampler)
{
  this->Parts->resampler = resampler;
  this->Parts->modelChanged = true;
  if (resampler)
  {
    resampler->SetTransform(this->Parts->resampled);
  }
}

void vtkInteractorStyleHaptic::SetBandwidthFilter(vtkKernelBandwidthFilter* filter)
{
  this->Parts->bandwidth = filter;
  this->Parts->modelChanged = true;
}

void vtkInteractorStyleHaptic::SetCloudActor(vtkActor* actor)
{
  this->Parts->cloudActor = actor;
}

void vtkInteractorStyleHaptic::SetProps(vtkHapticProps* props)
{
  this->Parts->props = props;
}

void vtkInteractorStyleHaptic::SetChart(vtkHapticChart* chart)
{
  this->Parts->chart = chart;
}

void vtkInteractorStyleHaptic::SetOverlay(vtkHapticOverlay* overlay)
{
  this->Parts->overlay = overlay;
  if (overlay)
  {
    overlay->SetHelp(this->Parts->bindings.describe());
  }
}

void vtkInteractorStyleHaptic::SetSliders(vtkHapticSliders* sliders)
{
  this->Parts->sliders = sliders;
}

void vtkInteractorStyleHaptic::SetIdealForce(std::function<double(const Vec3&)> ideal)
{
  this->Parts->idealForce = std::move(ideal);
}

void vtkInteractorStyleHaptic::SetBinding(pointhaptics::HapticAction action, const std::string& gestures)
{
  if (this->Parts->bindings.set(action, gestures))
  {
    this->SetOverlay(this->Parts->overlay);
    this->Parts->rendersWanted = true;
  }
}

std::string vtkInteractorStyleHaptic::GetBinding(pointhaptics::HapticAction action) const
{
  return this->Parts->bindings.get(action);
}

void vtkInteractorStyleHaptic::SetWorkspaceBounds(const double bounds[6])
{
  std::copy(bounds, bounds + 6, this->Parts->workspace.begin());
}

void vtkInteractorStyleHaptic::SetModelMatrix(vtkMatrix4x4* matrix)
{
  this->Parts->initial->DeepCopy(matrix);
  this->ResetModel();
  this->Parts->history.clear();
}

vtkTransform* vtkInteractorStyleHaptic::GetModelTransform()
{
  return this->Parts->model;
}

void vtkInteractorStyleHaptic::TurnModel(double degrees, const Vec3& axis)
{
  if (!std::isfinite(degrees) || !isFinite(axis) || !(norm(axis) > 0.0))
  {
    return;
  }
  this->RememberModel();
  const Vec3 c = this->Parts->center();
  this->Parts->model->Translate(-c.x, -c.y, -c.z);
  this->Parts->model->RotateWXYZ(degrees, axis.x, axis.y, axis.z);
  this->Parts->model->Translate(c.x, c.y, c.z);
  this->ModelChanged();
}

void vtkInteractorStyleHaptic::ShiftModel(const Vec3& offset)
{
  if (isFinite(offset))
  {
    this->RememberModel();
    this->Parts->model->Translate(offset.x, offset.y, offset.z);
    this->ModelChanged();
  }
}

void vtkInteractorStyleHaptic::ZoomModel(double factor)
{
  if (!std::isfinite(factor) || !(factor > 0.0))
  {
    return;
  }
  this->RememberModel();
  const Vec3 c = this->Parts->center();
  this->Parts->model->Translate(-c.x, -c.y, -c.z);
  this->Parts->model->Scale(factor, factor, factor);
  this->Parts->model->Translate(c.x, c.y, c.z);
  this->ModelChanged();
}

void vtkInteractorStyleHaptic::ResetModel()
{
  this->RememberModel();
  this->Parts->model->SetMatrix(this->Parts->initial);
  this->ModelChanged();
}

void vtkInteractorStyleHaptic::RememberModel()
{
  Internals& parts = *this->Parts;
  if (parts.inGesture() && parts.gestureRemembered)
  {
    return;
  }
  parts.gestureRemembered = true;
  std::array<double, 16> elements;
  std::copy_n(parts.model->GetMatrix()->GetData(), elements.size(), elements.begin());
  parts.history.push_back(elements);
  if (parts.history.size() > kLongestHistory)
  {
    parts.history.pop_front();
  }
}

bool vtkInteractorStyleHaptic::UndoModel()
{
  Internals& parts = *this->Parts;
  while (!parts.history.empty())
  {
    const std::array<double, 16> elements = parts.history.back();
    parts.history.pop_back();
    // A reset of a model that had not moved changed nothing.
    if (!std::equal(elements.begin(), elements.end(), parts.model->GetMatrix()->GetData()))
    {
      parts.model->SetMatrix(elements.data());
      this->ModelChanged();
      return true;
    }
  }
  return false;
}

void vtkInteractorStyleHaptic::InvalidateModel()
{
  this->Parts->modelChanged = true;
  this->ForgetPicked();
}

void vtkInteractorStyleHaptic::SetComputeResiduals(bool on)
{
  if (on != this->ComputeResiduals)
  {
    this->ComputeResiduals = on;
    this->InvalidateModel();
  }
}

void vtkInteractorStyleHaptic::SetComputeNormals(bool on)
{
  if (on != this->ComputeNormals)
  {
    this->ComputeNormals = on;
    this->InvalidateModel();
  }
}

void vtkInteractorStyleHaptic::StartUpdates(unsigned long milliseconds)
{
  this->StopUpdates();
  if (this->Interactor)
  {
    this->Parts->timer = this->Interactor->CreateRepeatingTimer(std::max(1ul, milliseconds));
  }
}

void vtkInteractorStyleHaptic::StopUpdates()
{
  if (this->Interactor && this->Parts->timer >= 0)
  {
    this->Interactor->DestroyTimer(this->Parts->timer);
  }
  this->Parts->timer = -1;
}

void vtkInteractorStyleHaptic::OnTimer()
{
  this->Refresh();
}

void vtkInteractorStyleHaptic::Refresh()
{
  Internals& parts = *this->Parts;
  this->MoveBySpaceMouse();
  if (parts.modelChanged && parts.resampler)
  {
    this->RequestScene();
  }
  this->ShowScene();
  const bool touchMoved = this->ReadServo();
  this->MoveByHand();
  this->PushPointer();
  const bool statusChanged = this->UpdateStatus();
  parts.rendersWanted = parts.rendersWanted || touchMoved || statusChanged;
  parts.touchMoved = touchMoved ? pointhaptics::style::now() : parts.touchMoved;
  if (parts.rendersWanted && parts.renderShare.due())
  {
    this->RenderNow();
  }
}

bool vtkInteractorStyleHaptic::ReadServo()
{
  Internals& parts = *this->Parts;
  parts.samples.clear();
  if (!parts.servo)
  {
    return false;
  }
  parts.servo->takeTrace(parts.samples);
  bool changed = false;
  if (parts.chart)
  {
    for (const ServoSample& sample : parts.samples)
    {
      const double ideal =
        parts.idealForce ? parts.idealForce(sample.state.hip) : std::numeric_limits<double>::quiet_NaN();
      parts.chart->AddSample(sample.timeSeconds, norm(sample.state.force), sample.state.radius, ideal);
    }
    // A chart that is drawn seldom costs little; it is brought up to date only where a render would show it.
    changed = parts.renderShare.due() && parts.chart->GetVisibility() && parts.chart->Update();
    parts.chartChanged = parts.chartChanged || changed;
  }
  if (!parts.samples.empty())
  {
    this->InvokeEvent(SamplesEvent, &parts.samples);
  }
  const ServoSample latest = parts.servo->latest();
  if (parts.props && latest.tick > 0)
  {
    changed = parts.props->Update(latest.state) || changed;
  }
  return changed;
}

void vtkInteractorStyleHaptic::RenderNow()
{
  Internals& parts = *this->Parts;
  parts.rendersWanted = false;
  if (this->Interactor)
  {
    parts.renderShare.run(
      [this, &parts]
      {
        if (vtkRenderer* renderer = this->MainRenderer())
        {
          renderer->ResetCameraClippingRange();
        }
        std::optional<ChartPause> pause;
        if (parts.chart)
        {
          pause.emplace(parts.chart->GetRenderer(), parts.chartChanged, parts.chartPicture);
        }
        parts.chartChanged = false;
        this->Interactor->Render();
      });
  }
}

vtkRenderer* vtkInteractorStyleHaptic::MainRenderer()
{
  if (this->CurrentRenderer)
  {
    return this->CurrentRenderer;
  }
  if (this->DefaultRenderer)
  {
    return this->DefaultRenderer;
  }
  vtkRenderWindow* window = this->Interactor ? this->Interactor->GetRenderWindow() : nullptr;
  return window ? window->GetRenderers()->GetFirstRenderer() : nullptr;
}

void vtkInteractorStyleHaptic::OnDropFiles(vtkStringArray* filePaths)
{
  this->InvokeEvent(FilesDroppedEvent, filePaths);
}

void vtkInteractorStyleHaptic::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "UseCovariance: " << this->UseCovariance << "\n";
  os << indent << "RefinesNearHand: " << this->RefinesNearHand << "\n";
  os << indent << "ComputeResiduals: " << this->ComputeResiduals << "\n";
  os << indent << "ComputeNormals: " << this->ComputeNormals << "\n";
  os << indent << "HandMode: " << this->Parts->handMode << "\n";
  os << indent << "ModelChanged: " << this->Parts->modelChanged << "\n";
  os << indent << "ModelTransform:\n";
  this->Parts->model->PrintSelf(os, indent.GetNextIndent());
}
