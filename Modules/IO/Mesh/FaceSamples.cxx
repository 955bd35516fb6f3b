#include "IO/Mesh/FaceSamples.h"

#include "Bytes/NumericType.h"
#include "Progress.h"

#include "Core/Base/FieldNames.h"
#include "Core/Base/QuantityText.h"
#include "Core/Neighbors/SpatialOrder.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTriangleFilter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace pointhaptics::io
{

namespace
{

constexpr double kSpacingsPerEdge = 4.0;
constexpr double kFewestSamples = 2e5;
constexpr double kMostSamples = 2e6;
/// Pieces have at most this part of a sample's area, so that each sample has one of its own.
constexpr double kPiecesPerSample = 2.0;
/// A piece smaller than this part of a sample's area is cut no further, however long it is.
constexpr double kSliversPerSample = 8.0;

using Corners = std::array<Vec3, 3>;

struct Triangle
{
  std::array<vtkIdType, 3> vertices;
  Corners corners;

  /// Along the normal.
  Vec3 doubledArea() const { return cross(corners[1] - corners[0], corners[2] - corners[0]); }
  double area() const { return 0.5 * norm(doubledArea()); }
  double weightOf(std::size_t corner, const Vec3& place) const
  {
    const Vec3 opposite = cross(corners[(corner + 1) % 3] - place, corners[(corner + 2) % 3] - place);
    return dot(opposite, doubledArea()) / norm2(doubledArea());
  }
};

using Progress = std::function<void(double)>;

/// Tells @p progress of @p done rows, once in a while.
void tell(const Progress& progress, double begin, double end, vtkIdType done, vtkIdType all)
{
  if (done % kProgressRows == 0)
  {
    progress(begin + (end - begin) * static_cast<double>(done) / static_cast<double>(all));
  }
}

/// The polygons of @p mesh whose corners are all there.
vtkSmartPointer<vtkCellArray> rightFaces(vtkPolyData* mesh)
{
  double range[2];
  mesh->GetPolys()->GetConnectivityArray()->GetRange(range, 0);
  const vtkIdType vertices = mesh->GetNumberOfPoints();
  if (range[0] >= 0.0 && range[1] < double(vertices))
  {
    return mesh->GetPolys();
  }
  auto right = vtkSmartPointer<vtkCellArray>::New();
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < mesh->GetPolys()->GetNumberOfCells(); ++i)
  {
    mesh->GetPolys()->GetCellAtId(i, corners);
    const bool isRight =
      std::all_of(corners->begin(), corners->end(), [=](vtkIdType v) { return v >= 0 && v < vertices; });
    isRight ? void(right->InsertNextCell(corners)) : void();
  }
  return right;
}

/// The faces in triangles, of those that have an area.
std::vector<Triangle> trianglesOf(vtkPolyData* mesh, vtkCellArray* polygons, const Progress& progress)
{
  vtkNew<vtkTriangleFilter> filter;
  vtkNew<vtkPolyData> faces;
  faces->SetPoints(mesh->GetPoints());
  faces->SetPolys(polygons);
  filter->SetInputData(faces);
  filter->Update();
  vtkCellArray* cells = filter->GetOutput()->GetPolys();
  std::vector<Triangle> triangles;
  triangles.reserve(std::size_t(cells->GetNumberOfCells()));
  vtkNew<vtkIdList> vertices;
  for (vtkIdType i = 0; i < cells->GetNumberOfCells(); ++i)
  {
    tell(progress, 0.2, 0.3, i, cells->GetNumberOfCells());
    cells->GetCellAtId(i, vertices);
    Triangle triangle{};
    for (int corner = 0; corner < 3 && vertices->GetNumberOfIds() == 3; ++corner)
    {
      triangle.vertices[std::size_t(corner)] = vertices->GetId(corner);
      mesh->GetPoint(vertices->GetId(corner), &triangle.corners[std::size_t(corner)].x);
    }
    if (const double area = triangle.area(); area > 0.0 && std::isfinite(area))
    {
      triangles.push_back(triangle);
    }
  }
  return triangles;
}

double medianEdge(const std::vector<Triangle>& triangles)
{
  std::vector<double> squared;
  for (const Triangle& triangle : triangles)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      squared.push_back(norm2(triangle.corners[(i + 1) % 3] - triangle.corners[i]));
    }
  }
  const auto median = squared.begin() + std::ptrdiff_t(squared.size() / 2);
  std::nth_element(squared.begin(), median, squared.end());
  return std::sqrt(*median);
}

