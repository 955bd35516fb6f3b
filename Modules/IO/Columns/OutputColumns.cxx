#include "OutputColumns.h"

#include "Bytes/NumericType.h"
#include "FileProblem.h"
#include "IO/Formats/FormatLooks.h"

#include "Core/Base/FieldNames.h"

#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <type_traits>

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
  const auto copy = vtkSmartPointer<vtkDataArray>::Take(
    vtkDataArray::CreateDataArray(type == VTK_VOID ? VTK_TYPE_UINT8 : type));
  copy->DeepCopy(array);
  return copy;
}

std::string plainName(const std::string& name, NameRule rule)
{
  std::string result = name.empty() ? "unnamed" : name;
  for (char& c : result)
  {
    const auto byte = static_cast<unsigned char>(c);
    const bool isOut = byte < ' ' || byte == 0x7f || (rule != NameRule::Any && byte == ' ') ||
      (rule == NameRule::Cells && std::string_view(",;|\"#%!>").find(c) != std::string_view::npos);
    c = isOut || (rule == NameRule::Cells && c == '/' && &c == result.data()) ? '_' : c;
  }
  // In the header of a text these are a column that is left out, and lists.
  for (const std::string_view mark : { "[]", "..." })
  {
    for (std::size_t at = 0; rule == NameRule::Cells && (at = result.find(mark)) != std::string::npos;)
    {
      result.replace(at, mark.size(), mark.size(), '_');
    }
  }
  return result == "-" ? "_" : result;
}

ArrayRole roleOf(vtkDataArray* array, vtkPointData* data)
{
  const std::string name = array->GetName() ? array->GetName() : "";
  const int components = array->GetNumberOfComponents();
  if (array->GetDataType() == VTK_UNSIGNED_CHAR && (components == 3 || components == 4) &&
    (array == data->GetScalars() || isSameField(name, "RGB") || isSameField(name, "RGBA")))
  {
    return ArrayRole::Colors;
  }
  if (isFloatingType(array->GetDataType()) && components == 3 &&
    (array == data->GetNormals() || isSameField(name, "Normals")))
  {
    return ArrayRole::Normals;
  }
  return ArrayRole::Other;
}

/// Only one array may be the colours, and one the normals: the first found; the active one goes first.
void keepFirstOfRole(std::vector<OutputArray>& arrays, ArrayRole role, vtkDataArray* active)
{
  const auto hasRole = [&](const OutputArray& each) { return each.role == role; };
  const auto isActive = [&](const OutputArray& each) { return hasRole(each) && each.array == active; };
  auto chosen = std::find_if(arrays.begin(), arrays.end(), isActive);
  chosen = chosen == arrays.end() ? std::find_if(arrays.begin(), arrays.end(), hasRole) : chosen;
  for (auto each = arrays.begin(); each != arrays.end(); ++each)
  {
    each->role = hasRole(*each) && each != chosen ? ArrayRole::Other : each->role;
  }
}

/// Name that the reader gives each array; empty where its columns become something else.
std::vector<std::string> namesRead(const std::vector<OutputArray>& arrays,
  const std::function<std::vector<Column>(const OutputArray&)>& columnsOf)
{
  std::vector<Column> columns;
  std::vector<std::size_t> firsts = { 0 };
  for (const OutputArray& array : arrays)
  {
    const std::vector<Column> own = columnsOf(array);
    columns.insert(columns.end(), own.begin(), own.end());
    firsts.push_back(columns.size());
  }
  const CloudColumns plan(columns, 0);
  std::set<std::string> seen;
  std::vector<std::string> names(arrays.size());
  std::vector<std::size_t> order(arrays.size());
  std::iota(order.begin(), order.end(), std::size_t{ 0 });
  // Another array gives way to colours and normals, whose names are fixed.
  std::stable_partition(
    order.begin(), order.end(), [&](std::size_t i) { return arrays[i].role != ArrayRole::Other; });
  for (const std::size_t i : order)
  {
    const std::size_t count = firsts[i + 1] - firsts[i];
    vtkDataArray* read = count > 0 ? plan.arrayOf(firsts[i]) : nullptr;
    bool isOwn = read && read == plan.arrayOf(firsts[i + 1] - 1) &&
      read->GetNumberOfComponents() == arrays[i].components();
    for (std::size_t column = firsts[i]; column < firsts[i + 1]; ++column)
    {
      isOwn = seen.insert(columns[column].name).second && isOwn;
    }
    const bool isCalled = isOwn &&
      (arrays[i].role != ArrayRole::Other ||
        read->GetName() == (count == 1 ? columns[firsts[i]].name : arrays[i].name));
    names[i] = isCalled ? read->GetName() : "";
  }
  return names;
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

std::vector<OutputArray> outputArrays(vtkPointSet* cloud, std::vector<std::string>& notes)
{
  std::vector<OutputArray> arrays;
  arrays.push_back({ ArrayRole::Points, "Points", inPlainMemory(cloud->GetPoints()->GetData()), "Points" });
  vtkPointData* data = cloud->GetPointData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = data->GetArray(i);
    if (!array || array->GetNumberOfComponents() < 1)
    {
      const char* name = data->GetAbstractArray(i)->GetName();
      notes.push_back("array " + inQuotes(name ? name : "") + " holds no numbers and is left out");
      continue;
    }
    const std::string name = utf8Name(array->GetName() ? array->GetName() : "");
    OutputArray output{ roleOf(array, data), name, inPlainMemory(array), name };
    failFormatIf(array->GetNumberOfTuples() < cloud->GetNumberOfPoints(),
      "give every array one value per point", "array {} has {} values for {} points", inQuotes(output.name),
      array->GetNumberOfTuples(), cloud->GetNumberOfPoints());
    arrays.push_back(output);
  }
  keepFirstOfRole(arrays, ArrayRole::Colors, data->GetScalars());
  keepFirstOfRole(arrays, ArrayRole::Normals, data->GetNormals());
  return arrays;
}

