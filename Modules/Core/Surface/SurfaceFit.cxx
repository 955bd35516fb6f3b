#include "Core/Surface/SurfaceFit.h"

#include "Core/Surface/QuadricEquations.h"

#include <algorithm>

namespace pointhaptics
{
namespace
{

/// The next coarser level begins to serve where the fit radius has more voxels than this.
constexpr double kVoxelsPerRadius = 3.0;
/// Part of a level's range after which the next level is blended in.
constexpr double kBlendFrom = 0.7;
constexpr int kFewestCellsForQuadric = 9;
/// Bound of each curvature term that the gate follows, over rho.
constexpr double kLargestGateCurvature = 0.6;
constexpr int kSettleRounds = 3;
/// Depth of the first gate over that of the others: a search may begin off the surface by the noise.
constexpr double kFirstGate = 1.5;

double smoothStep(double t)
{
  const double s = std::clamp(t, 0.0, 1.0);
  return s * s * (3.0 - 2.0 * s);
}

}

void SurfaceFrame::turnTo(const Vec3& newNormal) noexcept
{
  normal = newNormal;
  const Vec3 projected = a - dot(a, normal) * normal;
  a = norm2(projected) > 1e-12 ? projected / norm(projected) : anyPerpendicular(normal);
  b = cross(normal, a);
}

namespace
{

/// Level whose cells a fit of this radius uses: the one with 3 to 6 voxels in rho.
int fitLevel(const CellPyramid& pyramid, double radius, double& fraction)
{
  const double exact = std::log2(radius / (kVoxelsPerRadius * pyramid.level(0).voxelSize));
  const int top = pyramid.numberOfCellLevels() - 1;
  const int level = std::clamp(int(std::floor(exact)), 0, top);
  fraction = level < top ? std::clamp(exact - double(level), 0.0, 1.0) : 0.0;
  return level;
}

simd::FitView viewOf(const SurfaceFrame& frame, const FitSettings& settings)
{
  simd::FitView view;
  view.a = frame.a;
  view.b = frame.b;
  view.normal = frame.normal;
  view.radius = settings.radius;
  view.gate = settings.gate / settings.radius;
  view.twoSidedGate = settings.twoSidedGate;
  for (int i = 0; i < 3; ++i)
  {
    view.bend[i] =
      std::clamp(settings.curvature[i] * settings.radius, -kLargestGateCurvature, kLargestGateCurvature);
  }
  return view;
}

/// Collects the rows of one or two levels; the coarser one is blended in over the last part of the finer
/// one's range.
void collectRows(
  const CellPyramid& pyramid, const SurfaceFrame& frame, const FitSettings& settings, FitCells& memory)
{
  double fraction = 0.0;
  int level = fitLevel(pyramid, settings.radius, fraction);
  const double coarse = smoothStep((fraction - kBlendFrom) / (1.0 - kBlendFrom));
  simd::FitView view = viewOf(frame, settings);
  memory.rows().size = 0;
  const auto append = [&](double blendWeight)
  {
    const simd::FitBlock& block = memory.near(pyramid, level, frame.origin, settings.radius);
    view.origin = frame.origin - block.center;
    view.blendWeight = blendWeight;
    memory.kernels().appendRows(block, view, memory.rows());
  };
  append(1.0 - coarse);
  if (coarse > 0.0 && level + 1 < pyramid.numberOfCellLevels())
  {
    ++level;
    append(coarse);
  }
}

/// Sums the rows of a fit and solves it; the factor has no terms where the fit has no quality.
SurfaceFit solvedFit(FitCells& memory, double radius, simd::FitSums& sums, FitFactor& f)
{
  memory.kernels().sumRows(memory.rows(), sums);
  SurfaceFit fit;
  fit.radius = radius;
  fit.cells = int(sums.cells);
  if (fit.cells < 3 || !(sums.a[0] > 0.0))
  {
    return fit;
  }
  fit.centroidU = sums.a[1] / sums.a[0];
  fit.centroidV = sums.a[3] / sums.a[0];
  if (fit.cells >= kFewestCellsForQuadric && factor(sums, 6, f))
  {
    fit.quality = FitQuality::Quadric;
  }
  else if (factor(sums, 3, f))
  {
    fit.quality = FitQuality::Plane;
  }
  else
  {
    return fit;
  }
  solve(f, sums.rhs, fit.k);
  double explained = 0.0;
  for (int i = 0; i < f.terms; ++i)
  {
    explained += fit.k[i] * sums.rhs[i];
  }
  fit.residual = std::sqrt(std::max(0.0, (sums.zz - explained) / sums.a[0])) * radius;
  return fit;
}

/// Solves a quadric again with cubic terms. @p k receives all ten.
void solveCubic(
  FitCells& memory, double weight, simd::FitSums& sums, FitFactor& f, double k[10], SurfaceFit& fit)
{
  memory.kernels().sumCubicRows(memory.rows(), sums);
  addCubicTerms(sums, weight, f);
  solve(f, sums.rhs, k);
  std::copy(k, k + 6, fit.k);
  std::copy(k + 6, k + 10, fit.cubic);
}

}

SurfaceFit fitSurface(const CellPyramid& pyramid, const SurfaceFrame& frame, const FitSettings& settings,
  FitCells& memory, const TracedSlopes* slopes) noexcept
{
  collectRows(pyramid, frame, settings, memory);
  simd::FitSums sums;
  FitFactor f;
  SurfaceFit fit = solvedFit(memory, settings.radius, sums, f);
  const double cubicWeight = slopes ? std::max(slopes->strength, slopes->cubic) : 0.0;
  if (cubicWeight > 0.0 && f.terms == 6)
  {
    simd::TracedFit traced;
    solveCubic(memory, cubicWeight, sums, f, traced.k, fit);
    if (slopes->strength > 0.0)
    {
      inverseRow(f, 0, traced.row);
      simd::TraceSums trace;
      memory.kernels().traceRows(memory.rows(), traced, dot(slopes->radiusGradient, frame.a),
        dot(slopes->radiusGradient, frame.b), trace);
      traceSlopes(trace, slopes->strength, fit);
    }
  }
  return fit;
}

SurfaceFit fitSurface(const CellPyramid& pyramid, const SurfaceFrame& frame, const FitSettings& settings,
  FitCells& memory, SurfaceFitError& error, bool cubic) noexcept
{
  error = SurfaceFitError();
  collectRows(pyramid, frame, settings, memory);
  simd::FitSums sums;
  FitFactor f;
  SurfaceFit fit = solvedFit(memory, settings.radius, sums, f);
  if (cubic && f.terms == 6)
  {
    SurfaceFit quadric = fit;
    double k[10];
    solveCubic(memory, 1.0, sums, f, k, fit);
    if (f.cubicWeight < 1.0)
    {
      quadric.quality = FitQuality::Plane;
      return quadric;
    }
  }
  if (f.terms > 0)
  {
    errorsOf(memory.rows(), sums, f, fit.residual, settings.radius, error);
  }
  return fit;
}

bool settleOnSurface(const CellPyramid& pyramid, const Vec3& onSurface, double radius, double gate,
  FitCells& memory, SurfaceFrame& frame, SurfaceFit& fit, double curvature[3]) noexcept
{
  frame.origin = onSurface;
  std::fill(curvature, curvature + 3, 0.0);
  for (int round = 0; round < kSettleRounds; ++round)
  {
    FitSettings settings;
    settings.radius = radius;
    settings.gate = round == 0 ? kFirstGate * gate : gate;
    settings.twoSidedGate = true;
    std::copy(curvature, curvature + 3, settings.curvature);
    fit = fitSurface(pyramid, frame, settings, memory);
    if (fit.quality == FitQuality::None)
    {
      return false;
    }
    Vec3 foot;
    Vec3 normal;
    footPoint(fit, frame, frame.origin, foot, normal);
    frame.origin = foot;
    frame.turnTo(normal);
    for (int i = 0; i < 3; ++i)
    {
      curvature[i] = fit.k[3 + i] / fit.radius;
    }
  }
  return true;
}

void pointAt(
  const SurfaceFit& fit, const SurfaceFrame& frame, double u, double v, Vec3& point, Vec3& normal) noexcept
{
  point = frame.toWorld(fit.radius * Vec3{ u, v, fit.height(u, v) });
  normal = normalized(frame.normal - fit.slopeU(u, v) * frame.a - fit.slopeV(u, v) * frame.b, frame.normal);
}

bool footPoint(
  const SurfaceFit& fit, const SurfaceFrame& frame, const Vec3& target, Vec3& foot, Vec3& normal) noexcept
{
  constexpr int kMaximumIterations = 12;
  constexpr double kReach = 0.5;
  // The error left is about the last step squared.
  constexpr double kConverged = 1e-9;
  const double* k = fit.k;
  const double* c = fit.cubic;
  const Vec3 h = frame.toLocal(target) * (1.0 / fit.radius);
  double u = 0.0;
  double v = 0.0;
  bool inside = false;
  for (int i = 0; i < kMaximumIterations; ++i)
  {
    const double gap = fit.height(u, v) - h.z;
    const double qu = fit.slopeU(u, v);
    const double qv = fit.slopeV(u, v);
    const double gu = u - h.x + gap * qu;
    const double gv = v - h.y + gap * qv;
    double huu = 1.0 + qu * qu + 2.0 * gap * (k[3] + 3.0 * c[0] * u + c[1] * v);
    double huv = qu * qv + gap * (k[4] + 2.0 * (c[1] * u + c[2] * v));
    double hvv = 1.0 + qv * qv + 2.0 * gap * (k[5] + 3.0 * c[3] * v + c[2] * u);
    // The Hessian turns far on the hollow side; Gauss-Newton is always downhill.
    if (huu * hvv - huv * huv <= 0.02 || huu <= 0.1)
    {
      huu = 1.0 + qu * qu;
      huv = qu * qv;
      hvv = 1.0 + qv * qv;
    }
    const double det = huu * hvv - huv * huv;
    const double du = -(hvv * gu - huv * gv) / det;
    const double dv = -(huu * gv - huv * gu) / det;
    u += du;
    v += dv;
    const double r = std::sqrt(u * u + v * v);
    if (!(r <= kReach))
    {
      const double scale = std::isfinite(r) ? kReach / r : 0.0;
      u = scale > 0.0 ? u * scale : 0.0;
      v = scale > 0.0 ? v * scale : 0.0;
    }
    inside = r <= kReach;
    if (du * du + dv * dv < kConverged * kConverged)
    {
      break;
    }
  }
  pointAt(fit, frame, u, v, foot, normal);
  return inside;
}

bool principalNormal(
  const CellPyramid& pyramid, const Vec3& center, double radius, FitCells& memory, Vec3& normal) noexcept
{
  double fraction = 0.0;
  int level = fitLevel(pyramid, radius, fraction);
  const simd::FitBlock& block = memory.near(pyramid, level, center, radius);
  const Vec3 origin = center - block.center;
  double weights = 0.0;
  Vec3 sum;
  SymMat3 squares;
  const double perRadius2 = 1.0 / (radius * radius);
  int cells = 0;
  for (int i = 0; i < block.size; ++i)
  {
    const Vec3 d = Vec3(block.x[i], block.y[i], block.z[i]) - origin;
    const double base = 1.0 - norm2(d) * perRadius2;
    if (!(base > 0.0))
    {
      continue;
    }
    const double w = block.count[i] * base * base;
    weights += w;
    sum += w * d;
    SymMat3 square = outerProduct(d);
    square += { block.xx[i], block.yy[i], block.zz[i], block.xy[i], block.yz[i], block.xz[i] };
    square *= w;
    squares += square;
    ++cells;
  }
  if (cells < 3 || !(weights > 0.0))
  {
    return false;
  }
  const Vec3 mean = sum / weights;
  squares *= 1.0 / weights;
  SymMat3 offset = outerProduct(mean);
  offset *= -1.0;
  squares += offset;
  const SymEigen eigen = symmetricEigen(squares);
  normal = eigen.vectors[0];
  // A line or a point has no normal.
  return eigen.values[1] > 1e-6 * eigen.values[2] && eigen.values[2] > 0.0;
}

} // namespace pointhaptics
