/// @file
/// Scenes near the hand, as fine as the points are.
#pragma once

#include "Core/Neighbors/PointIndex.h"
#include "Core/Resample/VoxelResampler.h"
#include "Haptics/HapticScene.h"

#include <memory>
#include <utility>

namespace pointhaptics
{

/// Gives @p input what @p voxels, resampled by @p request, are, where they lie, and in which frame.
void takeVoxels(const VoxelResampler& voxels, const VoxelRequest& request, HapticSceneInput& input);

/// True if a hand would feel the cloud of @p global, the scene of the whole cloud, finer in a scene near it.
/// False far from all points; where points are as sparse as the global cells; where the surface is so smooth
/// that these resolve it; and where it is so noisy that finer cells resolve no more. @param hand the HIP and
/// the contact point, workspace frame.
bool isFinerNear(const Bounds& hand, const HapticScene& global) noexcept;

/// Resamples the points of a cloud about a hand into cells about as fine as their spacing, and makes a scene
/// of them. Its fallback for a hand that leaves is the global scene (HapticScene::fallback()). The cells are
/// those of one lattice over the whole cloud: overlapping scenes of one cell size have equal cells, bit for
/// bit. A scene costs some milliseconds. One thread at a time.
class LocalSceneBuilder
{
public:
  /// Half-width of the covered box about the hand, metres of the workspace.
  static constexpr double kReach = 3.0e-3;
  /// The next scene is due when the hand is nearer than this to the end of the covered box, metres.
  static constexpr double kNearEnd = 1.2e-3;
  /// Edge of the finest cell, over the global scene's.
  static constexpr double kFinest = 1.0 / 4.0;

  /// @param cloud the points in the model's frame; null: there are none, and no scene is made.
  explicit LocalSceneBuilder(std::shared_ptr<const PointIndex> cloud = nullptr)
    : index_(std::move(cloud))
  {
  }
  /// The points; null: there are none.
  const std::shared_ptr<const PointIndex>& index() const { return index_; }

  /// Builds the scene about @p hand beside @p global, whose origin says the workspace and the rule for proxy
  /// radii; null where it is of no use, cannot be made, or that origin is not known.
  std::shared_ptr<const HapticScene> build(
    const Bounds& hand, const std::shared_ptr<const HapticScene>& global, const Executor& executor = {});

private:
  std::shared_ptr<const PointIndex> index_;
  VoxelResampler resampler_;
};

/// The scene that a hand feels on its way: a local one where that is finer, made when the hand comes there.
/// Equal paths give equal scenes, whatever the executor's threads. One thread at a time.
class LocalSceneFollower
{
public:
  /// @param global the scene of the whole cloud; null: nothing is felt. @param cloud as LocalSceneBuilder has
  /// it.
  explicit LocalSceneFollower(
    std::shared_ptr<const HapticScene> global = nullptr, std::shared_ptr<const PointIndex> cloud = nullptr)
    : builder_(std::move(cloud))
    , global_(std::move(global))
  {
  }

  /// A scene is made kDueAhead seconds before the hand, as it moves now, would be near the end of the covered
  /// box: by then it must be there. It covers the place of the hand after kCoveredAhead seconds.
  static constexpr double kDueAhead = 0.02;
  static constexpr double kCoveredAhead = 0.04;
  /// Longest way ahead, metres.
  static constexpr double kMostAhead = 8.0e-3;

  /// Makes another scene if one is due. @param hand the HIP and the contact point, workspace frame. @param
  /// seconds since the last call, for a hand that moves on while a scene is made; 0: it waits. @return true:
  /// scene() is another one. Costs a comparison or two while the hand stays within the covered box.
  bool update(const Bounds& hand, double seconds = 0.0, const Executor& executor = {});
  /// The scene to feel now: a local one where there is one, else the global one.
  const std::shared_ptr<const HapticScene>& scene() const { return local_ ? local_ : global_; }
  const std::shared_ptr<const HapticScene>& global() const { return global_; }
  const std::shared_ptr<const PointIndex>& cloud() const { return builder_.index(); }

  /// Returns the scene for the next step in virtual time. @param touched contact point of the last step: the
  /// HIP itself out of contact. Valid until the next but one call.
  const HapticScene* at(const Vec3& hip, const Vec3& touched, const Executor& executor = {});

  /// Local scenes made so far.
  std::int64_t numberOfScenes() const { return numberOfScenes_; }
  /// Edge of the finest cells felt so far, metres of the workspace.
  double finestCell() const { return finestCell_; }

private:
  LocalSceneBuilder builder_;
  std::shared_ptr<const HapticScene> global_;
  std::shared_ptr<const HapticScene> local_;
  std::shared_ptr<const HapticScene> last_; ///< The last scene, in which the proxy may still be.
  Bounds failed_;                           ///< Box in which no local scene could be made.
  Bounds lastHand_;
  std::int64_t numberOfScenes_ = 0;
  double finestCell_ = global_ ? global_->latticeScale() * global_->cellSize() : 0.0;
};

} // namespace pointhaptics
