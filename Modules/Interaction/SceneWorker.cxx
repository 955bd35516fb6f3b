#include "SceneWorker.h"

#include "HapticSceneBuilder.h"
#include "SurfaceArrays.h"
#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include "vtkMatrix4x4.h"
#include "vtkMatrixToLinearTransform.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>

namespace pointhaptics
{
namespace
{

using Clock = std::chrono::steady_clock;

/// The filters, which live and die in the worker's thread.
class Pipeline
{
public:
  Pipeline()
  {
    transform_->SetInput(matrix_);
    resampler_->SetTransform(transform_);
    bandwidth_->SetInputConnection(resampler_->GetOutputPort());
  }

  void setCloud(vtkSmartPointer<vtkPointSet> cloud)
  {
    resampler_->SetInputDataObject(cloud);
    numberOfPoints_ = cloud ? cloud->GetNumberOfPoints() : 0;
  }

  /// Resamples and publishes.
  void feel(const SceneRequest& request, BuiltScene& built)
  {
    built.modelToWorkspace = request.modelToWorkspace;
    built.numberOfPoints = numberOfPoints_;
    matrix_->DeepCopy(request.modelToWorkspace.data());
    for (const SceneRequest::Setting& setting : request.settings)
    {
      setting(resampler_, bandwidth_);
    }
    std::optional<LocalBandwidthSettings> rule;
    if (request.hasBandwidth)
    {
      rule = bandwidth_->GetSettings();
    }
    std::shared_ptr<const HapticScene> scene;
    if (numberOfPoints_ > 0)
    {
      resampler_->Update();
      scene = makeHapticScene(resampler_->GetOutput(), built.status, request.useCovariance, rule);
    }
    built.empty = scene == nullptr;
    scene_ = request.hasResiduals || request.hasNormals ? scene : nullptr;
    if (request.publish)
    {
      request.publish(std::move(scene));
    }
  }

  /// Makes the arrays of the picture and hands all of it over.
  void show(const SceneRequest& request, BuiltScene& built)
  {
    built.means = vtkSmartPointer<vtkPolyData>::New();
    if (numberOfPoints_ > 0)
    {
      vtkPolyData* result = resampler_->GetOutput();
      if (request.hasBandwidth)
      {
        bandwidth_->Update();
        result = bandwidth_->GetOutput();
      }
      built.means->ShallowCopy(result);
    }
    if (scene_)
    {
      addSurfaceArrays(built.means, *scene_, request.hasResiduals, request.hasNormals);
    }
    this->letGo();
  }

  /// What was handed over is nobody else's; the next update makes new arrays.
  void letGo()
  {
    bandwidth_->GetOutput()->ReleaseData();
    resampler_->GetOutput()->ReleaseData();
    scene_.reset();
  }

private:
  vtkNew<vtkMatrix4x4> matrix_;
  vtkNew<vtkMatrixToLinearTransform> transform_;
  vtkNew<vtkVoxelMeanResampler> resampler_;
  vtkNew<vtkKernelBandwidthFilter> bandwidth_;
  vtkIdType numberOfPoints_ = 0;
  std::shared_ptr<const HapticScene> scene_; // for the arrays of the picture
};

} // namespace

SceneRequest SceneRequest::of(vtkVoxelMeanResampler* resampler, vtkKernelBandwidthFilter* bandwidth)
{
  SceneRequest request;
  std::array<double, 6> bounds;
  resampler->GetWorkspaceBounds(bounds.data());
  std::array<int, 3> dimensions;
  resampler->GetDimensions(dimensions.data());
  request.settings.push_back(
    [bounds, dimensions, automatic = resampler->GetAutomaticWorkspace(),
      voxelSize = resampler->GetVoxelSize(), precision = resampler->GetOutputPointsPrecision(),
      covariance = resampler->GetComputeCovariance(), arrays = resampler->GetPassAttributes(),
      categories = resampler->GetCategoricalArrays(), index = resampler->GetUsePointIndex(),
      instructions = resampler->GetInstructionSet()](vtkVoxelMeanResampler* own, vtkKernelBandwidthFilter*)
    {
      own->SetWorkspaceBounds(bounds.data());
      own->SetAutomaticWorkspace(automatic);
      own->SetDimensions(dimensions.data());
      own->SetVoxelSize(voxelSize);
      own->SetOutputPointsPrecision(precision);
      own->SetComputeCovariance(covariance);
      own->SetPassAttributes(arrays);
      own->ClearCategoricalArrays();
      for (const std::string& name : categories)
      {
        own->AddCategoricalArray(name.c_str());
      }
      own->SetUsePointIndex(index);
      own->SetInstructionSet(instructions);
    });
  request.hasBandwidth = bandwidth != nullptr;
  if (bandwidth)
  {
    request.settings.push_back(
      [neighborhood = bandwidth->GetNeighborhood(), neighbors = bandwidth->GetNumberOfNeighbors(),
        radius = bandwidth->GetRadius(), rule = bandwidth->GetRule(), scale = bandwidth->GetRadiusScale(),
        least = bandwidth->GetMinimumRadius(), most = bandwidth->GetMaximumRadius(),
        smooth = bandwidth->GetSmoothRadius(), kernel = bandwidth->GetDensityKernel(),
        bandwidths = bandwidth->GetComputeBandwidth(), radii = bandwidth->GetComputeProxyRadius(),
        densities = bandwidth->GetComputeDensity()](vtkVoxelMeanResampler*, vtkKernelBandwidthFilter* own)
      {
        own->SetNeighborhood(neighborhood);
        own->SetNumberOfNeighbors(neighbors);
        own->SetRadius(radius);
        own->SetRule(rule);
        own->SetRadiusScale(scale);
        own->SetMinimumRadius(least);
        own->SetMaximumRadius(most);
        own->SetSmoothRadius(smooth);
        own->SetDensityKernel(kernel);
        own->SetComputeBandwidth(bandwidths);
        own->SetComputeProxyRadius(radii);
        own->SetComputeDensity(densities);
      });
  }
  return request;
}

struct SceneWorker::Implementation
{
  mutable std::mutex mutex;
  std::condition_variable changed;
  // Under the mutex.
  std::optional<SceneRequest> waiting;
  vtkSmartPointer<vtkPointSet> cloud; // not yet the pipeline's
  bool cloudIsNew = false;
  BuiltScene finished;
  bool hasFinished = false;
  bool inFlight = false;
  bool ending = false;
  std::uint64_t number = 0;

