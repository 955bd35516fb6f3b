/// @file
/// What `feel` feels: the whole cloud, and finer scenes where the hand is.
#pragma once

#include "Feel/FeelOptions.h"

#include "Haptics/LocalScene.h"
#include "SmpExecutor.h"

#include <memory>
#include <optional>
#include <string>

class vtkPolyData;

namespace pointhaptics
{
namespace app
{

/// The scene of the whole cloud; where nobody chose a lattice (FeelOptions::refinesNearHand()) beside it
/// local ones, which are made as the hand comes along. One thread at a time.
class FeelScenes
{
public:
  /// False: @p message says why there is nothing to feel. Keeps no reference to @p cloud.
  bool make(const FeelOptions& options, vtkPolyData* cloud, std::string& message);

  const std::shared_ptr<const HapticScene>& whole() const { return whole_; }
  /// Null: the scene of the whole cloud is felt everywhere.
  LocalSceneFollower* follower() { return follower_ ? &*follower_ : nullptr; }
  /// In virtual time: the scene for the next step (see LocalSceneFollower::at()).
  const HapticScene* at(const Vec3& hip, const Vec3& touched)
  {
    return follower_ ? follower_->at(hip, touched, SmpExecutor()) : whole_.get();
  }

  std::int64_t numberOfLocalScenes() const { return follower_ ? follower_->numberOfScenes() : 0; }
  /// Edge of the finest cells felt, metres.
  double finestCell() const { return follower_ ? follower_->finestCell() : whole_->cellSize(); }

private:
  std::shared_ptr<const HapticScene> whole_;
  LocalSceneBuilder builder_;
  std::optional<LocalSceneFollower> follower_;
};

} // namespace app
} // namespace pointhaptics
