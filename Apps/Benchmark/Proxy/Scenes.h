/// @file
/// Scenes as the program makes them: a cloud resampled into the lattice, with or without second moments.
#pragma once

#include "Haptics/HapticScene.h"
#include "Shapes/Shapes.h"

#include <memory>
#include <vector>

namespace pointhaptics
{
namespace bench
{
namespace proxy
{

using Scene = std::shared_ptr<const HapticScene>;

struct SceneSettings
{
  double voxelSize = 1e-3 / 3.0; ///< Metres.
  bool covariances = true;
  bool raw = false;         ///< The points themselves, no voxels.
  double proxyRadius = 0.0; ///< r1 = r2, metres; 0: by the bandwidth.
  bool pointCounts = true;  ///< The bandwidth is that of the points in the voxels, not of the means.
  AffineTransform transform;
  InstructionSet instructions = InstructionSet::Automatic; ///< Of the scene itself.
};

/// Null where the cloud has no finite point or the lattice cannot be had.
Scene sceneOf(const std::vector<Vec3>& points, const SceneSettings& settings = {});

/// @p count points of @p shape with Gaussian noise of @p noise metres, always the same ones.
std::vector<Vec3> pointsOf(Shape shape, std::int64_t count, double noise);

/// Moved and scaled so that the longest side is 95 mm and the middle at the origin, as the viewer does.
std::vector<Vec3> fitted(std::vector<Vec3> points, double& scale, Vec3& middle);

/// "20 um", or "clean".
std::string noiseName(double noise);

} // namespace proxy
} // namespace bench
} // namespace pointhaptics
