#include "OutputColumns.h"

#include "FileProblem.h"
#include "NumericType.h"

#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"

#include <algorithm>
#include <set>

namespace pointhaptics::io
{

namespace
{

/// Contiguous and of a type every writer knows.
vtkSmartPointer<vtkDataArray> inPlainMemory(vtkDataArray* array)
{
  const int type = fixedSizeType(array->GetDataType());
  if (array->HasStandardMemoryLayout() && type != VTK_VOID)
  {
    return array;
  }
  vtkSmartPointer<vtkDataArray> copy;
  copy.TakeReference(vtkDataArray::CreateDataArray(type == VTK_VOID ? VTK_TYPE_UINT8 : type));
  copy->DeepCopy(array);
  return copy;
}

std::string plainName(const char* name)
{
  std::string result = name && *name ? name : "unnamed";
  for (char& c : result)
  {
    if (static_cast<unsigned char>(c) <= ' ' || c == ',' || c == ';' || c == '"' || c == '#')
    {
      c = '_';
    }
  }
  return result;
}

ArrayRole roleOf(vtkDataArray* array, vtkPointData* data)
{
  const std::string name = array->GetName() ? array->GetName() : "";
  const int components = array->GetNumberOfComponents();
  if (array->GetDataType() == VTK_UNSIGNED_CHAR && (components == 3 || components == 4) &&
    (array == data->GetScalars() || name == "RGB" || name == "RGBA"))
  {
    return ArrayRole::Colours;
  }
  if (isFloatingType(array->GetDataType()) && components == 3 &&
    (array == data->GetNormals() || name == "Normals"))
  {
    return ArrayRole::Normals;
  }
  return ArrayRole::Other;
}

/// Only one array may be the colours, and one the normals: the first found; the active one goes first.
void keepFirstOfRole(std::vector<OutputArray>& arrays, ArrayRole role, vtkDataArray* active)
{
  const bool activeHasRole = std::any_of(arrays.begin(), arrays.end(),
    [&](const OutputArray& each) { return each.role == role && each.array == active; });
  bool found = false;
  for (OutputArray& each : arrays)
  {
    if (each.role == role)
    {
      const bool chosen = !found && (!activeHasRole || each.array == active);
      each.role = chosen ? role : ArrayRole::Other;
      found = found || chosen;
    }
  }
}

} // namespace

ConstColumnView OutputArray::column(int component) const
{
  const int size = array->GetDataTypeSize();
  return { static_cast<const char*>(array->GetVoidPointer(0)) + component * size,
    std::ptrdiff_t{ size } * array->GetNumberOfComponents(), array->GetDataType() };
}

std::string OutputArray::componentName(int component) const
{
  return components() == 1 ? name : name + "_" + std::to_string(component);
}

std::vector<OutputArray> outputArrays(vtkPointSet* cloud)
{
  std::vector<OutputArray> arrays;
  arrays.push_back({ ArrayRole::Points, "Points", inPlainMemory(cloud->GetPoints()->GetData()) });
  std::set<std::string> used = { "Points", "x", "y", "z" };
  vtkPointData* data = cloud->GetPointData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = data->GetArray(i);
    if (!array || array->GetNumberOfComponents() < 1)
    {
      continue;
    }
    OutputArray output{ roleOf(array, data), plainName(array->GetName()), inPlainMemory(array) };
    if (array->GetNumberOfTuples() < cloud->GetNumberOfPoints())
    {
      failFormat("array " + inQuotes(output.name) + " has " + std::to_string(array->GetNumberOfTuples()) +
          " values for " + std::to_string(cloud->GetNumberOfPoints()) + " points",
        "give every array one value per point");
    }
    while (!used.insert(output.name).second)
    {
      output.name += "_again";
    }
    arrays.push_back(output);
  }
  keepFirstOfRole(arrays, ArrayRole::Colours, data->GetScalars());
  keepFirstOfRole(arrays, ArrayRole::Normals, data->GetNormals());
  return arrays;
}

std::vector<OutputArray> withoutLongIntegers(std::vector<OutputArray> arrays)
{
  for (OutputArray& each : arrays)
  {
    if (!isFloatingType(each.type()) && sizeOfType(each.type()) == 8)
    {
      vtkSmartPointer<vtkDataArray> copy;
      copy.TakeReference(vtkDataArray::CreateDataArray(VTK_DOUBLE));
      copy->DeepCopy(each.array);
      each.array = copy;
    }
  }
  return arrays;
}

} // namespace pointhaptics::io
