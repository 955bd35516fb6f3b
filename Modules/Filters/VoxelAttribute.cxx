#include "VoxelAttribute.h"

#include "vtkDataArray.h"
#include "vtkType.h"
#include "vtkVariant.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
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

/// One value for all that are told apart by their bits only: the zeroes, the NaNs.
template <typename T>
T canonical(T value)
{
  if constexpr (std::is_floating_point_v<T>)
  {
    return std::isnan(value) ? std::numeric_limits<T>::quiet_NaN() : value + T(0);
  }
  return value;
}

/// NaN is a value like others, the largest one.
template <typename T>
bool isLess(T a, T b)
{
  if constexpr (std::is_floating_point_v<T>)
  {
    return std::isnan(b) ? !std::isnan(a) : a < b;
  }
  return a < b;
}

/// The value that is there most often, the smallest of several. Sorts them.
template <typename T>
T mostFrequent(std::vector<T>& values)
{
  std::sort(values.begin(), values.end(), isLess<T>);
  T best = values.front();
  std::size_t longest = 0;
  for (std::size_t i = 0; i < values.size();)
  {
    std::size_t end = i + 1;
    while (end < values.size() && !isLess(values[i], values[end]))
    {
      ++end;
    }
    if (end - i > longest)
    {
      longest = end - i;
      best = values[i];
    }
    i = end;
  }
  return best;
}

/// The points of each voxel.
struct Members
{
  std::vector<std::int64_t> points;
  std::vector<std::size_t> begin;

  /// @param voxelOf of each point; negative: of none. @return false if the work was ended.
  bool find(const std::vector<std::int64_t>& voxelOf, std::int64_t voxels, WatchedPoints& watched)
  {
    begin.assign(std::size_t(voxels) + 1, 0);
    const bool isCounted =
      forPoints(voxelOf, watched, [&](std::size_t, std::int64_t voxel) { ++begin[std::size_t(voxel) + 1]; });
    if (!isCounted)
    {
      return false;
    }
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    points.resize(begin.back());
    std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
    return forPoints(voxelOf, watched,
      [&](std::size_t i, std::int64_t voxel) { points[next[std::size_t(voxel)]++] = std::int64_t(i); });
  }

private:
  template <typename Visit>
  static bool forPoints(const std::vector<std::int64_t>& voxelOf, WatchedPoints& watched, Visit&& visit)
  {
    return forWatchedSlices(std::int64_t(voxelOf.size()), watched,
      [&](std::int64_t first, std::int64_t last)
      {
        for (auto i = std::size_t(first); i < std::size_t(last); ++i)
        {
          if (voxelOf[i] >= 0)
          {
            visit(i, voxelOf[i]);
          }
        }
      });
  }
};

/// Voxels @p first to @p last.
template <typename T>
void writeMostFrequent(
  const Members& members, std::int64_t first, std::int64_t last, const T* input, int components, T* output)
{
  std::vector<T> values;
  for (std::int64_t v = first; v < last; ++v)
  {
    for (int c = 0; c < components; ++c)
    {
      values.clear();
      for (std::size_t m = members.begin[std::size_t(v)]; m < members.begin[std::size_t(v) + 1]; ++m)
      {
        values.push_back(canonical(input[components * members.points[m] + c]));
      }
      output[components * v + c] = mostFrequent(values);
    }
  }
}

}

VoxelAttribute::VoxelAttribute(vtkDataArray* input, AttributeKind kind, const AttributeValues* known,
  InstructionSet instructions, const Executor& executor)
  : input_(input)
  , plain_(known && known->copy ? known->copy : plainArray(input))
  , kind_(kind)
{
  if (kind != AttributeKind::Category)
  {
    const AttributeView view{ plain_->GetVoidPointer(0), scalarType(plain_->GetDataType()),
      plain_->GetNumberOfComponents(), std::int64_t(plain_->GetNumberOfTuples()) };
    mean_ = std::make_unique<AttributeMean>(
      view, known ? known->range : rangeOf(view, executor, instructions), instructions);
  }
}

AttributeValues VoxelAttribute::values() const
{
  return { mean_ ? mean_->range() : AttributeRange(), plain_ == input_ ? nullptr : plain_ };
}

void VoxelAttribute::prepare(
  std::int64_t voxels, std::int64_t mostPoints, Buffer<std::int64_t> spare, const Executor& executor)
{
  voxels_ = finestVoxels_ = voxels;
  if (mean_)
  {
    mean_->prepare(voxels, mostPoints, std::move(spare), executor);
  }
  else
  {
    voxelOf_.assign(std::size_t(plain_->GetNumberOfTuples()), -1);
  }
}

Buffer<std::int64_t> VoxelAttribute::takeSums()
{
  Buffer<std::int64_t> sums = mean_ ? mean_->takeSums() : Buffer<std::int64_t>();
  // Numbers of very different magnitudes take many parts: as memory to keep these are too large.
  constexpr std::size_t kMostKept = 4 * sizeof(std::int64_t);
  if (sums.bytes() > kMostKept * std::size_t(finestVoxels_) * std::size_t(plain_->GetNumberOfComponents()))
  {
    sums.release();
  }
  return sums;
}

TupleSource VoxelAttribute::source() const
{
  if (!mean_)
  {
    return {};
  }
  const AttributeView& view = mean_->view();
  return { view.values, bytesOf(view.type) * std::size_t(view.components) };
}

