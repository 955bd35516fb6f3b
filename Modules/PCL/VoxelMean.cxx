// Includes PCL: must see no -march flag, or Eigen's alignment differs from that of PCL's own libraries.
#include "PCL/VoxelMean.h"

#include <pcl/console/print.h>
#include <pcl/impl/instantiate.hpp>
#include <pcl/point_types.h>

#include <algorithm>
#include <cstring>
#include <limits>

namespace pointhaptics
{
namespace
{

int toInt(std::int64_t value)
{
  using Limits = std::numeric_limits<int>;
  return int(std::clamp<std::int64_t>(value, Limits::min(), Limits::max()));
}

}

/// Copies the records that take part where not all do.
bool PclVoxelMeanSettings::select(
  const Input& input, const std::vector<::pcl::PCLPointField>& fields, RecordCloud& cloud)
{
  cloud.records = input.records;
  cloud.size = input.size;
  cloud.step = input.step;
  selected_.clear();
  const ::pcl::PCLPointField* field = nullptr;
  if (!fieldName_.empty())
  {
    field = fieldNamed(fields, fieldName_);
    if (!field)
    {
      PCL_ERROR(
        "[pointhaptics::%s::filter] setFilterFieldName: no field is called %s; give one of the cloud's\n",
        input.name.c_str(), fieldName_.c_str());
      return false;
    }
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
      PCL_ERROR("[pointhaptics::%s::filter] setIndices: index %lld of %lld points; give 0 to %lld\n",
        input.name.c_str(), static_cast<long long>(point), static_cast<long long>(input.size),
        static_cast<long long>(input.size - 1));
      return false;
    }
    const char* record = input.records + input.step * std::size_t(point);
    const double value = field ? valueOf(*field, record) : 0.0;
    const bool isOut = field && (negative_ ? value < high_ && value > low_ : value > high_ || value < low_);
    if (!isOut)
    {
      selected_.insert(selected_.end(), record, record + input.step);
    }
  }
  cloud.records = selected_.data();
  cloud.size = std::int64_t(selected_.size() / input.step);
  return true;
}

bool PclVoxelMeanSettings::average(const Input& input, const std::vector<::pcl::PCLPointField>& fields)
{
  std::string message;
  RecordCloud cloud;
  // Drops the voxels of an earlier run.
  static_cast<void>(voxels_.run(cloud, {}, {}));
  if (!layoutOf(fields, input.step, layout_, message))
  {
    PCL_ERROR("[pointhaptics::%s::filter] %s\n", input.name.c_str(), message.c_str());
    return false;
  }
  if (!select(input, fields, cloud))
  {
    return false;
  }
  cloud.xyz = layout_.xyz;
  cloud.type = layout_.type;
  if (!downsampleAllData_)
  {
    layout_.others.clear();
  }
  RecordVoxelSettings settings;
  settings.leaf = leaf_;
  settings.minimumPoints = minimumPoints_;
  settings.keepKeys = saveLeafLayout_;
  settings.threads = threads_;
  const Status status = voxels_.run(cloud, layout_.others, settings);
  if (status != Status::Ok)
  {
    PCL_ERROR("[pointhaptics::%s::filter] leaf size (%g, %g, %g), %lld points: %s\n", input.name.c_str(),
      leaf_.x, leaf_.y, leaf_.z, static_cast<long long>(cloud.size), pointhaptics::message(status));
  }
  return status == Status::Ok;
}

void PclVoxelMeanSettings::write(char* records, std::size_t step) const
{
  std::vector<std::size_t> offsets;
  for (const RecordField& field : layout_.others)
  {
    offsets.push_back(field.offset);
  }
  voxels_.write(records, step, layout_.xyz, offsets);
}

void PclVoxelMeanSettings::write(char* records, std::size_t step, const std::array<std::size_t, 3>& xyz) const
{
  voxels_.write(records, step, xyz, {});
}

Eigen::Vector3i PclVoxelMeanSettings::getMinBoxCoordinates() const
{
  const auto& first = voxels_.first();
  return { int(first[0]), int(first[1]), int(first[2]) };
}

Eigen::Vector3i PclVoxelMeanSettings::getMaxBoxCoordinates() const
{
  return getMinBoxCoordinates() + getNrDivisions() - Eigen::Vector3i::Ones();
}

Eigen::Vector3i PclVoxelMeanSettings::getNrDivisions() const
{
  const auto& dimensions = voxels_.lattice().dimensions;
  return { int(dimensions[0]), int(dimensions[1]), int(dimensions[2]) };
}

Eigen::Vector3i PclVoxelMeanSettings::getDivisionMultiplier() const
{
  const auto& dimensions = voxels_.lattice().dimensions;
  return { 1, int(dimensions[0]), toInt(dimensions[0] * dimensions[1]) };
}

Eigen::Vector3i PclVoxelMeanSettings::getGridCoordinates(float x, float y, float z) const
{
  const auto voxel = RecordVoxels::voxelOf({ double(x), double(y), double(z) }, leaf_);
  return { toInt(voxel[0]), toInt(voxel[1]), toInt(voxel[2]) };
}

int PclVoxelMeanSettings::getCentroidIndexAt(const Eigen::Vector3i& voxel) const
{
  return toInt(voxels_.indexOf({ voxel[0], voxel[1], voxel[2] }));
}

std::vector<int> PclVoxelMeanSettings::getLeafLayout() const
{
  std::vector<int> layout = voxels_.layout(std::numeric_limits<int>::max());
  if (layout.empty() && saveLeafLayout_ && voxels_.size() > 0)
  {
    PCL_ERROR("[pointhaptics::PclVoxelMean::getLeafLayout] 2^31 voxels or more; use getCentroidIndexAt()\n");
  }
  return layout;
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
    write(reinterpret_cast<char*>(output.data.data()), output.point_step, { 0, bytes, 2 * bytes });
  }
  output.row_step = output.point_step * output.width;
}

#define PCL_INSTANTIATE_PclVoxelMean(T) template class PclVoxelMean<T>;
PCL_INSTANTIATE(PclVoxelMean, PCL_XYZ_POINT_TYPES)

} // namespace pointhaptics
