/// @file
/// Scenes of what is near the hand, as fine as the points are.
#pragma once

#include "Core/PointIndex.h"
#include "Core/VoxelResampler.h"
#include "Haptics/HapticScene.h"

#include <memory>
#include <optional>

namespace pointhaptics
{

/// Resamples the points of a cloud about a hand into cells about as fine as their spacing there, and makes a
/// scene of that, with the scene of the whole cloud beside it (HapticScene::beyond()) for the hand that
/// leaves. The cells are those of a lattice fixed to the global one: overlapping scenes of one cell size have
/// the same cells, bit for bit. A scene costs some milliseconds. One thread at a time.
class LocalSceneBuilder
{
public:
  /// Half-width about the hand of what a scene covers, metres of the workspace.
  static constexpr double kReach = 3.5e-3;
  /// A new one is due when the hand is nearer than this to the end of what is covered, metres.
  static constexpr double kNearEnd = 1.5e-3;
  /// Finest cell over the global scene's.
  static constexpr double kFinest = 1.0 / 4.0;

  /// @param points of the cloud, in the model's frame; copied. Errors: those of PointIndex::build().
  Status setCloud(const PointView& points, const Executor& executor = {});
  /// The rule for proxy radii, as in HapticSceneInput; without one 2.8 local spacings.
  void setBandwidth(const std::optional<LocalBandwidthSettings>& bandwidth) { bandwidth_ = bandwidth; }
  /// Points outside are not felt; workspace frame. Empty: all are.
  void setWorkspace(const Bounds& workspace) { workspace_ = workspace; }

  /// Whether the hand feels the cloud finer than in the scene of the whole: false where a scene would be of
  /// no use, as far from all points, or where points are as sparse as the global cells, or noisy.
  /// @param hand the HIP and what it touches, workspace frame. @param global the scene of the whole cloud.
  bool isUseful(const Bounds& hand, const HapticScene& global) const noexcept;

  /// The scene about @p hand; null where it is of no use, or cannot be made.
  std::shared_ptr<const HapticScene> build(
    const Bounds& hand, const std::shared_ptr<const HapticScene>& global, const Executor& executor = {});

private:
  double cellSize(const Vec3& place, const HapticScene& global) const noexcept;

  PointIndex index_;
  bool isIndexed_ = false;
  std::optional<LocalBandwidthSettings> bandwidth_;
  Bounds workspace_;
  VoxelResampler resampler_;
};

/// The scene that a hand in virtual time feels: local where that is finer, made when the hand comes there.
/// The same for the same path, whatever the executor's threads.
class LocalSceneFollower
{
public:
  /// @param builder with the cloud of @p global; both outlive this.
  LocalSceneFollower(LocalSceneBuilder& builder, std::shared_ptr<const HapticScene> global)
    : builder_(builder)
    , global_(std::move(global))
  {
  }

  /// The scene for the next step. @param hip workspace frame. @param touched what the hand touched in the
  /// last step: the HIP itself out of contact. Valid until the next but one call.
  const HapticScene* at(const Vec3& hip, const Vec3& touched, const Executor& executor = {});

private:
  LocalSceneBuilder& builder_;
  std::shared_ptr<const HapticScene> global_;
  std::shared_ptr<const HapticScene> local_;
  std::shared_ptr<const HapticScene> last_; ///< The proxy may still be in it.
  Bounds failed_;                           ///< There was no local scene here.
};

} // namespace pointhaptics
