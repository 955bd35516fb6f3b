#include "PieceOfCloud.h"

#include "PolyDataAccess.h"
#include "SmpExecutor.h"
#include "VoxelOutput.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkVariant.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <string>

namespace pointhaptics
{
namespace
{

using NewTuples = std::function<void(vtkAbstractArray* from, vtkAbstractArray* to)>;

/// Vertex cells of a piece: 0 for none, 1 where 32 bits number them, 2 for 64. Files show the bits, too.
int kindOfVertices(vtkPolyData* piece)
{
  return piece->GetNumberOfVerts() == 0 ? 0 : piece->GetVerts()->IsStorage64Bit() ? 2 : 1;
}

void addVertices(vtkPolyData* cloud, int kind)
{
  const vtkIdType points = cloud->GetNumberOfPoints();
  cloud->SetVerts(makeVertices(points, SmpExecutor()));
  if (kind == 1 && points < VTK_INT_MAX)
  {
    cloud->GetVerts()->ConvertTo32BitStorage();
  }
}

/// A cloud of other points, without cells, with arrays as those of @p cloud, which @p fill fills, and the
/// same field data.
vtkSmartPointer<vtkPolyData> cloudLike(vtkPolyData* cloud, const NewTuples& fill)
{
  auto result = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> places;
  places->SetDataType(cloud->GetPoints() ? cloud->GetPoints()->GetDataType() : VTK_FLOAT);
  if (cloud->GetPoints())
  {
    fill(cloud->GetPoints()->GetData(), places->GetData());
  }
  result->SetPoints(places);
  vtkPointData* from = cloud->GetPointData();
  vtkPointData* to = result->GetPointData();
  for (int i = 0; i < from->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = from->GetAbstractArray(i);
    const vtkSmartPointer<vtkAbstractArray> filled = emptyLike(array, array->GetDataType());
    fill(array, filled);
    addWithRoles(to, filled, rolesOf(from, array));
  }
  result->GetFieldData()->PassData(cloud->GetFieldData());
  return result;
}

/// Values one after the other; VTK packs bits, which are a byte each here.
std::string bytesOf(vtkAbstractArray* array)
{
  if (array->GetDataType() == VTK_BIT)
  {
    std::string bits;
    for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
    {
      bits.push_back(char(array->GetVariantValue(i).ToInt()));
    }
    return bits;
  }
  const auto bytes =
    std::size_t(array->GetNumberOfValues()) * std::size_t(std::max(array->GetDataTypeSize(), 0));
  return bytes == 0 ? std::string() : std::string(static_cast<const char*>(array->GetVoidPointer(0)), bytes);
}

void setBytes(vtkAbstractArray* array, const std::vector<std::string>& pieces)
{
  char* next = array->GetDataType() == VTK_BIT ? nullptr : static_cast<char*>(array->GetVoidPointer(0));
  vtkIdType bit = 0;
  for (const std::string& bytes : pieces)
  {
    for (std::size_t i = 0; !next && i < bytes.size(); ++i)
    {
      array->SetVariantValue(bit++, int(bytes[i]));
    }
    if (next)
    {
      std::memcpy(next, bytes.data(), bytes.size());
      next += bytes.size();
    }
  }
}

/// Header in front of the name of an array.
struct ArrayPreface
{
  int type = 0;
  int components = 0;
  int roles = 0;
  int nameLength = 0;
};

/// Never empty.
std::string namesAndTypes(vtkPointData* data)
{
  std::string text(1, '+');
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = data->GetAbstractArray(i);
    const std::string name = array->GetName() ? array->GetName() : "";
    const ArrayPreface preface{ array->GetDataType(), array->GetNumberOfComponents(), rolesOf(data, array),
      int(name.size()) };
    text += bytesOfValues(std::vector<ArrayPreface>{ preface }) + name;
  }
  return text;
}

void addEmptyArrays(const std::string& text, vtkPointData* data)
{
  for (std::size_t at = 1; at < text.size();)
  {
    const auto preface = valuesOfBytes<ArrayPreface>(text.substr(at, sizeof(ArrayPreface))).at(0);
    at += sizeof(ArrayPreface);
    const auto array = vtkSmartPointer<vtkAbstractArray>::Take(vtkAbstractArray::CreateArray(preface.type));
    array->SetNumberOfComponents(preface.components);
    array->SetName(text.substr(at, std::size_t(preface.nameLength)).c_str());
    at += std::size_t(preface.nameLength);
    addWithRoles(data, array, preface.roles);
  }
}

}

vtkSmartPointer<vtkPointSet> withArraysOfOthers(Ranks& ranks, vtkPointSet* piece)
{
  const bool hasPoints = piece->GetNumberOfPoints() > 0;
  for (const std::string& arrays :
    ranks.gather(hasPoints ? namesAndTypes(piece->GetPointData()) : std::string()))
  {
    if (!hasPoints && !arrays.empty())
    {
      auto empty = vtkSmartPointer<vtkPolyData>::New();
      addEmptyArrays(arrays, empty->GetPointData());
      return empty;
    }
  }
  return piece;
}

vtkSmartPointer<vtkPolyData> gatherPieces(Ranks& ranks, vtkPolyData* piece)
{
  if (ranks.size() == 1)
  {
    return piece;
  }
  const std::vector<int> toFirst(std::size_t(piece->GetNumberOfPoints()), 0);
  const vtkSmartPointer<vtkPolyData> all = exchangePoints(ranks, piece, toFirst);
  return ranks.rank() == 0 ? all : nullptr;
}

vtkSmartPointer<vtkPolyData> exchangePoints(Ranks& ranks, vtkPolyData* piece, const std::vector<int>& to)
{
  std::vector<vtkNew<vtkIdList>> rows(std::size_t(ranks.size()));
  for (std::size_t i = 0; i < to.size(); ++i)
  {
    if (to[i] >= 0)
    {
      rows[std::size_t(to[i])]->InsertNextId(vtkIdType(i));
    }
  }
  std::vector<std::vector<vtkIdType>> counts;
  for (const vtkNew<vtkIdList>& wanted : rows)
  {
    counts.push_back({ wanted->GetNumberOfIds() });
  }
  vtkIdType points = 0;
  for (const vtkIdType count : ranks.exchangeValues(counts))
  {
    points += count;
  }
  // A rank without points shows none of these.
  const int vertices = ranks.reduce(kindOfVertices(piece), [](int a, int b) { return std::max(a, b); });
  const vtkSmartPointer<vtkPolyData> result = cloudLike(piece,
    [&](vtkAbstractArray* from, vtkAbstractArray* into)
    {
      std::vector<std::string> parts;
      for (const vtkNew<vtkIdList>& wanted : rows)
      {
        const vtkSmartPointer<vtkAbstractArray> part = emptyLike(from, from->GetDataType());
        part->SetNumberOfTuples(wanted->GetNumberOfIds());
        from->GetTuples(wanted, part);
        parts.push_back(bytesOf(part));
      }
      parts = ranks.exchange(std::move(parts));
      into->SetNumberOfTuples(points);
      setBytes(into, parts);
    });
  if (vertices > 0)
  {
    addVertices(result, vertices);
  }
  return result;
}

} // namespace pointhaptics
