// From a change of the model to the scene that is felt and the means that are shown.
#include "vtkInteractorStyleHapticInternals.h"

#include "PolyDataAccess.h"

#include "vtkMapper.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

#include <utility>

using pointhaptics::BuiltScene;
using pointhaptics::SceneRequest;

namespace
{

/// The data object that others see: the output of the last filter there is.
vtkPolyData* shownCloud(vtkVoxelMeanResampler* resampler, vtkKernelBandwidthFilter* bandwidth)
{
  return bandwidth ? bandwidth->GetOutput() : resampler->GetOutput();
}

/// What must be within reach of the hand: itself and what it touches.
pointhaptics::Bounds handBounds(const pointhaptics::ServoLoop* servo)
{
  pointhaptics::Bounds bounds;
  const pointhaptics::ServoSample latest = servo ? servo->latest() : pointhaptics::ServoSample();
  if (latest.tick > 0)
  {
    bounds.include(latest.state.hip);
    bounds.include(latest.state.proxy);
  }
  return bounds;
}

} // namespace

void vtkInteractorStyleHaptic::ModelChanged()
{
  Internals& parts = *this->Parts;
  // Many small steps must not grow vtkTransform's list of concatenated matrices without end.
  vtkNew<vtkMatrix4x4> matrix;
  matrix->DeepCopy(parts.model->GetMatrix());
  parts.model->SetMatrix(matrix);
  parts.modelChanged = true;
  this->ForgetPicked();
  this->MoveScene();
  this->PreviewModel();
  if (parts.timer >= 0 && parts.resampler)
  {
    this->RequestScene(); // the timer, and what it has to draw, would come later
  }
  this->InvokeEvent(ModelChangedEvent);
}

/// The hand feels the model where it is before it is resampled there. Not with another cloud than before:
/// what is felt until that is resampled stays where it was.
void vtkInteractorStyleHaptic::MoveScene()
{
  pointhaptics::AffineTransform modelToWorkspace;
  if (this->IsCloudSent() && pointhaptics::affineFromTransform(this->Parts->model, modelToWorkspace))
  {
    this->Parts->publisher.move(modelToWorkspace);
  }
}

/// The drawn means are those of the last resampling: show them where the model is now.
void vtkInteractorStyleHaptic::PreviewModel()
{
  Internals& parts = *this->Parts;
  if (parts.cloudActor)
  {
    vtkNew<vtkMatrix4x4> back;
    vtkMatrix4x4::Invert(parts.resampled->GetMatrix(), back);
    vtkMatrix4x4::Multiply4x4(parts.model->GetMatrix(), back, parts.preview);
    parts.preview->Modified(); // the product does not say so itself
    parts.cloudActor->SetUserMatrix(parts.preview);
    parts.rendersWanted = true;
  }
}

bool vtkInteractorStyleHaptic::IsModelChanged() const
{
  return this->Parts->modelChanged || this->Parts->requested != this->Parts->shown;
}

bool vtkInteractorStyleHaptic::UpdateModel()
{
  Internals& parts = *this->Parts;
  if (parts.resampler && this->IsModelChanged())
  {
    if (parts.modelChanged)
    {
      this->RequestScene();
    }
    parts.worker.wait();
    this->ShowScene();
  }
  return !parts.sceneEmpty;
}

/// To be called before anything that the worker's requests hold goes away.
void vtkInteractorStyleHaptic::StopBuilding()
{
  Internals& parts = *this->Parts;
  parts.worker.cancel();
  parts.modelChanged = parts.modelChanged || parts.requested != parts.shown;
  parts.shown = parts.requested;
}

bool vtkInteractorStyleHaptic::IsCloudSent() const
{
  const Internals& parts = *this->Parts;
  auto* cloud =
    parts.resampler ? vtkPointSet::SafeDownCast(parts.resampler->GetInputDataObject(0, 0)) : nullptr;
  return cloud == parts.sentCloud && (cloud ? cloud->GetMTime() : 0) == parts.sentCloudTime;
}

void vtkInteractorStyleHaptic::SendCloud()
{
  Internals& parts = *this->Parts;
  if (vtkAlgorithm* source = parts.resampler->GetInputAlgorithm())
  {
    source->Update();
  }
  if (this->IsCloudSent())
  {
    return;
  }
  auto* cloud = vtkPointSet::SafeDownCast(parts.resampler->GetInputDataObject(0, 0));
  parts.sentCloud = cloud;
  parts.sentCloudTime = cloud ? cloud->GetMTime() : 0;
  vtkSmartPointer<vtkPointSet> copy;
  if (cloud)
  {
    copy.TakeReference(vtkPointSet::SafeDownCast(cloud->NewInstance()));
    copy->ShallowCopy(cloud);
  }
  parts.publisher.startCloud();
  parts.worker.setCloud(std::move(copy));
}

