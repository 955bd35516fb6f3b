// Includes PCL: must see no -march flag, or Eigen's alignment differs from that of Debian's PCL.
#include "Benchmark/Resample/Rivals/Rival.h"

#include <pcl/console/print.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/pcl_config.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <vtkPolyData.h>

#include <cmath>
#include <limits>

namespace pointhaptics::bench::resample
{
namespace
{

class PclVoxelGrid : public Rival
{
public:
  std::string name() const override { return "PCL " PCL_VERSION_PRETTY " VoxelGrid"; }
  std::string refusal(const ResampleTask& task) const override
  {
    const double voxels = std::pow(double(task.dimension), 3);
    return voxels > double(std::numeric_limits<int>::max())
      ? "its 32-bit voxel index ends at 2^31 voxels; it would return the cloud as it is"
      : "";
  }
  void load(const ResampleTask& task) override
  {
    leaf_ = task.leaf;
    auto cloud = pcl::PointCloud<pcl::PointXYZ>::Ptr(new pcl::PointCloud<pcl::PointXYZ>);
    cloud->reserve(std::size_t(task.cloud->GetNumberOfPoints()));
    for (vtkIdType i = 0; i < task.cloud->GetNumberOfPoints(); ++i)
    {
      double p[3];
      task.cloud->GetPoint(i, p);
      cloud->emplace_back(float(p[0]), float(p[1]), float(p[2]));
    }
    filter_.setInputCloud(cloud);
    filter_.setLeafSize(float(leaf_), float(leaf_), float(leaf_));
    filter_.setMinimumPointsNumberPerVoxel(0);
    pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  }
  void run() override { filter_.filter(output_); }
  ResampleAnswer answer() const override
  {
    ResampleAnswer answer;
    const Eigen::Vector3i low = filter_.getMinBoxCoordinates();
    const Eigen::Vector3i divisions = filter_.getNrDivisions();
    for (int axis = 0; axis < 3; ++axis)
    {
      answer.lattice.origin[axis] = low[axis] * leaf_;
      answer.lattice.spacing[axis] = leaf_;
      answer.lattice.dimensions[std::size_t(axis)] = divisions[axis];
    }
    for (const pcl::PointXYZ& p : output_)
    {
      answer.xyz.insert(answer.xyz.end(), { double(p.x), double(p.y), double(p.z) });
    }
    return answer;
  }

private:
  double leaf_ = 0.0;
  mutable pcl::VoxelGrid<pcl::PointXYZ> filter_; // its getters are not const
  pcl::PointCloud<pcl::PointXYZ> output_;
};

} // namespace
} // namespace pointhaptics::bench::resample

/// See kMakeRival.
extern "C" pointhaptics::bench::resample::Rival* pointhapticsMakeRival()
{
  return new pointhaptics::bench::resample::PclVoxelGrid;
}
