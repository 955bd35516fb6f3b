// Includes PCL: must see no -march flag, or Eigen's alignment differs from that of PCL's own libraries.
#include "PCL/VoxelMean.h"

#include "SmpExecutor.h"

#include "Core/Resample/TransformedBounds.h"

#include <pcl/console/print.h>
#include <pcl/impl/instantiate.hpp>
#include <pcl/point_types.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>

namespace pointhaptics
{
namespace
{

int toInt(std::int64_t value)
{
  using Limits = std::numeric_limits<int>;
  return int(std::clamp<std::int64_t>(value, Limits::min(), Limits::max()));
}

/// The coordinates where they are. Of strides and offsets that are no multiples of the numbers' sizes, and of
/// x, y and z that do not follow each other, they are copied to @p copy.
template <typename Real>
PointView viewOf(const char* records, std::int64_t size, std::size_t step,
  const std::array<std::size_t, 3>& xyz, std::vector<Real>& copy)
{
  const auto* first = records + xyz[0];
  if (step % sizeof(Real) == 0 && reinterpret_cast<std::uintptr_t>(first) % alignof(Real) == 0 &&
    xyz[1] == xyz[0] + sizeof(Real) && xyz[2] == xyz[1] + sizeof(Real))
  {
    return { reinterpret_cast<const Real*>(first), size, std::int64_t(step / sizeof(Real)) };
  }
  copy.resize(3 * std::size_t(size));
  for (std::size_t i = 0; i < copy.size(); ++i)
  {
    std::memcpy(&copy[i], records + step * (i / 3) + xyz[i % 3], sizeof(Real));
  }
  return { copy.data(), size };
}

/// A field of the voxels, and where it goes.
struct Written
{
  const char* tuples;
  std::size_t every; ///< Bytes from one tuple to the next.
  std::size_t bytes; ///< Bytes that are copied of each tuple.
  std::size_t offset;
};

}

/// Copies the records that take part to @p selected where not all do. False: @p message says why none can.
bool PclVoxelMeanSettings::select(Input& input, const std::vector<::pcl::PCLPointField>& fields,
  std::vector<char>& selected, std::string& message) const
{
  const ::pcl::PCLPointField* field = fieldName_.empty() ? nullptr : fieldNamed(fields, fieldName_);
  if (!fieldName_.empty() && !field)
  {
    message = "setFilterFieldName: no field is called " + fieldName_ + "; give one of the cloud's";
    return false;
  }
  if (!field && !input.indices)
  {
    return true;
  }
  const std::int64_t count = input.indices ? std::int64_t(input.indices->size()) : input.size;
  for (std::int64_t i = 0; i < count; ++i)
  {
    const std::int64_t point = input.indices ? std::int64_t((*input.indices)[std::size_t(i)]) : i;
    if (point < 0 || point >= input.size)
    {
      message = "setIndices: index " + std::to_string(point) + " of " + std::to_string(input.size) +
        " points; give 0 to " + std::to_string(input.size - 1);
      return false;
    }
    const char* record = input.records + input.step * std::size_t(point);
    const double value = field ? valueOf(*field, record) : 0.0;
    const bool isOut = field && (negative_ ? value < high_ && value > low_ : value > high_ || value < low_);
    if (!isOut)
    {
      selected.insert(selected.end(), record, record + input.step);
    }
  }
  input.records = selected.data();
  input.size = std::int64_t(selected.size() / input.step);
  return true;
}

bool PclVoxelMeanSettings::average(Input input, const std::vector<::pcl::PCLPointField>& fields)
{
  lattice_ = Lattice();
  kept_.clear();
  keys_.clear();
  size_ = 0;
  std::string problem;
  std::vector<char> selected;
  if (layoutOf(fields, input.step, layout_, problem) && select(input, fields, selected, problem))
  {
    if (!downsampleAllData_)
    {
      layout_.others.clear();
    }
    const Status status = run(input, SmpExecutor(threads_));
    if (status == Status::Ok)
    {
      return true;
    }
    std::ostringstream text;
    text << "leaf size (" << leaf_.x << ", " << leaf_.y << ", " << leaf_.z << "), " << input.size
         << " points: " << message(status);
    problem = text.str();
  }
  PCL_ERROR("[pointhaptics::%s::filter] %s\n", input.name.c_str(), problem.c_str());
  return false;
}

/// Errors: Empty (no finite point), those of alignedLattice() and VoxelResampler::run().
Status PclVoxelMeanSettings::run(const Input& input, const Executor& executor)
{
  std::vector<float> floats;
  std::vector<double> doubles;
  VoxelRequest request;
  request.singlePrecision = layout_.type == ScalarType::Float;
  request.points = request.singlePrecision
    ? viewOf(input.records, input.size, input.step, layout_.xyz, floats)
    : viewOf(input.records, input.size, input.step, layout_.xyz, doubles);
  request.keys = saveLeafLayout_;
  for (const RecordField& field : layout_.others)
  {
    const AttributeView view = { input.records + field.offset, field.type, field.components, input.size,
      std::int64_t(input.step) };
    request.attributes.push_back({ view, field.statistic });
  }
  const Bounds box = transformedBounds(request.points, {}, executor);
  Status status = box.empty() ? Status::Empty : alignedLattice(leaf_, box, lattice_, first_);
  if (status != Status::Ok)
  {
    return status;
  }
  request.lattice = lattice_;
  engine_ = engine_ ? std::move(engine_) : std::make_unique<VoxelResampler>();
  status = engine_->run(request, executor);
  if (status != Status::Ok)
  {
    return status;
  }
  for (std::int64_t v = 0; minimumPoints_ > 1 && v < engine_->size(); ++v)
  {
    if (engine_->counts()[v] >= std::int64_t(minimumPoints_))
    {
      kept_.push_back(v);
    }
  }
  size_ = minimumPoints_ > 1 ? std::int64_t(kept_.size()) : engine_->size();
  for (std::size_t i = 0; saveLeafLayout_ && i < std::size_t(size_); ++i)
  {
    keys_.push_back(engine_->keys()[kept_.empty() ? i : std::size_t(kept_[i])]);
  }
  return status;
}

/// The fields of a record lie together: each record is written once.
void PclVoxelMeanSettings::write(
  char* records, std::size_t step, const std::optional<std::array<std::size_t, 3>>& xyz) const
{
  if (size_ == 0)
  {
    return;
  }
  const bool isSingle = layout_.type == ScalarType::Float;
  const void* means = isSingle ? static_cast<const void*>(engine_->floats()) : engine_->doubles();
  const std::size_t bytes = isSingle ? sizeof(float) : sizeof(double);
  std::vector<Written> fields;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    fields.push_back(
      { static_cast<const char*>(means) + axis * bytes, 3 * bytes, bytes, xyz.value_or(layout_.xyz)[axis] });
  }
  for (std::size_t i = 0; i < layout_.others.size(); ++i)
  {
    const RecordField& other = layout_.others[i];
    fields.push_back(
      { static_cast<const char*>(engine_->attribute(i)), other.bytes(), other.bytes(), other.offset });
  }
  forEachIndex(SmpExecutor(threads_), size_,
    [&](std::int64_t i)
    {
      const std::size_t voxel = std::size_t(kept_.empty() ? i : kept_[std::size_t(i)]);
      char* record = records + step * std::size_t(i);
      for (const Written& field : fields)
      {
        std::memcpy(record + field.offset, field.tuples + field.every * voxel, field.bytes);
      }
    });
}