std::vector<Column> columnsByComponent(const OutputArray& array)
{
  std::vector<Column> columns;
  for (int component = 0; component < array.components(); ++component)
  {
    columns.push_back({ array.componentName(component), array.type() });
  }
  return columns;
}

void chooseNames(std::vector<OutputArray>& arrays,
  const std::function<std::vector<Column>(const OutputArray&)>& columnsOf, const NameLimits& limits,
  std::vector<std::string>& notes)
{
  constexpr std::size_t kLongestNumber = 4; // of a component, with its '_'
  constexpr int kMostRounds = 16;
  std::set<std::string> used = { "Points", "x", "y", "z" };
  const auto choose = [&](OutputArray& array, const std::string& wanted)
  {
    const bool isCut = limits.longest != std::string::npos && array.components() > 1;
    array.name =
      unusedName(used, plainName(wanted, limits.rule), limits.longest - (isCut ? kLongestNumber : 0));
  };
  std::vector<std::string> names(arrays.size());
  for (int round = 0; std::find(names.begin() + 1, names.end(), "") != names.end(); ++round)
  {
    failFormatIf(
      round > kMostRounds, "give them other names", "arrays whose names mean something else together");
    for (std::size_t i = 1; i < arrays.size(); ++i)
    {
      const bool mayChange = round == 0 || arrays[i].role == ArrayRole::Other;
      names[i].empty() && mayChange ? choose(arrays[i], arrays[i].name) : void();
    }
    names = namesRead(arrays, columnsOf);
  }
  for (std::size_t i = 1; i < arrays.size(); ++i)
  {
    if (names[i] != arrays[i].given)
    {
      limits.comments && !arrays[i].given.empty()
        ? void(limits.comments->names.emplace_back(names[i], arrays[i].given))
        : notes.push_back("array " + inQuotes(arrays[i].given) + " is called " + names[i]);
    }
  }
}

std::vector<OutputArray> withoutLongIntegers(std::vector<OutputArray> arrays, std::vector<std::string>& notes)
{
  for (OutputArray& each : arrays)
  {
    if (isFloatingType(each.type()) || sizeOfType(each.type()) != 8)
    {
      continue;
    }
    const auto copy = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(VTK_DOUBLE));
    copy->DeepCopy(each.array);
    vtkIdType changed = 0;
    withType(each.type(),
      [&](auto zero)
      {
        using T = decltype(zero);
        const T* from = static_cast<const T*>(each.array->GetVoidPointer(0));
        const double* to = static_cast<const double*>(copy->GetVoidPointer(0));
        for (vtkIdType i = 0; i < copy->GetNumberOfValues(); ++i)
        {
          // 2^64 itself, to which the largest ones are rounded, is no T.
          constexpr double kAbove = std::is_signed_v<T> ? 0x1p63 : 0x1p64;
          changed += to[i] < kAbove && static_cast<T>(to[i]) == from[i] ? 0 : 1;
        }
      });
    if (changed > 0)
    {
      notes.push_back(std::to_string(changed) + " integers of array " + each.name +
        " are beyond 2^53 and rounded to doubles; write .vtp or .pcd to keep every bit");
    }
    each.array = copy;
  }
  return arrays;
}

} // namespace pointhaptics::io
