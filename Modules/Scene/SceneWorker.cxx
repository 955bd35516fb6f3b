#include "SceneWorker.h"

#include "HapticSceneBuilder.h"
#include "LatticeChoice.h"
#include "LocalSceneProvider.h"
#include "SurfaceArrays.h"
#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include "vtkCallbackCommand.h"
#include "vtkMatrix4x4.h"
#include "vtkMatrixToLinearTransform.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

namespace pointhaptics
{
namespace
{

using Clock = std::chrono::steady_clock;

/// Time between two looks at the hand: 0.5 mm at 50 mm/s.
constexpr std::chrono::milliseconds kLookPeriod(10);
/// Time between two looks at a hand that rested for kRestingLooks looks.
constexpr std::chrono::milliseconds kRestPeriod(40);
constexpr int kRestingLooks = 50;

/// Filters that live and die in the worker's thread.
class Pipeline
{
public:
  Pipeline()
  {
    // Messages of these filters come from another thread; the owner reports them as BuiltScene::problem.
    for (const auto event : { vtkCommand::ErrorEvent, vtkCommand::WarningEvent })
    {
      resampler_->AddObserver(event, silent_);
      bandwidth_->AddObserver(event, silent_);
    }
    transform_->SetInput(matrix_);
    resampler_->SetTransform(transform_);
    bandwidth_->SetInputConnection(resampler_->GetOutputPort());
  }

  void setCloud(vtkSmartPointer<vtkPointSet> cloud)
  {
    resampler_->SetInputDataObject(cloud);
    numberOfPoints_ = cloud ? cloud->GetNumberOfPoints() : 0;
  }

  /// Resamples and makes the scene; null where there is nothing to feel.
  std::shared_ptr<const HapticScene> buildScene(const SceneRequest& request, BuiltScene& built)
  {
    built.modelToWorkspace = request.modelToWorkspace;
    built.numberOfPoints = numberOfPoints_;
    matrix_->DeepCopy(request.modelToWorkspace.data());
    VoxelMeanSettings voxels = request.voxels;
    resampler_->SetSettings(voxels);
    std::optional<LocalBandwidthSettings> rule;
    if (request.bandwidth)
    {
      bandwidth_->SetSettings(*request.bandwidth);
      rule = *request.bandwidth;
    }
    std::shared_ptr<const HapticScene> scene;
    if (numberOfPoints_ > 0)
    {
      this->resample(request.findsLattice, voxels, built);
      built.problem = resampler_->GetErrorMessage();
      scene = makeHapticScene(resampler_->GetOutput(), built.status, request.useCovariance, rule, &voxels);
    }
    built.empty = scene == nullptr;
    scene_ = request.hasResiduals || request.hasNormals ? scene : nullptr;
    return scene;
  }

  /// Updates the resampler, whose settings are @p voxels.
  void resample(bool findsLattice, VoxelMeanSettings& voxels, BuiltScene& built)
  {
    const auto with = [&](int dimension)
    {
      voxels.lattice.dimensions = { dimension, dimension, dimension };
      resampler_->SetSettings(voxels);
      resampler_->Update();
      auto means = vtkSmartPointer<vtkPolyData>::New();
      means->ShallowCopy(resampler_->GetOutput());
      return means;
    };
    if (!findsLattice)
    {
      resampler_->Update();
      return;
    }
    const LatticeChoice choice = chooseLattice(with, [] { return true; });
    built.latticeDimension = choice.dimension;
    if (!choice.isNewest)
    {
      with(choice.dimension);
    }
  }

  /// Makes the arrays of the picture and moves all of them into @p built.
  void buildDisplay(const SceneRequest& request, BuiltScene& built)
  {
    built.means = vtkSmartPointer<vtkPolyData>::New();
    if (numberOfPoints_ > 0)
    {
      vtkPolyData* result = resampler_->GetOutput();
      if (request.bandwidth)
      {
        bandwidth_->Update();
        result = bandwidth_->GetOutput();
        built.problem += bandwidth_->GetErrorMessage();
      }
      built.means->ShallowCopy(result);
    }
    if (scene_)
    {
      addSurfaceArrays(built.means, *scene_, request.hasResiduals, request.hasNormals);
    }
    this->release();
  }

