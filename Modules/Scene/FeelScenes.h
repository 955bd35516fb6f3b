/// @file
/// Scenes that a hand feels: the whole cloud, and finer scenes where the hand is.
#pragma once

#include "Haptics/LocalScene.h"
#include "SmpExecutor.h"

#include "PointHapticsSceneModule.h" // For export macro

#include <functional>
#include <memory>
#include <string>

class vtkPoints;
class vtkPointSet;
class vtkVoxelMeanResampler;

namespace pointhaptics
{

class ServoLoop;
class StoppableThread;

/// Settings of the scenes of a cloud.
struct FeelSceneSettings
{
  LocalBandwidthSettings bandwidth; ///< Rule for proxy radii.
  bool useCovariance = true;        ///< Feel the second moments of the voxels, too.
  bool refineNearHand = true;       ///< Scenes near the hand are as fine as the points there.
  /// Called with the part that is done, 0 to 1; false aborts the work. May be missing.
  std::function<bool(double)> goesOn;
};

/// An index of @p points, which may be null; null: there are none, or it cannot be made.
std::shared_ptr<const PointIndex> indexOf(vtkPoints* points);

/// The scene of the whole cloud, and local ones, which are made as the hand comes along. One thread at a
/// time.
class POINTHAPTICSSCENE_EXPORT FeelScenes
{
public:
  FeelScenes() = default;
  /// Copies for another hand, whose path begins: shares the immutable scenes, and may be used in another
  /// thread. The other object does not change.
  explicit FeelScenes(const FeelScenes& shared)
    : follower_(shared.whole(), shared.follower_.cloud())
  {
  }
  FeelScenes& operator=(const FeelScenes&) = delete;

  /// Takes the scene of the whole cloud. @param cloud the points of the cloud in its own frame, for scenes
  /// near the hand, of which no reference is kept; null: there are no scenes near the hand. None are made
  /// either where the scene's origin is not known.
  void adopt(std::shared_ptr<const HapticScene> whole, vtkPoints* cloud);
  /// Resamples @p cloud and makes its scenes. @param resampler has lattice and transform, and is used up.
  /// Errors: Aborted, Empty (no finite point in the workspace), InvalidParameter (the resampler's settings),
  /// those of HapticScene::create(); @p message says which, with the cure.
  Status resample(vtkPointSet* cloud, vtkVoxelMeanResampler* resampler, const FeelSceneSettings& settings,
    std::string& message);
  /// Note on the points that resample() left out, as they are far from all others; empty: there are none.
  const std::string& note() const { return note_; }
  /// Forgets the hand: the next path is felt as the first one.
  void restart() { follower_ = LocalSceneFollower(whole(), follower_.cloud()); }

  const std::shared_ptr<const HapticScene>& whole() const { return follower_.global(); }
  /// Scene for the next step in virtual time (see LocalSceneFollower::at()).
  const HapticScene* at(const Vec3& hip, const Vec3& touched)
  {
    return follower_.at(hip, touched, SmpExecutor());
  }
  /// Publishes to @p loop the scenes of where its hand comes, in @p thread, until that is stopped. Both are
  /// outlived by this.
  void publishNearHand(ServoLoop& loop, StoppableThread& thread);

  std::int64_t numberOfLocalScenes() const { return follower_.numberOfScenes(); }
  /// Edge of the finest cells felt, metres.
  double finestCell() const { return follower_.finestCell(); }

private:
  std::string note_;
  LocalSceneFollower follower_;
};

} // namespace pointhaptics
