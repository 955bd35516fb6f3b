/// @file
/// The immutable snapshot of a cloud that the servo thread feels.
#pragma once

#include "Core/Bandwidth/LocalBandwidth.h"
#include "Core/Base/AffineTransform.h"
#include "Core/Base/Executor.h"
#include "Core/Base/Status.h"
#include "Core/Surface/CellPyramid.h"
#include "Core/Surface/FitCells.h"
#include "Core/Surface/RadiusField.h"
#include "Haptics/ContactField.h"
#include "Haptics/SceneOrigin.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace pointhaptics
{

class HapticScene;

/// Input of HapticScene::create(). Vectors have one entry per point; those that may be empty say so. Frame:
/// the workspace (the transformed cloud); units: metres.
struct HapticSceneInput
{
  std::vector<Vec3> points;         ///< Voxel means, or raw points.
  std::vector<double> counts;       ///< Points each one stands for; empty: 1 each.
  std::vector<SymMat3> covariances; ///< Central second moments of each voxel; empty: zero.
  std::vector<double> proxyRadii;   ///< From the bandwidth; empty: found as the next line says.
  /// Rule for the radii. Only the radii that the scene needs are computed, a few in a hundred; the scene is
  /// the same, bit for bit, as with the proxyRadii of localBandwidths. Counts give the density of the points
  /// unless usePointCounts is off. Without rule and radii: 2.8 local spacings everywhere.
  std::optional<LocalBandwidthSettings> bandwidth;
  /// Edge of the finest index cell: the voxel size; 0: from the points' spacing. It is raised to 0.8 typical
  /// spacings where the points are sparser, as finer cells would be empty; not in a local scene.
  double cellSize = 0.0;
  /// Origin from which index cells are counted, such as the lattice's corner, in place of the points' own
  /// corner. Without effect if a point is below it on an axis.
  std::optional<Vec3> corner;
  /// A scene of a box alone, with finer cells than a scene of the whole cloud.
  struct Local
  {
    Bounds covered; ///< Box in which it is felt; the points go on for some fit radii beyond.
    std::shared_ptr<const HapticScene> global; ///< The scene that is felt elsewhere; not null.
  };
  std::optional<Local> local;
  /// Instructions to build it with, as far as this machine has them; the scene is the same, bit for bit.
  InstructionSet instructions = InstructionSet::Automatic;
  std::shared_ptr<const SceneOrigin> origin; ///< Origin of the points; null: not known.
  AffineTransform
    modelToWorkspace; ///< The transform the points went through; carries the proxy into a new snapshot.
};

/// Built once by create(), read by any number of threads, never edited: a transform makes a new one. That is
/// either a cloud resampled anew, by create(), or the same cloud put elsewhere, by moved().
///
/// Frames: all places and lengths that a scene has of its cloud are in the frame the cloud was
/// resampled in, which stays with it when it is moved: the lattice frame. toLattice() and toWorkspace() go
/// between that and the workspace; unless the scene was moved they are the same frame. Metres in both.
class HapticScene
{
public:
  /// Copies nothing it can move. Points that are not finite are left out. Cost O(n log n), about 150 bytes a
  /// point, of sparse clouds 600 and 7 us. Errors: Empty (no finite point), LatticeNotAddressable (the
  /// points' spacing is below 2^-21 of the extent), PointsTooFar (one lies beyond 1e9 m), InvalidParameter
  /// (vectors of different lengths), those of the bandwidth's settings, the transform's own; @p status says
  /// which, the result is null.
  /// @p executor may spread the work over threads; the result is the same.
  static std::shared_ptr<const HapticScene> create(
    HapticSceneInput input, Status& status, const Executor& executor = {});

  /// This cloud where @p modelToWorkspace puts the model: turned, shifted, mirrored or uniformly scaled
  /// against how it was resampled. The HIP is taken into the lattice frame and the answer back, so this costs
  /// nothing per point (below a microsecond) and shares all memory; the force is that of a cloud resampled
  /// under @p modelToWorkspace up to the accuracy of either. What create() clipped stays away, and the voxels
  /// keep their place in the model: a finer or wider cut is a matter of a new create(), whose scene takes
  /// over any time. Errors, the result null: the transform's own, and InvalidParameter where it is no
  /// similarity against the one of create() (shear, or a scale that differs by axis): resample. Any thread.
  std::shared_ptr<const HapticScene> moved(const AffineTransform& modelToWorkspace, Status& status) const;

  /// The global scene, moved to the same place: it is felt where this local scene does not cover(). Null:
  /// this one is global.
  const HapticScene* fallback() const { return fallback_.get(); }
  bool isLocal() const { return !cloud_->covered.empty(); }
  /// True if a hand at @p p (lattice frame) feels the same in a global scene.
  bool covers(const Vec3& p) const noexcept;
  /// Box in which a local scene is felt; lattice frame.
  const Bounds& covered() const { return cloud_->covered; }
  /// Box in which this scene has the same cells and fields as @p other, of the same lattice frame: cells
  /// gathered there serve both. Empty: none. Local scenes overlap.
  Bounds sharedWith(const HapticScene& other) const noexcept;
  /// Prepares @p memory, which served a scene that equals this one in @p shared.
  void carryOver(FitCells& memory, const Bounds& shared) const noexcept
  {
    memory.carryOver(pyramid(), cloud_->scale, shared);
  }

  std::size_t numberOfPoints() const { return pyramid().level(0).cells.size(); }
  const CellPyramid& pyramid() const { return cloud_->pyramid; }
  const AffineTransform& modelToWorkspace() const { return modelToWorkspace_; }
  /// The transform the points went through.
  const AffineTransform& modelToLattice() const { return cloud_->modelToLattice; }
  bool isMoved() const { return isMoved_; }
  /// Number of this object, above 0: differs for each scene, also for those that moved() makes.
  std::uint64_t number() const { return number_; }
  /// Origin of the cloud; null: not known. Equal for scenes that share their cloud.
  const std::shared_ptr<const SceneOrigin>& origin() const { return cloud_->origin; }
  /// Equal for scenes that share their cloud, and for no others of this run.
  std::uint64_t cloudNumber() const { return cloud_->number; }
  /// Number of the global scene's cloud: equal for a global scene and the local ones beside it.
  std::uint64_t globalCloudNumber() const { return fallback_ ? fallback_->cloudNumber() : cloudNumber(); }
  Vec3 toLattice(const Vec3& p) const noexcept { return isMoved_ ? workspaceToLattice_.apply(p) : p; }
  Vec3 toWorkspace(const Vec3& p) const noexcept { return isMoved_ ? latticeToWorkspace_.apply(p) : p; }
  /// Turns a unit vector of the lattice frame into the workspace.
  Vec3 directionToWorkspace(const Vec3& v) const noexcept
  {
    return isMoved_ ? latticeToWorkspace_.applyToVector(v) / scale_ : v;
  }
  /// Length in the workspace of one metre of the lattice frame.
  double latticeScale() const { return scale_; }
  const Bounds& bounds() const { return cloud_->bounds; }
  /// Edge of the finest index cell, metres.
  double cellSize() const { return pyramid().level(0).voxelSize; }
  /// Radius of the proxy sphere at @p position: smooth, from the radii of the points near it, and the cloud's
  /// typical one far from all of them; metres, above 0.
  double proxyRadius(const Vec3& position) const noexcept { return fitScale(position).proxyRadius; }
  /// Radius of a sphere that stands on the cells themselves. Where cells are means of several points,
  /// proxyRadius() may be smaller than the gaps between them, and such a sphere would fall through. This is
  /// then at least 2.8 cells, the default rule for points a cell apart. On raw points it equals
  /// proxyRadius().
  double coveringRadius(const Vec3& position) const noexcept
  {
    return std::max(proxyRadius(position), cloud_->leastCovering);
  }
  /// Radius and gate of the local surface fit at @p position: large enough for 30 points and 14 cells, more
  /// where the cloud is noisy. Functions of position only, so that the force does not depend on how the hand
  /// came there.
  LocalScale fitScale(const Vec3& position) const noexcept { return cloud_->scale.at(pyramid(), position); }
  /// As fitScale(position) up to rounding, faster while the positions stay near each other; adds the gradient
  /// of the radius.
  LocalScale fitScale(const Vec3& position, FitCells& memory, Vec3& radiusGradient) const noexcept
  {
    return memory.scaleAt(pyramid(), cloud_->scale, position, radiusGradient);
  }
  double fitRadius(const Vec3& position) const noexcept { return fitScale(position).radius; }
  /// False where no cell of the cloud can be within clearance() of @p position: free space to stride through.
  bool isNear(const Vec3& position) const noexcept;
  /// True if a point that decides about contact is within @p distance (metres, lattice frame) of @p position.
  bool hasPointsWithin(const Vec3& position, double distance) const noexcept
  {
    return contactPyramid().anyWithin(0, position, distance, [](const Cell&) { return true; });
  }
  double clearance() const { return cloud_->clearance; }
  /// The points that decide about contact: the cells. Where the cells of a global scene are sparser than the
  /// requested voxels, points half way between them are added (SurfaceMidpoints.h), or a ball small enough
  /// for the shape would fall between them. The midpoints are no data: no fit takes them.
  const CellPyramid& contactPyramid() const { return cloud_->contact ? *cloud_->contact : cloud_->pyramid; }
  /// The points of contactPyramid() with the radii by which they keep the ball away.
  const ContactField& contactField() const { return cloud_->field; }
  /// Edge of their finest index cell, metres.
  double contactCell() const { return contactPyramid().level(0).voxelSize; }
  /// Standard deviation of the points about the surface near @p position, metres; 0 where no cell is near.
  double noise(const Vec3& position) const noexcept { return cloud_->scale.noiseAt(pyramid(), position); }
  /// True where the covariances of the voxels are known, or each cell is a single point; false for plain
  /// means, whose fits ripple with the voxels.
  bool hasExactMoments() const { return cloud_->exactMoments; }

private:
  HapticScene();

  /// The part that does not change when the model moves.
  struct Cloud
  {
    CellPyramid pyramid;
    std::unique_ptr<CellPyramid> contact; ///< Null: the same points.
    ContactField field;
    RadiusField scale;
    AffineTransform modelToLattice;
    Bounds bounds;
    Bounds covered; ///< Box in which a local scene is felt.
    double clearance = 0.0;
    double leastCovering = 0.0; ///< coveringRadius() is not below this.
    bool exactMoments = true;
    std::uint64_t number = 0;
    std::shared_ptr<const SceneOrigin> origin;

    /// Sorts the cells into the pyramid. @pre at least one cell, and a valid modelToWorkspace.
    Status index(const HapticSceneInput& input, std::vector<Cell> cells);
    /// True if the voxels of @p asked hold hardly more than a point each. @pre index() gave Ok.
    bool isSparse(double asked) const;
    /// Adds midpoints where the cells are sparser than that.
    void refineContact(double asked, const Executor& executor);
    /// Finds the radii of the ball.
    void buildField(const HapticSceneInput& input, const Executor& executor);
    /// Fills the fields of radii and fits over the pyramid. @pre index() gave Ok.
    Status measure(HapticSceneInput input, const Executor& executor);
  };

  std::shared_ptr<const Cloud> cloud_;
  std::shared_ptr<const HapticScene> fallback_;
  AffineTransform modelToWorkspace_;
  AffineTransform latticeToWorkspace_;
  AffineTransform workspaceToLattice_;
  double scale_ = 1.0;
  bool isMoved_ = false;
  std::uint64_t number_ = 0;
};

} // namespace pointhaptics