void VoxelAttribute::add(const void* tuples, std::size_t stride, const std::int64_t* voxels, int count)
{
  if (mean_)
  {
    mean_->add(tuples, stride, voxels, count);
    return;
  }
  const auto* number = static_cast<const char*>(tuples);
  for (int i = 0; i < count; ++i, number += stride)
  {
    voxelOf_[std::size_t(*reinterpret_cast<const std::int64_t*>(number))] = voxels[i];
  }
}

void VoxelAttribute::coarsen(const std::vector<std::int64_t>& parents, std::int64_t voxels)
{
  voxels_ = voxels;
  if (mean_)
  {
    mean_->coarsen(parents, voxels);
  }
  for (std::int64_t& voxel : voxelOf_)
  {
    voxel = voxel < 0 ? voxel : parents[std::size_t(voxel)];
  }
}

bool VoxelAttribute::canWriteSets() const
{
  const int type = plain_->GetDataType();
  return kind_ == AttributeKind::Mean ||
    (kind_ == AttributeKind::Normal && (type == VTK_FLOAT || type == VTK_DOUBLE));
}

void VoxelAttribute::prepareSets(std::int64_t voxels, const AffineTransform& transform, ArrayPool& pool)
{
  written_ = newArray(input_, plain_->GetDataType());
  pool.allocate(written_, voxels);
  setNormalColumns(transform);
}

void VoxelAttribute::writeSet(const AttributeMean& sums, std::int64_t first, const std::int64_t* counts) const
{
  const AttributeView& view = sums.view();
  void* to = static_cast<char*>(written_->GetVoidPointer(0)) + first * view.components * bytesOf(view.type);
  if (kind_ == AttributeKind::Normal)
  {
    sums.writeUnitVectors(counts, normalColumns_, to, Executor());
    return;
  }
  sums.write(counts, to, Executor());
}

vtkSmartPointer<vtkDataArray> VoxelAttribute::output(const std::int64_t* counts,
  const AffineTransform& transform, ArrayPool& pool, const Executor& executor, Watcher* watcher)
{
  vtkSmartPointer<vtkDataArray> result = written_;
  if (!result)
  {
    result = newArray(input_, plain_->GetDataType());
    pool.allocate(result, voxels_);
    setNormalColumns(transform);
    if (!write(result, counts, executor, watcher))
    {
      return nullptr;
    }
  }
  written_ = nullptr;
  if (input_->GetDataType() == plain_->GetDataType())
  {
    return result;
  }
  auto original = newArray(input_, input_->GetDataType());
  original->DeepCopy(result);
  original->SetName(input_->GetName());
  return original;
}

void VoxelAttribute::setNormalColumns(const AffineTransform& transform)
{
  normalColumns_[0] = transform.applyToNormal({ 1, 0, 0 });
  normalColumns_[1] = transform.applyToNormal({ 0, 1, 0 });
  normalColumns_[2] = transform.applyToNormal({ 0, 0, 1 });
}

bool VoxelAttribute::write(
  vtkDataArray* output, const std::int64_t* counts, const Executor& executor, Watcher* watcher) const
{
  switch (kind_)
  {
    case AttributeKind::Mean:
      mean_->write(counts, output->GetVoidPointer(0), executor);
      break;
    case AttributeKind::Normal:
      writeNormals(output, counts, executor);
      break;
    case AttributeKind::Category:
      return writeCategories(output, executor, watcher);
  }
  return true;
}

void VoxelAttribute::writeNormals(
  vtkDataArray* output, const std::int64_t* counts, const Executor& executor) const
{
  if (output->GetDataType() == VTK_FLOAT || output->GetDataType() == VTK_DOUBLE)
  {
    mean_->writeUnitVectors(counts, normalColumns_, output->GetVoidPointer(0), executor);
    return;
  }
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
        mean_->mean(v, counts[v], &mean.x);
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

bool VoxelAttribute::writeCategories(vtkDataArray* output, const Executor& executor, Watcher* watcher) const
{
  WatchedPoints watched(watcher, std::int64_t(voxelOf_.size()), 3);
  Members members;
  if (!members.find(voxelOf_, voxels_, watched))
  {
    return false;
  }
  const int components = plain_->GetNumberOfComponents();
  for (std::int64_t first = 0; first < voxels_;)
  {
    // Voxels of so many points that the watcher should hear of them; one at least.
    const std::size_t points = members.begin[std::size_t(first)];
    const auto end = std::upper_bound(
      members.begin.begin() + first + 2, members.begin.end(), points + std::size_t(kWatchedPoints));
    const std::int64_t count = end - members.begin.begin() - 1 - first;
    forRange(executor, count,
      [&](std::int64_t begin, std::int64_t last)
      {
        switch (output->GetDataType())
        {
          vtkTemplateMacro(writeMostFrequent(members, first + begin, first + last,
            static_cast<const VTK_TT*>(plain_->GetVoidPointer(0)), components,
            static_cast<VTK_TT*>(output->GetVoidPointer(0))));
        }
      });
    first += count;
    if (!watched.add(std::int64_t(members.begin[std::size_t(first)] - points)))
    {
      return false;
    }
  }
  return true;
}

} // namespace pointhaptics
