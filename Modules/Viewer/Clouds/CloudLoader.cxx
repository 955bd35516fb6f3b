#include "CloudLoader.h"

#include "Core/Base/Host/OutOfMemory.h"
#include "Core/Base/Status.h"

#include <vtkPolyData.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

namespace pointhaptics
{
namespace
{

using Clock = std::chrono::steady_clock;

/// One load. The GUI's thread fills request before the load is queued; then members that are not atomic
/// belong to the loader's thread until finished, and to the GUI's thread from then on.
struct Load
{
  CloudRequest request;
  Clock::time_point begin = Clock::now();
  std::atomic<double> progress{ 0.0 };
  std::atomic<const char*> step{ nullptr }; // null while files are read
  std::atomic<double> partOfStep{ 0.0 };
  std::atomic<bool> cancelled{ false };
  bool finished = false; // under the mutex
  LoadedCloud loaded;
  std::string message;

  void run();
};

void Load::run()
{
  const auto shouldContinue = [this](double part)
  {
    progress = std::max(progress.load(), std::clamp(part, 0.0, 1.0));
    return !cancelled;
  };
  try
  {
    request.working = [this](const char* name, double part)
    {
      partOfStep = std::clamp(part, 0.0, 1.0);
      step = name;
    };
    if (loadCloud(request, shouldContinue, loaded, message))
    {
      message.clear();
    }
  }
  catch (const std::exception& fault)
  {
    message = request.name() + ": " +
      (isOutOfMemory(fault) ? pointhaptics::message(Status::OutOfMemory) : fault.what());
  }
}

} // namespace

struct CloudLoader::Implementation
{
  mutable std::mutex mutex;
  /// Notified when `queued` or `shouldEnd` changes, for the loader, and when a load is finished, for
  /// waitFor().
  mutable std::condition_variable changed;
  // Under the mutex.
  std::shared_ptr<Load> queued;
  bool shouldEnd = false;

  std::shared_ptr<Load> present; // the GUI thread's
  std::thread thread;

  void run();
};

void CloudLoader::Implementation::run()
{
  std::unique_lock<std::mutex> lock(this->mutex);
  while (true)
  {
    this->changed.wait(lock, [this] { return this->shouldEnd || this->queued; });
    if (this->shouldEnd)
    {
      return;
    }
    std::shared_ptr<Load> load = std::move(this->queued);
    lock.unlock();
    load->run();
    lock.lock();
    load->finished = true;
    lock.unlock();
    this->changed.notify_all();
    load.reset(); // frees a cloud that was given up outside the lock: this may take long
    lock.lock();
  }
}

CloudLoader::CloudLoader()
  : implementation_(std::make_unique<Implementation>())
{
}

CloudLoader::~CloudLoader()
{
  Implementation& self = *implementation_;
  this->cancel();
  {
    const std::lock_guard<std::mutex> lock(self.mutex);
    self.shouldEnd = true;
  }
  self.changed.notify_all();
  if (self.thread.joinable())
  {
    self.thread.join();
  }
}

void CloudLoader::start(CloudRequest request)
{
  Implementation& self = *implementation_;
  this->cancel();
  self.present = std::make_shared<Load>();
  self.present->request = std::move(request);
  {
    const std::lock_guard<std::mutex> lock(self.mutex);
    self.queued = self.present;
  }
  if (!self.thread.joinable())
  {
    self.thread = std::thread([&self] { self.run(); });
  }
  self.changed.notify_all();
}

void CloudLoader::cancel()
{
  Implementation& self = *implementation_;
  if (!self.present)
  {
    return;
  }
  self.present->cancelled = true;
  self.present.reset();
  const std::lock_guard<std::mutex> lock(self.mutex);
  self.queued.reset();
}

bool CloudLoader::busy() const
{
  return implementation_->present != nullptr;
}

double CloudLoader::progress() const
{
  return this->busy() ? implementation_->present->progress.load() : 0.0;
}

CloudLoader::Step CloudLoader::step() const
{
  const char* name = this->busy() ? implementation_->present->step.load() : nullptr;
  return name ? Step{ name, implementation_->present->partOfStep } : Step{ "reading", this->progress() };
}

double CloudLoader::seconds() const
{
  return this->busy() ? std::chrono::duration<double>(Clock::now() - implementation_->present->begin).count()
                      : 0.0;
}

bool CloudLoader::waitFor(double seconds) const
{
  const Implementation& self = *implementation_;
  if (!self.present)
  {
    return false;
  }
  std::unique_lock<std::mutex> lock(self.mutex);
  return self.changed.wait_for(
    lock, std::chrono::duration<double>(seconds), [&self] { return self.present->finished; });
}

bool CloudLoader::take(LoadedCloud& loaded, std::string& message)
{
  if (!this->waitFor(0.0))
  {
    return false;
  }
  const std::shared_ptr<Load> load = std::move(implementation_->present);
  implementation_->present.reset();
  message = load->message;
  if (message.empty())
  {
    loaded = std::move(load->loaded);
    load->loaded = LoadedCloud(); // the caller alone shall hold the VTK objects
  }
  return true;
}

} // namespace pointhaptics
