/// @file
/// Scenes near the hand, as fine as the points are.
#pragma once

#include "Core/Neighbors/PointIndex.h"
#include "Core/Resample/VoxelResampler.h"
#include "Haptics/HapticScene.h"

#include <memory>
#include <optional>

namespace pointhaptics
{

/// Gives @p input what @p voxels, resampled by @p request, are, where they lie, and in which frame.
void takeVoxels(const VoxelResampler& voxels, const VoxelRequest& request, HapticSceneInput& input);

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

  /// Sets the cloud. @param points in the model's frame; copied. Errors: those of PointIndex::build().
  Status setCloud(const PointView& points, const Executor& executor = {});
  /// As setCloud(points), for a cloud that is indexed already. Null removes the cloud.
  void setCloud(std::shared_ptr<const PointIndex> index) { index_ = std::move(index); }
  /// The index of the cloud's points, for other builders of the same cloud; null without a cloud.
  const std::shared_ptr<const PointIndex>& index() const { return index_; }
  /// The rule for proxy radii, as in HapticSceneInput; without one 2.8 local spacings.
  void setBandwidth(const std::optional<LocalBandwidthSettings>& bandwidth) { bandwidth_ = bandwidth; }
  /// Points outside are not felt; workspace frame. Empty: all are.
  void setWorkspace(const Bounds& workspace) { workspace_ = workspace; }

  /// True if the hand would feel the cloud finer than in the global scene. False far from all points; where
  /// points are as sparse as the global cells; where the surface is so smooth that these resolve it; and
  /// where it is so noisy that finer cells resolve no more. Needs no cloud. @param hand the HIP and the
  /// contact point, workspace frame. @param global the scene of the whole cloud.
  bool isUseful(const Bounds& hand, const HapticScene& global) const noexcept;

  /// Builds the scene about @p hand; null where it is of no use, or cannot be made.
  std::shared_ptr<const HapticScene> build(
    const Bounds& hand, const std::shared_ptr<const HapticScene>& global, const Executor& executor = {});

private:
  Lattice latticeOf(const HapticScene& global, double cell) const;
  double cellSize(const Bounds& hand, const HapticScene& global) const noexcept;
  std::shared_ptr<const SceneOrigin> originOf(const Bounds& hand, const HapticScene& global) const;

  std::shared_ptr<const PointIndex> index_;
  std::optional<LocalBandwidthSettings> bandwidth_;
  Bounds workspace_;
  VoxelResampler resampler_;
};

/// The scene that a hand feels on its way: a local one where that is finer, made when the hand comes there.
/// Equal paths give equal scenes, whatever the executor's threads. One thread at a time.
class LocalSceneFollower
{
public:
  /// @param builder with the cloud of @p global; outlives this.
  LocalSceneFollower(LocalSceneBuilder& builder, std::shared_ptr<const HapticScene> global)
    : builder_(builder)
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

  /// Returns the scene for the next step in virtual time. @param touched contact point of the last step: the
  /// HIP itself out of contact. Valid until the next but one call.
  const HapticScene* at(const Vec3& hip, const Vec3& touched, const Executor& executor = {});

  /// Local scenes made so far.
  std::int64_t numberOfScenes() const { return numberOfScenes_; }
  /// Edge of the finest cells felt so far, metres of the workspace.
  double finestCell() const { return finestCell_; }

private:
  LocalSceneBuilder& builder_;
  std::shared_ptr<const HapticScene> global_;
  std::shared_ptr<const HapticScene> local_;
  std::shared_ptr<const HapticScene> last_; ///< The last scene, in which the proxy may still be.
  Bounds failed_;                           ///< Box in which no local scene could be made.
  Bounds lastHand_;
  std::int64_t numberOfScenes_ = 0;
  double finestCell_ = global_ ? global_->latticeScale() * global_->cellSize() : 0.0;
};

} // namespace pointhaptics
