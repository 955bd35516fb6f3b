#include "Benchmark/Bandwidth/Rivals/RivalLoop.h"

#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStaticPointLocator.h>
#include <vtkVersion.h>

namespace pointhaptics
{
namespace bench
{
namespace bandwidth
{
namespace
{

class VtkStaticPointLocator : public Rival
{
public:
  std::string name() const override
  {
    return std::string("VTK ") + vtkVersion::GetVTKVersion() + " vtkStaticPointLocator";
  }
  void load(const BandwidthTask& task) override { task_ = task; }
  void run(bool parallel) override
  {
    vtkNew<vtkStaticPointLocator> locator;
    locator->SetDataSet(task_.cloud);
    locator->BuildLocator();
    answer_.bandwidths.resize(std::size_t(task_.points.size()));
    answer_.radii.resize(std::size_t(task_.points.size()));
    loopOver(task_.points.size(), parallel,
      [&](vtkIdType begin, vtkIdType end)
      {
        vtkNew<vtkIdList> found;
        for (vtkIdType i = begin; i < end; ++i)
        {
          const Vec3 center = task_.points[i];
          locator->FindClosestNPoints(task_.neighbors + 1, &center.x, found);
          NeighborhoodSums sums;
          for (vtkIdType j = 0; j < found->GetNumberOfIds(); ++j)
          {
            const Vec3 offset = task_.points[found->GetId(j)] - center;
            sums.add(offset, norm2(offset));
          }
          sums.write(int(found->GetNumberOfIds()), std::size_t(i), answer_);
        }
      });
  }
  BandwidthAnswer answer() const override { return answer_; }

private:
  BandwidthTask task_;
  BandwidthAnswer answer_;
};

} // namespace

std::unique_ptr<Rival> makeVtkStaticPointLocator()
{
  return std::make_unique<VtkStaticPointLocator>();
}

} // namespace bandwidth
} // namespace bench
} // namespace pointhaptics