Eigen::Vector3i PclVoxelMeanSettings::getMinBoxCoordinates() const
{
  return { int(first_[0]), int(first_[1]), int(first_[2]) };
}

Eigen::Vector3i PclVoxelMeanSettings::getMaxBoxCoordinates() const
{
  return getMinBoxCoordinates() + getNrDivisions() - Eigen::Vector3i::Ones();
}

Eigen::Vector3i PclVoxelMeanSettings::getNrDivisions() const
{
  const auto& dimensions = lattice_.dimensions;
  return { int(dimensions[0]), int(dimensions[1]), int(dimensions[2]) };
}

Eigen::Vector3i PclVoxelMeanSettings::getDivisionMultiplier() const
{
  const auto& dimensions = lattice_.dimensions;
  return { 1, int(dimensions[0]), toInt(dimensions[0] * dimensions[1]) };
}

Eigen::Vector3i PclVoxelMeanSettings::getGridCoordinates(float x, float y, float z) const
{
  constexpr double kFarAway = 1e12; // in no lattice
  Lattice aboutOrigin;
  aboutOrigin.spacing = leaf_;
  Vec3 index = aboutOrigin.continuousIndex({ double(x), double(y), double(z) });
  for (int axis = 0; axis < 3; ++axis)
  {
    index[axis] = std::isnan(index[axis]) ? -kFarAway : std::clamp(index[axis], -kFarAway, kFarAway);
  }
  const std::array<std::int64_t, 3> voxel = Lattice::voxelAt(index);
  return { toInt(voxel[0]), toInt(voxel[1]), toInt(voxel[2]) };
}

