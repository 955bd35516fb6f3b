/// @file
/// The immutable snapshot of a cloud that the servo thread feels.
#pragma once

#include "Core/AffineTransform.h"
#include "Core/CellPyramid.h"
#include "Core/Executor.h"
#include "Core/FitCells.h"
#include "Core/LocalBandwidth.h"
#include "Core/RadiusField.h"
#include "Core/Status.h"

#include <memory>
#include <optional>
#include <vector>

namespace pointhaptics
{

/// What a snapshot is built from; all vectors have one entry per point, or are empty where that is said.
/// Frame: the workspace (the transformed cloud); units: metres.
struct HapticSceneInput
{
  std::vector<Vec3> points;         ///< Voxel means, or raw points.
  std::vector<double> counts;       ///< Points each one stands for; empty: 1 each.
  std::vector<SymMat3> covariances; ///< Central second moments of each voxel; empty: zero.
  std::vector<double> proxyRadii;   ///< From the bandwidth; empty: found as the next line says.
  /// The rule for the radii, of which only those that the scene needs are computed, a few in a hundred: the
  /// scene is the same, bit for bit, as with the proxyRadii of localBandwidths. Neither: 2.8 local spacings
  /// everywhere.
  std::optional<LocalBandwidthSettings> bandwidth;
  /// Edge of the finest index cell: the voxel size; 0: from the points' spacing. Raised to 0.8 typical
  /// spacings where the points are sparser: finer cells would be empty.
  double cellSize = 0.0;
  AffineTransform
    modelToWorkspace; ///< The transform the points went through; carries the proxy into a new snapshot.
};

/// Built once by create(), read by any number of threads, never edited: a transform makes a new one.
class HapticScene
{
public:
  /// Copies nothing it can move. Points that are not finite are left out. Cost O(n log n), about 150 bytes a
  /// point. Errors: Empty (no finite point), LatticeNotAddressable (the points' spacing is below
  /// 2^-21 of the extent), InvalidParameter (vectors of different lengths), those of the bandwidth's
  /// settings, the transform's own; @p status says which, the result is null.
  /// @p executor may spread the work over threads; the result is the same.
  static std::shared_ptr<const HapticScene> create(
    HapticSceneInput input, Status& status, const Executor& executor = {});

  std::size_t numberOfPoints() const { return pyramid_.level(0).cells.size(); }
  const CellPyramid& pyramid() const { return pyramid_; }
  const AffineTransform& modelToWorkspace() const { return modelToWorkspace_; }
  const Bounds& bounds() const { return bounds_; }
  /// Edge of the finest index cell, metres.
  double cellSize() const { return pyramid_.level(0).voxelSize; }
  /// Radius of the proxy sphere at @p position: smooth, from the radii of the points near it, and the cloud's
  /// typical one far from all of them; metres, above 0.
  double proxyRadius(const Vec3& position) const noexcept;
  /// Radius and gate of the local surface fit at @p position: large enough for 30 points and 14 cells, more
  /// where the cloud is noisy. Functions of position only, so that the force does not depend on how the hand
  /// came there.
  LocalScale fitScale(const Vec3& position) const noexcept;
  /// The same up to rounding, faster while the positions stay near each other; and the gradient of the
  /// radius.
  LocalScale fitScale(const Vec3& position, FitCells& memory, Vec3& radiusGradient) const noexcept
  {
    return memory.scaleAt(pyramid_, scale_, position, radiusGradient);
  }
  double fitRadius(const Vec3& position) const noexcept { return fitScale(position).radius; }
  /// False where no cell of the cloud can be within clearance() of @p position: free space to stride through.
  bool isNear(const Vec3& position) const noexcept;
  double clearance() const { return clearance_; }
  /// True where the covariances of the voxels are known, or each cell is a single point; false for plain
  /// means, whose fits ripple with the voxels.
  bool hasExactMoments() const { return exactMoments_; }

private:
  HapticScene() = default;

  CellPyramid pyramid_;
  RadiusField scale_;
  AffineTransform modelToWorkspace_;
  Bounds bounds_;
  double clearance_ = 0.0;
  bool exactMoments_ = true;
};

} // namespace pointhaptics