  std::thread thread;

  void run();
  bool isFollowed() const;
};

bool SceneWorker::Implementation::isFollowed() const
{
  const std::lock_guard<std::mutex> lock(this->mutex);
  return this->waiting.has_value();
}

void SceneWorker::Implementation::run()
{
  Pipeline pipeline;
  Clock::time_point shown = Clock::now() - std::chrono::hours(1);
  std::unique_lock<std::mutex> lock(this->mutex);
  while (true)
  {
    this->changed.wait(lock, [this] { return this->ending || this->waiting.has_value(); });
    if (this->ending)
    {
      return;
    }
    const SceneRequest request = std::move(*this->waiting);
    this->waiting.reset();
    this->inFlight = true;
    BuiltScene built;
    built.number = this->number;
    const bool newCloud = std::exchange(this->cloudIsNew, false);
    vtkSmartPointer<vtkPointSet> newest = std::move(this->cloud);
    lock.unlock();
    if (newCloud)
    {
      pipeline.setCloud(std::move(newest));
    }
    pipeline.feel(request, built);
    const std::chrono::duration<double> since = Clock::now() - shown;
    const bool isSlow = request.hasResiduals || request.hasNormals;
    const bool shows = !this->isFollowed() || (!isSlow && since.count() > kPictureSeconds);
    if (shows)
    {
      pipeline.show(request, built);
      shown = Clock::now();
    }
    lock.lock();
    this->inFlight = false;
    if (shows)
    {
      this->finished = std::move(built);
      this->hasFinished = true;
    }
    this->changed.notify_all();
  }
}

SceneWorker::SceneWorker()
  : implementation_(std::make_unique<Implementation>())
{
}

SceneWorker::~SceneWorker()
{
  Implementation& self = *implementation_;
  {
    const std::lock_guard<std::mutex> lock(self.mutex);
    self.ending = true;
  }
  self.changed.notify_all();
  if (self.thread.joinable())
  {
    self.thread.join();
  }
}

void SceneWorker::setCloud(vtkSmartPointer<vtkPointSet> cloud)
{
  const std::lock_guard<std::mutex> lock(implementation_->mutex);
  implementation_->cloud = std::move(cloud);
  implementation_->cloudIsNew = true;
}

std::uint64_t SceneWorker::request(SceneRequest request)
{
  Implementation& self = *implementation_;
  if (!self.thread.joinable())
  {
    self.thread = std::thread([&self] { self.run(); });
  }
  std::uint64_t number = 0;
  {
    const std::lock_guard<std::mutex> lock(self.mutex);
    self.waiting = std::move(request);
    number = ++self.number;
  }
  self.changed.notify_all();
  return number;
}

bool SceneWorker::take(BuiltScene& built)
{
  const std::lock_guard<std::mutex> lock(implementation_->mutex);
  if (!implementation_->hasFinished)
  {
    return false;
  }
  implementation_->hasFinished = false;
  built = std::move(implementation_->finished);
  implementation_->finished = BuiltScene();
  return true;
}

bool SceneWorker::busy() const
{
  const std::lock_guard<std::mutex> lock(implementation_->mutex);
  return implementation_->inFlight || implementation_->waiting.has_value();
}

void SceneWorker::wait()
{
  Implementation& self = *implementation_;
  std::unique_lock<std::mutex> lock(self.mutex);
  self.changed.wait(lock, [&self] { return !self.inFlight && !self.waiting.has_value(); });
}

void SceneWorker::cancel()
{
  Implementation& self = *implementation_;
  {
    const std::lock_guard<std::mutex> lock(self.mutex);
    self.waiting.reset();
  }
  this->wait();
  const std::lock_guard<std::mutex> lock(self.mutex);
  self.finished = BuiltScene();
  self.hasFinished = false;
}

} // namespace pointhaptics
