#include "LocalSceneProvider.h"

#include "vtkPoints.h"

#include <utility>

namespace pointhaptics
{
namespace
{

/// @p scene where the model is at @p place; null where it cannot be moved there.
std::shared_ptr<const HapticScene> movedTo(
  const AffineTransform& place, const std::shared_ptr<const HapticScene>& scene)
{
  Status status = Status::Ok;
  return scene->modelToWorkspace() == place ? scene : scene->moved(place, status);
}

} // namespace

void LocalSceneProvider::setCloud(vtkSmartPointer<vtkPoints> points)
{
  *this = LocalSceneProvider();
  points_ = std::move(points);
}

std::shared_ptr<const HapticScene> LocalSceneProvider::refine(
  const Bounds& hand, const std::shared_ptr<const HapticScene>& global, const AffineTransform& place)
{
  const auto now = std::chrono::steady_clock::now();
  const std::chrono::duration<double> seconds = now - std::exchange(lastLook_, now);
  if (global_ != global || !moved_ || !(moved_->modelToWorkspace() == place))
  {
    global_ = global;
    moved_ = movedTo(place, global);
  }
  if (hand.empty() || !moved_ || !moved_->origin() || !(isIndexed() || isFinerNear(hand, *moved_)) ||
    !this->index())
  {
    return nullptr;
  }
  if (fine_.global() != moved_)
  {
    fine_ = LocalSceneFollower(moved_, index_);
  }
  return fine_.update(hand, seconds.count(), smp_) && fine_.scene() != moved_ ? fine_.scene() : nullptr;
}

std::shared_ptr<const HapticScene> LocalSceneProvider::make(
  const SceneOrigin& origin, const std::shared_ptr<const HapticScene>& global)
{
  const auto beside = movedTo(origin.modelToWorkspace, global);
  return beside && this->index() ? LocalSceneBuilder(index_).build(origin.hand, beside, smp_) : nullptr;
}

bool LocalSceneProvider::index()
{
  index_ = index_ ? index_ : indexOf(points_);
  return index_ != nullptr;
}

} // namespace pointhaptics
