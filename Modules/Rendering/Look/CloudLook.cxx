#include "CloudLook.h"

#include "RoomEvidence.h"

#include "SmpExecutor.h"

#include "Core/Base/Boxes.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <cstddef>
#include <mutex>
#include <unordered_map>

namespace pointhaptics
{
namespace
{

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180.0;
constexpr const char* kKindNames[] = { "object", "terrain", "sweep", "indoors", "frame" };
/// Number of points that decide about the kind.
constexpr std::int64_t kLookedAt = 50000;

constexpr double kSweepCorrelation = 0.6;
constexpr double kSweepRange = 5.0;
constexpr double kIndoorCells = 0.6;
constexpr double kTerrainUp = 0.7;
constexpr double kStripRatio = 1.6;

double valueAt(std::vector<double>& values, double part)
{
  const auto place = values.begin() + std::ptrdiff_t(std::lround(part * double(values.size() - 1)));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

Vec3 normalOf(const PointShape& shape)
{
  return { double(shape.normal[0]), double(shape.normal[1]), double(shape.normal[2]) };
}

template <typename Visit>
void forSample(const PointView& cloud, const LocalShape& shape, Visit&& visit)
{
  const std::int64_t step = 1 + cloud.size() / kLookedAt;
  for (std::int64_t i = 0; i < cloud.size(); i += step)
  {
    if (shape.at(i).spacing > 0.0F && norm2(cloud[i]) > 0.0)
    {
      visit(cloud[i], shape.at(i));
    }
  }
}

/// True if the spacing grows with the distance from the origin, as rays from one place spread.
bool isScannedFromOrigin(const PointView& cloud, const LocalShape& shape)
{
  std::vector<double> distances;
  double n = 0.0;
  double sx = 0.0;
  double sy = 0.0;
  double sxx = 0.0;
  double syy = 0.0;
  double sxy = 0.0;
  forSample(cloud, shape,
    [&](const Vec3& p, const PointShape& each)
    {
      const double x = std::log(norm(p));
      const double y = std::log(double(each.spacing));
      distances.push_back(norm(p));
      n += 1.0;
      sx += x;
      sy += y;
      sxx += x * x;
      syy += y * y;
      sxy += x * y;
    });
  if (distances.size() < 100)
  {
    return false;
  }
  const double spread = (sxx - sx * sx / n) * (syy - sy * sy / n);
  const double correlation = spread > 0.0 ? (sxy - sx * sy / n) / std::sqrt(spread) : 0.0;
  return correlation > kSweepCorrelation && valueAt(distances, 0.98) > kSweepRange * valueAt(distances, 0.02);
}

/// True if points lie in most directions above the horizon.
bool isUnderARoof(const PointView& cloud, const LocalShape& shape, const Vec3& up)
{
  constexpr int kAround = 24;
  constexpr int kAbove = 4; // from 15 to 75 degrees
  const Vec3 u = anyPerpendicular(up);
  const Vec3 v = cross(up, u);
  std::bitset<kAround * kAbove> hit;
  for (std::int64_t i = 0; i < cloud.size(); ++i)
  {
    const Vec3 p = cloud[i];
    const double length = norm(p);
    if (shape.at(i).spacing > 0.0F && length > 0.0)
    {
      const double above = std::asin(std::clamp(dot(p, up) / length, -1.0, 1.0)) / kDegree;
      const double around = std::atan2(dot(p, v), dot(p, u)) / kDegree + 180.0;
      if (above >= 15.0 && above < 75.0)
      {
        const int column = std::min(kAround - 1, int(around / 15.0));
        hit.set(std::size_t(column * kAbove + int((above - 15.0) / 15.0)));
      }
    }
  }
  return double(hit.count()) > kIndoorCells * kAround * kAbove;
}

bool facesUp(const PointView& cloud, const LocalShape& shape, const Vec3& up)
{
  double sum = 0.0;
  double weight = 0.0;
  forSample(cloud, shape,
    [&](const Vec3&, const PointShape& each)
    {
      sum += double(each.flatness) * std::abs(dot(normalOf(each), up));
      weight += double(each.flatness);
    });
  return weight > 0.0 && sum > kTerrainUp * weight;
}

/// Finds the direction of the cloud's longer horizontal axis, and returns how much more it varies than the
/// other.
double horizontalStrip(const PointView& cloud, const LocalShape& shape, const Vec3& up, Vec3& along)
{
  const Vec3 u = anyPerpendicular(up);
  const Vec3 v = cross(up, u);
  double n = 0.0;
  Vec3 sum;
  SymMat3 moments;
  Vec3 origin;
  forSample(cloud, shape,
    [&](const Vec3& p, const PointShape&)
    {
      origin = n == 0.0 ? p : origin; // coordinates may be large
      const Vec3 q{ dot(p - origin, u), dot(p - origin, v), 0.0 };
      n += 1.0;
      sum += q;
      moments += outerProduct(q);
    });
  if (n < 2.0)
  {
    return 1.0;
  }
  SymMat3 mean = outerProduct(sum);
  mean *= -1.0 / n;
  moments += mean;
  const double middle = 0.5 * (moments.xx + moments.yy);
  const double radius = std::hypot(0.5 * (moments.xx - moments.yy), moments.xy);
  const double angle = 0.5 * std::atan2(2.0 * moments.xy, moments.xx - moments.yy);
  along = std::cos(angle) * u + std::sin(angle) * v;
  return middle > radius ? (middle + radius) / (middle - radius) : INFINITY;
}

/// Place from which a room was seen: the origin, or its middle, above most that stands in it. A single wall
/// has no inside.
Vec3 sensorOf(const PointView& cloud, const LocalShape& shape, const Vec3& up)
{
  constexpr double kAboveMiddle = 0.3; // over the height
  constexpr double kThin = 0.05;       // shortest side over the longest
  Bounds box;
  forSample(cloud, shape, [&](const Vec3& p, const PointShape&) { box.include(p); });
  const Vec3 size = box.extent();
  const bool isThin = std::min({ size.x, size.y, size.z }) < kThin * std::max({ size.x, size.y, size.z });
  return box.empty() || isThin || isScannedFromOrigin(cloud, shape)
    ? Vec3()
    : box.center() + kAboveMiddle * std::abs(dot(size, up)) * up;
}

/// Mean direction of the walls that the sensor sees.
Vec3 facesOfWalls(const PointView& cloud, const LocalShape& shape, const CloudLook& look)
{
  Vec3 sum;
  forSample(cloud, shape,
    [&](const Vec3& p, const PointShape& each)
    {
      const Vec3 n = normalOf(each);
      sum += (dot(n, p - look.sensor) > 0.0 ? -1.0 : 1.0) * double(each.flatness) * n;
    });
  sum -= dot(sum, look.up) * look.up;
  return normalized(sum, look.front);
}

void lookAtTerrain(CloudLook& look, const PointView& cloud, const LocalShape& shape)
{
  look.elevation = 35.0;
  Vec3 along;
  const double ratio = horizontalStrip(cloud, shape, look.up, along);
  if (ratio > kStripRatio)
  {
    // The long axis runs across the window, its front on the side nearer to the usual one.
    const Vec3 front = cross(along, look.up);
    look.front = dot(front, look.front) < 0.0 ? -1.0 * front : front;
    look.azimuth = 12.0;
    look.tilt = ratio;
  }
}

/// A point of a sample, and whether it lies on a surface.
struct SamplePoint
{
  Vec3 place;
  bool isOnSurface;
};

/// Takes the points out of @p rest that lie on a surface or have company: at least @p fewest points of the
/// rest in 27 cells of this @p edge. Returns their box.
Bounds takeTogether(std::vector<SamplePoint>& rest, const Vec3& corner, double edge, int fewest)
{
  const auto cellOf = [&](const Vec3& p)
  {
    std::int64_t cell = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      cell = (cell << 21) + 1 + std::int64_t((p[axis] - corner[axis]) / edge);
    }
    return cell;
  };
  std::unordered_map<std::int64_t, int> counts;
  for (const SamplePoint& point : rest)
  {
    ++counts[cellOf(point.place)];
  }
  Bounds together;
  const auto isTogether = [&](const SamplePoint& point)
  {
    int count = 0;
    for (int i = 0; i < 27 && count < fewest; ++i)
    {
      const std::int64_t beside =
        (std::int64_t(i / 9 - 1) << 42) + (std::int64_t(i / 3 % 3 - 1) << 21) + i % 3 - 1;
      const auto found = counts.find(cellOf(point.place) + beside);
      count += found == counts.end() ? 0 : found->second;
    }
    const bool takes = point.isOnSurface || count >= fewest;
    takes ? together.include(point.place) : void();
    return takes;
  };
  rest.erase(std::remove_if(rest.begin(), rest.end(), isTogether), rest.end());
  return together;
}

/// Box about the points of a sample that are no floaters. What has no company at the spacing of the cloud may
/// be a sparse part beside a dense one: there the points have company of their own kind in wider cells.
/// Empty: none is a floater, or more are than floaters can be.
Bounds coreOf(const PointView& cloud, const LocalShape& shape)
{
  constexpr double kSpacings = 2.0;        // so a surface has 4 points in a cell
  constexpr int kFewest = 5;               // in 27 cells; a surface has 36 there, a line 6
  constexpr double kSparseSpacings = 16.0; // a line has 48 points in 27 cells, floaters at most 12
  constexpr int kFewestSparse = 30;
  constexpr float kOnSurface = 0.3F;
  constexpr double kMostFloaters = 0.1;
  constexpr double kCells = 1 << 20; // along an axis
  const std::int64_t step = 1 + cloud.size() / kLookedAt;
  const double spacing = shape.medianSpacing * std::sqrt(double(step));
  Bounds all;
  std::vector<SamplePoint> rest;
  for (std::int64_t i = 0; i < cloud.size(); i += step)
  {
    all.include(cloud[i]);
    rest.push_back({ cloud[i], shape.at(i).flatness > kOnSurface });
  }
  const Vec3 size = all.extent();
  if (!(spacing > 0.0) || !(std::max({ size.x, size.y, size.z }) < kCells * kSpacings * spacing))
  {
    return {};
  }
  const double most = kMostFloaters * double(rest.size());
  Bounds core =
    grown(takeTogether(rest, all.minimum, kSpacings * spacing, kFewest), 0.5 * kSpacings * spacing);
  const Bounds sparse = takeTogether(rest, all.minimum, kSparseSpacings * spacing, kFewestSparse);
  if (!sparse.empty())
  {
    // The outskirts are sparser still.
    const Bounds wider = grown(sparse, kSparseSpacings * spacing);
    core.include(wider.minimum);
    core.include(wider.maximum);
  }
  return rest.empty() || double(rest.size()) > most ? Bounds() : core;
}

/// The axes of a view.
struct View
{
  Vec3 right;
  Vec3 up;
  Vec3 back; ///< Axis towards the viewer.
};

View viewOf(const CloudLook& look, const AffineTransform& toWorld, double aspect, double turn)
{
  const Vec3 up = normalized(toWorld.applyToVector(look.up));
  const Vec3 front = toWorld.applyToVector(look.front);
  const Vec3 right = normalized(cross(up, front), anyPerpendicular(up));
  const Vec3 ahead = cross(right, up);
  double elevation = look.elevation;
  if (look.tilt > 0.0)
  {
    elevation = std::clamp(std::asin(std::min(1.0, std::sqrt(look.tilt) / aspect)) / kDegree, 35.0, 55.0);
  }
  const double a = (look.azimuth + turn) * kDegree;
  const double e = elevation * kDegree;
  View view;
  view.back = std::cos(e) * (std::cos(a) * ahead + std::sin(a) * right) + std::sin(e) * up;
  view.right = normalized(cross(up, view.back), right);
  view.up = cross(view.back, view.right);
  return view;
}

/// Extremes of x + tz, -x + tz, y + tz, -y + tz: they decide if a point is in view.
struct Extremes
{
  double most[4] = { -INFINITY, -INFINITY, -INFINITY, -INFINITY };
  void include(const Vec3& p, double tx, double ty)
  {
    most[0] = std::max(most[0], p.x + tx * p.z);
    most[1] = std::max(most[1], -p.x + tx * p.z);
    most[2] = std::max(most[2], p.y + ty * p.z);
    most[3] = std::max(most[3], -p.y + ty * p.z);
  }
  void include(const Extremes& other)
  {
    std::transform(most, most + 4, other.most, most, [](double a, double b) { return std::max(a, b); });
  }
  double distance(double tx, double ty) const
  {
    return std::max((most[0] + most[1]) / (2.0 * tx), (most[2] + most[3]) / (2.0 * ty));
  }
};

constexpr double kViewAngle = 30.0;
constexpr double kFilledPart = 0.92;
constexpr double kStrayFactor = 1.5;

/// Finds the part of a sample without its outskirts on any axis of the view: from, to on each.
void middleOf(std::vector<Vec3>& sample, double share, Vec3& from, Vec3& to)
{
  std::vector<double> values(sample.size());
  for (int axis = 0; axis < 3; ++axis)
  {
    std::transform(sample.begin(), sample.end(), values.begin(), [axis](const Vec3& p) { return p[axis]; });
    from[axis] = valueAt(values, share);
    to[axis] = valueAt(values, 1.0 - share);
  }
}

bool isBetween(const Vec3& p, const Vec3& from, const Vec3& to)
{
  return p.x >= from.x && p.x <= to.x && p.y >= from.y && p.y <= to.y && p.z >= from.z && p.z <= to.z;
}

/// Extremes of @p seen(i) over those of @p count that @p counts(i).
template <typename Seen, typename Counts>
Extremes extremesOf(std::int64_t count, const Seen& seen, const Counts& counts, double tx, double ty)
{
  Extremes extremes;
  std::mutex mutex;
  forRange(SmpExecutor(), count,
    [&](std::int64_t begin, std::int64_t end)
    {
      Extremes part;
      for (; begin < end; ++begin)
      {
        if (counts(begin))
        {
          part.include(seen(begin), tx, ty);
        }
      }
      const std::lock_guard<std::mutex> lock(mutex);
      extremes.include(part);
    });
  return extremes;
}

/// Extremes of the points of @p sample in the box; none for many equal points, which give nothing to fit.
Extremes extremesBetween(
  const std::vector<Vec3>& sample, const Vec3& from, const Vec3& to, double tx, double ty)
{
  Extremes extremes;
  for (const Vec3& p : sample)
  {
    if (isBetween(p, from, to) && !(from == to))
    {
      extremes.include(p, tx, ty);
    }
  }
  return extremes;
}

CameraFit fitFrame(
  const PointView& cloud, const CloudLook& look, const AffineTransform& toWorld, double aspect)
{
  constexpr double kRays = 0.998;
  constexpr double kFilled = 0.985;
  const double ahead = look.front.z > 0.0 ? -1.0 : 1.0; // the sensor looks along z, or against it
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> z;
  for (std::int64_t i = 0; i < cloud.size(); ++i)
  {
    const Vec3 p = cloud[i];
    const double depth = ahead * p.z;
    if (depth > 0.0)
    {
      x.push_back(p.x / depth);
      y.push_back(p.y / depth);
      z.push_back(depth);
    }
  }
  if (z.empty())
  {
    x = y = { 0.0 };
    z = { 1.0 };
  }
  const double cut = 0.5 * (1.0 - kRays);
  const double left = std::atan(valueAt(x, cut));
  const double right = std::atan(valueAt(x, 1.0 - cut));
  const double top = std::atan(valueAt(y, cut));
  const double bottom = std::atan(valueAt(y, 1.0 - cut));
  const double half =
    std::max(std::tan(0.5 * (bottom - top)), std::tan(0.5 * (right - left)) / aspect) / kFilled;
  const Vec3 middle{ std::tan(0.5 * (left + right)), std::tan(0.5 * (top + bottom)), ahead };
  CameraFit fit;
  fit.position = toWorld.apply({ 0.0, 0.0, 0.0 });
  fit.focalPoint = toWorld.apply(valueAt(z, 0.5) * middle);
  fit.up = normalized(toWorld.applyToVector(look.up));
  fit.viewAngle = std::clamp(2.0 * std::atan(half) / kDegree, 1.0, 150.0);
  return fit;
}

} // namespace

const char* cloudKindName(CloudKind kind)
{
  return kKindNames[static_cast<int>(kind)];
}

bool cloudKindFromName(const std::string& name, CloudKind& kind)
{
  for (int i = 0; i < 5; ++i)
  {
    if (name == kKindNames[i])
    {
      kind = static_cast<CloudKind>(i);
      return true;
    }
  }
  return false;
}

std::vector<std::uint32_t> drawnPoints(const PointView& cloud)
{
  std::vector<std::uint32_t> drawn;
  std::vector<std::uint32_t> zeros;
  drawn.reserve(std::size_t(cloud.size()));
  for (std::int64_t i = 0; i < cloud.size(); ++i)
  {
    const Vec3 p = cloud[i];
    if (isFinite(p))
    {
      (isAtZero(p) ? zeros : drawn).push_back(std::uint32_t(i));
    }
  }
  if (!areNoReturns(std::int64_t(zeros.size()), std::int64_t(zeros.size() + drawn.size())))
  {
    drawn.insert(drawn.end(), zeros.begin(), zeros.end());
    std::inplace_merge(drawn.begin(), drawn.end() - std::ptrdiff_t(zeros.size()), drawn.end());
  }
  return drawn;
}

CloudKind cloudKind(const PointView& cloud, const LocalShape& shape, const CloudOrientation& orientation)
{
  if (orientation.fromSensor)
  {
    return CloudKind::Frame;
  }
  if (std::abs(orientation.up.y) > 0.5)
  {
    return CloudKind::Object;
  }
  if (isScannedFromOrigin(cloud, shape))
  {
    return isUnderARoof(cloud, shape, orientation.up) ? CloudKind::Indoors : CloudKind::Sweep;
  }
  return facesUp(cloud, shape, orientation.up)     ? CloudKind::Terrain
    : isFurnishedBox(cloud, shape, orientation.up) ? CloudKind::Indoors
                                                   : CloudKind::Object;
}

CloudLook cloudLook(
  CloudKind kind, const PointView& cloud, const LocalShape& shape, const CloudOrientation& orientation)
{
  CloudLook look;
  look.kind = kind;
  look.up = orientation.up;
  look.front = orientation.front;
  look.noiseLength = 2.0 * shape.noise * shape.medianSpacing;
  look.meanFlatness = shape.meanFlatness;
  look.hasOwnLight = kind == CloudKind::Frame;
  switch (kind)
  {
    case CloudKind::Object:
      look.core = coreOf(cloud, shape);
      break;
    case CloudKind::Terrain:
      look.core = coreOf(cloud, shape);
      lookAtTerrain(look, cloud, shape);
      break;
    case CloudKind::Sweep:
    case CloudKind::Indoors:
      look.sensor = kind == CloudKind::Indoors ? sensorOf(cloud, shape, look.up) : Vec3();
      look.front = facesOfWalls(cloud, shape, look);
      look.azimuth = 0.0;
      look.elevation = 40.0;
      look.hidesBackFaces = kind == CloudKind::Indoors;
      look.largestPixels = kind == CloudKind::Sweep ? 8.0 : 16.0;
      look.strayShare = kind == CloudKind::Sweep ? 0.06 : 0.03;
      look.cutsSparse = true;
      break;
    case CloudKind::Frame:
      look.azimuth = look.elevation = 0.0;
      look.noisePerDistance = 0.04;
      break;
  }
  return look;
}

CameraFit fitCamera(const PointView& cloud, const CloudLook& look, const AffineTransform& toWorld,
  double aspect, double turn, bool parallel)
{
  if (look.kind == CloudKind::Frame && cloud.size() > 0 && !parallel)
  {
    return fitFrame(cloud, look, toWorld, aspect);
  }
  const View view = viewOf(look, toWorld, aspect, turn);
  const double tangent = kFilledPart * std::tan(0.5 * kViewAngle * kDegree);
  const double ty = parallel ? 0.0 : tangent; // rays that do not diverge
  const double tx = ty * aspect;
  const auto seen = [&](std::int64_t i)
  {
    const Vec3 q = toWorld.apply(cloud[i]);
    return Vec3{ dot(q, view.right), dot(q, view.up), dot(q, view.back) };
  };
  const auto isInCore = [&](std::int64_t i) { return contains(look.core, cloud[i]); };
  const bool hasCore = !look.cutsSparse && !look.core.empty();
  Extremes extremes = hasCore ? extremesOf(cloud.size(), seen, isInCore, tx, ty) : Extremes();
  if (!std::isfinite(extremes.most[0])) // no core, or nothing of it is left
  {
    extremes = extremesOf(
      cloud.size(), seen, [](std::int64_t) { return true; }, tx, ty);
  }
  std::vector<Vec3> sample;
  for (std::int64_t i = 0; i < cloud.size(); i += 1 + cloud.size() / kLookedAt)
  {
    sample.push_back(seen(i));
  }
  CameraFit fit;
  fit.viewAngle = kViewAngle;
  fit.up = view.up;
  if (sample.empty())
  {
    fit.position = view.back;
    return fit;
  }
  Vec3 from;
  Vec3 to;
  middleOf(sample, look.strayShare, from, to);
  // The camera turns about the focal point.
  const double depth = 0.5 * (from.z + to.z);
  const auto distanceOf = [&](const Extremes& each)
  { return parallel ? depth + each.distance(tangent * aspect, tangent) : each.distance(tx, ty); };
  if (look.cutsSparse)
  {
    const Extremes middle = extremesBetween(sample, from, to, tx, ty);
    const bool isSmall = distanceOf(extremes) - depth >= kStrayFactor * (distanceOf(middle) - depth);
    extremes = std::isfinite(middle.most[0]) && isSmall ? middle : extremes;
  }
  const double ofPoints = distanceOf(extremes) - depth;
  const double disc = look.discRadius * std::cbrt(std::abs(toWorld.determinant()));
  const double ofDiscs = kFilledPart * (ofPoints + disc / (tangent * std::min(1.0, aspect)));
  const double distance = depth + std::max({ ofPoints, ofDiscs, 1e-6 * (1.0 + std::abs(depth)) });
  const double x = 0.5 * (extremes.most[0] - extremes.most[1]);
  const double y = 0.5 * (extremes.most[2] - extremes.most[3]);
  const auto place = [&](double z) { return x * view.right + y * view.up + z * view.back; };
  fit.position = place(distance);
  fit.focalPoint = place(depth);
  return fit;
}

} // namespace pointhaptics
