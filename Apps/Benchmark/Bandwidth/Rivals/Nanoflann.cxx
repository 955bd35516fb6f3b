#include "Benchmark/Bandwidth/Rivals/RivalLoop.h"

#include <nanoflann.hpp>

namespace pointhaptics::bench::bandwidth
{
namespace
{

/// As nanoflann asks for a cloud.
struct Places
{
  std::vector<Vec3> points;

  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const { return points[i][int(axis)]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const
  {
    return false;
  }
};

using Tree =
  nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Places>, Places, 3, std::uint32_t>;

class Nanoflann : public Rival
{
public:
  std::string name() const override
  {
    return "nanoflann " + std::to_string(NANOFLANN_VERSION >> 8) + "." +
      std::to_string(NANOFLANN_VERSION >> 4 & 15) + "." + std::to_string(NANOFLANN_VERSION & 15);
  }
  void load(const BandwidthTask& task) override
  {
    neighbors_ = task.neighbors;
    places_.points.clear();
    for (std::int64_t i = 0; i < task.points.size(); ++i)
    {
      places_.points.push_back(task.points[i]);
    }
  }
  void run(bool parallel) override
  {
    Tree tree(3, places_, nanoflann::KDTreeSingleIndexAdaptorParams(10));
    tree.buildIndex();
    answer_.bandwidths.resize(places_.points.size());
    answer_.radii.resize(places_.points.size());
    loopOver(std::int64_t(places_.points.size()), parallel,
      [&](vtkIdType begin, vtkIdType end)
      {
        const std::size_t wanted = std::size_t(neighbors_) + 1;
        std::vector<std::uint32_t> indices(wanted);
        std::vector<double> squares(wanted);
        for (std::size_t i = std::size_t(begin); i < std::size_t(end); ++i)
        {
          const Vec3 center = places_.points[i];
          const std::size_t count = tree.knnSearch(&center.x, wanted, indices.data(), squares.data());
          NeighborhoodSums sums;
          for (std::size_t j = 0; j < count; ++j)
          {
            sums.add(places_.points[indices[j]] - center, squares[j]);
          }
          sums.write(int(count), i, answer_);
        }
      });
  }
  BandwidthAnswer answer() const override { return answer_; }

private:
  int neighbors_ = 16;
  Places places_;
  BandwidthAnswer answer_;
};

} // namespace
} // namespace pointhaptics::bench::bandwidth

/// See kMakeRival.
extern "C" pointhaptics::bench::bandwidth::Rival* pointhapticsMakeRival()
{
  return new pointhaptics::bench::bandwidth::Nanoflann;
}
