#include "Core/SurfaceFit.h"

#include "Core/QuadricEquations.h"

#include <algorithm>

namespace pointhaptics
{
namespace
{

/// Voxels in the fit radius at which the next coarser level begins to serve.
constexpr double kVoxelsPerRadius = 3.0;
/// Part of a level's range after which the next level is blended in.
constexpr double kBlendFrom = 0.7;
constexpr int kFewestCellsForQuadric = 9;
/// The gate opens over the last part of its depth.
constexpr double kGateOpen = 0.7;
/// Bound of each curvature term the gate follows, over rho.
constexpr double kLargestGateCurvature = 0.6;
constexpr int kSettleRounds = 3;

double smoothStep(double t)
{
  const double s = std::clamp(t, 0.0, 1.0);
  return s * s * (3.0 - 2.0 * s);
}

/// 1 near the surface, 0 beyond the gate, smooth between; heights and gate over rho.
double gateWeight(double height, double gate, bool twoSided)
{
  const double depth = twoSided ? std::abs(height) : -height;
  if (depth <= kGateOpen * gate)
  {
    return 1.0;
  }
  return depth >= gate ? 0.0 : 1.0 - smoothStep((depth - kGateOpen * gate) / ((1.0 - kGateOpen) * gate));
}

void accumulate(const CellPyramid& pyramid, int level, const SurfaceFrame& frame, const FitSettings& settings,
  double share, NormalEquations& eq)
{
  const double perRho = 1.0 / settings.radius;
  const double perRho2 = perRho * perRho;
  double bend[3];
  for (int i = 0; i < 3; ++i)
  {
    bend[i] =
      std::clamp(settings.curvature[i] * settings.radius, -kLargestGateCurvature, kLargestGateCurvature);
  }
  const double gate = settings.gate * perRho;
  pyramid.visitBallUnmixed(level, frame.origin, settings.radius,
    [&](const Cell& cell, double d2)
    {
      const Vec3 local = perRho * frame.toLocal(cell.mean);
      const double u = local.x;
      const double v = local.y;
      const double base = 1.0 - d2 * perRho2;
      double w = share * cell.count * (base * base) * (base * base);
      if (gate > 0.0)
      {
        const double below = local.z - (bend[0] * u * u + bend[1] * u * v + bend[2] * v * v);
        w *= gateWeight(below, gate, settings.twoSidedGate);
      }
      if (!(w > 0.0))
      {
        return;
      }
      const Vec3 ca = cell.covariance * frame.a;
      const Vec3 cb = cell.covariance * frame.b;
      const double p[6] = { 1.0, u, v, u * u + dot(frame.a, ca) * perRho2, u * v + dot(frame.b, ca) * perRho2,
        v * v + dot(frame.b, cb) * perRho2 };
      eq.add(p, local.z, u, v, w);
      if (eq.withErrors)
      {
        eq.addScatter(p, w, cell.count);
      }
      if (eq.seen && eq.seen->count++ < SeenCells::kCapacity)
      {
        eq.seen->cells[eq.seen->count - 1] = { { p[0], p[1], p[2], p[3], p[4], p[5] }, local.z, w,
          4.0 * w / base, d2 * perRho2, dot(frame.normal, ca) * perRho2, dot(frame.normal, cb) * perRho2 };
      }
    });
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

/// The finest cells a fit of this radius uses: level l with 3 to 6 voxels in rho.
int fitLevel(const CellPyramid& pyramid, double radius, double& fraction)
{
  const double exact = std::log2(radius / (kVoxelsPerRadius * pyramid.level(0).voxelSize));
  const int top = pyramid.numberOfCellLevels() - 1;
  const int level = std::clamp(int(std::floor(exact)), 0, top);
  fraction = level < top ? std::clamp(exact - double(level), 0.0, 1.0) : 0.0;
  return level;
}

SurfaceFit fitCells(const CellPyramid& pyramid, const SurfaceFrame& frame, const FitSettings& settings,
  SurfaceFitError* error, const TracedSlopes* slopes)
{
  SurfaceFit fit;
  fit.radius = settings.radius;
  double fraction = 0.0;
  const int level = fitLevel(pyramid, settings.radius, fraction);
  const double coarse = smoothStep((fraction - kBlendFrom) / (1.0 - kBlendFrom));
  NormalEquations eq;
  eq.withErrors = error != nullptr;
  SeenCells seen;
  eq.seen = slopes && slopes->strength > 0.0 ? &seen : nullptr;
  accumulate(pyramid, level, frame, settings, 1.0 - coarse, eq);
  if (coarse > 0.0)
  {
    accumulate(pyramid, level + 1, frame, settings, coarse, eq);
  }
  fit.cells = eq.cells;
  if (eq.cells < 3 || !(eq.weights > 0.0))
  {
    return fit;
  }
  fit.centroidU = eq.sumU / eq.weights;
  fit.centroidV = eq.sumV / eq.weights;
  double l[6][6];
  int terms = 6;
  if (eq.cells >= kFewestCellsForQuadric && factor(eq, 6, l))
  {
    fit.quality = FitQuality::Quadric;
  }
  else if (factor(eq, 3, l))
  {
    terms = 3;
    fit.quality = FitQuality::Plane;
  }
  else
  {
    return fit;
  }
  backSolve(l, terms, eq.rhs, fit.k);
  double explained = 0.0;
  for (int i = 0; i < terms; ++i)
  {
    explained += fit.k[i] * eq.rhs[i];
  }
  fit.residual = std::sqrt(std::max(0.0, (eq.zz - explained) / eq.weights)) * settings.radius;
  if (error)
  {
    errorsOf(eq, l, terms, fit.residual, settings.radius, *error);
  }
  if (eq.seen && terms == 6 && seen.count <= SeenCells::kCapacity)
  {
    traceSlopes(seen, l, frame, *slopes, fit);
  }
  return fit;
}

}

SurfaceFit fitSurface(
  const CellPyramid& pyramid, const SurfaceFrame& frame, const FitSettings& settings) noexcept
{
  return fitCells(pyramid, frame, settings, nullptr, nullptr);
}

SurfaceFit fitSurface(const CellPyramid& pyramid, const SurfaceFrame& frame, const FitSettings& settings,
  SurfaceFitError& error) noexcept
{
  error = SurfaceFitError();
  return fitCells(pyramid, frame, settings, &error, nullptr);
}

SurfaceFit fitSurface(const CellPyramid& pyramid, const SurfaceFrame& frame, const FitSettings& settings,
  const TracedSlopes& slopes) noexcept
{
  return fitCells(pyramid, frame, settings, nullptr, &slopes);
}

bool settleOnSurface(const CellPyramid& pyramid, const Vec3& onSurface, double radius, SurfaceFrame& frame,
  SurfaceFit& fit, double curvature[3]) noexcept
{
  frame.origin = onSurface;
  std::fill(curvature, curvature + 3, 0.0);
  for (int round = 0; round < kSettleRounds; ++round)
  {
    FitSettings settings;
    settings.radius = radius;
    settings.gate = round == 0 ? 0.0 : 2.0 * kGateDepth * radius;
    settings.twoSidedGate = true;
    std::copy(curvature, curvature + 3, settings.curvature);
    fit = fitSurface(pyramid, frame, settings);
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
  const double* k = fit.k;
  point = frame.toWorld(fit.radius * Vec3{ u, v, fit.height(u, v) });
  const double qu = k[1] + 2.0 * k[3] * u + k[4] * v;
  const double qv = k[2] + k[4] * u + 2.0 * k[5] * v;
  normal = normalized(frame.normal - qu * frame.a - qv * frame.b, frame.normal);
}

bool footPoint(
  const SurfaceFit& fit, const SurfaceFrame& frame, const Vec3& target, Vec3& foot, Vec3& normal) noexcept
{
  constexpr int kMaximumIterations = 12;
  constexpr double kReach = 0.5;
  constexpr double kConverged = 1e-12;
  const double* k = fit.k;
  const Vec3 h = frame.toLocal(target) * (1.0 / fit.radius);
  double u = 0.0;
  double v = 0.0;
  bool inside = false;
  for (int i = 0; i < kMaximumIterations; ++i)
  {
    const double gap = fit.height(u, v) - h.z;
    const double qu = k[1] + 2.0 * k[3] * u + k[4] * v;
    const double qv = k[2] + k[4] * u + 2.0 * k[5] * v;
    const double gu = u - h.x + gap * qu;
    const double gv = v - h.y + gap * qv;
    double huu = 1.0 + qu * qu + 2.0 * gap * k[3];
    double huv = qu * qv + gap * k[4];
    double hvv = 1.0 + qv * qv + 2.0 * gap * k[5];
    // Far on the hollow side the Hessian turns: Gauss-Newton is always downhill.
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

bool principalNormal(const CellPyramid& pyramid, const Vec3& center, double radius, Vec3& normal) noexcept
{
  double fraction = 0.0;
  const int level = fitLevel(pyramid, radius, fraction);
  double weights = 0.0;
  Vec3 sum;
  SymMat3 squares;
  const double perRadius2 = 1.0 / (radius * radius);
  int cells = 0;
  pyramid.visitBallUnmixed(level, center, radius,
    [&](const Cell& cell, double d2)
    {
      const double base = 1.0 - d2 * perRadius2;
      const double w = cell.count * base * base;
      const Vec3 d = cell.mean - center;
      weights += w;
      sum += w * d;
      SymMat3 square = outerProduct(d);
      square += cell.covariance;
      square *= w;
      squares += square;
      ++cells;
    });
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
