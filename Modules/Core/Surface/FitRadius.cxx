#include "Core/Surface/FitRadius.h"

#include "Core/Surface/SurfaceFit.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace pointhaptics
{
namespace
{

/// A surface is smooth up to kSmooth, the RMS residual of a fit in cells. The next two limit the fraction of
/// a residual that a smaller fit leaves: where the residual is shape, and in the median over a cloud without
/// noise. Noise leaves 0.85, scans 0.45 to 0.63.
constexpr double kSmooth = 1e-3;
constexpr double kLeftOfShape = 0.5;
constexpr double kLeftWithoutNoise = 0.7;
constexpr double kCountGrowth = 1.1;
constexpr int kCountSteps = 120;

constexpr int kMostScales = 16;
/// Margin of gathered cells, so that they serve the next scale, too.
constexpr double kScalesMargin = 1.32;
/// Scales whose residuals estimate the noise: at longer ones curvature contributes.
constexpr int kNoiseScales = 3;
/// A longer radius may differ from a shorter one by this many standard errors.
constexpr double kAgreement = 2.0;
/// Standard errors with cubic terms, which are large where the radius is short.
constexpr double kCubicAgreement = 2.5;
/// Standard errors below these leave nothing to gain: of the height, over the finest cell, and of the slopes.
constexpr double kEnoughHeight = 1e-3;
constexpr double kEnoughSlope = 1e-3;
/// A cloud counts as noisy if its radius grew by this factor; cubic terms at a longer radius are tried then.
constexpr double kNoisyGrowth = 1.3;
/// Longest radius with cubic terms, over that of the quadratic fit.
constexpr double kCubicReach = 1.1;
/// A fit with cubic terms is as good if its slope errors are at most kCubicErrorAsGood times the quadratic
/// fit's. Up to the second factor it is preferred where the slopes of the two disagree, since the quadratic
/// fit is bent then.
constexpr double kCubicErrorAsGood = 1.2;
constexpr double kCubicErrorAtMost = 3.0;
/// Slopes disagree if they differ by this many standard errors.
constexpr double kDisagreement = 1.0;
/// Cubic terms are tried only if at most this part of the points within reach belongs to other sheets: they
/// would bend to the points that pass the gate.
constexpr double kOtherSheets = 0.01;
/// Points are scattered, and no radius is better than another, if this part of those within reach lies beyond
/// the gate; two sheets have half. Without this limit each fit in a fog takes thousands of cells.
constexpr double kScattered = 0.55;
/// Fractions of neighbours that prefer cubic terms: from the first on these count, from the second on in
/// full.
constexpr double kCubicVotesFrom = 0.3;
constexpr double kCubicVotesTo = 0.75;
/// The gate is at least this many standard deviations of noise deep.
constexpr double kGateNoise = 4.0;
/// Reach of the vote among neighbouring nodes, in voxels of the node level.
constexpr double kVoteReach = 2.0;

double countRadius(const CellPyramid& pyramid, const Vec3& seed, double largest, const FitNeeds& needs)
{
  double radius = needs.radiusInCells * pyramid.level(0).voxelSize;
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
    if (points >= needs.points && cells >= needs.cells)
    {
      break;
    }
    radius *= kCountGrowth;
  }
  return radius;
}

/// Position and slopes at one scale, with the standard errors for noise 1.
struct ScaleEstimate
{
  double value[3];
  double error[3];
};

/// True if the two scales agree within @p tolerance standard errors of the shorter one.
bool agrees(const ScaleEstimate& longer, const ScaleEstimate& shorter, double tolerance)
{
  for (int i = 0; i < 3; ++i)
  {
    if (std::abs(longer.value[i] - shorter.value[i]) > tolerance * shorter.error[i])
    {
      return false;
    }
  }
  return true;
}

/// The scale that the search chose.
struct ScaleChoice
{
  double radius = 0.0;
  ScaleEstimate estimate{ { 0.0, 0.0, 0.0 }, { INFINITY, INFINITY, INFINITY } };

  double slopeError() const { return std::max(estimate.error[1], estimate.error[2]); }
};

/// Lepski's scale search: tries longer and longer radii in one frame.
class ScaleSearch
{
public:
  ScaleSearch(const CellPyramid& pyramid, const SurfaceFrame& frame, const double curvature[3],
    double countRadius, double growth, FitCells& memory)
    : pyramid_(pyramid)
    , frame_(frame)
    , countRadius_(countRadius)
    , growth_(growth)
    , memory_(memory)
  {
    std::copy(curvature, curvature + 3, curvature_);
  }

  /// Runs the search. The first run must be without cubic terms, as it estimates the noise. Radius 0: another
  /// sheet is in reach.
  ScaleChoice run(double largest, bool cubic)
  {
    ScaleChoice result;
    result.radius = countRadius_;
    ScaleEstimate estimates[kMostScales];
    int size = 0;
    FitSettings settings;
    settings.radius = countRadius_;
    settings.gate = 2.0 * kGateDepth * countRadius_;
    settings.twoSidedGate = true;
    std::copy(curvature_, curvature_ + 3, settings.curvature);
    for (int s = 0; s < kMostScales; ++s)
    {
      SurfaceFitError error;
      const SurfaceFit here = fitSurface(pyramid_, frame_, settings, memory_, error, cubic);
      const bool usable = here.quality == FitQuality::Quadric;
      // The first radius may be too short for so many terms.
      if (!usable && !(cubic && size == 0))
      {
        break;
      }
      if (usable && error.leftOut > kScattered)
      {
        break;
      }
      if (usable)
      {
        noise_ = !cubic && s < kNoiseScales ? std::min(noise_, error.noise) : noise_;
        estimates[size] = { { settings.radius * here.k[0], here.k[1], here.k[2] },
          { error.standardError[0], error.standardError[1], error.standardError[2] } };
        const double tolerance = (cubic ? kCubicAgreement : kAgreement) * noise_;
        const bool accepted = std::all_of(estimates, estimates + size,
          [&](const ScaleEstimate& shorter) { return agrees(estimates[size], shorter, tolerance); });
        if (!accepted)
        {
          break;
        }
        if (cubic && error.leftOut > kOtherSheets)
        {
          return {};
        }
        result = { settings.radius, estimates[size] };
        // From here on the gate follows the curvature found so far.
        std::transform(
          here.k + 3, here.k + 6, settings.curvature, [&](double k) { return k / settings.radius; });
        ++size;
        if (isEnough(result))
        {
          break;
        }
      }
      if (!(settings.radius < largest))
      {
        break;
      }
      settings.radius = std::min(largest, growth_ * settings.radius);
    }
    return result;
  }

  double noise() const { return noise_; }

private:
  /// True if the errors are so small that a longer radius would only smooth detail, holes and rims away.
  bool isEnough(const ScaleChoice& choice) const
  {
    return noise_ * choice.estimate.error[0] < kEnoughHeight * pyramid_.level(0).voxelSize &&
      noise_ * choice.slopeError() < kEnoughSlope;
  }

  const CellPyramid& pyramid_;
  const SurfaceFrame& frame_;
  double curvature_[3];
  double countRadius_;
  double growth_;
  FitCells& memory_;
  double noise_ = INFINITY;
};

/// True if the fit with cubic terms is better: its slopes are about as exact, or differ from those of the
/// quadratic fit by more than their errors.
bool prefersCubic(const ScaleChoice& cubic, const ScaleChoice& quadratic, double noise)
{
  const double ratio = cubic.slopeError() / quadratic.slopeError();
  if (!(cubic.radius >= quadratic.radius) || !(ratio < kCubicErrorAtMost))
  {
    return false;
  }
  bool differs = false;
  for (int i = 1; i < 3; ++i)
  {
    differs = differs ||
      std::abs(cubic.estimate.value[i] - quadratic.estimate.value[i]) >
        kDisagreement * noise * cubic.estimate.error[i];
  }
  return differs || ratio < kCubicErrorAsGood;
}

double medianOf(std::vector<double>& values)
{
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}

FitScale chooseFitRadius(const CellPyramid& pyramid, const Vec3& seed, double largestCount, double largest,
  FitCells& memory, const FitNeeds& needs)
{
  if (needs.finerWhereShaped)
  {
    // A smaller fit has as much residual by noise, and less by shape.
    const FitScale wide = chooseFitRadius(pyramid, seed, largestCount, largest, memory);
    if (wide.noise <= kSmooth * pyramid.level(0).voxelSize)
    {
      return wide;
    }
    const FitScale fine =
      chooseFitRadius(pyramid, seed, largestCount, largest, memory, FitNeeds::ofFineCells());
    FitScale chosen = fine.noise < kLeftOfShape * wide.noise ? fine : wide;
    chosen.left = fine.noise / wide.noise;
    return chosen;
  }
  // Cells that another node gathered would round otherwise: results would depend on how threads share nodes.
  memory.invalidate();
  FitScale scale;
  scale.countRadius = countRadius(pyramid, seed, largestCount, needs);
  scale.radius = scale.countRadius;
  SurfaceFrame frame;
  SurfaceFit fit;
  double curvature[3];
  Vec3 normal;
  if (!principalNormal(pyramid, seed, scale.countRadius, memory, normal))
  {
    return scale;
  }
  frame.turnTo(normal);
  if (!settleOnSurface(pyramid, seed, scale.countRadius, 2.0 * kGateDepth * scale.countRadius, memory, frame,
        fit, curvature))
  {
    return scale;
  }
  ScaleSearch search(pyramid, frame, curvature, scale.countRadius, needs.growth, memory);
  const ScaleChoice quadratic = search.run(largest, false);
  scale.radius = quadratic.radius;
  scale.noise = std::isfinite(search.noise()) ? search.noise() : 0.0;
  if (needs.weighsCubic && quadratic.radius > kNoisyGrowth * scale.countRadius)
  {
    const ScaleChoice cubic = search.run(kCubicReach * largest, true);
    scale.cubic = prefersCubic(cubic, quadratic, scale.noise);
    scale.radius = scale.cubic ? cubic.radius : quadratic.radius;
  }
  return scale;
}

namespace
{

/// Medians over a node and those about it.
LocalScale vote(const CellPyramid& pyramid, int nodeLevel, const std::vector<FitScale>& scales, std::size_t i)
{
  const auto& nodes = pyramid.level(nodeLevel);
  std::vector<double> radii;
  std::vector<double> noises;
  double cubic = 0.0;
  pyramid.visitBall(nodeLevel, nodes.cells[i].mean, kVoteReach * nodes.voxelSize,
    [&](std::uint32_t j, const Cell&, double)
    {
      radii.push_back(scales[j].radius);
      noises.push_back(scales[j].noise);
      cubic += scales[j].cubic ? 1.0 : 0.0;
    });
  const double votes = cubic / double(radii.size());
  LocalScale result;
  result.radius = std::max(scales[i].countRadius, medianOf(radii));
  result.countRadius = scales[i].countRadius;
  result.noise = medianOf(noises);
  result.cubic = std::clamp((votes - kCubicVotesFrom) / (kCubicVotesTo - kCubicVotesFrom), 0.0, 1.0);
  result.gate = std::max(kGateDepth * scales[i].countRadius, kGateNoise * result.noise);
  return result;
}

/// True if smaller fits leave so little of the residuals over the cloud that these are shape. One node tells
/// little, many nodes are certain.
bool isFreeOfNoise(const std::vector<FitScale>& scales)
{
  std::vector<double> left;
  for (const FitScale& scale : scales)
  {
    if (scale.left > 0.0)
    {
      left.push_back(scale.left);
    }
  }
  return !left.empty() && medianOf(left) < kLeftWithoutNoise;
}

}

std::vector<LocalScale> fitScales(const CellPyramid& pyramid, double largestCount, double largest,
  const Executor& executor, const FitNeeds& needs, InstructionSet wanted)
{
  // A node takes some ten microseconds, and more where there is noise.
  constexpr std::int64_t kSmallestRange = 16;
  const int nodeLevel = RadiusField::nodeLevel(pyramid);
  const auto& nodes = pyramid.level(nodeLevel);
  std::vector<FitScale> scales(nodes.cells.size());
  const auto choose = [&](const FitNeeds& wantedNeeds, auto&& isWanted)
  {
    forRange(executor, std::int64_t(scales.size()), kSmallestRange,
      [&](std::int64_t begin, std::int64_t end)
      {
        const auto memory = std::make_unique<FitCells>(wanted, kScalesMargin);
        for (std::size_t i = std::size_t(begin); i < std::size_t(end); ++i)
        {
          if (!isWanted(i))
          {
            continue;
          }
          double distance = 0.0;
          const Vec3 node = nodes.cells[i].mean;
          const std::int64_t seed = pyramid.nearest(0, node, 2.0 * nodes.voxelSize, distance);
          const Vec3 place = seed < 0 ? node : pyramid.level(0).cells[std::size_t(seed)].mean;
          scales[i] = chooseFitRadius(pyramid, place, largestCount, largest, *memory, wantedNeeds);
        }
      });
  };
  choose(needs, [](std::size_t) { return true; });
  if (needs.finerWhereShaped && isFreeOfNoise(scales))
  {
    choose(FitNeeds::ofBarePoints(), [&](std::size_t i) { return scales[i].left > 0.0; });
  }
  std::vector<LocalScale> result(scales.size());
  forRange(executor, std::int64_t(scales.size()), kSmallestRange,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::size_t i = std::size_t(begin); i < std::size_t(end); ++i)
      {
        result[i] = vote(pyramid, nodeLevel, scales, i);
      }
    });
  return result;
}

} // namespace pointhaptics
