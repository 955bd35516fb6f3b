// A pipeline of PCL's tutorials: downsample, find the table, take it away, estimate the normals of what
// stands on it. The grid is the one line that differs.
#include "PCL/VoxelMean.h"

#include <pcl/console/print.h>
#include <pcl/features/normal_3d.h>
#include <pcl/filters/extract_indices.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/sac_segmentation.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <random>

namespace
{

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

/// A ball of 20 cm on a table of 2 m, with a millimetre of noise.
Cloud::Ptr scene()
{
  auto cloud = pcl::make_shared<Cloud>();
  std::mt19937 random(1);
  std::uniform_real_distribution<float> place(-1.0f, 1.0f);
  std::normal_distribution<float> normal;
  for (int i = 0; i < 400000; ++i)
  {
    cloud->push_back({ place(random), place(random), 0.001f * normal(random) });
    if (i % 4 == 0)
    {
      const Eigen::Vector3f up(normal(random), normal(random), normal(random));
      const Eigen::Vector3f p = 0.2f * up.normalized() + Eigen::Vector3f(0.0f, 0.0f, 0.2f);
      cloud->push_back({ p.x(), p.y(), p.z() });
    }
  }
  return cloud;
}

struct Result
{
  std::size_t means = 0;
  double seconds = 0.0; ///< Seconds of the grid: the best of five.
  pcl::ModelCoefficients table;
  std::size_t left = 0;     ///< Points that are not the table's.
  double normalError = 0.0; ///< Mean sine between the normals and those of the ball.
};

template <typename Grid>
Result run(const Cloud::ConstPtr& cloud)
{
  Result result;
  auto means = pcl::make_shared<Cloud>();
  Grid grid;
  grid.setInputCloud(cloud);
  grid.setLeafSize(0.015625f, 0.015625f, 0.015625f);
  result.seconds = 1e9;
  for (int i = 0; i < 5; ++i)
  {
    const auto start = std::chrono::steady_clock::now();
    grid.filter(*means);
    result.seconds = std::min(
      result.seconds, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  result.means = means->size();

  pcl::SACSegmentation<pcl::PointXYZ> segmentation;
  segmentation.setOptimizeCoefficients(true);
  segmentation.setModelType(pcl::SACMODEL_PLANE);
  segmentation.setMethodType(pcl::SAC_RANSAC);
  segmentation.setDistanceThreshold(0.01);
  segmentation.setInputCloud(means);
  auto table = pcl::make_shared<pcl::PointIndices>();
  segmentation.segment(*table, result.table);
  pcl::ExtractIndices<pcl::PointXYZ> extract;
  extract.setInputCloud(means);
  extract.setIndices(table);
  extract.setNegative(true);
  auto ball = pcl::make_shared<Cloud>();
  extract.filter(*ball);
  result.left = ball->size();

  pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setInputCloud(ball);
  estimation.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
  estimation.setKSearch(12);
  pcl::PointCloud<pcl::Normal> normals;
  estimation.compute(normals);
  for (std::size_t i = 0; i < normals.size(); ++i)
  {
    const Eigen::Vector3f out =
      ((*ball)[i].getVector3fMap() - Eigen::Vector3f(0.0f, 0.0f, 0.2f)).normalized();
    result.normalError +=
      double(out.cross(normals[i].getNormalVector3fMap()).norm()) / double(normals.size());
  }
  return result;
}

}

int main()
{
  const Cloud::ConstPtr cloud = scene();
  const Result theirs = run<pcl::VoxelGrid<pcl::PointXYZ>>(cloud);
  const Result ours = run<pointhaptics::PclVoxelMean<pcl::PointXYZ>>(cloud); // the one line
  std::printf("%zu points, %zu means: table z = %.5f, %zu points of the ball, normals off by %.4f\n",
    cloud->size(), ours.means, double(-ours.table.values[3] / ours.table.values[2]), ours.left,
    ours.normalError);
  std::printf("the grid took %.2f ms, pcl::VoxelGrid %.2f ms: %.1f times as long\n", 1e3 * ours.seconds,
    1e3 * theirs.seconds, theirs.seconds / ours.seconds);
  const double shift = std::abs(std::abs(ours.table.values[3]) - std::abs(theirs.table.values[3]));
  const bool same = ours.means == theirs.means && ours.left == theirs.left && shift < 1e-5 &&
    std::abs(ours.normalError - theirs.normalError) < 1e-4 && ours.left > 1000 && ours.normalError < 0.05;
  std::puts(
    same ? "the same table and ball as with pcl::VoxelGrid" : "another result than with pcl::VoxelGrid");
  return same ? 0 : 1;
}
