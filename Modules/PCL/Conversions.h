/// @file
/// Between VTK's clouds and PCL's, nothing lost: every field of a point keeps its bits.
#pragma once

#include "vtkSmartPointer.h"

#include <pcl/PCLPointCloud2.h>
#include <pcl/conversions.h>
#include <pcl/point_cloud.h>

#include <cstddef>

class vtkPolyData;

namespace pointhaptics
{

/// The cloud as points with a vertex each, and point arrays as vtkPointCloudReader makes them of a PCD file:
/// "rgb" and "rgba" become "RGB" or "RGBA" (unsigned char, the active scalars; "RGB" where the fourth byte is
/// 0 everywhere), normal_x, normal_y and normal_z become "Normals" (the active normals), every other field an
/// array of its name, type and count. Points that are NaN stay. Field data: "OrganizedDimensions" (width,
/// height) of organised clouds; "PclFields" and "PclHeader", what toPointCloud2() needs to give the same
/// back. FLOAT64 coordinates stay double. A cloud that contradicts itself gives an empty vtkPolyData and a
/// PCL_ERROR. Never null. Any thread.
vtkSmartPointer<vtkPolyData> toPolyData(const ::pcl::PCLPointCloud2& cloud);

/// The way back: points become x, y and z (FLOAT32 or FLOAT64), "RGB" and "RGBA" packed "rgb" (FLOAT32) and
/// "rgba" (UINT32), the active normals normal_x, normal_y and normal_z, every other numeric array a field of
/// its name, type and count. Arrays of strings, and those without a name, have no place in a PCL cloud: a
/// PCL_WARN names them. Fields follow each other without gaps. Null, and a cloud without points, gives an
/// empty one and a PCL_ERROR. @return whether there are points.
bool toPointCloud2(vtkPolyData* points, ::pcl::PCLPointCloud2& cloud);

/// Field data "Viewpoint": tx ty tz qw qx qy qz, as vtkPointCloudReader has it.
void setViewpoint(vtkPolyData* points, const double viewpoint[7]);
/// False, and an unmoved viewpoint, where there is none.
bool getViewpoint(vtkPolyData* points, double viewpoint[7]);

/// As toPolyData() above, for clouds of one type of points, with the pose of the sensor as "Viewpoint".
template <typename PointT>
vtkSmartPointer<vtkPolyData> toPolyData(const ::pcl::PointCloud<PointT>& cloud)
{
  ::pcl::PCLPointCloud2 fields;
  ::pcl::toPCLPointCloud2(cloud, fields);
  vtkSmartPointer<vtkPolyData> result = toPolyData(fields);
  const auto& t = cloud.sensor_origin_;
  const auto& q = cloud.sensor_orientation_;
  const double viewpoint[7] = { t[0], t[1], t[2], q.w(), q.x(), q.y(), q.z() };
  setViewpoint(result, viewpoint);
  return result;
}

/// Fields that PointT lacks are left out, as by pcl::fromPCLPointCloud2.
template <typename PointT>
bool toPointCloud(vtkPolyData* points, ::pcl::PointCloud<PointT>& cloud)
{
  ::pcl::PCLPointCloud2 fields;
  cloud = ::pcl::PointCloud<PointT>();
  if (!toPointCloud2(points, fields))
  {
    return false;
  }
  ::pcl::fromPCLPointCloud2(fields, cloud);
  double v[7];
  static_cast<void>(getViewpoint(points, v));
  cloud.sensor_origin_ = { float(v[0]), float(v[1]), float(v[2]), 0.0f };
  cloud.sensor_orientation_ = Eigen::Quaternionf(float(v[3]), float(v[4]), float(v[5]), float(v[6]));
  return true;
}

} // namespace pointhaptics