int PclVoxelMeanSettings::getCentroidIndexAt(const Eigen::Vector3i& voxel) const
{
  std::array<std::int64_t, 3> inside{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    inside[axis] = voxel[Eigen::Index(axis)] - first_[axis];
    if (inside[axis] < 0 || inside[axis] >= lattice_.dimensions[axis])
    {
      return -1;
    }
  }
  const std::uint64_t key = lattice_.key(inside[0], inside[1], inside[2]);
  const auto found = std::lower_bound(keys_.begin(), keys_.end(), key);
  return found != keys_.end() && *found == key ? toInt(found - keys_.begin()) : -1;
}

void PclVoxelMean<::pcl::PCLPointCloud2>::applyFilter(::pcl::PCLPointCloud2& output)
{
  const ::pcl::PCLPointCloud2& cloud = *input_;
  // Where all of a record is written anew its memory need not be cleared.
  std::vector<std::uint8_t> kept;
  kept.swap(output.data);
  output.fields.clear();
  output.width = output.height = output.point_step = output.row_step = 0;
  output.is_bigendian = ::pcl::PCLPointCloud2().is_bigendian;
  output.is_dense = true;
  const std::size_t size = std::size_t(cloud.width) * cloud.height;
  const std::size_t rowBytes = std::size_t(cloud.width) * cloud.point_step;
  if (size == 0 || cloud.point_step == 0 || cloud.is_bigendian != output.is_bigendian ||
    (cloud.height > 1 && cloud.row_step != rowBytes) || cloud.data.size() / cloud.point_step < size)
  {
    PCL_ERROR(
      "[pointhaptics::%s::filter] %u x %u points of %u bytes in rows of %u, %zu bytes in all: no cloud of "
      "this machine; give points, rows without gaps, as many bytes as they need, and is_bigendian as here\n",
      filter_name_.c_str(), cloud.width, cloud.height, cloud.point_step, cloud.row_step, cloud.data.size());
    return;
  }
  const Input input{ reinterpret_cast<const char*>(cloud.data.data()), std::int64_t(size), cloud.point_step,
    fake_indices_ ? nullptr : indices_.get(), filter_name_ };
  if (!average(input, cloud.fields))
  {
    return;
  }
  output.width = ::pcl::uindex_t(numberOfVoxels());
  output.height = 1;
  if (getDownsampleAllData())
  {
    output.fields = cloud.fields;
    output.point_step = cloud.point_step;
    output.data.swap(kept);
    output.data.resize(std::size_t(output.point_step) * output.width);
    write(reinterpret_cast<char*>(output.data.data()), output.point_step);
  }
  else
  {
    const std::size_t bytes =
      fieldNamed(cloud.fields, "x")->datatype == ::pcl::PCLPointField::FLOAT32 ? 4 : 8;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      output.fields.push_back(*fieldNamed(cloud.fields, std::string(1, "xyz"[axis])));
      output.fields.back().offset = ::pcl::uindex_t(bytes * axis);
    }
    output.point_step = ::pcl::uindex_t(4 * bytes); // as pcl::VoxelGrid: aligned
    output.data.resize(std::size_t(output.point_step) * output.width);
    const std::array<std::size_t, 3> xyz = { 0, bytes, 2 * bytes };
    write(reinterpret_cast<char*>(output.data.data()), output.point_step, xyz);
  }
  output.row_step = output.point_step * output.width;
}

#define PCL_INSTANTIATE_PclVoxelMean(T) template class PclVoxelMean<T>;
PCL_INSTANTIATE(PclVoxelMean, PCL_XYZ_POINT_TYPES)

} // namespace pointhaptics
