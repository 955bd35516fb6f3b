// VoxelMeanBenchmark [POINTS]: PclVoxelMean beside pcl::VoxelGrid in one run, with all fields, by point type.
// Medians of wall times and minima of processor times of rounds in which each contestant runs once; quote
// ratios.
#include "PCL/VoxelMean.h"

#include <pcl/conversions.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <random>
#include <vector>

namespace
{

constexpr int kRounds = 15;

template <typename PointT>
void fill(PointT& point, std::mt19937& random)
{
  std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
  float direction[3] = { unit(random), unit(random), unit(random) };
  const float length =
    std::sqrt(direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2]) +
    1e-6f;
  for (float& component : direction)
  {
    component /= length;
  }
  // A sphere of radius 0.5, as scans are: two-dimensional.
  point.x = 0.5f * direction[0];
  point.y = 0.5f * direction[1];
  point.z = 0.5f * direction[2];
  if constexpr (pcl::traits::has_color<PointT>::value)
  {
    point.r = std::uint8_t(random());
    point.g = std::uint8_t(random());
    point.b = std::uint8_t(random());
  }
  if constexpr (pcl::traits::has_normal<PointT>::value)
  {
    std::copy(direction, direction + 3, point.normal);
  }
  if constexpr (pcl::traits::has_curvature<PointT>::value)
  {
    point.curvature = unit(random);
  }
  if constexpr (pcl::traits::has_intensity<PointT>::value)
  {
    point.intensity = unit(random);
  }
}

/// Times of a contestant's rounds, milliseconds.
struct Times
{
  std::vector<double> wall;
  std::vector<double> processor; ///< Time of all threads: useful where others have the machine, too.

  void add(const std::function<void()>& work)
  {
    const auto begin = std::chrono::steady_clock::now();
    const std::clock_t ticks = std::clock();
    work();
    processor.push_back(1e3 * double(std::clock() - ticks) / CLOCKS_PER_SEC);
    wall.push_back(
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
  }
  double medianWall() const
  {
    std::vector<double> sorted = wall;
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2];
  }
  double leastProcessor() const { return *std::min_element(processor.begin(), processor.end()); }
};

template <typename Cloud, typename Grid, typename Ours>
void race(const char* name, const typename Cloud::Ptr& cloud)
{
  const float leaf = 1.0f / 300.0f;
  Grid grid;
  Ours one;
  Ours two;
  grid.setInputCloud(cloud);
  grid.setLeafSize(leaf, leaf, leaf);
  for (Ours* ours : { &one, &two })
  {
    ours->setInputCloud(cloud);
    ours->setLeafSize(leaf, leaf, leaf);
    ours->setNumberOfThreads(ours == &one ? 1 : 2);
  }
  Cloud output[3];
  Times times[3];
  for (int round = 0; round < kRounds; ++round)
  {
    times[0].add([&] { grid.filter(output[0]); });
    times[1].add([&] { one.filter(output[1]); });
    times[2].add([&] { two.filter(output[2]); });
  }
  std::printf("%-24s |%8.2f%8.2f%8.2f |%6.1f%6.1f |%8.2f%8.2f |%6.1f\n", name, times[0].medianWall(),
    times[1].medianWall(), times[2].medianWall(), times[0].medianWall() / times[1].medianWall(),
    times[0].medianWall() / times[2].medianWall(), times[0].leastProcessor(), times[1].leastProcessor(),
    times[0].leastProcessor() / times[1].leastProcessor());
}

template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr makeCloud(int points)
{
  std::mt19937 random(1);
  typename pcl::PointCloud<PointT>::Ptr cloud(new pcl::PointCloud<PointT>);
  cloud->resize(std::size_t(points));
  for (PointT& point : *cloud)
  {
    fill(point, random);
  }
  return cloud;
}

template <typename PointT>
void raceOf(const char* name, int points)
{
  race<pcl::PointCloud<PointT>, pcl::VoxelGrid<PointT>, pointhaptics::PclVoxelMean<PointT>>(
    name, makeCloud<PointT>(points));
}

} // namespace

int main(int argc, char* argv[])
{
  const int points = argc > 1 ? std::atoi(argv[1]) : 543652;
  std::printf(
    "%-24s |%24s |%12s |%16s |%6s\n", "", "wall: grid, 1, 2 threads", "ratios", "processor", "ratio");
  raceOf<pcl::PointXYZ>("PointXYZ", points);
  raceOf<pcl::PointXYZI>("PointXYZI", points);
  raceOf<pcl::PointXYZRGB>("PointXYZRGB", points);
  raceOf<pcl::PointNormal>("PointNormal", points);
  raceOf<pcl::PointXYZRGBNormal>("PointXYZRGBNormal", points);
  pcl::PCLPointCloud2::Ptr cloud(new pcl::PCLPointCloud2);
  pcl::toPCLPointCloud2(*makeCloud<pcl::PointXYZRGBNormal>(points), *cloud);
  race<pcl::PCLPointCloud2, pcl::VoxelGrid<pcl::PCLPointCloud2>,
    pointhaptics::PclVoxelMean<pcl::PCLPointCloud2>>("PCLPointCloud2, the same", cloud);
  return 0;
}
