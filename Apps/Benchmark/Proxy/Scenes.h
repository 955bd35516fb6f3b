/// @file
/// Scenes as the program makes them: a cloud resampled into the lattice, with or without second moments.
#pragma once

#include "Haptics/HapticScene.h"
#include "Shapes/Shapes.h"

#include <memory>
#include <string>
#include <vector>

namespace pointhaptics::bench::proxy
{

using Scene = std::shared_ptr<const HapticScene>;

struct SceneSettings
{
  double voxelSize = 1e-3 / 3.0; ///< Metres.
  bool covariances = true;
  bool raw = false; ///< The points themselves, no voxels.
  AffineTransform transform;
};

/// Null where the cloud has no finite point or the lattice cannot be had.
Scene sceneOf(const std::vector<Vec3>& points, const SceneSettings& settings = {});

/// @p count points of @p shape with Gaussian noise of @p noise metres, always the same ones.
std::vector<Vec3> pointsOf(Shape shape, std::int64_t count, double noise);

/// Moved and scaled so that the longest side is 95 mm and the middle at the origin, as the viewer does.
std::vector<Vec3> fitted(std::vector<Vec3> points);

/// "20 um", or "clean".
std::string noiseName(double noise);

} // namespace pointhaptics::bench::proxy