SceneRequest vtkInteractorStyleHaptic::MakeRequest()
{
  Internals& parts = *this->Parts;
  SceneRequest request = SceneRequest::of(parts.resampler, parts.bandwidth);
  std::copy_n(parts.model->GetMatrix()->GetData(), 16, request.modelToWorkspace.begin());
  request.useCovariance = this->UseCovariance;
  request.hand = [servo = parts.servo] { return handBounds(servo); };
  request.refinesNearHand = this->RefinesNearHand;
  request.hasResiduals = this->ComputeResiduals;
  request.hasNormals = this->ComputeNormals;
  request.publish = [publisher = &parts.publisher, cloud = parts.publisher.cloud()](
                      std::shared_ptr<const pointhaptics::HapticScene> scene, std::uint64_t number)
  { publisher->publish(std::move(scene), cloud, number); };
  return request;
}

void vtkInteractorStyleHaptic::RequestScene()
{
  Internals& parts = *this->Parts;
  parts.modelChanged = false;
  this->SendCloud();
  this->MoveScene();
  parts.requested = parts.worker.request(this->MakeRequest());
}

void vtkInteractorStyleHaptic::AdoptModel(
  vtkMatrix4x4* matrix, std::shared_ptr<const pointhaptics::HapticScene> scene)
{
  Internals& parts = *this->Parts;
  if (!parts.resampler)
  {
    this->SetModelMatrix(matrix);
    return;
  }
  parts.initial->DeepCopy(matrix);
  parts.model->SetMatrix(matrix);
  parts.history.clear();
  parts.modelChanged = false;
  this->ForgetPicked();
  this->SendCloud();
  this->MoveScene();
  BuiltScene built;
  std::copy_n(matrix->GetData(), 16, built.modelToWorkspace.begin());
  built.means = shownCloud(parts.resampler, parts.bandwidth);
  auto* cloud = vtkPointSet::SafeDownCast(parts.resampler->GetInputDataObject(0, 0));
  built.numberOfPoints = cloud ? cloud->GetNumberOfPoints() : 0;
  built.empty = scene == nullptr;
  parts.requested = parts.worker.adopt(this->MakeRequest(), std::move(scene));
  built.number = parts.requested;
  this->ShowBuilt(built);
  this->InvokeEvent(ModelChangedEvent);
}

std::uint64_t vtkInteractorStyleHaptic::GetNumberOfBuilds() const
{
  return this->Parts->worker.numberOfBuilds();
}

/// What the worker has made becomes the output of the filters that the program knows, as if they had run.
bool vtkInteractorStyleHaptic::ShowScene()
{
  Internals& parts = *this->Parts;
  BuiltScene built;
  const bool isNew = parts.worker.take(built);
  if (isNew)
  {
    this->ShowBuilt(built);
  }
  return isNew;
}

void vtkInteractorStyleHaptic::ShowBuilt(const BuiltScene& built)
{
  Internals& parts = *this->Parts;
  parts.shown = built.number;
  parts.sceneEmpty = built.empty;
  parts.numberOfPoints = built.numberOfPoints;
  parts.numberOfVoxels = built.means->GetNumberOfPoints();
  if (built.empty && built.status != pointhaptics::Status::Empty)
  {
    vtkErrorMacro("The model cannot be felt as it stands: " << pointhaptics::message(built.status)
                                                            << " Key 0 resets the model.");
  }
  parts.resampled->SetMatrix(built.modelToWorkspace.data());
  vtkPolyData* shown = shownCloud(parts.resampler, parts.bandwidth);
  if (shown != built.means)
  {
    shown->ShallowCopy(built.means);
  }
  vtkMapper* mapper = parts.cloudActor ? parts.cloudActor->GetMapper() : nullptr;
  if (mapper && mapper->GetInputDataObject(0, 0) == shown)
  {
    mapper->SetInputDataObject(shown); // a connection to the filters would make them run
  }
  this->PreviewModel();
  parts.rendersWanted = true;
  this->InvokeEvent(SceneChangedEvent);
}
