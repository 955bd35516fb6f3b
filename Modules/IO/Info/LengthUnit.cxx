#include "IO/Info/LengthUnit.h"

#include "IO/Info/FieldText.h"

#include "Core/Base/Boxes.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtksys/SystemTools.hxx"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

namespace pointhaptics
{
namespace
{

/// Map coordinates have at least six digits before the point.
constexpr double kMapCoordinate = 1e5;
/// Longest side of a thing that is measured in millimetres: from a teapot to a lorry.
constexpr double kSmallestThing = 100.0;
constexpr double kLargestThing = 1e4;
/// Shortest over longest side of a thing; of streets, terrain and rooms it is less where the scanner stands
/// within.
constexpr double kCompact = 0.2;
constexpr double kCompactAboutOrigin = 0.45;

bool has(const std::string& text, const char* part)
{
  return text.find(part) != std::string::npos;
}

/// As findLengthUnit(), and degrees. False: none is known.
bool findUnit(const std::string& name, LengthUnit& unit)
{
  const NamedUnit* found = findLengthUnit(name);
  const bool isDegree = has(vtksys::SystemTools::LowerCase(name), "degree");
  unit = isDegree ? LengthUnit{ "deg", 1.0, UnitEvidence::File }
    : found       ? LengthUnit{ found->name, found->metres, UnitEvidence::File }
                  : unit;
  return isDegree || found;
}

/// True if a point array of @p cloud has one of these words in its name.
template <std::size_t Count>
bool hasArray(vtkPolyData* cloud, const char* const (&words)[Count])
{
  vtkPointData* data = cloud->GetPointData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    const std::string name =
      vtksys::SystemTools::LowerCase(data->GetArrayName(i) ? data->GetArrayName(i) : "");
    if (std::any_of(words, words + Count, [&](const char* word) { return has(name, word); }))
    {
      return true;
    }
  }
  return false;
}

bool isThing(vtkPolyData* cloud, const Bounds& bounds)
{
  constexpr const char* kMeasured[] = { "intensity", "reflectivity", "reflectance" };
  const Vec3 size = bounds.extent();
  const double longest = std::max({ size.x, size.y, size.z });
  const double shortest = std::min({ size.x, size.y, size.z });
  bool isAboutOrigin = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    isAboutOrigin = isAboutOrigin && bounds.minimum[axis] < 0.0 && bounds.maximum[axis] > 0.0;
  }
  return longest >= kSmallestThing && longest <= kLargestThing &&
    shortest >= (isAboutOrigin ? kCompactAboutOrigin : kCompact) * longest && !hasArray(cloud, kMeasured);
}

/// A copy of @p cloud with field data of its own, whose points @p move places, as doubles in @p unit. What
/// tells of the file's own coordinates is left out.
template <typename Move>
vtkSmartPointer<vtkPolyData> movedCloud(vtkPolyData* cloud, const std::string& unit, const Move& move)
{
  vtkNew<vtkFieldData> fields;
  fields->ShallowCopy(cloud->GetFieldData());
  for (const char* ofTheFile :
    { "LengthUnit", kHeightUnit, "CoordinateSystem", "LasScale", "LasOffset", "LasHeader", "LasRecords" })
  {
    fields->RemoveArray(ofTheFile);
  }
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(cloud->GetNumberOfPoints());
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    Vec3 p;
    cloud->GetPoint(i, &p.x);
    p = move(p);
    points->SetPoint(i, &p.x);
  }
  auto moved = vtkSmartPointer<vtkPolyData>::New();
  moved->ShallowCopy(cloud);
  moved->SetFieldData(fields);
  moved->SetPoints(points);
  io::addFieldText(moved, "LengthUnit", unit);
  return moved;
}

} // namespace

