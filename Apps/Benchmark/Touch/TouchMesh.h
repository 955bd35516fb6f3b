/// @file
/// Triangle meshes to touch: scans with their own mesh, and generated ones with edges and thin parts.
#pragma once

#include "Core/Base/Vector3.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace pointhaptics::bench::touch
{

/// Twice the area, m^2, below which a triangle has no usable normal.
constexpr double kLeastArea = 1e-16;

/// Metres, workspace frame. Counter-clockwise from outside.
struct TouchMesh
{
  std::string name;
  std::vector<Vec3> points;
  std::vector<std::uint32_t> triangles; ///< Three indices of points each.
  bool isScan = false;                  ///< Its bare vertices are a cloud of their own.
};

/// Winds the triangles of each connected part alike, outward by the sign of its volume. Drops triangles
/// without area. An open part is treated as if it were closed from its middle.
void orientOutward(TouchMesh& mesh);

/// The boundary of the filled cells of a rectangular grid: closed, conforming, outward. @p x, @p y, @p z:
/// ascending coordinates of the grid's planes; @p filled is asked with the indices of a cell.
TouchMesh blockMesh(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& z,
  const std::function<bool(int, int, int)>& filled);
/// A prism of height @p height about z = 0 over a polygon that is star-shaped about the origin,
/// counter-clockwise.
TouchMesh prismMesh(const std::vector<Vec3>& polygon, double height);

/// A sphere of @p radius with @p rings circles of latitude, and a round cylinder along z; for tests.
TouchMesh sphereMesh(double radius, int rings);
TouchMesh cylinderMesh(double radius, double height, int sides);

/// Turned about the origin, so that no face of a box is parallel to the lattice.
Vec3 turnedAway(const Vec3& p);

/// The generated meshes of the benchmark, about 60 mm, turned away from the axes: parts with edges, and the
/// smooth ones, whose facets are smaller than fits reach.
std::vector<std::string> generatedMeshNames();
std::vector<std::string> smoothMeshNames();
/// One of either names; empty for another name.
TouchMesh generatedMesh(const std::string& name);

/// @p count points uniform over the area; the same for the same seed. With @p noise, Gaussian along the
/// normal, metres.
std::vector<Vec3> samplesOf(
  const TouchMesh& mesh, std::int64_t count, std::uint64_t seed, double noise = 0.0);

} // namespace pointhaptics::bench::touch
