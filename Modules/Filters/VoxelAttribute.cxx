#include "VoxelAttribute.h"

#include "PolyDataAccess.h"

#include "Core/Resample/AttributeView.h"

#include "vtkDataArray.h"
#include "vtkType.h"
#include "vtkVariant.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace pointhaptics
{
namespace
{

/// VTK packs bits; everything else is one number after the other once it is in VTK's usual arrays.
int plainType(int vtkType)
{
  return vtkType == VTK_BIT ? VTK_UNSIGNED_CHAR : vtkType;
}

/// VTK copies arrays it has no fast path for by way of double, which has no room for 64-bit integers.
void copyIntegers(vtkDataArray* from, bool isSigned, void* to)
{
  auto* const words = static_cast<std::uint64_t*>(to);
  for (vtkIdType i = 0; i < from->GetNumberOfValues(); ++i)
  {
    const vtkVariant value = from->GetVariantValue(i);
    words[i] = isSigned ? std::uint64_t(value.ToTypeInt64()) : value.ToTypeUInt64();
  }
}

vtkSmartPointer<vtkDataArray> plainArray(vtkDataArray* array)
{
  if (array->HasStandardMemoryLayout() && array->GetDataType() != VTK_BIT)
  {
    return array;
  }
  auto copy =
    vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(plainType(array->GetDataType())));
  const ScalarType type = scalarTypeOf(copy);
  if (type != ScalarType::Int64 && type != ScalarType::UInt64)
  {
    copy->DeepCopy(array);
    return copy;
  }
  copy->SetNumberOfComponents(array->GetNumberOfComponents());
  copy->SetNumberOfTuples(array->GetNumberOfTuples());
  copyIntegers(array, type == ScalarType::Int64, copy->GetVoidPointer(0));
  return copy;
}

}

VoxelAttribute::VoxelAttribute(
  vtkDataArray* input, AttributeStatistic statistic, const AttributeValues* known)
  : input_(input)
  , plain_(known && known->copy ? known->copy : plainArray(input))
  , statistic_(statistic)
  , view_{ plain_->GetVoidPointer(0), scalarTypeOf(plain_), plain_->GetNumberOfComponents(),
    std::int64_t(plain_->GetNumberOfTuples()) }
{
  values_.copy = plain_ == input_ ? nullptr : plain_;
  values_.range = known ? known->range : std::nullopt;
}

void VoxelAttribute::findRange(const Executor& executor)
{
  if (!values_.range && isSum(statistic_))
  {
    values_.range = rangeOf(view_, executor);
  }
}

vtkSmartPointer<vtkDataArray> VoxelAttribute::emptyArray() const
{
  return vtkDataArray::SafeDownCast(emptyLike(input_, plain_->GetDataType()));
}

vtkSmartPointer<vtkDataArray> VoxelAttribute::inOwnType(vtkSmartPointer<vtkDataArray> plain) const
{
  if (input_->GetDataType() == plain->GetDataType())
  {
    return plain;
  }
  const vtkSmartPointer<vtkDataArray> original =
    vtkDataArray::SafeDownCast(emptyLike(input_, input_->GetDataType()));
  original->DeepCopy(plain);
  original->SetName(input_->GetName());
  return original;
}

vtkSmartPointer<vtkDataArray> VoxelAttribute::chosen(
  const std::vector<std::int64_t>& points, ArrayPool& pool, const Executor& executor) const
{
  const vtkSmartPointer<vtkDataArray> result = emptyArray();
  pool.allocateFor(result, std::int64_t(points.size()));
  const std::size_t bytes = std::size_t(bytesOf(view_.type)) * std::size_t(view_.components);
  const auto* from = static_cast<const char*>(view_.values);
  auto* to = static_cast<char*>(result->GetVoidPointer(0));
  forRange(executor, std::int64_t(points.size()),
    [&](std::int64_t first, std::int64_t last)
    {
      for (std::int64_t v = first; v < last; ++v)
      {
        std::memcpy(to + bytes * std::size_t(v), from + bytes * std::size_t(points[std::size_t(v)]), bytes);
      }
    });
  return inOwnType(result);
}

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

} // namespace pointhaptics
