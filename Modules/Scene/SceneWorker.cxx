#include "SceneWorker.h"

#include "LocalSceneProvider.h"
#include "SceneFilters.h"
#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

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

/// A cloud for all threads, which copy it or take its points, and change nothing. It has one reference of
/// VTK's: who lets go of one of several makes vtkGarbageCollector walk through an object of other threads.
using SharedCloud = std::shared_ptr<vtkSmartPointer<vtkPointSet>>;

/// A request, with what it is to be built of.
struct Job
{
  std::shared_ptr<const SceneRequest> request;
  std::uint64_t number = 0;
  SharedCloud cloud = std::make_shared<vtkSmartPointer<vtkPointSet>>();
  std::shared_ptr<const HapticScene> global; ///< The newest global scene of the cloud; null: none yet.
};

/// A thread of the worker. All members but the thread are guarded by the worker's mutex.
struct Builder
{
  std::uint64_t begun = 0; ///< Number of the newest request that it has begun, or need not build.
  bool isBuilding = false; ///< It works on a request.
  bool isRefining = false; ///< It looks for a finer scene near the hand.
  std::thread thread;
};

} // namespace

SceneRequest SceneRequest::of(vtkVoxelMeanResampler* resampler, vtkKernelBandwidthFilter* filter)
{
  SceneRequest request;
  request.recipe.voxels = resampler->GetSettings();
  if (filter)
  {
    request.recipe.bandwidth = filter->GetSettings();
    request.arrays = filter->GetSettings();
  }
  return request;
}

struct SceneWorker::Implementation
{
  mutable std::mutex mutex;
  std::condition_variable changed;
  // Guarded by the mutex.
  Job newest;                ///< The newest request, with the cloud of the next one.
  std::uint64_t adopted = 0; ///< Scenes of requests until this one are dropped.
  bool mayRefine = false;    ///< Finer scenes beside newest.global are wanted.
  std::unique_ptr<BuiltScene> finished;
  std::uint64_t builds = 0;
  bool ending = false;
  Builder global;
  Builder local;
  // State of the thread near the hand.
  Bounds seenHand;
  int restingLooks = 0;

  void start(Builder& builder, void (Implementation::*build)());
  bool busy(const Builder& builder) const { return builder.isBuilding || newest.number > builder.begun; }
  bool busy() const { return busy(global) || busy(local); }
  bool isCurrent(const Job& job) const { return job.cloud == newest.cloud && job.number > adopted; }
  std::uint64_t renew(SceneRequest request);
  std::optional<Job> next(Builder& builder);
  void waitForLocal(const Job& job);
  bool isFollowed() const;
  void offerRefinement(const Job& job, const std::shared_ptr<const HapticScene>& scene);
  void buildGlobalScenes();
  void buildLocalScenes();
};

/// Where the system has no thread left it throws: to be called before anything waits for that thread.
void SceneWorker::Implementation::start(Builder& builder, void (Implementation::*build)())
{
  if (!builder.thread.joinable())
  {
    builder.thread = std::thread([this, build] { (this->*build)(); });
  }
}

/// Takes a request in the place of the one before. @return its number. @pre the mutex is locked.
std::uint64_t SceneWorker::Implementation::renew(SceneRequest request)
{
  newest.request = std::make_shared<const SceneRequest>(std::move(request));
  mayRefine = false;
  return ++newest.number;
}

/// Ends the thread's last job and waits for the next one. Nothing: the thread must end.
std::optional<Job> SceneWorker::Implementation::next(Builder& builder)
{
  std::unique_lock<std::mutex> lock(mutex);
  builder.isBuilding = builder.isRefining = false;
  changed.notify_all();
  const auto isDue = [&] { return ending || newest.number > builder.begun; };
  const auto refines = [&] { return &builder == &local && mayRefine; };
  while (!isDue())
  {
    changed.wait(lock, [&] { return isDue() || refines(); });
    const auto period = restingLooks < kRestingLooks ? kLookPeriod : kRestPeriod;
    if (!changed.wait_for(lock, period, isDue) && refines())
    {
      builder.isRefining = true;
      return newest;
    }
  }
  builder.isBuilding = true;
  builder.begun = newest.number;
  return ending ? std::nullopt : std::optional<Job>(newest);
}

/// Lets the thread of the whole cloud wait until the other one is done with this job, or with a newer one:
/// local scenes go first.
void SceneWorker::Implementation::waitForLocal(const Job& job)
{
  std::unique_lock<std::mutex> lock(mutex);
  changed.wait(lock, [&] { return ending || !busy(local) || local.begun > job.number; });
}

bool SceneWorker::Implementation::isFollowed() const
{
  const std::lock_guard<std::mutex> lock(mutex);
  return newest.number > global.begun;
}

/// Offers the scene of a request, which is published, for refinement, if no other request follows.
void SceneWorker::Implementation::offerRefinement(
  const Job& job, const std::shared_ptr<const HapticScene>& scene)
{
  const SceneRequest& request = *job.request;
  const bool isWanted =
    scene && request.refinesNearHand && request.hand && request.publish && request.recipe.useCovariance;
  const std::lock_guard<std::mutex> lock(mutex);
  if (isWanted && job.number == newest.number && job.cloud == newest.cloud)
  {
    mayRefine = true;
    changed.notify_all();
  }
}

