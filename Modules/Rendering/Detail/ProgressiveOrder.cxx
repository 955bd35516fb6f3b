#include "ProgressiveOrder.h"

#include "SmpExecutor.h"

#include "Core/Neighbors/SpatialOrder.h"
#include "Core/Resample/TransformedBounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>

namespace pointhaptics
{
namespace
{

constexpr int kDepth = 10; // halvings of the lattice, those of spatialOrder()
constexpr int kStepsPerHalving = 4;

/// For each point of @p along, as many halvings as it takes to part it from the one before; kDepth + 1: no
/// cell does.
std::vector<std::uint8_t> depthsOf(
  const PointView& points, const std::vector<std::uint32_t>& along, const Bounds& box, double perUnit)
{
  const auto cellOf = [&](std::uint32_t index)
  {
    std::array<std::uint32_t, 3> cell{};
    const Vec3 place = perUnit * (points[index] - box.minimum);
    for (int axis = 0; axis < 3; ++axis)
    {
      cell[std::size_t(axis)] = std::uint32_t(std::min(place[axis], double((1 << kDepth) - 1)));
    }
    return cell;
  };
  std::vector<std::uint8_t> depths(along.size());
  forRange(SmpExecutor(), std::int64_t(along.size()),
    [&](std::int64_t begin, std::int64_t end)
    {
      auto other = cellOf(along[std::size_t(std::max<std::int64_t>(begin - 1, 0))]);
      for (std::int64_t i = std::max<std::int64_t>(begin, 1); i < end; ++i)
      {
        const auto one = other;
        other = cellOf(along[std::size_t(i)]);
        std::uint32_t differing = (one[0] ^ other[0]) | (one[1] ^ other[1]) | (one[2] ^ other[2]);
        std::uint8_t depth = kDepth + 1;
        for (; differing > 0; differing >>= 1)
        {
          --depth;
        }
        depths[std::size_t(i)] = depth;
      }
    });
  return depths;
}

/// Part of a halving that @p one of the points in a row belongs to: multiples of the golden section fill an
/// interval evenly, however many are taken, so each part comes from all of the row. Four times the points
/// halve the gap: the parts end where 1 + 3 place is 2^(1/2), 2 and 2^(3/2).
int partOf(std::size_t one)
{
  constexpr double kGoldenSection = 0.6180339887498949;
  constexpr double kEnds[kStepsPerHalving - 1] = { 0.1380711874576984, 1.0 / 3.0, 0.6094757082487301 };
  const double turns = kGoldenSection * double(one);
  const double place = turns - std::floor(turns);
  return int(std::count_if(kEnds, std::end(kEnds), [place](double end) { return place >= end; }));
}

} // namespace

ProgressiveOrder progressiveOrder(const PointView& points)
{
  const SmpExecutor executor;
  const std::vector<std::uint32_t> along = spatialOrder(points, kMostOrderedPoints, executor);
  const Bounds box = transformedBounds(points, AffineTransform(), executor);
  const Vec3 extent = box.empty() ? Vec3() : box.extent();
  ProgressiveOrder order;
  order.edge = std::max({ extent.x, extent.y, extent.z });
  const double perUnit = order.edge > 0.0 ? double(1 << kDepth) / order.edge : 0.0;
  std::vector<std::uint8_t> parts = depthsOf(points, along, box, perUnit);
  constexpr int kParts = (kDepth + 2) * kStepsPerHalving;
  std::array<std::size_t, kDepth + 2> seen{};
  std::array<std::size_t, kParts> ends{};
  for (std::uint8_t& part : parts)
  {
    const std::uint8_t depth = part;
    part = std::uint8_t(kStepsPerHalving * depth + partOf(seen[depth]++));
    ++ends[part];
  }
  std::size_t end = 0;
  for (int part = 0; part < kParts; ++part)
  {
    std::size_t& size = ends[std::size_t(part)];
    const std::size_t begin = end;
    end += size;
    if (size > 0)
    {
      const double halvings = double(part + 1) / kStepsPerHalving - 1.0;
      order.steps.push_back({ std::int64_t(end), order.edge * std::exp2(-halvings) });
    }
    size = begin; // grows to the end as its points come
  }
  order.indices.reserve(std::size_t(points.size()));
  order.indices.resize(along.size());
  for (std::size_t i = 0; i < along.size(); ++i)
  {
    order.indices[ends[parts[i]]++] = along[i];
  }
  for (std::int64_t i = 0; i < points.size() && along.size() < std::size_t(points.size()); ++i)
  {
    if (!isFinite(points[i]))
    {
      order.indices.push_back(std::uint32_t(i));
    }
  }
  if (!order.steps.empty())
  {
    order.steps.pop_back();
  }
  order.steps.push_back({ points.size(), 0.0 });
  return order;
}

} // namespace pointhaptics
