#include "VoxelAttribute.h"

#include "vtkDataArray.h"
#include "vtkType.h"
#include "vtkVariant.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>

namespace pointhaptics
{
namespace
{

template <typename T>
ScalarType integerType()
{
  constexpr bool isSigned = std::is_signed<T>::value;
  switch (sizeof(T))
  {
    case 1:
      return isSigned ? ScalarType::Int8 : ScalarType::UInt8;
    case 2:
      return isSigned ? ScalarType::Int16 : ScalarType::UInt16;
    case 4:
      return isSigned ? ScalarType::Int32 : ScalarType::UInt32;
    default:
      return isSigned ? ScalarType::Int64 : ScalarType::UInt64;
  }
}

ScalarType scalarType(int vtkType)
{
  switch (vtkType)
  {
    case VTK_FLOAT:
      return ScalarType::Float;
    case VTK_CHAR:
      return integerType<char>();
    case VTK_SIGNED_CHAR:
      return integerType<signed char>();
    case VTK_UNSIGNED_CHAR:
      return integerType<unsigned char>();
    case VTK_SHORT:
      return integerType<short>();
    case VTK_UNSIGNED_SHORT:
      return integerType<unsigned short>();
    case VTK_INT:
      return integerType<int>();
    case VTK_UNSIGNED_INT:
      return integerType<unsigned int>();
    case VTK_LONG:
      return integerType<long>();
    case VTK_UNSIGNED_LONG:
      return integerType<unsigned long>();
    case VTK_LONG_LONG:
      return integerType<long long>();
    case VTK_UNSIGNED_LONG_LONG:
      return integerType<unsigned long long>();
    case VTK_ID_TYPE:
      return integerType<vtkIdType>();
    default:
      return ScalarType::Double;
  }
}

/// VTK packs bits; everything else is one number after the other once it is in VTK's usual arrays.
int plainType(int vtkType)
{
  return vtkType == VTK_BIT ? VTK_UNSIGNED_CHAR : vtkType;
}

/// VTK copies arrays it has no fast path for by way of double, which has no room for 64-bit integers.
template <typename Integer>
void copyIntegers(vtkDataArray* from, Integer* to)
{
  for (vtkIdType i = 0; i < from->GetNumberOfValues(); ++i)
  {
    to[i] = from->GetVariantValue(i).ToTypeInt64();
  }
}
template <>
void copyIntegers(vtkDataArray* from, std::uint64_t* to)
{
  for (vtkIdType i = 0; i < from->GetNumberOfValues(); ++i)
  {
    to[i] = from->GetVariantValue(i).ToTypeUInt64();
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
  const ScalarType type = scalarType(copy->GetDataType());
  if (type != ScalarType::Int64 && type != ScalarType::UInt64)
  {
    copy->DeepCopy(array);
    return copy;
  }
  copy->SetNumberOfComponents(array->GetNumberOfComponents());
  copy->SetNumberOfTuples(array->GetNumberOfTuples());
  if (type == ScalarType::Int64)
  {
    copyIntegers(array, static_cast<std::int64_t*>(copy->GetVoidPointer(0)));
  }
  else
  {
    copyIntegers(array, static_cast<std::uint64_t*>(copy->GetVoidPointer(0)));
  }
  return copy;
}

vtkSmartPointer<vtkDataArray> newArray(vtkDataArray* like, int type)
{
  auto array = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
  array->SetName(like->GetName());
  array->SetNumberOfComponents(like->GetNumberOfComponents());
  array->CopyComponentNames(like);
  if (like->HasInformation())
  {
    array->CopyInformation(like->GetInformation());
  }
  array->SetLookupTable(like->GetLookupTable());
  return array;
}

}

VoxelAttribute::VoxelAttribute(vtkDataArray* input, AttributeKind kind, const AttributeValues* known,
  InstructionSet instructions, const Executor& executor)
  : input_(input)
  , plain_(known && known->copy ? known->copy : plainArray(input))
  , kind_(kind)
  , view_{ plain_->GetVoidPointer(0), scalarType(plain_->GetDataType()), plain_->GetNumberOfComponents(),
    std::int64_t(plain_->GetNumberOfTuples()) }
  , tuples_(AttributeTuples(view_.type, view_.components,
      kind == AttributeKind::Median ? TupleStatistic::Median : TupleStatistic::Mode))
{
  if (kind == AttributeKind::Mean || kind == AttributeKind::Normal)
  {
    tuples_ =
      AttributeMean(view_, known ? known->range : rangeOf(view_, executor, instructions), instructions);
  }
}

AttributeValues VoxelAttribute::values() const
{
  const auto* mean = std::get_if<AttributeMean>(&tuples_);
  return { mean ? mean->range() : AttributeRange(), plain_ == input_ ? nullptr : plain_ };
}

void VoxelAttribute::prepare(Tuples& tuples, const std::int64_t* counts, std::int64_t voxels,
  std::int64_t mostPoints, Buffer<std::int64_t> spare, const Executor& executor)
{
  if (auto* mean = std::get_if<AttributeMean>(&tuples))
  {
    mean->prepare(voxels, mostPoints, std::move(spare), executor);
    return;
  }
  std::get<AttributeTuples>(tuples).prepare(counts, voxels);
}

void VoxelAttribute::add(
  Tuples& tuples, const void* from, std::size_t stride, const std::int64_t* voxels, int count)
{
  std::visit([&](auto& ofVoxels) { ofVoxels.add(from, stride, voxels, count); }, tuples);
}

void VoxelAttribute::prepare(const std::int64_t* counts, std::int64_t voxels, std::int64_t mostPoints,
  Buffer<std::int64_t> spare, const Executor& executor)
{
  voxels_ = finestVoxels_ = voxels;
  prepare(tuples_, counts, voxels, mostPoints, std::move(spare), executor);
}

Buffer<std::int64_t> VoxelAttribute::takeSums()
{
  auto* mean = std::get_if<AttributeMean>(&tuples_);
  Buffer<std::int64_t> sums = mean ? mean->takeSums() : Buffer<std::int64_t>();
  // Numbers of very different magnitudes take many parts: as memory to keep these are too large.
  constexpr std::size_t kMostKept = 4 * sizeof(std::int64_t);
  if (sums.bytes() > kMostKept * std::size_t(finestVoxels_) * std::size_t(view_.components))
  {
    sums.release();
  }
  return sums;
}

TupleSource VoxelAttribute::source() const
{
  return { view_.values, std::size_t(bytesOf(view_.type)) * std::size_t(view_.components) };
}

void VoxelAttribute::add(const void* tuples, std::size_t stride, const std::int64_t* voxels, int count)
{
  add(tuples_, tuples, stride, voxels, count);
}

void VoxelAttribute::coarsen(const std::vector<std::int64_t>& parents, std::int64_t voxels)
{
  voxels_ = voxels;
  std::visit([&](auto& ofVoxels) { ofVoxels.coarsen(parents, voxels); }, tuples_);
}

VoxelAttribute::Tuples VoxelAttribute::tuplesOfSet() const
{
  return std::visit([](const auto& ofVoxels) { return Tuples(ofVoxels.another()); }, tuples_);
}

bool VoxelAttribute::canWriteSets() const
{
  const int type = plain_->GetDataType();
  return kind_ != AttributeKind::Normal || type == VTK_FLOAT || type == VTK_DOUBLE;
}

void VoxelAttribute::prepareSets(std::int64_t voxels, const AffineTransform& transform, ArrayPool& pool)
{
  written_ = newArray(input_, plain_->GetDataType());
  pool.allocate(written_, voxels);
  setNormalColumns(transform);
}

void VoxelAttribute::writeSet(const Tuples& tuples, std::int64_t first, const std::int64_t* counts) const
{
  write(tuples, written_, first, counts, Executor(), nullptr);
}

vtkSmartPointer<vtkDataArray> VoxelAttribute::output(const std::int64_t* counts,
  const AffineTransform& transform, ArrayPool& pool, const Executor& executor, ProgressObserver* observer)
{
  vtkSmartPointer<vtkDataArray> result = written_;
  if (!result)
  {
    result = newArray(input_, plain_->GetDataType());
    pool.allocate(result, voxels_);
    setNormalColumns(transform);
    if (!write(tuples_, result, 0, counts, executor, observer))
    {
      return nullptr;
    }
  }
  written_ = nullptr;
  return inOwnType(result);
}

vtkSmartPointer<vtkDataArray> VoxelAttribute::inOwnType(vtkSmartPointer<vtkDataArray> plain) const
{
  if (input_->GetDataType() == plain->GetDataType())
  {
    return plain;
  }
  auto original = newArray(input_, input_->GetDataType());
  original->DeepCopy(plain);
  original->SetName(input_->GetName());
  return original;
}

vtkSmartPointer<vtkDataArray> VoxelAttribute::chosen(
  const std::vector<std::int64_t>& points, ArrayPool& pool, const Executor& executor) const
{
  const vtkSmartPointer<vtkDataArray> result = newArray(input_, plain_->GetDataType());
  pool.allocate(result, std::int64_t(points.size()));
  const TupleSource from = source();
  auto* to = static_cast<char*>(result->GetVoidPointer(0));
  forRange(executor, std::int64_t(points.size()),
    [&](std::int64_t first, std::int64_t last)
    {
      for (std::int64_t v = first; v < last; ++v)
      {
        std::memcpy(to + from.bytes * std::size_t(v),
          static_cast<const char*>(from.values) + from.bytes * std::size_t(points[std::size_t(v)]),
          from.bytes);
      }
    });
  return inOwnType(result);
}

void VoxelAttribute::setNormalColumns(const AffineTransform& transform)
{
  normalColumns_[0] = transform.applyToNormal({ 1, 0, 0 });
  normalColumns_[1] = transform.applyToNormal({ 0, 1, 0 });
  normalColumns_[2] = transform.applyToNormal({ 0, 0, 1 });
}

/// To the voxels of @p output from @p first on.
bool VoxelAttribute::write(const Tuples& tuples, vtkDataArray* output, std::int64_t first,
  const std::int64_t* counts, const Executor& executor, ProgressObserver* observer) const
{
  const std::size_t bytes = std::size_t(bytesOf(view_.type)) * std::size_t(view_.components);
  void* to = static_cast<char*>(output->GetVoidPointer(0)) + std::size_t(first) * bytes;
  switch (kind_)
  {
    case AttributeKind::Mean:
      std::get<AttributeMean>(tuples).write(counts, to, executor);
      break;
    case AttributeKind::Normal:
      if (view_.type == ScalarType::Float || view_.type == ScalarType::Double)
      {
        std::get<AttributeMean>(tuples).writeUnitVectors(counts, normalColumns_, to, executor);
        break;
      }
      writeIntegerNormals(output, counts, executor); // never of a set, see canWriteSets()
      break;
    case AttributeKind::Category:
    case AttributeKind::Median:
    case AttributeKind::Chosen: // never: see chosen()
      return std::get<AttributeTuples>(tuples).write(to, executor, observer);
  }
  return true;
}

void VoxelAttribute::writeIntegerNormals(
  vtkDataArray* output, const std::int64_t* counts, const Executor& executor) const
{
  const auto& means = std::get<AttributeMean>(tuples_);
  const Vec3& x = normalColumns_[0];
  const Vec3& y = normalColumns_[1];
  const Vec3& z = normalColumns_[2];
  const double low = output->GetDataTypeMin();
  // The largest 64-bit integer is no double; the one below is.
  const double high =
    output->GetDataTypeSize() < 8 ? output->GetDataTypeMax() : std::nextafter(output->GetDataTypeMax(), 0.0);
  forRange(executor, voxels_,
    [&](std::int64_t first, std::int64_t last)
    {
      for (std::int64_t v = first; v < last; ++v)
      {
        // Integers have a scale of their own: they keep the length of their mean.
        Vec3 mean;
        means.mean(v, counts[v], &mean.x);
        const Vec3 turned = mean.x * x + mean.y * y + mean.z * z;
        const double length = norm(turned);
        const double scale = length > 0.0 ? norm(mean) / length : 0.0;
        for (int axis = 0; axis < 3; ++axis)
        {
          output->SetComponent(vtkIdType(v), axis, std::clamp(std::round(scale * turned[axis]), low, high));
        }
      }
    });
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
