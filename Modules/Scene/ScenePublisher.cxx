#include "ScenePublisher.h"

#include <utility>

namespace pointhaptics
{

void ScenePublisher::setSink(Sink sink)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  sink_ = std::move(sink);
}

void ScenePublisher::move(const AffineTransform& modelToWorkspace)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  const bool isThere = place_ == modelToWorkspace;
  place_ = modelToWorkspace;
  if (isThere || !newest_ || !sink_)
  {
    return;
  }
  Status status = Status::Ok;
  if (std::shared_ptr<const HapticScene> moved = newest_->moved(modelToWorkspace, status))
  {
    sink_(std::move(moved));
  }
}

void ScenePublisher::publish(
  std::shared_ptr<const HapticScene> scene, std::uint64_t cloud, std::uint64_t number)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (cloud != cloud_ || number < number_)
  {
    return;
  }
  number_ = number;
  newest_ = scene;
  if (scene && place_ && !(scene->modelToWorkspace() == *place_))
  {
    Status status = Status::Ok;
    if (std::shared_ptr<const HapticScene> moved = scene->moved(*place_, status))
    {
      scene = std::move(moved);
    }
  }
  if (sink_)
  {
    sink_(std::move(scene));
  }
}

void ScenePublisher::startCloud()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  newest_.reset();
  number_ = 0;
  ++cloud_;
}

std::uint64_t ScenePublisher::cloud() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return cloud_;
}

} // namespace pointhaptics