/// A part of a triangle.
struct Piece
{
  Vec3 middle;
  double area;
  std::size_t triangle;
};

/// Cuts a triangle at the middle of its longest edge until the pieces are small beside the area of a sample.
void cut(
  std::size_t triangle, const Corners& corners, double area, double areaOfSample, std::vector<Piece>& pieces)
{
  std::size_t apex = 0;
  double longest = -1.0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const double squared = norm2(corners[(i + 2) % 3] - corners[(i + 1) % 3]);
    apex = squared > longest ? i : apex;
    longest = std::max(squared, longest);
  }
  const bool isLong = longest > areaOfSample && kSliversPerSample * area > areaOfSample;
  if (!isLong && kPiecesPerSample * area <= areaOfSample)
  {
    pieces.push_back({ (corners[0] + corners[1] + corners[2]) / 3.0, area, triangle });
    return;
  }
  const Vec3 from = corners[(apex + 1) % 3];
  const Vec3 to = corners[(apex + 2) % 3];
  const Vec3 half = 0.5 * (from + to);
  cut(triangle, { corners[apex], from, half }, 0.5 * area, areaOfSample, pieces);
  cut(triangle, { corners[apex], half, to }, 0.5 * area, areaOfSample, pieces);
}

/// The piece of each of @p count samples: of those whose middle along the curve is in the sample's part of
/// the area the one nearest to their common middle.
std::vector<Piece> chosenOf(
  const std::vector<Piece>& pieces, double areaOfSample, vtkIdType count, const Progress& progress)
{
  constexpr std::int64_t kMostPerCell = 16;
  const std::vector<std::uint32_t> order = spatialOrder(
    PointView(&pieces.front().middle.x, std::int64_t(pieces.size()), sizeof(Piece) / sizeof(double)),
    kMostPerCell);
  std::vector<Piece> chosen;
  auto begin = order.begin();
  double done = 0.0;
  for (vtkIdType sample = 1; sample <= count; ++sample)
  {
    tell(progress, 0.7, 0.8, sample, count);
    Vec3 sum;
    const double before = done;
    auto end = begin;
    for (; end != order.end() && done + 0.5 * pieces[*end].area < areaOfSample * double(sample); ++end)
    {
      sum += pieces[*end].area * pieces[*end].middle;
      done += pieces[*end].area;
    }
    const auto distance = [&](std::uint32_t i) { return norm2((done - before) * pieces[i].middle - sum); };
    const auto nearest = std::min_element(
      begin, end, [&](std::uint32_t a, std::uint32_t b) { return distance(a) < distance(b); });
    chosen.push_back(pieces[nearest == order.end() ? order.back() : *nearest]); // rounding may leave none
    begin = end;
  }
  return chosen;
}

bool isLabel(vtkAbstractArray* array)
{
  constexpr const char* kAmounts[] = { "Intensity", "NearInfrared", "Color16", "RGB", "RGBA" };
  const char* name = array->GetName() ? array->GetName() : "";
  return !isFloatingType(array->GetDataType()) &&
    std::none_of(std::begin(kAmounts), std::end(kAmounts),
      [name](const char* amount) { return isSameField(name, amount); });
}