const NamedUnit* findLengthUnit(const std::string& name)
{
  const std::string said = vtksys::SystemTools::LowerCase(name);
  const auto isCalled = [&](const NamedUnit& unit)
  {
    return said == unit.name || said == vtksys::SystemTools::LowerCase(unit.word) ||
      (!said.empty() && has(" " + std::string(unit.others) + " ", (" " + said + " ").c_str()));
  };
  const auto* found = std::find_if(std::begin(kLengthUnits), std::end(kLengthUnits), isCalled);
  if (found != std::end(kLengthUnits))
  {
    return found;
  }
  const auto hasWord = [&](const std::string& word)
  {
    const std::size_t at = said.find(word);
    const auto isLetter = [&](std::size_t i)
    { return i < said.size() && std::isalpha(static_cast<unsigned char>(said[i])); };
    return at != std::string::npos && !(at > 0 && isLetter(at - 1)) && !isLetter(at + word.size());
  };
  const bool isFoot = hasWord("foot") || hasWord("feet") || (hasWord("ft") && hasWord("us"));
  return isFoot ? findLengthUnit(has(said, "survey") || hasWord("us") ? "US survey foot" : "foot") : nullptr;
}

LengthUnit lengthUnitOf(vtkPolyData* cloud, const Bounds& bounds)
{
  constexpr const char* kLidar[] = { "classification", "returnnumber", "gpstime", "gps_time", "ring",
    "timestamp" };
  LengthUnit unit;
  if (!cloud || findUnit(io::fieldText(cloud->GetFieldData(), "LengthUnit"), unit) || bounds.empty())
  {
    return unit;
  }
  const Vec3 size = bounds.extent();
  const double farthest = std::max({ std::abs(bounds.minimum.x), std::abs(bounds.maximum.x),
    std::abs(bounds.minimum.y), std::abs(bounds.maximum.y) });
  const bool isMap = farthest > kMapCoordinate && std::max({ size.x, size.y, size.z }) < farthest;
  if (isMap || hasArray(cloud, kLidar))
  {
    return { "m", 1.0, UnitEvidence::Shape };
  }
  return isThing(cloud, bounds) ? LengthUnit{ "mm", 1e-3, UnitEvidence::Shape } : unit;
}

std::string contradictedUnit(const std::string& file, vtkPolyData* cloud, const std::string& chosen)
{
  const LengthUnit own = lengthUnitOf(cloud, Bounds());
  return own.evidence == UnitEvidence::File && own.name != chosen ? file +
      ": the file says that its unit is " + own.name + ", and " + chosen + " is taken; check which is right"
                                                                  : std::string();
}

bool looksLikeDegrees(vtkPolyData* cloud)
{
  constexpr vtkIdType kLookedAt = 1000; // each read pays for them
  constexpr double kSteep = 20.0;       // least height in metres over extent in degrees, of flat land
  constexpr double kFar = 3.0;          // place over extent
  constexpr double kPerCell = 8.0;
  constexpr double kLevel = 0.25; // variance of z in the cells over that of all
  constexpr double kArea = 3.0;   // cells with points over those along a side: a line has up to 2
  if (!cloud->GetPoints() || lengthUnitOf(cloud, Bounds()).evidence != UnitEvidence::None)
  {
    return false;
  }
  std::vector<Vec3> points;
  Bounds box;
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); i += 1 + cloud->GetNumberOfPoints() / kLookedAt)
  {
    Vec3 p;
    cloud->GetPoint(i, &p.x);
    isFinite(p) && !isAtZero(p) ? points.push_back(p), box.include(p) : void();
  }
  const Vec3 size = box.extent();
  const double extent = std::max(size.x, size.y);
  if (!(extent > 0.0) || size.z < kSteep * extent || box.minimum.x < -180.0 || box.maximum.x > 360.0 ||
    box.minimum.y < -90.0 || box.maximum.y > 90.0 ||
    std::max(std::abs(box.center().x), std::abs(box.center().y)) < kFar * extent)
  {
    return false;
  }
  const double side = std::sqrt(static_cast<double>(points.size()) / kPerCell);
  const double perLength = side / extent;
  const auto squares = [](const Vec3& sums) { return sums.z - sums.y * sums.y / sums.x; };
  std::map<std::pair<int, int>, Vec3> cells; // sums of 1, z and its square
  Vec3 all;
  for (const Vec3& p : points)
  {
    const Vec3 place = p - box.minimum;
    const double z = place.z - 0.5 * size.z;
    Vec3& cell = cells[{ int(perLength * place.x), int(perLength * place.y) }];
    cell += Vec3{ 1.0, z, z * z };
    all += Vec3{ 1.0, z, z * z };
  }
  double within = 0.0;
  for (const auto& [place, sums] : cells)
  {
    within += squares(sums);
  }
  return static_cast<double>(cells.size()) > kArea * side && within < kLevel * squares(all);
}

