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
  std::uint64_t globalNumber = 0;            ///< Number of the request it was made for.
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
  Job newest;              ///< The newest request, with the cloud of the next one.
  std::uint64_t begun = 0; ///< Number of the newest request whose build has begun, or need not be built.
  std::uint64_t first = 0; ///< Scenes of requests before this one are dropped.
  std::unique_ptr<BuiltScene> finished;
  std::uint64_t builds = 0;
  bool isBuilding = false;
  bool isRefining = false;  ///< A finer scene near the hand is looked for.
  bool isCancelled = false; ///< None is wanted until the next request.
  bool ending = false;
  std::thread builder;
  std::thread refiner;

  void start(std::thread& thread, void (Implementation::*work)());
  bool busy() const { return isBuilding || newest.number > begun; }
  bool isCurrent(const Job& job) const { return job.cloud == newest.cloud && job.number >= first; }
  bool refines() const;
  std::uint64_t renew(SceneRequest request);
  std::optional<Job> nextBuild();
  std::optional<Job> nextLook(const SharedCloud& held, std::chrono::milliseconds period);
  bool isFollowed() const;
  void publish(const Job& job, const std::shared_ptr<const HapticScene>& scene);
  void buildGlobalScenes();
  void buildLocalScenes();
};

/// Where the system has no thread left it throws: to be called before anything waits for that thread.
void SceneWorker::Implementation::start(std::thread& thread, void (Implementation::*work)())
{
  if (!thread.joinable())
  {
    thread = std::thread([this, work] { (this->*work)(); });
  }
}

/// True if finer scenes are wanted beside the newest global one. @pre the mutex is locked.
bool SceneWorker::Implementation::refines() const
{
  const SceneRequest* const request = newest.request.get();
  return !isCancelled && newest.global && request->refinesNearHand && request->hand && request->publish &&
    request->recipe.useCovariance;
}

/// Takes a request in the place of the one before. @return its number. @pre the mutex is locked.
std::uint64_t SceneWorker::Implementation::renew(SceneRequest request)
{
  newest.request = std::make_shared<const SceneRequest>(std::move(request));
  isCancelled = false;
  return ++newest.number;
}

/// Ends the last build and waits for the next one. Nothing: the thread must end.
std::optional<Job> SceneWorker::Implementation::nextBuild()
{
  std::unique_lock<std::mutex> lock(mutex);
  isBuilding = false;
  changed.notify_all();
  changed.wait(lock, [this] { return ending || newest.number > begun; });
  isBuilding = !ending;
  begun = newest.number;
  return ending ? std::nullopt : std::optional<Job>(newest);
}

/// Ends the last look at the hand and waits for the next one, at least @p period, or for another cloud than
/// the one @p held. Nothing: the thread must end.
std::optional<Job> SceneWorker::Implementation::nextLook(
  const SharedCloud& held, std::chrono::milliseconds period)
{
  std::unique_lock<std::mutex> lock(mutex);
  isRefining = false;
  changed.notify_all();
  const auto isDue = [&] { return ending || newest.cloud != held; };
  changed.wait_for(lock, period, isDue);
  changed.wait(lock, [&] { return isDue() || this->refines(); });
  isRefining = !ending && this->refines();
  return ending ? std::nullopt : std::optional<Job>(newest);
}

bool SceneWorker::Implementation::isFollowed() const
{
  const std::lock_guard<std::mutex> lock(mutex);
  return newest.number > begun;
}

/// Publishes the global scene of a request, and offers it for refinement after that.
void SceneWorker::Implementation::publish(const Job& job, const std::shared_ptr<const HapticScene>& scene)
{
  if (job.request->publish)
  {
    job.request->publish(scene, job.number);
  }
  const std::lock_guard<std::mutex> lock(mutex);
  if (this->isCurrent(job))
  {
    newest.global = scene;
    newest.globalNumber = job.number;
    changed.notify_all();
  }
}

void SceneWorker::Implementation::buildGlobalScenes()
{
  SceneFilters filters;
  SharedCloud cloud;
  Clock::time_point displayed = Clock::now() - std::chrono::hours(1);
  while (const std::optional<Job> job = this->nextBuild())
  {
    const SceneRequest& request = *job->request;
    if (job->cloud != cloud)
    {
      cloud = job->cloud;
      filters.setCloud(*cloud);
    }
    auto built = std::make_unique<BuiltScene>();
    built->number = job->number;
    const std::shared_ptr<const HapticScene> scene =
      filters.makeScene(request.recipe, request.findsLattice, *built);
    {
      const std::lock_guard<std::mutex> lock(mutex);
      ++builds;
    }
    this->publish(*job, scene);
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
  Bounds seenHand;
  int restingLooks = 0;
  // If the hand rests, the next look comes later, and a window at rest sleeps.
  while (const auto job = this->nextLook(cloud, restingLooks < kRestingLooks ? kLookPeriod : kRestPeriod))
  {
    if (job->cloud != cloud)
    {
      cloud = job->cloud;
      provider.setCloud(*cloud ? (*cloud)->GetPoints() : nullptr);
    }
    if (!isRefining) // only this thread changes it
    {
      continue;
    }
    const SceneRequest& request = *job->request;
    const Bounds hand = request.hand();
    restingLooks = hand == seenHand ? restingLooks + 1 : 0;
    seenHand = hand;
    if (auto scene = provider.refine(hand, job->global, request.recipe.modelToWorkspace))
    {
      request.publish(std::move(scene), job->globalNumber);
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
  for (std::thread* thread : { &self.builder, &self.refiner })
  {
    if (thread->joinable())
    {
      thread->join();
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
  self.finished.reset();
  self.changed.notify_all();
}

std::uint64_t SceneWorker::request(SceneRequest request)
{
  Implementation& self = *implementation_;
  const std::lock_guard<std::mutex> lock(self.mutex);
  self.start(self.builder, &Implementation::buildGlobalScenes);
  if (request.hand)
  {
    self.start(self.refiner, &Implementation::buildLocalScenes);
  }
  const std::uint64_t number = self.renew(std::move(request));
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
      self.start(self.refiner, &Implementation::buildLocalScenes);
    }
    self.first = self.begun = self.renew(std::move(request));
    self.finished.reset();
    job = self.newest;
  }
  self.publish(job, scene);
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
  self.begun = self.newest.number;
  self.isCancelled = true;
  self.changed.wait(lock, [&self] { return !self.busy() && !self.isRefining; });
  self.finished.reset();
}

} // namespace pointhaptics
