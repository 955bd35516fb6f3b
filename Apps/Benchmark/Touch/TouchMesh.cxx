#include "Benchmark/Touch/TouchMesh.h"

#include "Shapes/PortableRandom.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace pointhaptics::bench::touch
{
namespace
{

constexpr double kTwoPi = 6.28318530717958647692;
constexpr std::uint32_t kNone = ~0u;

Vec3 areaVector(const TouchMesh& mesh, std::size_t triangle)
{
  const Vec3& a = mesh.points[mesh.triangles[3 * triangle]];
  return cross(
    mesh.points[mesh.triangles[3 * triangle + 1]] - a, mesh.points[mesh.triangles[3 * triangle + 2]] - a);
}

void dropTrianglesWithoutArea(TouchMesh& mesh)
{
  std::vector<std::uint32_t> kept;
  for (std::size_t i = 0; i < mesh.triangles.size() / 3; ++i)
  {
    if (norm(areaVector(mesh, i)) > kLeastArea)
    {
      kept.insert(kept.end(), mesh.triangles.begin() + 3 * i, mesh.triangles.begin() + 3 * i + 3);
    }
  }
  mesh.triangles = std::move(kept);
}

/// Up to two triangles on each edge, and whether the edge runs from the lower index to the higher one.
struct EdgeSides
{
  std::uint32_t triangle[2] = { kNone, kNone };
  bool ascending[2] = { false, false };
};

using EdgeMap = std::unordered_map<std::uint64_t, EdgeSides>;

std::uint64_t edgeKey(std::uint32_t a, std::uint32_t b)
{
  return (std::uint64_t(std::min(a, b)) << 32) | std::max(a, b);
}

EdgeMap edgesOf(const TouchMesh& mesh)
{
  EdgeMap edges;
  edges.reserve(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
  {
    const std::uint32_t a = mesh.triangles[i];
    const std::uint32_t b = mesh.triangles[i % 3 == 2 ? i - 2 : i + 1];
    EdgeSides& sides = edges[edgeKey(a, b)];
    const int slot = sides.triangle[0] == kNone ? 0 : 1;
    if (sides.triangle[slot] == kNone)
    {
      sides.triangle[slot] = std::uint32_t(i / 3);
      sides.ascending[slot] = a < b;
    }
  }
  return edges;
}

/// Collects the connected part of @p first; winds it as that triangle is.
std::vector<std::uint32_t> windPart(const TouchMesh& mesh, const EdgeMap& edges, std::uint32_t first,
  std::vector<std::uint8_t>& visited, std::vector<std::uint8_t>& flipped)
{
  std::vector<std::uint32_t> part{ first };
  visited[first] = 1;
  for (std::size_t next = 0; next < part.size(); ++next)
  {
    const std::uint32_t t = part[next];
    for (int corner = 0; corner < 3; ++corner)
    {
      const EdgeSides& sides =
        edges.at(edgeKey(mesh.triangles[3 * t + corner], mesh.triangles[3 * t + (corner + 1) % 3]));
      const std::uint32_t other = sides.triangle[0] == t ? sides.triangle[1] : sides.triangle[0];
      if (other != kNone && !visited[other] && sides.triangle[1] != kNone)
      {
        visited[other] = 1;
        flipped[other] = std::uint8_t(flipped[t] ^ int(sides.ascending[0] == sides.ascending[1]));
        part.push_back(other);
      }
    }
  }
  return part;
}

void addQuad(TouchMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d)
{
  mesh.triangles.insert(mesh.triangles.end(), { a, b, c, a, c, d });
}

TouchMesh gear()
{
  constexpr int kTeeth = 12;
  constexpr double kToothRadius = 0.030;
  constexpr double kGapRadius = 0.0245;
  std::vector<Vec3> polygon;
  for (int i = 0; i < kTeeth; ++i)
  {
    for (const auto& [part, radius] :
      { std::pair{ 0.0, kGapRadius }, { 0.5, kGapRadius }, { 0.6, kToothRadius }, { 0.9, kToothRadius } })
    {
      const double angle = kTwoPi * (i + part) / kTeeth;
      polygon.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
    }
  }
  return prismMesh(polygon, 0.016);
}

TouchMesh stairs()
{
  std::vector<double> steps;
  for (int i = 0; i <= 6; ++i)
  {
    steps.push_back(-0.030 + 0.010 * i);
  }
  std::vector<double> heights;
  for (int i = 0; i <= 6; ++i)
  {
    heights.push_back(-0.015 + 0.005 * i);
  }
  return blockMesh(steps, { -0.025, 0.025 }, heights, [](int x, int, int z) { return z <= std::min(x, 5); });
}

TouchMesh slottedPlate()
{
  return blockMesh({ -0.030, -0.020, 0.020, 0.030 }, { -0.020, -0.003, 0.003, 0.020 }, { -0.0015, 0.0015 },
    [](int x, int y, int) { return x != 1 || y != 1; });
}

} // namespace

void orientOutward(TouchMesh& mesh)
{
  dropTrianglesWithoutArea(mesh);
  const EdgeMap edges = edgesOf(mesh);
  const std::size_t count = mesh.triangles.size() / 3;
  std::vector<std::uint8_t> visited(count, 0);
  std::vector<std::uint8_t> flipped(count, 0);
  for (std::uint32_t first = 0; first < count; ++first)
  {
    if (visited[first])
    {
      continue;
    }
    const std::vector<std::uint32_t> part = windPart(mesh, edges, first, visited, flipped);
    Vec3 middle;
    for (const std::uint32_t t : part)
    {
      middle += mesh.points[mesh.triangles[3 * t]] / double(part.size());
    }
    double volume = 0.0;
    for (const std::uint32_t t : part)
    {
      const double sign = flipped[t] ? -1.0 : 1.0;
      volume += sign * dot(areaVector(mesh, t), mesh.points[mesh.triangles[3 * t]] - middle);
    }
    for (const std::uint32_t t : part)
    {
      if (bool(flipped[t]) != (volume < 0.0))
      {
        std::swap(mesh.triangles[3 * t + 1], mesh.triangles[3 * t + 2]);
      }
    }
  }
}

TouchMesh blockMesh(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& z,
  const std::function<bool(int, int, int)>& filled)
{
  const int size[3] = { int(x.size()) - 1, int(y.size()) - 1, int(z.size()) - 1 };
  const auto isFilled = [&](const int* c)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      if (c[axis] < 0 || c[axis] >= size[axis])
      {
        return false;
      }
    }
    return filled(c[0], c[1], c[2]);
  };
  TouchMesh mesh;
  std::map<std::array<int, 3>, std::uint32_t> corners;
  const auto cornerAt = [&](const std::array<int, 3>& c)
  {
    const auto [found, isNew] = corners.try_emplace(c, std::uint32_t(mesh.points.size()));
    if (isNew)
    {
      mesh.points.emplace_back(x[c[0]], y[c[1]], z[c[2]]);
    }
    return found->second;
  };
  int c[3];
  for (c[2] = 0; c[2] < size[2]; ++c[2])
  {
    for (c[1] = 0; c[1] < size[1]; ++c[1])
    {
      for (c[0] = 0; c[0] < size[0]; ++c[0])
      {
        for (int face = 0; isFilled(c) && face < 6; ++face)
        {
          const int axis = face / 2;
          const int side = face % 2;
          int beside[3] = { c[0], c[1], c[2] };
          beside[axis] += side ? 1 : -1;
          if (isFilled(beside))
          {
            continue;
          }
          const int u = (axis + 1) % 3;
          const int v = (axis + 2) % 3;
          std::uint32_t quad[4];
          for (int i = 0; i < 4; ++i)
          {
            std::array<int, 3> corner{ c[0], c[1], c[2] };
            corner[std::size_t(axis)] += side;
            corner[std::size_t(u)] += i == 1 || i == 2;
            corner[std::size_t(v)] += i >= 2;
            quad[i] = cornerAt(corner);
          }
          side ? addQuad(mesh, quad[0], quad[1], quad[2], quad[3])
               : addQuad(mesh, quad[0], quad[3], quad[2], quad[1]);
        }
      }
    }
  }
  return mesh;
}

