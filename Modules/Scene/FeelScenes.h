/// @file
/// Scenes that a hand on a path feels: the whole cloud, and finer scenes where the hand is.
#pragma once

#include "Haptics/LocalScene.h"
#include "SmpExecutor.h"

#include "PointHapticsSceneModule.h" // For export macro

#include <memory>
#include <optional>
#include <string>

class vtkPoints;
class vtkPointSet;
class vtkPolyData;
class vtkVoxelMeanResampler;

namespace pointhaptics
{

/// Settings of the scenes of a cloud.
struct FeelSceneSettings
{
  LocalBandwidthSettings bandwidth; ///< Rule for proxy radii.
  Bounds workspace;                 ///< Points outside are not felt; empty: all are.
  bool useCovariance = true;        ///< Feel the second moments of the voxels, too.
  bool refineNearHand = true;       ///< Scenes near the hand are as fine as the points there.
};

/// The scene of the whole cloud, and local ones with FeelSceneSettings::refineNearHand, which are made as the
/// hand comes along. One thread at a time.
class POINTHAPTICSSCENE_EXPORT FeelScenes
{
public:
  FeelScenes() = default;
  /// Copies for another hand, whose path begins: shares the immutable scenes, and may be used in another
  /// thread. The other object does not change.
  explicit FeelScenes(const FeelScenes& shared);
  FeelScenes& operator=(const FeelScenes&) = delete;

  /// Makes the scenes. @param felt the points that are felt, in the workspace frame: the output of
  /// vtkVoxelMeanResampler, or raw points. @param cloud the points of the cloud in
  /// its own frame, for the scenes near the hand; no reference is kept. Errors: those of
  /// HapticScene::create().
  Status make(vtkPolyData* felt, vtkPoints* cloud, const FeelSceneSettings& settings);
  /// As make(), with a scene of the whole cloud that is there already.
  void adopt(std::shared_ptr<const HapticScene> whole, vtkPoints* cloud, const FeelSceneSettings& settings);
  /// Resamples @p cloud and makes its scenes. @param resampler has lattice and transform, and is used up; its
  /// observers may abort the work. @p settings' workspace is that of the resampler. Errors: Aborted, Empty
  /// (no finite point in the workspace), InvalidParameter (the resampler's settings), those of
  /// HapticScene::create(); @p message says which, with the cure.
  Status resample(
    vtkPointSet* cloud, vtkVoxelMeanResampler* resampler, FeelSceneSettings settings, std::string& message);
  /// Note on the points that resample() left out, as they are far from all others; empty: there are none.
  const std::string& note() const { return note_; }
  /// Forgets the hand: the next path is felt as the first one.
  void restart();

  const std::shared_ptr<const HapticScene>& whole() const { return whole_; }
  /// Follower of the hand; null: the global scene is felt everywhere.
  LocalSceneFollower* follower() { return follower_ ? &*follower_ : nullptr; }
  /// Scene for the next step in virtual time (see LocalSceneFollower::at()).
  const HapticScene* at(const Vec3& hip, const Vec3& touched)
  {
    return follower_ ? follower_->at(hip, touched, SmpExecutor()) : whole_.get();
  }

  std::int64_t numberOfLocalScenes() const { return follower_ ? follower_->numberOfScenes() : 0; }
  /// Edge of the finest cells felt, metres.
  double finestCell() const { return follower_ ? follower_->finestCell() : whole_->cellSize(); }

private:
  void follow();

  FeelSceneSettings settings_;
  std::string note_;
  std::shared_ptr<const HapticScene> whole_;
  LocalSceneBuilder builder_;
  std::optional<LocalSceneFollower> follower_;
};

} // namespace pointhaptics