  /// Lets go of the output, which others own now; the next update makes new arrays.
  void release()
  {
    bandwidth_->GetOutput()->ReleaseData();
    resampler_->GetOutput()->ReleaseData();
    scene_.reset();
  }

private:
  vtkNew<vtkCallbackCommand> silent_;
  vtkNew<vtkMatrix4x4> matrix_;
  vtkNew<vtkMatrixToLinearTransform> transform_;
  vtkNew<vtkVoxelMeanResampler> resampler_;
  vtkNew<vtkKernelBandwidthFilter> bandwidth_;
  vtkIdType numberOfPoints_ = 0;
  std::shared_ptr<const HapticScene> scene_; // for the arrays of the picture
};

} // namespace

SceneRequest SceneRequest::of(vtkVoxelMeanResampler* resampler, vtkKernelBandwidthFilter* filter)
{
  SceneRequest request;
  request.voxels = resampler->GetSettings();
  if (filter)
  {
    request.bandwidth = filter->GetSettings();
  }
  return request;
}

namespace
{

/// An object whose ownership passes to another thread. vtkSmartPointer copies even where it is assigned from
/// a moved pointer, so a reference would stay behind. Whoever lets go of one of several references makes
/// vtkGarbageCollector walk through an object that belongs to another thread by then. The constructor of an
/// optional moves.
template <typename Object>
using Owned = std::optional<Object>;

template <typename Object>
Owned<Object> takeOwned(Owned<Object>& from)
{
  Owned<Object> to(std::move(from));
  from.reset();
  return to;
}

/// The scene of the newest request, which may be refined near the hand.
struct Refinable
{
  SceneRequest request;
  std::uint64_t number;
  std::shared_ptr<const HapticScene> global;
};

/// Task of a thread of the worker.
struct Job
{
  SceneRequest request;
  std::uint64_t number;
  std::uint64_t cloudNumber;
  Owned<vtkSmartPointer<vtkPointSet>> cloud;            // if it is a new one
  std::shared_ptr<const Refinable> refinable = nullptr; // refine this; there is no request then
};

/// A thread of the worker and its next task. All members but the thread are guarded by the worker's mutex.
struct Builder
{
  std::optional<SceneRequest> waiting;
  Owned<vtkSmartPointer<vtkPointSet>> cloud; // a new one that is not yet the thread's own
  bool inFlight = false;
  bool refines = false;     // as long as it does, who cancels waits
  std::uint64_t number = 0; // of the newest job that was begun
  std::thread thread;

  bool busy() const { return this->inFlight || this->waiting.has_value(); }
};

} // namespace

struct SceneWorker::Implementation
{
  mutable std::mutex mutex;
  std::condition_variable changed;
  // Guarded by the mutex.
  Builder global;
  Builder local;
  std::uint64_t number = 0;
  std::uint64_t cloudNumber = 0;
  std::uint64_t adopted = 0; // the newest request that is not built here; what was begun before is dropped
  std::uint64_t builds = 0;
  std::shared_ptr<const HapticScene> newestGlobal; // of this cloud
  std::shared_ptr<const Refinable> refinable;      // while no request follows, if that is wanted
  Owned<BuiltScene> finished;
  bool ending = false;
  // State of the thread near the hand.
  Bounds seenHand;
  int restingLooks = 0;