void SceneWorker::Implementation::buildGlobalScenes()
{
  SceneFilters filters;
  SharedCloud cloud;
  Clock::time_point displayed = Clock::now() - std::chrono::hours(1);
  while (const std::optional<Job> job = this->next(global))
  {
    const SceneRequest& request = *job->request;
    if (job->cloud != cloud)
    {
      cloud = job->cloud;
      filters.setCloud(*cloud);
    }
    this->waitForLocal(*job);
    auto built = std::make_unique<BuiltScene>();
    built->number = job->number;
    const std::shared_ptr<const HapticScene> scene =
      filters.makeScene(request.recipe, request.findsLattice, *built);
    {
      const std::lock_guard<std::mutex> lock(mutex);
      ++builds;
      newest.global = this->isCurrent(*job) ? scene : newest.global;
    }
    if (request.publish)
    {
      request.publish(scene, job->number);
    }
    this->offerRefinement(*job, scene);
    const std::chrono::duration<double> since = Clock::now() - displayed;
    const bool isSlow = request.hasResiduals || request.hasNormals;
    if (this->isFollowed() && (isSlow || since.count() <= kPictureSeconds))
    {
      continue;
    }
    filters.makePicture(request, scene.get(), *built);
    displayed = Clock::now();
    const std::lock_guard<std::mutex> lock(mutex);
    if (this->isCurrent(*job))
    {
      finished = std::move(built);
    }
  }
}

void SceneWorker::Implementation::buildLocalScenes()
{
  LocalSceneProvider provider;
  SharedCloud cloud;
  while (const std::optional<Job> job = this->next(local))
  {
    const SceneRequest& request = *job->request;
    if (job->cloud != cloud)
    {
      cloud = job->cloud;
      provider.setCloud(*cloud ? (*cloud)->GetPoints() : nullptr);
    }
    const Bounds hand = request.hand();
    std::shared_ptr<const HapticScene> scene;
    if (local.isRefining) // only this thread changes it
    {
      // If the hand rests, the next look comes later, and a window at rest sleeps.
      restingLooks = hand == seenHand ? restingLooks + 1 : 0;
      seenHand = hand;
      scene = provider.refine(hand, job->global);
    }
    else
    {
      scene = provider.build(request.recipe, hand, job->global);
    }
    if (scene && request.publish)
    {
      request.publish(std::move(scene), job->number);
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

void SceneWorker::setCloud(vtkPointSet* cloud)
{
  Implementation& self = *implementation_;
  const auto copy = std::make_shared<vtkSmartPointer<vtkPointSet>>();
  if (cloud)
  {
    copy->TakeReference(cloud->NewInstance());
    (*copy)->ShallowCopy(cloud);
  }
  const std::lock_guard<std::mutex> lock(self.mutex);
  self.newest.cloud = copy;
  self.newest.global.reset();
  self.mayRefine = false;
  self.finished.reset();
}

std::uint64_t SceneWorker::request(SceneRequest request)
{
  Implementation& self = *implementation_;
  const bool hasHand = bool(request.hand);
  const std::lock_guard<std::mutex> lock(self.mutex);
  self.start(self.global, &Implementation::buildGlobalScenes);
  if (hasHand)
  {
    self.start(self.local, &Implementation::buildLocalScenes);
  }
  const std::uint64_t number = self.renew(std::move(request));
  self.local.begun = hasHand ? self.local.begun : number;
  self.changed.notify_all();
  return number;
}

std::uint64_t SceneWorker::adopt(SceneRequest request, std::shared_ptr<const HapticScene> scene)
{
  Implementation& self = *implementation_;
  Job job;
  {
    const std::lock_guard<std::mutex> lock(self.mutex);
    if (request.hand)
    {
      self.start(self.local, &Implementation::buildLocalScenes);
    }
    self.adopted = self.global.begun = self.local.begun = self.renew(std::move(request));
    self.finished.reset();
    self.newest.global = scene;
    job = self.newest;
  }
  if (job.request->publish)
  {
    job.request->publish(scene, job.number);
  }
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
  const std::unique_ptr<BuiltScene> finished = std::move(implementation_->finished);
  if (finished)
  {
    built = std::move(*finished);
  }
  return finished != nullptr;
}

bool SceneWorker::busy() const
{
  const std::lock_guard<std::mutex> lock(implementation_->mutex);
  return implementation_->busy();
}

void SceneWorker::wait()
{
  Implementation& self = *implementation_;
  std::unique_lock<std::mutex> lock(self.mutex);
  self.changed.wait(lock, [&self] { return !self.busy(); });
}

void SceneWorker::cancel()
{
  Implementation& self = *implementation_;
  std::unique_lock<std::mutex> lock(self.mutex);
  self.global.begun = self.local.begun = self.newest.number;
  self.mayRefine = false;
  self.changed.wait(lock, [&self] { return !self.busy() && !self.local.isRefining; });
  self.mayRefine = false; // of a build that was in flight
  self.finished.reset();
}

} // namespace pointhaptics