/// Gives @p cloud points, arrays and normals at the middles of the @p chosen pieces.
void takeMiddles(vtkPolyData* cloud, const std::vector<Triangle>& triangles, const std::vector<Piece>& chosen,
  const Progress& progress)
{
  const vtkIdType count = vtkIdType(chosen.size());
  vtkPointData* from = cloud->GetPointData();
  vtkNew<vtkPointData> to;
  to->CopyAllOn();
  to->CopyAllocate(from, count);
  to->SetNumberOfTuples(count);
  vtkNew<vtkPoints> points;
  points->SetDataType(cloud->GetPoints()->GetDataType());
  points->SetNumberOfPoints(count);
  vtkSmartPointer<vtkDataArray> normals = to->GetNormals();
  if (!normals)
  {
    normals = vtkSmartPointer<vtkFloatArray>::New();
    normals->SetName("Normals");
    normals->SetNumberOfComponents(3);
    normals->SetNumberOfTuples(count);
    normals->Fill(0.0);
  }
  vtkNew<vtkIdList> vertices;
  vertices->SetNumberOfIds(3);
  for (vtkIdType i = 0; i < count; ++i)
  {
    tell(progress, 0.8, 1.0, i, count);
    const Piece& piece = chosen[std::size_t(i)];
    const Triangle& triangle = triangles[piece.triangle];
    std::array<double, 3> weights{};
    for (std::size_t corner = 0; corner < 3; ++corner)
    {
      weights[corner] = triangle.weightOf(corner, piece.middle);
      vertices->SetId(vtkIdType(corner), triangle.vertices[corner]);
    }
    const auto nearest = std::max_element(weights.begin(), weights.end()) - weights.begin();
    for (int array = 0; array < to->GetNumberOfArrays(); ++array)
    {
      vtkAbstractArray* source = from->GetAbstractArray(array);
      isLabel(source) ? to->GetAbstractArray(array)->SetTuple(i, vertices->GetId(int(nearest)), source)
                      : to->GetAbstractArray(array)->InterpolateTuple(i, vertices, source, weights.data());
    }
    points->SetPoint(i, &piece.middle.x);
    Vec3 normal;
    normals->GetTuple(i, &normal.x);
    normal = normalized(normal, normalized(triangle.doubledArea()));
    normals->SetTuple(i, &normal.x);
  }
  to->SetNormals(normals);
  cloud->SetPoints(points);
  from->ShallowCopy(to);
}

} // namespace

std::string facesText(std::uint64_t count)
{
  return countText(static_cast<std::int64_t>(count)) + (count == 1 ? " face" : " faces");
}

bool sampleFaces(
  vtkPolyData* cloud, vtkIdType samples, std::uint64_t count, const Progress& progress, std::string& told)
{
  const std::string faces = facesText(count);
  told = "the points are the vertices of " + faces;
  const vtkSmartPointer<vtkCellArray> polygons = rightFaces(cloud);
  const auto right = static_cast<std::uint64_t>(polygons->GetNumberOfCells());
  if (right == 0)
  {
    told += " that name missing ones";
    return false;
  }
  const std::vector<Triangle> triangles = trianglesOf(cloud, polygons, progress);
  double area = 0.0;
  for (const Triangle& triangle : triangles)
  {
    area += triangle.area();
  }
  if (!(area > 0.0 && std::isfinite(area)))
  {
    told += ", which have no area";
    return false;
  }
  if (samples == kAutomaticSamples)
  {
    const double perEdge = kSpacingsPerEdge / medianEdge(triangles);
    samples = vtkIdType(std::clamp(std::ceil(perEdge * perEdge * area), kFewestSamples, kMostSamples));
    if (cloud->GetNumberOfPoints() >= samples)
    {
      told += ", more than samples of them";
      return false;
    }
  }
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    tell(progress, 0.3, 0.5, vtkIdType(i), vtkIdType(triangles.size()));
    cut(i, triangles[i].corners, triangles[i].area(), area / double(samples), pieces);
  }
  takeMiddles(cloud, triangles, chosenOf(pieces, area / double(samples), samples, progress), progress);
  told = countText(samples) + " samples of " + faces;
  if (right < count)
  {
    told += ", but for " + countText(static_cast<std::int64_t>(count - right)) +
      " with missing vertices or fewer than three corners";
  }
  return true;
}

} // namespace pointhaptics::io
