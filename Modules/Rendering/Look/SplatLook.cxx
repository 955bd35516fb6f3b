#include "SplatLook.h"

#include "CloudParts.h"
#include "SmpExecutor.h"
#include "vtkSplatMapper.h"

#include "Core/Resample/TransformedBounds.h"

#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkShortArray.h"
#include "vtkUnsignedShortArray.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace pointhaptics
{
namespace
{

/// Diameter of a splat over the spacing where nothing is flat; and the addition where it is.
constexpr double kPointDiameter = 1.1;
constexpr double kFlatDiameter = 1.1;
/// Diameter of a splat over the spacing of the rays of a frame, flat or not: the rays lie in a grid, whose
/// diagonals must close.
constexpr double kGridDiameter = 1.5;
/// Radius of a disc over its reach: discs that just meet leave holes where the surface bends.
constexpr double kOverlap = 1.1;
constexpr double kSmallestShownPixels = 2.0;
/// The pixels bound the splats, not the median of their lengths: a sweep is sparse far away.
constexpr double kFarthestRatio = 1e6;
/// An object is a surface from this mean flatness on.
constexpr double kSurfaceFlatness = 0.63;
/// Gaps up to this many median spacings are closed where a surface is not flat.
constexpr double kWidestGap = 3.0;
/// Over the widest gap: a point farther from its neighbours closes nothing where nothing is flat.
constexpr double kApart = 2.0;
/// Height, pixels, of the window that the first picture is computed for.
constexpr double kUsualHeight = 800.0;
/// Clouds of more points are sampled: one point is measured in every place that the first picture can show.
constexpr std::int64_t kAllMeasured = 3000000;
constexpr double kSharedPixels = 0.5;

/// Radius of a Gaussian splat that is drawn, in standard deviations.
constexpr double kDeviations = 1.5;
/// Parts of an octave in which growths are kept.
constexpr double kSplatGrowthStep = 1024.0;
/// Depths of discs of one bent surface differ by this part of their median diameter.
constexpr double kStepsOfSplats = 0.15;

/// Usual diameter for a spacing.
double usualDiameter(double flatness, double spacing)
{
  return (kPointDiameter + kFlatDiameter * flatness) * spacing;
}

/// The disc that is drawn for a Gaussian splat.
struct OwnDisc
{
  double diameter = 0.0;
  double flatness = 0.0; ///< 1: a plane; 0: its two short axes are alike.
  Vec3 normal;
};

OwnDisc discOf(vtkDataArray* scales, vtkDataArray* turns, vtkIdType i)
{
  const bool isOfBytes = turns->GetDataType() == VTK_UNSIGNED_CHAR; // of a .splat, with lengths
  Vec3 lengths;
  double q[4]; // w, x, y, z
  scales->GetTuple(i, &lengths.x);
  turns->GetTuple(i, q);
  int order[3] = { 0, 1, 2 };
  double size = 0.0;
  for (int k = 0; k < 4; ++k)
  {
    q[k] = isOfBytes ? (q[k] - 128.0) / 128.0 : q[k];
    size += q[k] * q[k];
  }
  for (int axis = 0; axis < 3 && !isOfBytes; ++axis)
  {
    lengths[axis] = std::exp(lengths[axis]);
  }
  std::sort(order, order + 3, [&lengths](int a, int b) { return lengths[a] < lengths[b]; });
  OwnDisc disc;
  const double longest = lengths[order[2]];
  if (!(size > 0.0) || !(longest > 0.0) || !std::isfinite(longest * size))
  {
    return disc;
  }
  disc.diameter = 2.0 * kDeviations * std::sqrt(longest * lengths[order[1]]);
  disc.flatness = lengths[order[1]] > 0.0 ? 1.0 - lengths[order[0]] / lengths[order[1]] : 0.0;
  // The column of the rotation's matrix.
  const int k = order[0];
  const Vec3 v{ q[1], q[2], q[3] };
  Vec3 axis;
  axis[k] = 1.0;
  disc.normal = normalized((q[0] * q[0] - norm2(v)) * axis + 2.0 * v[k] * v + 2.0 * q[0] * cross(v, axis));
  return disc;
}

} // namespace

bool measureCloud(const PointView& cloud, const CloudOrientation& orientation,
  const std::optional<CloudKind>& kind, MeasuredCloud& measured, ProgressObserver* observer)
{
  const SmpExecutor executor;
  measured.query.build(cloud, executor);
  LocalShapeSettings settings;
  const Vec3 extent = transformedBounds(cloud, AffineTransform(), executor).extent();
  settings.pixel = std::max({ extent.x, extent.y, extent.z }) / kUsualHeight;
  if (cloud.size() > kAllMeasured)
  {
    settings.apart = kSharedPixels * settings.pixel;
  }
  LocalShape& shape = measured.shape;
  if (measureLocalShape(cloud, measured.query, settings, shape, executor, observer) != Status::Ok)
  {
    return false;
  }
  const CloudKind decided = kind ? *kind : cloudKind(cloud, shape, orientation);
  measured.look = cloudLook(decided, cloud, shape, orientation);
  if (decided == CloudKind::Frame)
  {
    spaceByRays(cloud, shape);
  }
  measured.look.closesAll =
    decided == CloudKind::Frame || (decided == CloudKind::Object && shape.meanFlatness > kSurfaceFlatness);
  return true;
}

void spaceByRays(const PointView& cloud, LocalShape& shape)
{
  std::vector<double> angles;
  for (std::int64_t i = 0; i + 1 < cloud.size(); ++i)
  {
    const Vec3 a = cloud[i];
    const Vec3 b = cloud[i + 1];
    if (isFinite(a) && isFinite(b) && a.z * b.z > 0.0)
    {
      angles.push_back(std::hypot(a.x / a.z - b.x / b.z, a.y / a.z - b.y / b.z));
    }
  }
  const auto median = angles.begin() + std::ptrdiff_t(angles.size() / 2);
  std::nth_element(angles.begin(), median, angles.end());
  const double angle = angles.empty() ? 0.0 : *median;
  for (std::int64_t i = 0; angle > 0.0 && i < cloud.size(); ++i)
  {
    PointShape& each = shape.points[std::size_t(i)];
    each.spacing = each.spacing > 0.0F ? float(angle * std::abs(cloud[i].z)) : 0.0F;
    each.reach = 0.0F;
  }
}

void takeOwnShapes(vtkPolyData* cloud, const std::vector<std::uint32_t>& drawn, MeasuredCloud& measured)
{
  vtkPointData* data = cloud->GetPointData();
  vtkDataArray* normals = data->GetNormals();
  vtkDataArray* scales = data->GetArray("scale");
  vtkDataArray* turns = data->GetArray("rot") ? data->GetArray("rot") : data->GetArray("rotation");
  const bool areSplats =
    scales && turns && scales->GetNumberOfComponents() == 3 && turns->GetNumberOfComponents() == 4;
  vtkDataArray* logits = data->GetArray("opacity");
  vtkDataArray* colors = data->GetArray("RGBA");
  // A splat that is nowhere half opaque is no wall, however large it is: it is drawn as a point.
  const auto isOpaque = [&](vtkIdType of)
  { return logits ? logits->GetComponent(of, 0) >= 0.0 : !colors || colors->GetComponent(of, 3) >= 127.5; };
  std::vector<PointShape>& shapes = measured.shape.points;
  std::vector<float> own;
  std::size_t splats = 0;
  measured.diameters.resize(areSplats ? shapes.size() : 0);
  for (std::size_t i = 0; i < shapes.size() && (areSplats || normals); ++i)
  {
    const auto of = vtkIdType(drawn.empty() ? i : drawn[i]);
    Vec3 normal{ double(shapes[i].normal[0]), double(shapes[i].normal[1]), double(shapes[i].normal[2]) };
    // A cloud that is joined with splats has neither scales nor rotations.
    const OwnDisc disc = areSplats ? discOf(scales, turns, of) : OwnDisc();
    splats += disc.diameter > 0.0;
    if (disc.diameter > 0.0 && isOpaque(of))
    {
      const double most = 2.0 * double(PointShape::kLargestReach) * double(shapes[i].spacing);
      const double least = std::max(2.0 * kOverlap * double(shapes[i].reach), // where it closes a surface
        double(shapes[i].flatness) * usualDiameter(1.0, double(shapes[i].spacing)));
      measured.diameters[i] = float(std::max(std::min(disc.diameter, most), least));
      own.push_back(measured.diameters[i]);
      shapes[i].flatness = float(disc.flatness);
      normal = disc.normal;
    }
    else if (normals)
    {
      Vec3 given;
      normals->GetTuple(of, &given.x);
      normal = normalized(given, normal);
    }
    std::copy(&normal.x, &normal.x + 3, shapes[i].normal);
  }
  if (2 * splats > shapes.size()) // most are splats
  {
    measured.look.closesAll = measured.look.hasOwnLight = true;
    own.push_back(0.0F); // where all are faint
    const auto median = own.begin() + std::ptrdiff_t(own.size() / 2);
    std::nth_element(own.begin(), median, own.end());
    measured.look.noiseLength = std::max(measured.look.noiseLength, kStepsOfSplats * double(*median));
  }
}

void addSplats(vtkPolyData* points, const MeasuredCloud& measured)
{
  const LocalShape& shape = measured.shape;
  const CloudLook& look = measured.look;
  std::vector<Vec3> copy;
  const PointView places = viewOf(points, copy);
  const bool isFrame = look.kind == CloudKind::Frame;
  const bool facesSensor = look.kind == CloudKind::Sweep || look.kind == CloudKind::Indoors;
  const double widest = kWidestGap * shape.medianSpacing;
  const vtkIdType count = points->GetNumberOfPoints();
  vtkNew<vtkFloatArray> lengths;
  lengths->SetName(kSplatLengthName);
  lengths->SetNumberOfValues(count);
  vtkNew<vtkShortArray> normals;
  normals->SetName(kSplatNormalName);
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(count);
  vtkNew<vtkUnsignedShortArray> growths;
  growths->SetName(kSplatGrowthName);
  growths->SetNumberOfValues(count);
  const auto addOne = [&](std::int64_t i)
  {
    const PointShape& each = shape.points[std::size_t(i)];
    const double spacing = double(each.spacing);
    const double usual = usualDiameter(double(each.flatness), spacing);
    // Where all is closed, what is no surface and beyond the widest gap is the smaller the farther it is
    // apart: a floater is no wall.
    const bool isApart = look.closesAll && !isFrame && spacing > kApart * widest;
    const double surface = std::clamp(2.0 * double(each.flatness) - 0.6, 0.0, 1.0);
    const double filled = isApart ? kApart * widest * widest / spacing : std::min(spacing, widest);
    const double bounded =
      usualDiameter(double(each.flatness), isApart ? std::max(filled, surface * spacing) : spacing);
    const double least = isFrame ? kGridDiameter * spacing
      : look.closesAll           ? usualDiameter(1.0, filled)
                                 : 0.0;
    const double closed = isApart ? surface : look.closesAll ? 1.0 : double(each.flatness);
    const double own = measured.diameters.empty() ? 0.0 : double(measured.diameters[std::size_t(i)]);
    const double length =
      own > 0.0 ? own : std::max({ bounded, least, 2.0 * kOverlap * closed * double(each.reach) });
    lengths->SetValue(i, float(length));
    const double octaves = usual > 0.0 && length > 0.0 ? std::log2(length / usual) : 0.0;
    growths->SetValue(i,
      static_cast<unsigned short>(std::lround(kSplatGrowthStep * (32.0 + std::clamp(octaves, -32.0, 31.0)))));
    const Vec3 n{ double(each.normal[0]), double(each.normal[1]), double(each.normal[2]) };
    const double side = facesSensor && dot(n, places[i] - look.sensor) > 0.0 ? -1.0 : 1.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      normals->SetValue(3 * i + axis,
        short(std::lround(side * kSplatNormalUnit * std::clamp(double(each.flatness) * n[axis], -1.0, 1.0))));
    }
  };
  forRange(SmpExecutor(), count,
    [&addOne](std::int64_t begin, std::int64_t end)
    {
      for (; begin < end; ++begin)
      {
        addOne(begin);
      }
    });
  points->GetPointData()->AddArray(lengths);
  points->GetPointData()->AddArray(growths);
  points->GetPointData()->AddArray(normals);
}