vtkSmartPointer<vtkPolyData> inLocalMetres(vtkPolyData* cloud, bool isGuessed)
{
  constexpr double kRadian = 3.14159265358979323846 / 180.0;
  constexpr double kMetresPerDegree = 6371008.8 * kRadian;
  if (!cloud || !cloud->GetPoints() ||
    (lengthUnitOf(cloud, Bounds()).name != "deg" && !(isGuessed && looksLikeDegrees(cloud))))
  {
    return cloud;
  }
  const auto medianOf = [&](int axis)
  {
    std::vector<double> finite;
    for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
    {
      Vec3 p;
      cloud->GetPoint(i, &p.x);
      std::isfinite(p[axis]) && !isAtZero(p) ? finite.push_back(p[axis]) : void();
    }
    const auto median = finite.begin() + std::ptrdiff_t(finite.size() / 2);
    std::nth_element(finite.begin(), median, finite.end());
    return finite.empty() ? 0.0 : *median;
  };
  const double middle[2] = { medianOf(0), medianOf(1) };
  const double metres[2] = { kMetresPerDegree * std::cos(kRadian * middle[1]), kMetresPerDegree };
  vtkNew<vtkDoubleArray> frame;
  frame->SetName(kLocalFrame);
  const NamedUnit* height = findLengthUnit(io::fieldText(cloud->GetFieldData(), kHeightUnit));
  for (const double number : { middle[0], middle[1], metres[0], metres[1], height ? height->metres : 1.0 })
  {
    frame->InsertNextValue(number);
  }
  vtkNew<vtkPolyData> framed;
  framed->GetFieldData()->AddArray(frame);
  auto local =
    movedCloud(cloud, "metre", [&](const Vec3& p) { return isAtZero(p) ? p : toLocalFrame(framed, p); });
  local->GetFieldData()->AddArray(frame);
  return local;
}

vtkSmartPointer<vtkPolyData> scaledCloud(vtkPolyData* cloud, double factor, const std::string& unit)
{
  return movedCloud(cloud, unit, [factor](const Vec3& p) { return factor * p; });
}

std::string lengthUnitCalled(const std::string& name)
{
  LengthUnit unit;
  return findUnit(name, unit) ? unit.name : std::string();
}

Vec3 toLocalFrame(vtkPolyData* cloud, const Vec3& place)
{
  vtkDataArray* frame = cloud->GetFieldData()->GetArray(kLocalFrame);
  return !frame ? place
                : Vec3{ frame->GetTuple1(2) * std::remainder(place.x - frame->GetTuple1(0), 360.0),
                    frame->GetTuple1(3) * (place.y - frame->GetTuple1(1)), place.z * frame->GetTuple1(4) };
}

Vec3 fromLocalFrame(vtkPolyData* cloud, const Vec3& place)
{
  vtkDataArray* frame = cloud->GetFieldData()->GetArray(kLocalFrame);
  return !frame ? place
                : Vec3{ place.x / frame->GetTuple1(2) + frame->GetTuple1(0),
                    place.y / frame->GetTuple1(3) + frame->GetTuple1(1), place.z / frame->GetTuple1(4) };
}

} // namespace pointhaptics
