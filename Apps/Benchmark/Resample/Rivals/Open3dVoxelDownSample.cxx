// Includes Eigen: must see no -march flag, or its alignment differs from that of the installed Open3D.
#include "Benchmark/Resample/Rivals/Rival.h"

#include <open3d/Open3DConfig.h>
#include <open3d/geometry/PointCloud.h>

#include <vtkPolyData.h>

#include <cmath>

namespace pointhaptics
{
namespace bench
{
namespace resample
{
namespace
{

class Open3dVoxelDownSample : public Rival
{
public:
  std::string name() const override { return "Open3D " OPEN3D_VERSION " VoxelDownSample"; }
  void load(const ResampleTask& task) override
  {
    leaf_ = task.leaf;
    cloud_.points_.reserve(std::size_t(task.cloud->GetNumberOfPoints()));
    for (vtkIdType i = 0; i < task.cloud->GetNumberOfPoints(); ++i)
    {
      double p[3];
      task.cloud->GetPoint(i, p);
      cloud_.points_.emplace_back(p[0], p[1], p[2]);
    }
  }
  void run() override { output_ = cloud_.VoxelDownSample(leaf_); }
  /// Its lattice begins half a voxel below the cloud.
  ResampleAnswer answer() const override
  {
    ResampleAnswer answer;
    const Eigen::Vector3d low = cloud_.GetMinBound();
    const Eigen::Vector3d high = cloud_.GetMaxBound();
    for (int axis = 0; axis < 3; ++axis)
    {
      answer.lattice.origin[axis] = low[axis] - 0.5 * leaf_;
      answer.lattice.spacing[axis] = leaf_;
      answer.lattice.dimensions[std::size_t(axis)] =
        std::int64_t(std::floor((high[axis] - low[axis]) / leaf_ + 0.5)) + 1;
    }
    for (const Eigen::Vector3d& p : output_->points_)
    {
      answer.xyz.insert(answer.xyz.end(), { p[0], p[1], p[2] });
    }
    return answer;
  }
  std::int64_t resultBytes() const override
  {
    return std::int64_t(output_->points_.size() * sizeof(Eigen::Vector3d));
  }

private:
  double leaf_ = 0.0;
  open3d::geometry::PointCloud cloud_;
  std::shared_ptr<open3d::geometry::PointCloud> output_;
};

} // namespace

} // namespace resample
} // namespace bench
} // namespace pointhaptics

/// See kMakeRival.
extern "C" pointhaptics::bench::resample::Rival* pointhapticsMakeRival()
{
  return new pointhaptics::bench::resample::Open3dVoxelDownSample;
}
