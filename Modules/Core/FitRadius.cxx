#include "Core/FitRadius.h"

#include "Core/SurfaceFit.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace pointhaptics
{
namespace
{

constexpr double kSmallestRadiusInCells = 3.6;
constexpr double kPoints = 30.0;
constexpr double kCells = 14.0;
constexpr double kCountGrowth = 1.1;
constexpr int kCountSteps = 120;

constexpr double kLadderGrowth = 1.15;
constexpr int kLadderRungs = 16;
/// Rungs whose residuals may tell the noise: longer ones see curvature too.
constexpr int kNoiseRungs = 3;
/// Standard errors by which a longer radius may differ from a shorter one.
constexpr double kAgreement = 2.0;
/// Standard errors of the height (over the finest cell) and of the slopes that leave nothing to gain.
constexpr double kEnoughHeight = 1e-3;
constexpr double kEnoughSlope = 1e-3;
/// The gate never cuts into this many standard deviations of noise.
constexpr double kGateNoise = 4.0;
/// Neighbouring nodes that vote, in voxels of the node level.
constexpr double kVoteReach = 2.0;

double countRadius(const CellPyramid& pyramid, const Vec3& seed, double largest)
{
  double radius = kSmallestRadiusInCells * pyramid.level(0).voxelSize;
  for (int i = 0; i < kCountSteps && radius < largest; ++i)
  {
    double points = 0.0;
    double cells = 0.0;
    pyramid.visitBall(0, seed, radius,
      [&](std::uint32_t, const Cell& cell, double d2)
      {
        const double base = 1.0 - d2 / (radius * radius);
        const double weight = 5.0 * (base * base) * (base * base);
        points += weight * cell.count;
        cells += weight;
      });
    if (points >= kPoints && cells >= kCells)
    {
      break;
    }
    radius *= kCountGrowth;
  }
  return radius;
}

/// Position and slopes of one rung, with the standard errors for noise 1.
struct Rung
{
  double value[3];
  double error[3];
};

bool agrees(const Rung& longer, const Rung& shorter, double noise)
{
  for (int i = 0; i < 3; ++i)
  {
    if (std::abs(longer.value[i] - shorter.value[i]) > kAgreement * noise * shorter.error[i])
    {
      return false;
    }
  }
  return true;
}

double medianOf(std::vector<double>& values)
{
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}

FitScale chooseFitRadius(
  const CellPyramid& pyramid, const Vec3& seed, double largestCount, double largest, FitCells& memory)
{
  FitScale scale;
  scale.countRadius = countRadius(pyramid, seed, largestCount);
  scale.radius = scale.countRadius;
  SurfaceFrame frame;
  SurfaceFit fit;
  double curvature[3];
  Vec3 normal;
  if (!principalNormal(pyramid, seed, scale.countRadius, normal))
  {
    return scale;
  }
  frame.turnTo(normal);
  if (!settleOnSurface(pyramid, seed, scale.countRadius, 2.0 * kGateDepth * scale.countRadius, memory, frame,
        fit, curvature))
  {
    return scale;
  }
  Rung rungs[kLadderRungs];
  double noise = INFINITY;
  double radius = scale.countRadius;
  for (int s = 0; s < kLadderRungs && (s == 0 || radius <= largest); ++s, radius *= kLadderGrowth)
  {
    FitSettings settings;
    settings.radius = radius;
    settings.gate = 2.0 * kGateDepth * scale.countRadius;
    settings.twoSidedGate = true;
    std::copy(curvature, curvature + 3, settings.curvature);
    SurfaceFitError error;
    const SurfaceFit here = fitSurface(pyramid, frame, settings, memory, error);
    if (here.quality != FitQuality::Quadric)
    {
      break;
    }
    noise = s < kNoiseRungs ? std::min(noise, error.noise) : noise;
    rungs[s] = { { radius * here.k[0], here.k[1], here.k[2] },
      { error.standardError[0], error.standardError[1], error.standardError[2] } };
    bool accepted = true;
    for (int o = 0; o < s && accepted; ++o)
    {
      accepted = agrees(rungs[s], rungs[o], noise);
    }
    if (!accepted)
    {
      break;
    }
    scale.radius = radius;
    // Good enough: looking further would only blur what is there, and see holes and rims late.
    if (noise * rungs[s].error[0] < kEnoughHeight * pyramid.level(0).voxelSize &&
      noise * std::max(rungs[s].error[1], rungs[s].error[2]) < kEnoughSlope)
    {
      break;
    }
  }
  scale.noise = std::isfinite(noise) ? noise : 0.0;
  return scale;
}

std::vector<LocalScale> fitScales(
  const CellPyramid& pyramid, double largestCount, double largest, const Executor& executor)
{
  const int nodeLevel = RadiusField::nodeLevel(pyramid);
  const auto& nodes = pyramid.level(nodeLevel);
  std::vector<FitScale> scales(nodes.cells.size());
  forRange(executor, std::int64_t(scales.size()),
    [&](std::int64_t begin, std::int64_t end)
    {
      const auto memory = std::make_unique<FitCells>();
      for (std::size_t i = std::size_t(begin); i < std::size_t(end); ++i)
      {
        double distance = 0.0;
        const Vec3 node = nodes.cells[i].mean;
        const std::int64_t seed = pyramid.nearest(0, node, 2.0 * nodes.voxelSize, distance);
        const Vec3 place = seed < 0 ? node : pyramid.level(0).cells[std::size_t(seed)].mean;
        scales[i] = chooseFitRadius(pyramid, place, largestCount, largest, *memory);
      }
    });
  std::vector<LocalScale> result(scales.size());
  std::vector<double> radii;
  std::vector<double> noises;
  for (std::size_t i = 0; i < scales.size(); ++i)
  {
    radii.clear();
    noises.clear();
    pyramid.visitBall(nodeLevel, nodes.cells[i].mean, kVoteReach * nodes.voxelSize,
      [&](std::uint32_t j, const Cell&, double)
      {
        radii.push_back(scales[j].radius);
        noises.push_back(scales[j].noise);
      });
    const double radius = radii.empty() ? scales[i].radius : medianOf(radii);
    const double noise = noises.empty() ? scales[i].noise : medianOf(noises);
    result[i].radius = std::max(scales[i].countRadius, radius);
    result[i].countRadius = scales[i].countRadius;
    result[i].noise = noise;
    result[i].gate = std::max(kGateDepth * scales[i].countRadius, kGateNoise * noise);
  }
  return result;
}

} // namespace pointhaptics