  void look(const SceneRequest& request);
  void start(Builder& builder, void (Implementation::*build)());
  std::optional<Job> next(Builder& builder);
  void waitForLocal(const Job& job);
  bool isFollowed() const;
  void offerRefinement(const Job& job, const std::shared_ptr<const HapticScene>& scene);
  void buildGlobalScenes();
  void buildLocalScenes();
};

void SceneWorker::Implementation::start(Builder& builder, void (Implementation::*build)())
{
  if (!builder.thread.joinable())
  {
    builder.thread = std::thread([this, build] { (this->*build)(); });
  }
}

/// Ends the thread's last job and waits for the next one. Nothing: the thread must end.
std::optional<Job> SceneWorker::Implementation::next(Builder& builder)
{
  std::unique_lock<std::mutex> lock(this->mutex);
  builder.inFlight = false;
  builder.refines = false;
  this->changed.notify_all();
  const auto isDue = [&] { return this->ending || builder.waiting.has_value(); };
  const auto mayRefine = [&] { return &builder == &this->local && this->refinable; };
  while (!isDue())
  {
    this->changed.wait(lock, [&] { return isDue() || mayRefine(); });
    const auto period = this->restingLooks < kRestingLooks ? kLookPeriod : kRestPeriod;
    if (!this->changed.wait_for(lock, period, isDue) && mayRefine())
    {
      builder.refines = true;
      return Job{ {}, this->refinable->number, this->cloudNumber, takeOwned(builder.cloud), this->refinable };
    }
  }
  if (this->ending)
  {
    return {};
  }
  builder.inFlight = true;
  builder.number = this->number;
  Job job = { std::move(*builder.waiting), this->number, this->cloudNumber, takeOwned(builder.cloud) };
  builder.waiting.reset();
  return job;
}

/// Lets the thread of the whole cloud wait until the other one is done with this job, or with a newer one:
/// local scenes go first.
void SceneWorker::Implementation::waitForLocal(const Job& job)
{
  std::unique_lock<std::mutex> lock(this->mutex);
  this->changed.wait(
    lock, [&] { return this->ending || !this->local.busy() || this->local.number > job.number; });
}

bool SceneWorker::Implementation::isFollowed() const
{
  const std::lock_guard<std::mutex> lock(this->mutex);
  return this->global.waiting.has_value();
}

/// Offers the scene of a request, which is published, for refinement, if no other request follows.
void SceneWorker::Implementation::offerRefinement(
  const Job& job, const std::shared_ptr<const HapticScene>& scene)
{
  const SceneRequest& request = job.request;
  const std::lock_guard<std::mutex> lock(this->mutex);
  const bool isNewest = job.number == this->number && job.cloudNumber == this->cloudNumber;
  if (isNewest && scene && request.refinesNearHand && request.hand && request.publish &&
    request.useCovariance)
  {
    this->refinable = std::make_shared<const Refinable>(Refinable{ request, job.number, scene });
    this->changed.notify_all();
  }
}

void SceneWorker::Implementation::buildGlobalScenes()
{
  Pipeline pipeline;
  Clock::time_point displayed = Clock::now() - std::chrono::hours(1);
  while (std::optional<Job> job = this->next(this->global))
  {
    if (job->cloud)
    {
      pipeline.setCloud(std::move(*job->cloud));
    }
    this->waitForLocal(*job);
    BuiltScene built;
    built.number = job->number;
    std::shared_ptr<const HapticScene> scene = pipeline.buildScene(job->request, built);
    {
      const std::lock_guard<std::mutex> lock(this->mutex);
      ++this->builds;
      const bool isOurs = job->cloudNumber == this->cloudNumber && job->number > this->adopted;
      this->newestGlobal = isOurs ? scene : this->newestGlobal;
    }
    if (job->request.publish)
    {
      job->request.publish(scene, job->number);
    }
    this->offerRefinement(*job, scene);
    scene.reset();
    const std::chrono::duration<double> since = Clock::now() - displayed;
    const bool isSlow = job->request.hasResiduals || job->request.hasNormals;
    if (this->isFollowed() && (isSlow || since.count() <= kPictureSeconds))
    {
      continue;
    }
    pipeline.buildDisplay(job->request, built);
    displayed = Clock::now();
    const std::lock_guard<std::mutex> lock(this->mutex);
    if (job->number > this->adopted && job->cloudNumber == this->cloudNumber)
    {
      this->finished.emplace(std::move(built));
    }
  }
}

/// Looks at the hand. If it rests, the next look comes later, and a window at rest sleeps.
void SceneWorker::Implementation::look(const SceneRequest& request)
{
  const Bounds hand = request.hand();
  this->restingLooks = hand == this->seenHand ? this->restingLooks + 1 : 0;
  this->seenHand = hand;
}

void SceneWorker::Implementation::buildLocalScenes()
{
  LocalSceneProvider builder;
  while (std::optional<Job> job = this->next(this->local))
  {
    if (job->cloud)
    {
      builder.setCloud(std::move(*job->cloud));
    }
    if (job->refinable)
    {
      const SceneRequest& request = job->refinable->request;
      this->look(request);
      if (std::shared_ptr<const HapticScene> finer = builder.refine(request, job->refinable->global))
      {
        request.publish(std::move(finer), job->number);
      }
      continue;
    }
    std::shared_ptr<const HapticScene> newest;
    {
      const std::lock_guard<std::mutex> lock(this->mutex);
      newest = job->cloudNumber == this->cloudNumber ? this->newestGlobal : nullptr;
    }
    std::shared_ptr<const HapticScene> scene = builder.build(job->request, std::move(newest));
    if (scene && job->request.publish)
    {
      job->request.publish(std::move(scene), job->number);
    }
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
  for (Builder* builder : { &self.global, &self.local })
  {
    if (builder->thread.joinable())
    {
      builder->thread.join();
    }
  }
}

void SceneWorker::setCloud(vtkSmartPointer<vtkPointSet> cloud)
{
  vtkSmartPointer<vtkPointSet> copy;
  if (cloud)
  {
    copy.TakeReference(vtkPointSet::SafeDownCast(cloud->NewInstance()));
    copy->ShallowCopy(cloud);
  }
  Implementation& self = *implementation_;
  const std::lock_guard<std::mutex> lock(self.mutex);
  self.global.cloud.emplace(std::move(cloud));
  self.local.cloud.emplace(std::move(copy));
  self.newestGlobal.reset();
  self.refinable.reset();
  self.finished.reset();
  ++self.cloudNumber;
}

std::uint64_t SceneWorker::request(SceneRequest request)
{
  Implementation& self = *implementation_;
  const bool hasHand = bool(request.hand);
  self.start(self.global, &Implementation::buildGlobalScenes);
  if (hasHand)
  {
    self.start(self.local, &Implementation::buildLocalScenes);
  }
  std::uint64_t number = 0;
  {
    const std::lock_guard<std::mutex> lock(self.mutex);
    self.local.waiting = hasHand ? std::optional<SceneRequest>(request) : std::nullopt;
    self.global.waiting = std::move(request);
    self.refinable.reset();
    number = ++self.number;
  }
  self.changed.notify_all();
  return number;
}

std::uint64_t SceneWorker::adopt(SceneRequest request, std::shared_ptr<const HapticScene> scene)
{
  Implementation& self = *implementation_;
  Job job{};
  {
    const std::lock_guard<std::mutex> lock(self.mutex);
    self.local.waiting.reset();
    self.global.waiting.reset();
    self.refinable.reset();
    self.finished.reset();
    self.newestGlobal = scene;
    self.adopted = ++self.number;
    job.number = self.number;
    job.cloudNumber = self.cloudNumber;
  }
  if (request.hand)
  {
    self.start(self.local, &Implementation::buildLocalScenes);
  }
  if (request.publish)
  {
    request.publish(scene, job.number);
  }
  job.request = std::move(request);
  self.offerRefinement(job, scene);
  return job.number;
}

std::uint64_t SceneWorker::numberOfBuilds() const
{
  const std::lock_guard<std::mutex> lock(implementation_->mutex);
  return implementation_->builds;
}

bool SceneWorker::take(BuiltScene& built)
{
  const std::lock_guard<std::mutex> lock(implementation_->mutex);
  if (!implementation_->finished)
  {
    return false;
  }
  built = *takeOwned(implementation_->finished);
  return true;
}

bool SceneWorker::busy() const
{
  const std::lock_guard<std::mutex> lock(implementation_->mutex);
  return implementation_->global.busy() || implementation_->local.busy();
}

void SceneWorker::wait()
{
  Implementation& self = *implementation_;
  std::unique_lock<std::mutex> lock(self.mutex);
  self.changed.wait(lock, [&self] { return !self.global.busy() && !self.local.busy(); });
}

void SceneWorker::cancel()
{
  Implementation& self = *implementation_;
  {
    const std::lock_guard<std::mutex> lock(self.mutex);
    self.global.waiting.reset();
    self.local.waiting.reset();
    self.refinable.reset();
  }
  std::unique_lock<std::mutex> lock(self.mutex);
  self.changed.wait(
    lock, [&self] { return !self.global.busy() && !self.local.busy() && !self.local.refines; });
  self.refinable.reset(); // of a build that was in flight
  self.finished.reset();
}

} // namespace pointhaptics
