/// @file
/// Shapes with exact answers: point samples to feel, and the true closest point to judge the feeling by.
#pragma once

#include "Core/Base/Status.h"
#include "Core/Base/Vector3.h"

#include <cstdint>
#include <string>
#include <vector>

namespace pointhaptics
{

/// Metres, centred at the origin, inside the 10 cm workspace. z is up; the idol looks along -y.
enum class Shape
{
  Plane,       ///< z = 0, a square of 0.08.
  Sphere,      ///< Radius 0.025.
  Torus,       ///< About the z axis: 0.025 to the middle of the tube, tube radius 0.010.
  Ellipsoid,   ///< Semi-axes 0.040, 0.025, 0.018.
  Saddle,      ///< z = (x^2 - y^2) / 0.1 over a square of 0.06.
  Box,         ///< The surface of a cube of 0.05.
  Edge,        ///< A ridge along y: z = 0 for x <= 0 and x = 0 for z <= 0, 0.04 wide each, 0.08 long.
  Sheet,       ///< Two squares of 0.06 at z = +-0.0004: a slab without side walls.
  Hole,        ///< The plane with a round hole of radius 0.010 about the origin.
  DensityStep, ///< The plane, with 16 times as many points per area where x > 0.
  Idol, ///< A closed, smooth statue, 0.09 tall; 16 times as many points per area at the face as behind the
        ///< foot.
};
constexpr int kNumberOfShapes = 11;

/// The name on the command line: "plane", "density-step", ... Static storage.
const char* shapeName(Shape shape) noexcept;
/// False, and @p shape unchanged, for a name that is none of them.
bool shapeFromName(const std::string& name, Shape& shape) noexcept;

/// The point of a shape nearest to some position.
struct SurfacePoint
{
  Vec3 point;
  Vec3 normal{ 0.0, 0.0,
    1.0 };               ///< Outward, unit length. Of plane, saddle, hole and density-step: the upper side's.
  double distance = 0.0; ///< Metres, negative inside; on open shapes below.
};

/// Draws @p count points, and their outward normals where @p normals is given. Uniform over the area, except
/// for DensityStep and Idol. The same bit for bit on every machine for the same shape, seed and noise.
/// @param noise standard deviation in metres of Gaussian noise along the normal, at least 0.
/// Errors: InvalidParameter (count negative, noise negative or not finite); the vectors are then empty.
/// Throws std::bad_alloc. Cost: 20 to 50 ns a point, the idol about 2 us. Thread safe.
Status generateShape(Shape shape, std::int64_t count, std::uint64_t seed, double noise,
  std::vector<Vec3>& points, std::vector<Vec3>* normals = nullptr);

/// The nearest point of @p shape, the rims of open ones among them. Closed forms, or Newton to the last
/// digits: error of point and distance below 1e-14 m within the workspace; the idol 1e-14 m for positions
/// within 5 mm of its surface (further away another part of the surface may be nearer by a little). Where
/// several points are nearest, one of them. Test: ShapesTest.cxx. @p position must be finite. Thread safe.
SurfacePoint closestPoint(Shape shape, const Vec3& position);

} // namespace pointhaptics
