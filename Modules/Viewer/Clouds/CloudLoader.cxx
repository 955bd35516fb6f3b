#include "CloudLoader.h"

#include "Core/Base/Host/OutOfMemory.h"
#include "Core/Base/Status.h"

#include <vtkPolyData.h>

#include <algorithm>
#include <exception>
#include <utility>

namespace pointhaptics
{

/// One load. The loader's thread has the members that are not atomic until the load has ended, and the GUI's
/// thread has them from then on.
struct CloudLoader::Load
{
  CloudRequest request;
  Clock::time_point begin = Clock::now();
  std::atomic<const char*> step{ Step().name };
  std::atomic<double> part{ 0.0 };
  std::atomic<bool> cancelled{ false };
  LoadedCloud loaded;
  std::string message;

  void run();
};

void CloudLoader::Load::run()
{
  const auto report = [this](const char* name, double done)
  {
    part = std::clamp(done, 0.0, 1.0);
    step = name;
    return !cancelled;
  };
  try
  {
    if (!cancelled && loadCloud(request, report, loaded, message))
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

CloudLoader::CloudLoader() = default;

CloudLoader::~CloudLoader()
{
  this->cancel();
}

void CloudLoader::start(CloudRequest request)
{
  this->cancel();
  present_ = std::make_shared<Load>();
  present_->request = std::move(request);
  auto work = [load = present_, former = std::move(ended_)]() mutable
  {
    if (former.valid())
    {
      former.get(); // and lets go of what it kept
    }
    load->run();
    load.reset(); // frees a cloud that was given up: this may take long
  };
  ended_ = std::async(std::launch::async, std::move(work));
}

void CloudLoader::cancel()
{
  if (present_)
  {
    present_->cancelled = true;
    present_.reset();
  }
}

CloudLoader::Step CloudLoader::step() const
{
  return present_ ? Step{ present_->step, present_->part } : Step();
}

double CloudLoader::seconds() const
{
  return present_ ? std::chrono::duration<double>(Clock::now() - present_->begin).count() : 0.0;
}

bool CloudLoader::waitFor(double seconds) const
{
  return present_ && ended_.wait_for(std::chrono::duration<double>(seconds)) == std::future_status::ready;
}

bool CloudLoader::take(LoadedCloud& loaded, std::string& message)
{
  if (!this->waitFor(0.0))
  {
    return false;
  }
  const std::shared_ptr<Load> load = std::exchange(present_, nullptr);
  message = load->message;
  if (message.empty())
  {
    loaded = std::move(load->loaded);
    load->loaded = LoadedCloud(); // the caller alone shall hold the VTK objects
  }
  return true;
}

} // namespace pointhaptics
