// Includes PCL: must see no -march flag, or Eigen's alignment differs from that of Debian's PCL.
#include "Benchmark/Bandwidth/Rivals/RivalLoop.h"

#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/pcl_config.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

namespace pointhaptics::bench::bandwidth
{
namespace
{

class PclKdTree : public Rival
{
public:
  std::string name() const override { return "PCL " PCL_VERSION_PRETTY " KdTreeFLANN"; }
  void load(const BandwidthTask& task) override
  {
    neighbors_ = task.neighbors;
    cloud_.reset(new pcl::PointCloud<pcl::PointXYZ>);
    for (std::int64_t i = 0; i < task.points.size(); ++i)
    {
      const Vec3 p = task.points[i];
      cloud_->emplace_back(float(p.x), float(p.y), float(p.z));
    }
  }
  void run(bool parallel) override
  {
    pcl::KdTreeFLANN<pcl::PointXYZ> tree(false); // unsorted results, the faster way
    tree.setInputCloud(cloud_);
    answer_.bandwidths.resize(cloud_->size());
    answer_.radii.resize(cloud_->size());
    loopOver(std::int64_t(cloud_->size()), parallel,
      [&](vtkIdType begin, vtkIdType end)
      {
        std::vector<int> indices;
        std::vector<float> squares;
        for (std::size_t i = std::size_t(begin); i < std::size_t(end); ++i)
        {
          const int count = tree.nearestKSearch((*cloud_)[i], neighbors_ + 1, indices, squares);
          const Vec3 center = placeOf(i);
          NeighborhoodSums sums;
          for (int j = 0; j < count; ++j)
          {
            sums.add(placeOf(std::size_t(indices[std::size_t(j)])) - center, double(squares[std::size_t(j)]));
          }
          sums.write(count, i, answer_);
        }
      });
  }
  BandwidthAnswer answer() const override { return answer_; }

private:
  Vec3 placeOf(std::size_t i) const
  {
    const pcl::PointXYZ& p = (*cloud_)[i];
    return { double(p.x), double(p.y), double(p.z) };
  }

  int neighbors_ = 16;
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud_;
  BandwidthAnswer answer_;
};

} // namespace
} // namespace pointhaptics::bench::bandwidth

/// See kMakeRival.
extern "C" pointhaptics::bench::bandwidth::Rival* pointhapticsMakeRival()
{
  return new pointhaptics::bench::bandwidth::PclKdTree;
}
