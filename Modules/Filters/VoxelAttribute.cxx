#include "VoxelAttribute.h"

#include "PolyDataAccess.h"

#include "vtkAbstractArray.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkType.h"
#include "vtkVariant.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>

namespace pointhaptics
{
namespace
{

std::string nameOf(vtkAbstractArray* array)
{
  return array->GetName() ? array->GetName() : "";
}

/// Ghost flags are meaningless once points are merged, and so are counts and covariances of an earlier
/// resampling.
bool isBookkeeping(vtkAbstractArray* array)
{
  const std::string name = nameOf(array);
  return name == vtkDataSetAttributes::GhostArrayName() || name == "VoxelPointCount" ||
    name == "VoxelCovariance" || name == "VoxelIndex" || name == kOriginalPointIds;
}

bool areIds(vtkDataSetAttributes* attributes, vtkAbstractArray* array)
{
  return array == attributes->GetGlobalIds() || array == attributes->GetPedigreeIds();
}

std::string whyDropped(vtkDataSetAttributes* attributes, vtkAbstractArray* array, vtkIdType points)
{
  std::ostringstream text;
  text << "Array \"" << nameOf(array) << "\" ";
  if (areIds(attributes, array))
  {
    text << "holds ids: merged points have none and it is dropped.";
  }
  else if (!vtkDataArray::SafeDownCast(array))
  {
    text << "is not numeric: it has no mean and is dropped.";
  }
  else
  {
    text << "has " << array->GetNumberOfTuples() << " tuples for " << points << " points: it is dropped.";
  }
  return text.str();
}

AttributeStatistic statisticOf(vtkDataArray* array, const VoxelMeanSettings& settings, bool isNormal)
{
  return isCategorical(settings, nameOf(array))         ? AttributeStatistic::Mode
    : settings.representative == Representative::Median ? AttributeStatistic::Median
    : isNormal                                          ? AttributeStatistic::Normal
                                                        : AttributeStatistic::Mean;
}

/// VTK packs bits; everything else is one number after the other once it is in VTK's usual arrays. It copies
/// arrays it has no fast path for by way of double, which has no room for 64-bit integers.
vtkSmartPointer<vtkDataArray> plainArray(vtkDataArray* array)
{
  const int type = array->GetDataType();
  if (array->HasStandardMemoryLayout() && type != VTK_BIT)
  {
    return array;
  }
  auto copy = vtkSmartPointer<vtkDataArray>::Take(
    vtkDataArray::CreateDataArray(type == VTK_BIT ? VTK_UNSIGNED_CHAR : type));
  const ScalarType scalar = scalarTypeOf(copy);
  if (scalar != ScalarType::Int64 && scalar != ScalarType::UInt64)
  {
    copy->DeepCopy(array);
    return copy;
  }
  copy->SetNumberOfComponents(array->GetNumberOfComponents());
  copy->SetNumberOfTuples(array->GetNumberOfTuples());
  auto* const words = static_cast<std::uint64_t*>(copy->GetVoidPointer(0));
  for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
  {
    const vtkVariant value = array->GetVariantValue(i);
    words[i] = scalar == ScalarType::Int64 ? std::uint64_t(value.ToTypeInt64()) : value.ToTypeUInt64();
  }
  return copy;
}

AttributeView viewOf(vtkDataArray* plain)
{
  return { plain->GetVoidPointer(0), scalarTypeOf(plain), plain->GetNumberOfComponents(),
    std::int64_t(plain->GetNumberOfTuples()) };
}

/// Turns normals by the inverse transpose of @p transform and makes them unit vectors; those in integers keep
/// their length.
void turnNormals(vtkDataArray* normals, const AffineTransform& transform)
{
  const bool isFloating = normals->GetDataType() == VTK_FLOAT || normals->GetDataType() == VTK_DOUBLE;
  const double low = normals->GetDataTypeMin();
  const double high = normals->GetDataTypeSize() < 8 ? normals->GetDataTypeMax()
                                                     : std::nextafter(normals->GetDataTypeMax(), 0.0);
  for (vtkIdType v = 0; v < normals->GetNumberOfTuples(); ++v)
  {
    Vec3 normal;
    normals->GetTuple(v, &normal.x);
    const Vec3 turned = transform.applyToNormal(normal);
    const double length = norm(turned);
    const double scale = length > 0.0 ? (isFloating ? 1.0 : norm(normal)) / length : 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double value = scale * turned[axis];
      normals->SetComponent(v, axis, isFloating ? value : std::clamp(std::round(value), low, high));
    }
  }
}

}

std::vector<VoxelAttribute> voxelArrays(
  vtkPointSet* input, const VoxelMeanSettings& settings, std::vector<std::string>& dropped)
{
  std::vector<VoxelAttribute> found;
  vtkPointData* data = input->GetPointData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* any = data->GetAbstractArray(i);
    if (isBookkeeping(any))
    {
      continue;
    }
    vtkDataArray* array = vtkDataArray::SafeDownCast(any);
    if (areIds(data, any) || !array || array->GetNumberOfTuples() != input->GetNumberOfPoints())
    {
      dropped.push_back(whyDropped(data, any, input->GetNumberOfPoints()));
      continue;
    }
    const bool isNormal = array == data->GetNormals() && array->GetNumberOfComponents() == 3;
    found.push_back({ array, statisticOf(array, settings, isNormal), rolesOf(data, array), isNormal });
  }
  return found;
}

AttributeRequest VoxelAttribute::request()
{
  plain = plainArray(array);
  return { viewOf(plain), statistic };
}

void VoxelAttribute::addTo(VoxelRequest& wanted)
{
  const AttributeRequest own = this->request();
  keepsPoints(wanted.representative) ? wanted.tieBreakers.push_back(own.view)
                                     : wanted.attributes.push_back(own);
}

vtkSmartPointer<vtkDataArray> VoxelAttribute::reduced(const VoxelResampler& engine,
  const VoxelRequest& request, std::size_t i, OutputMemory& memory, const Executor& executor) const
{
  vtkSmartPointer<vtkDataArray> result = vtkDataArray::SafeDownCast(emptyLike(array, plain->GetDataType()));
  if (keepsPoints(request.representative))
  {
    OutputMemory::allocateFor(result, engine.size());
    const AttributeView view = viewOf(plain);
    const auto bytes = std::size_t(view.tupleBytes());
    auto* const to = static_cast<char*>(result->GetVoidPointer(0));
    forEachIndex(executor, engine.size(),
      [&](std::int64_t v) {
        std::memcpy(to + bytes * std::size_t(v), view.tuple(engine.chosenPoints()[std::size_t(v)]), bytes);
      });
  }
  else
  {
    memory.take(OutputAllocator::Attributes + i, result, engine.size());
  }
  if (array->GetDataType() != result->GetDataType())
  {
    const vtkSmartPointer<vtkDataArray> own =
      vtkDataArray::SafeDownCast(emptyLike(array, array->GetDataType()));
    own->DeepCopy(result);
    own->SetName(array->GetName()); // a copy of bits has none
    result = own;
  }
  if (request.representative != Representative::Mean && isNormal && !request.transform.isIdentity())
  {
    turnNormals(result, request.transform);
  }
  return result;
}

} // namespace pointhaptics
