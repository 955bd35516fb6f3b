#include "MergedCloud.h"

#include "Bytes/NumericType.h"
#include "Core/Base/FieldNames.h"
#include "FileProblem.h"
#include "IO/Columns/CloudColumns.h"
#include "IO/Info/FieldText.h"
#include "IO/Info/LengthUnit.h"

#include <fmt/format.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkVariant.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace pointhaptics::io
{

namespace
{

/// True of one cloud, never of several.
constexpr const char* kOfOneCloud[] = { "OrganizedDimensions", "ScanNames", "ScanPoints", "ScanPoses",
  "Chunks" };

/// The writer finds another grid, and says so where that rounds.
constexpr const char* kOfOneGrid[] = { "LasScale", "LasOffset" };

struct MergedArray
{
  std::string name;
  int type = VTK_DOUBLE;
  int components = 1;
  std::vector<vtkDataArray*> sources; ///< One a cloud; null where it has none.
};

MergedArray& arrayFor(std::vector<MergedArray>& arrays, vtkDataArray* source, std::size_t clouds)
{
  const std::string given = source->GetName() ? source->GetName() : "unnamed";
  const int components = source->GetNumberOfComponents();
  const auto named = [&](const std::string& name)
  {
    return std::find_if(
      arrays.begin(), arrays.end(), [&](const MergedArray& array) { return array.name == name; });
  };
  std::string name = given;
  auto found = named(name);
  while (found != arrays.end() && found->components != components)
  {
    name += fmt::format("_{}", components);
    found = named(name);
  }
  if (found != arrays.end())
  {
    found->type = found->type == source->GetDataType() ? found->type : VTK_DOUBLE;
    return *found;
  }
  arrays.push_back({ name, source->GetDataType(), components, std::vector<vtkDataArray*>(clouds, nullptr) });
  return arrays.back();
}

std::vector<MergedArray> planArrays(const std::vector<vtkPolyData*>& clouds, std::vector<std::string>& notes)
{
  std::vector<MergedArray> arrays;
  for (std::size_t i = 0; i < clouds.size(); ++i)
  {
    vtkPointData* data = clouds[i]->GetPointData();
    for (int k = 0; k < data->GetNumberOfArrays(); ++k)
    {
      vtkDataArray* source = data->GetArray(k);
      if (source)
      {
        arrayFor(arrays, source, clouds.size()).sources[i] = source;
      }
      else
      {
        notes.push_back(fmt::format("array {} holds no numbers and is left out",
          data->GetAbstractArray(k)->GetName() ? data->GetAbstractArray(k)->GetName() : "without a name"));
      }
    }
  }
  return arrays;
}

/// "1 of 3 inputs, b.ply,".
std::string lackingInputs(const MergedArray& array, const std::vector<std::string>& names)
{
  constexpr std::size_t kNamed = 3;
  std::vector<std::string> lacking;
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    array.sources[i] ? void() : lacking.push_back(inQuotes(names[i]));
  }
  const auto named = lacking.begin() + std::ptrdiff_t(std::min(kNamed, lacking.size()));
  return lacking.empty() ? std::string()
                         : fmt::format("{} of {} inputs, {}{},", lacking.size(), names.size(),
                             fmt::join(lacking.begin(), named, ", "), lacking.size() > kNamed ? " ..." : "");
}

vtkSmartPointer<vtkDataArray> filled(const MergedArray& array, const std::vector<vtkPolyData*>& clouds,
  const std::vector<std::string>& names, std::vector<std::string>& notes)
{
  const std::string lacking = lackingInputs(array, names);
  // 0 is what LAS and colours have for none, and the usual label of what has none; a double holds no long
  // number.
  const bool hasNone = isFloatingType(array.type) || sizeOfType(array.type) == 8 ||
    isPointField(array.name) || isColorName(array.name) || isSameField(array.name, "RGBA") ||
    std::any_of(std::begin(kLabelFields), std::end(kLabelFields),
      [&](const char* label) { return isLabelField(array.name, label); });
  const vtkIdType rows = std::accumulate(clouds.begin(), clouds.end(), vtkIdType{ 0 },
    [](vtkIdType sum, vtkPolyData* cloud) { return sum + cloud->GetNumberOfPoints(); });
  const vtkSmartPointer<vtkDataArray> result =
    makeArray(lacking.empty() || hasNone ? array.type : VTK_DOUBLE, array.components, rows, array.name);
  const bool isFloating = isFloatingType(result->GetDataType());
  result->Fill(isFloating ? std::numeric_limits<double>::quiet_NaN() : 0.0);
  vtkIdType begin = 0;
  for (std::size_t i = 0; i < clouds.size(); ++i)
  {
    const vtkIdType count = clouds[i]->GetNumberOfPoints();
    if (array.sources[i])
    {
      result->InsertTuples(begin, count, 0, array.sources[i]);
    }
    begin += count;
  }
  if (!lacking.empty())
  {
    notes.push_back(fmt::format(
      "{} have no {}: their points have {} there", lacking, array.name, isFloating ? "NaN" : "0"));
  }
  return result;
}

bool isSame(vtkAbstractArray* a, vtkAbstractArray* b)
{
  bool same = a && b && a->GetDataType() == b->GetDataType() &&
    a->GetNumberOfValues() == b->GetNumberOfValues() &&
    a->GetNumberOfComponents() == b->GetNumberOfComponents();
  for (vtkIdType i = 0; same && i < a->GetNumberOfValues(); ++i)
  {
    same = a->GetVariantValue(i) == b->GetVariantValue(i);
  }
  return same;
}

template <std::size_t N>
bool isOneOf(const char* const (&names)[N], const std::string& name)
{
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

/// The clouds without GPS times have nothing to say about how these count.
bool isOfAll(const std::vector<vtkPolyData*>& clouds, vtkAbstractArray* field, const std::string& name)
{
  return !isOneOf(kOfOneCloud, name) &&
    std::all_of(clouds.begin(), clouds.end(),
      [&](vtkPolyData* cloud)
      {
        vtkAbstractArray* other = cloud->GetFieldData()->GetAbstractArray(name.c_str());
        return isSame(field, other) || (!other && name == "LasGlobalEncoding");
      });
}

void mergeFieldData(
  const std::vector<vtkPolyData*>& clouds, vtkPolyData* merged, std::vector<std::string>& notes)
{
  std::vector<std::string> lost;
  for (vtkPolyData* from : clouds)
  {
    vtkFieldData* fields = from->GetFieldData();
    for (int i = 0; i < fields->GetNumberOfArrays(); ++i)
    {
      vtkAbstractArray* field = fields->GetAbstractArray(i);
      const std::string name = field->GetName() ? field->GetName() : "";
      if (isOfAll(clouds, field, name))
      {
        merged->GetFieldData()->AddArray(field);
      }
      else if (!isOneOf(kOfOneGrid, name) && std::find(lost.begin(), lost.end(), name) == lost.end())
      {
        lost.push_back(name);
        notes.push_back(fmt::format("field data {} is not that of all inputs and is left out", name));
      }
    }
  }
}

/// As lengthUnitCalled(); empty where it is that of x and y.
std::string heightUnitOf(vtkPolyData* cloud)
{
  return lengthUnitCalled(fieldText(cloud->GetFieldData(), kHeightUnit));
}

/// The clouds in the unit of the first one that says one; none where that cannot be.
std::vector<vtkSmartPointer<vtkPolyData>> inOneUnit(const std::vector<vtkPolyData*>& clouds,
  const std::vector<std::string>& names, std::vector<std::string>& notes)
{
  std::vector<vtkSmartPointer<vtkPolyData>> result;
  vtkPolyData* first = nullptr;
  LengthUnit unit;
  for (std::size_t i = 0; i < clouds.size(); ++i)
  {
    const LengthUnit own = lengthUnitOf(clouds[i], Bounds());
    const bool isSaid = own.evidence == UnitEvidence::File;
    unit = first || !isSaid ? unit : own;
    first = first || !isSaid ? first : clouds[i];
    const bool isUnlike = isSaid && own.metres != unit.metres;
    if (isUnlike && (own.name == "deg" || unit.name == "deg"))
    {
      notes.push_back(fmt::format("{} is in {} and others are in {}, which cannot be one cloud: project "
                                  "degrees to metres first",
        inQuotes(names[i]), own.name, unit.name));
      return {};
    }
    const double factor = own.metres / unit.metres;
    if (heightUnitOf(clouds[i]) != heightUnitOf(clouds[0]) || (isUnlike && !heightUnitOf(clouds[i]).empty()))
    {
      notes.push_back(
        fmt::format("{} and {} cannot be one cloud, as heights are in another unit than x and y: "
                    "convert heights first",
          inQuotes(names[0]), inQuotes(names[i])));
      return {};
    }
    result.emplace_back(clouds[i]);
    if (isSaid && factor != 1.0)
    {
      result.back() = scaledCloud(clouds[i], factor, fieldText(first->GetFieldData(), "LengthUnit"));
    }
    if (isUnlike)
    {
      notes.push_back(fmt::format("the coordinates of {} are converted from {} to {}", inQuotes(names[i]),
                        own.name, unit.name) +
        (clouds[i]->GetPointData()->GetNumberOfArrays() > 0 ? ", its arrays are not" : ""));
    }
  }
  return result;
}

} // namespace

vtkSmartPointer<vtkPolyData> mergeClouds(const std::vector<vtkPolyData*>& given,
  const std::vector<std::string>& names, std::vector<std::string>& notes)
{
  const std::vector<vtkSmartPointer<vtkPolyData>> alike = inOneUnit(given, names, notes);
  if (alike.empty())
  {
    return nullptr;
  }
  const std::vector<vtkPolyData*> clouds(alike.begin(), alike.end());
  auto merged = vtkSmartPointer<vtkPolyData>::New();
  MergedArray coordinates{ "Points", clouds.front()->GetPoints()->GetDataType(), 3, {} };
  for (vtkPolyData* cloud : clouds)
  {
    vtkDataArray* points = cloud->GetPoints()->GetData();
    coordinates.type = coordinates.type == points->GetDataType() ? coordinates.type : VTK_DOUBLE;
    coordinates.sources.push_back(points);
  }
  vtkNew<vtkPoints> points;
  points->SetData(filled(coordinates, clouds, names, notes));
  merged->SetPoints(points);
  for (const MergedArray& array : planArrays(clouds, notes))
  {
    merged->GetPointData()->AddArray(filled(array, clouds, names, notes));
  }
  for (vtkPolyData* cloud : clouds)
  {
    for (const int type : { vtkDataSetAttributes::SCALARS, vtkDataSetAttributes::NORMALS })
    {
      vtkAbstractArray* active = cloud->GetPointData()->GetAbstractAttribute(type);
      active && active->GetName() ? merged->GetPointData()->SetActiveAttribute(active->GetName(), type) : 0;
    }
  }
  mergeFieldData(clouds, merged, notes);
  return merged;
}

} // namespace pointhaptics::io
