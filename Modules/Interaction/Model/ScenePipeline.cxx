#include "ScenePipeline.h"

#include "ModelTransform.h"
#include "PolyDataAccess.h"

#include "vtkActor.h"
#include "vtkMapper.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkTransform.h"

#include <algorithm>

namespace pointhaptics
{
namespace
{

/// Box that must be within reach of the hand: the HIP and the contact point. The worker's threads ask.
Bounds handBounds(const WatchedPointer<ServoLoop>& servo)
{
  ServoSample latest;
  servo.use([&latest](const ServoLoop& loop) { latest = loop.latest(); });
  Bounds bounds;
  if (latest.tick > 0)
  {
    bounds.include(latest.state.hip);
    bounds.include(latest.state.proxy);
  }
  return bounds;
}

} // namespace

ScenePipeline::ScenePipeline(ModelTransform& model)
  : model_(model)
  , resampled_(vtkSmartPointer<vtkTransform>::New())
  , preview_(vtkSmartPointer<vtkMatrix4x4>::New())
{
}

ScenePipeline::~ScenePipeline() = default;

void ScenePipeline::setServo(ServoLoop* servo)
{
  // Scenes in flight would go to the former loop.
  worker_.cancel();
  isInvalid_ = true;
  shownNumber_ = requested_;
  servo_ = servo;
  publisher_.setSink([target = servo_](std::shared_ptr<const HapticScene> scene)
    { target.use([&scene](ServoLoop& loop) { loop.publishScene(std::move(scene)); }); });
}

void ScenePipeline::setResampler(vtkVoxelMeanResampler* resampler)
{
  resampler_ = resampler;
  isInvalid_ = true;
  if (resampler)
  {
    resampler->SetTransform(resampled_);
  }
}

void ScenePipeline::setBandwidthFilter(vtkKernelBandwidthFilter* filter)
{
  bandwidth_ = filter;
  isInvalid_ = true;
}

void ScenePipeline::setCloudActor(vtkActor* actor)
{
  actor_ = actor;
}

void ScenePipeline::setOptions(const SceneOptions& options)
{
  isInvalid_ = isInvalid_ || options.computeResiduals != options_.computeResiduals ||
    options.computeNormals != options_.computeNormals;
  options_ = options;
}

void ScenePipeline::moveModel(bool requestsNow)
{
  isInvalid_ = true;
  this->publishMoved();
  this->preview();
  if (requestsNow && resampler_)
  {
    this->request();
  }
}

void ScenePipeline::startCloud(bool findsLattice)
{
  isInvalid_ = true;
  findsLattice_ = findsLattice;
  isEmpty_ = true;
  numberOfVoxels_ = 0;
  auto* input = resampler_ ? vtkPointSet::SafeDownCast(resampler_->GetInputDataObject(0, 0)) : nullptr;
  numberOfPoints_ = input ? input->GetNumberOfPoints() : 0;
  // Means of another cloud are neither drawn nor felt.
  if (vtkPolyData* shown = this->cloud())
  {
    shown->Initialize();
  }
}

void ScenePipeline::release()
{
  publisher_.startCloud();
  publisher_.publish(nullptr, publisher_.cloud(), 0);
}

/// Lets the hand feel the model at its new place before it is resampled there. Not after a change of the
/// cloud: the felt scene then stays where it was until the new cloud is resampled.
void ScenePipeline::publishMoved()
{
  AffineTransform modelToWorkspace;
  if (this->isCloudSent() && affineFromTransform(model_.transform(), modelToWorkspace))
  {
    publisher_.move(modelToWorkspace);
  }
}

/// Shows the drawn means, which are those of the last resampling, at the model's present place.
void ScenePipeline::preview()
{
  if (actor_)
  {
    vtkNew<vtkMatrix4x4> back;
    vtkMatrix4x4::Invert(resampled_->GetMatrix(), back);
    vtkMatrix4x4::Multiply4x4(model_.transform()->GetMatrix(), back, preview_);
    preview_->Modified(); // the product does not say so itself
    actor_->SetUserMatrix(preview_);
  }
}

void ScenePipeline::poll()
{
  if (isInvalid_ && resampler_)
  {
    this->request();
  }
  this->showFinished();
}

bool ScenePipeline::update()
{
  if (resampler_ && this->isChanged())
  {
    if (isInvalid_)
    {
      this->request();
    }
    worker_.wait();
    this->showFinished();
  }
  return !isEmpty_;
}

bool ScenePipeline::isCloudSent() const
{
  auto* cloud = resampler_ ? vtkPointSet::SafeDownCast(resampler_->GetInputDataObject(0, 0)) : nullptr;
  return cloud == sentCloud_ && (cloud ? cloud->GetMTime() : 0) == sentCloudTime_;
}

void ScenePipeline::sendCloud()
{
  if (vtkAlgorithm* source = resampler_->GetInputAlgorithm())
  {
    source->Update();
  }
  if (this->isCloudSent())
  {
    return;
  }
  auto* cloud = vtkPointSet::SafeDownCast(resampler_->GetInputDataObject(0, 0));
  sentCloud_ = cloud;
  sentCloudTime_ = cloud ? cloud->GetMTime() : 0;
  publisher_.startCloud();
  worker_.setCloud(cloud);
}

SceneRequest ScenePipeline::makeRequest()
{
  SceneRequest request = SceneRequest::of(resampler_, bandwidth_);
  request.recipe.modelToWorkspace = transformOf(model_.transform()->GetMatrix());
  request.recipe.useCovariance = options_.useCovariance;
  request.findsLattice = findsLattice_;
  request.hand = [servo = servo_] { return handBounds(servo); };
  request.refinesNearHand = options_.refinesNearHand;
  request.hasResiduals = options_.computeResiduals;
  request.hasNormals = options_.computeNormals;
  request.publish = [publisher = &publisher_, cloud = publisher_.cloud()](
                      std::shared_ptr<const HapticScene> scene, std::uint64_t number)
  { publisher->publish(std::move(scene), cloud, number); };
  return request;
}

void ScenePipeline::request()
{
  isInvalid_ = false;
  this->sendCloud();
  this->publishMoved();
  requested_ = worker_.request(this->makeRequest());
}

void ScenePipeline::adopt(std::shared_ptr<const HapticScene> scene)
{
  isInvalid_ = false;
  findsLattice_ = false;
  this->sendCloud();
  this->publishMoved();
  BuiltScene built;
  built.modelToWorkspace = transformOf(model_.transform()->GetMatrix());
  built.means = this->cloud();
  auto* input = vtkPointSet::SafeDownCast(resampler_->GetInputDataObject(0, 0));
  built.numberOfPoints = input ? input->GetNumberOfPoints() : 0;
  built.empty = scene == nullptr;
  requested_ = worker_.adopt(this->makeRequest(), std::move(scene));
  built.number = requested_;
  this->show(built);
}

/// The data object that others see.
vtkPolyData* ScenePipeline::cloud() const
{
  return bandwidth_ ? bandwidth_->GetOutput() : resampler_ ? resampler_->GetOutput() : nullptr;
}

void ScenePipeline::showFinished()
{
  BuiltScene built;
  if (worker_.take(built))
  {
    this->show(built);
  }
}

/// Makes the worker's result the output of the filters that the program knows, as if they had run.
void ScenePipeline::show(const BuiltScene& built)
{
  shownNumber_ = built.number;
  isEmpty_ = built.empty;
  problem_ = built.problem;
  numberOfPoints_ = built.numberOfPoints;
  numberOfVoxels_ = built.means->GetNumberOfPoints();
  vtkNew<vtkMatrix4x4> placed;
  setElements(placed, built.modelToWorkspace);
  resampled_->SetMatrix(placed);
  if (findsLattice_ && built.number == requested_ && built.latticeDimension > 0)
  {
    findsLattice_ = false;
    const int n = built.latticeDimension;
    resampler_->SetDimensions(n, n, n);
  }
  vtkPolyData* shown = this->cloud();
  if (shown && shown != built.means)
  {
    shown->ShallowCopy(built.means);
  }
  vtkMapper* mapper = actor_ ? actor_->GetMapper() : nullptr;
  if (mapper && mapper->GetInputDataObject(0, 0) == shown)
  {
    mapper->SetInputDataObject(shown); // a connection to the filters would make them run
  }
  this->preview();
  if (shownObserver_)
  {
    shownObserver_(built);
  }
}

} // namespace pointhaptics