TouchMesh prismMesh(const std::vector<Vec3>& polygon, double height)
{
  TouchMesh mesh;
  const auto count = std::uint32_t(polygon.size());
  const Vec3 up{ 0.0, 0.0, 0.5 * height };
  for (const double sign : { -1.0, 1.0 })
  {
    for (const Vec3& p : polygon)
    {
      mesh.points.push_back(p + sign * up);
    }
  }
  mesh.points.push_back(-up);
  mesh.points.push_back(up);
  for (std::uint32_t i = 0; i < count; ++i)
  {
    const std::uint32_t j = (i + 1) % count;
    addQuad(mesh, i, j, count + j, count + i);
    mesh.triangles.insert(mesh.triangles.end(), { j, i, 2 * count, count + i, count + j, 2 * count + 1 });
  }
  return mesh;
}

TouchMesh sphereMesh(double radius, int rings)
{
  TouchMesh mesh;
  const int sides = 2 * rings;
  for (int ring = 1; ring < rings; ++ring)
  {
    const double latitude = 0.5 * kTwoPi * ring / rings;
    for (int i = 0; i < sides; ++i)
    {
      const double angle = kTwoPi * i / sides;
      mesh.points.push_back(radius *
        Vec3(std::sin(latitude) * std::cos(angle), std::sin(latitude) * std::sin(angle), std::cos(latitude)));
    }
  }
  const auto north = std::uint32_t(mesh.points.size());
  mesh.points.emplace_back(0.0, 0.0, radius);
  mesh.points.emplace_back(0.0, 0.0, -radius);
  for (int i = 0; i < sides; ++i)
  {
    const int j = (i + 1) % sides;
    for (int ring = 0; ring + 2 < rings; ++ring)
    {
      addQuad(mesh, std::uint32_t(ring * sides + i), std::uint32_t((ring + 1) * sides + i),
        std::uint32_t((ring + 1) * sides + j), std::uint32_t(ring * sides + j));
    }
    const int last = (rings - 2) * sides;
    mesh.triangles.insert(mesh.triangles.end(),
      { std::uint32_t(i), std::uint32_t(j), north, std::uint32_t(last + j), std::uint32_t(last + i),
        north + 1 });
  }
  return mesh;
}