void setUpSplats(vtkSplatMapper* mapper, const CloudLook& look)
{
  SplatSettings& settings = mapper->Settings();
  settings.sizeArray = kSplatLengthName;
  settings.sizeScale = 1.0;
  settings.largestRatio = kFarthestRatio;
  settings.smallestPixels = kSmallestShownPixels;
  settings.largestPixels = look.largestPixels;
  settings.normalArray = kSplatNormalName;
  settings.normalUnit = kSplatNormalUnit;
  settings.ambientLight = settings.surfaces = true;
  settings.hidesBackFaces = look.hidesBackFaces;
  settings.closesAll = look.closesAll;
  settings.foreshortens = look.kind != CloudKind::Frame;
}

void addDensity(vtkPolyData* points)
{
  vtkDataArray* lengths = points->GetPointData()->GetArray(kSplatLengthName);
  vtkDataArray* normals = points->GetPointData()->GetArray(kSplatNormalName);
  vtkDataArray* growths = points->GetPointData()->GetArray(kSplatGrowthName);
  if (!lengths || !normals || !growths)
  {
    return; // not measured yet
  }
  vtkNew<vtkFloatArray> density;
  density->SetName("Density");
  density->SetNumberOfValues(points->GetNumberOfPoints());
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    Vec3 n;
    normals->GetTuple(i, &n.x);
    const double usual = std::abs(lengths->GetComponent(i, 0)) *
      std::exp2(32.0 - growths->GetComponent(i, 0) / kSplatGrowthStep);
    const double spacing = usual / usualDiameter(norm(n) / kSplatNormalUnit, 1.0);
    density->SetValue(i, spacing > 0.0 ? float(1.0 / (spacing * spacing)) : NAN);
  }
  points->GetPointData()->AddArray(density);
}

} // namespace pointhaptics
