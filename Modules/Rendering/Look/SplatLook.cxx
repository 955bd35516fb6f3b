#include "SplatLook.h"

#include "CloudParts.h"
#include "SmpExecutor.h"
#include "vtkSplatMapper.h"

#include "Core/Resample/VoxelMean.h"

#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkShortArray.h"
#include "vtkUnsignedCharArray.h"

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
/// Gaps up to this many median spacings are closed where a surface is not flat: single points beside it stay
/// small.
constexpr double kWidestGap = 3.0;
/// Height, pixels, of the window that the first picture is computed for.
constexpr double kUsualHeight = 800.0;
/// Clouds of more points are sampled: one point is measured in every place that the first picture can show.
constexpr std::int64_t kAllMeasured = 3000000;
constexpr double kSharedPixels = 0.5;

/// Usual diameter for a spacing.
double usualDiameter(double flatness, double spacing)
{
  return (kPointDiameter + kFlatDiameter * flatness) * spacing;
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
    // A few neighbours that are apart reach as far as many that are close.
    settings.apart = kSharedPixels * settings.pixel;
    settings.numberOfNeighbors = LocalShapeSettings::kFewest;
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

void addSplats(vtkPolyData* points, const MeasuredCloud& measured, vtkDataArray* ownNormals)
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
  vtkNew<vtkUnsignedCharArray> growths;
  growths->SetName(kSplatGrowthName);
  growths->SetNumberOfValues(count);
  const auto addOne = [&](std::int64_t i)
  {
    const PointShape& each = shape.points[std::size_t(i)];
    const double usual = usualDiameter(double(each.flatness), double(each.spacing));
    const double least = isFrame ? kGridDiameter * double(each.spacing)
      : look.closesAll           ? usualDiameter(1.0, std::min(double(each.spacing), widest))
                                 : 0.0;
    const double closed = look.closesAll ? 1.0 : double(each.flatness);
    const double length = std::max({ usual, least, 2.0 * kOverlap * closed * double(each.reach) });
    lengths->SetValue(i, float(length));
    growths->SetValue(
      i, static_cast<unsigned char>(usual > 0.0 ? kNoSplatGrowth * length / usual + 0.5 : kNoSplatGrowth));
    Vec3 n{ double(each.normal[0]), double(each.normal[1]), double(each.normal[2]) };
    if (ownNormals)
    {
      Vec3 own;
      ownNormals->GetTuple(i, &own.x);
      n = normalized(own, n);
    }
    const double side = facesSensor && dot(n, places[i]) > 0.0 ? -1.0 : 1.0;
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
    const double usual = std::abs(lengths->GetComponent(i, 0)) * kNoSplatGrowth / growths->GetComponent(i, 0);
    const double spacing = usual / usualDiameter(norm(n) / kSplatNormalUnit, 1.0);
    density->SetValue(i, spacing > 0.0 ? float(1.0 / (spacing * spacing)) : NAN);
  }
  points->GetPointData()->AddArray(density);
}

} // namespace pointhaptics