TouchMesh cylinderMesh(double radius, double height, int sides)
{
  std::vector<Vec3> polygon;
  for (int i = 0; i < sides; ++i)
  {
    const double angle = kTwoPi * i / sides;
    polygon.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
  }
  return prismMesh(polygon, height);
}

Vec3 turnedAway(const Vec3& p)
{
  const Vec3 axis = normalized(Vec3(0.3, 0.8, 0.5));
  const double c = std::cos(0.6);
  const double s = std::sin(0.6);
  return c * p + s * cross(axis, p) + (1.0 - c) * dot(axis, p) * axis;
}

std::vector<std::string> generatedMeshNames()
{
  return { "box", "stairs", "slot", "gear" };
}

std::vector<std::string> smoothMeshNames()
{
  return { "sphere", "ellipsoid" };
}

TouchMesh generatedMesh(const std::string& name)
{
  TouchMesh mesh;
  if (name == "box")
  {
    mesh =
      blockMesh({ -0.030, 0.030 }, { -0.025, 0.025 }, { -0.020, 0.020 }, [](int, int, int) { return true; });
  }
  else if (name == "stairs")
  {
    mesh = stairs();
  }
  else if (name == "slot")
  {
    mesh = slottedPlate();
  }
  else if (name == "gear")
  {
    mesh = gear();
  }
  else if (name == "sphere" || name == "ellipsoid")
  {
    mesh = sphereMesh(0.030, 600);
    const Vec3 scale = name == "sphere" ? Vec3(1.0, 1.0, 1.0) : Vec3(1.0, 0.7, 0.5);
    std::transform(mesh.points.begin(), mesh.points.end(), mesh.points.begin(),
      [&](const Vec3& p) { return Vec3(scale.x * p.x, scale.y * p.y, scale.z * p.z); });
  }
  mesh.name = name;
  std::transform(mesh.points.begin(), mesh.points.end(), mesh.points.begin(), turnedAway);
  return mesh;
}

std::vector<Vec3> samplesOf(const TouchMesh& mesh, std::int64_t count, std::uint64_t seed, double noise)
{
  const std::size_t triangles = mesh.triangles.size() / 3;
  std::vector<double> areas(triangles);
  for (std::size_t i = 0; i < triangles; ++i)
  {
    areas[i] = norm(areaVector(mesh, i));
  }
  std::partial_sum(areas.begin(), areas.end(), areas.begin());
  detail::PortableRandom random(seed);
  std::vector<Vec3> points;
  points.reserve(std::size_t(count));
  for (std::int64_t n = 0; n < count && triangles > 0; ++n)
  {
    const double wanted = random.uniform() * areas.back();
    const auto t = std::min<std::size_t>(
      triangles - 1, std::size_t(std::upper_bound(areas.begin(), areas.end(), wanted) - areas.begin()));
    double u = random.uniform();
    double v = random.uniform();
    if (u + v > 1.0)
    {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    const Vec3& a = mesh.points[mesh.triangles[3 * t]];
    Vec3 p =
      a + u * (mesh.points[mesh.triangles[3 * t + 1]] - a) + v * (mesh.points[mesh.triangles[3 * t + 2]] - a);
    if (noise > 0.0)
    {
      p += (noise * random.gaussian()) * normalized(areaVector(mesh, t));
    }
    points.push_back(p);
  }
  return points;
}

} // namespace pointhaptics::bench::touch
