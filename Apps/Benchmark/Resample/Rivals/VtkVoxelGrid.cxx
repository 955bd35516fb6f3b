#include "Benchmark/Resample/Rivals/Rival.h"

#include <fmt/format.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkVersion.h>
#include <vtkVoxelGrid.h>

#include <cmath>

namespace pointhaptics
{
namespace bench
{
namespace resample
{
namespace
{

/// Its bins are dense; this many take seconds and gigabytes.
constexpr double kMostBins = 4e8;

class VtkVoxelGrid : public Rival
{
public:
  std::string name() const override
  {
    return fmt::format("VTK {} vtkVoxelGrid", vtkVersion::GetVTKVersion());
  }
  std::string refusal(const ResampleTask& task) const override
  {
    const double bins = std::pow(double(task.dimension), 3);
    return bins > kMostBins ? fmt::format("its bins are dense: {:.1e} of them", bins) : "";
  }
  void load(const ResampleTask& task) override
  {
    leaf_ = task.leaf;
    input_->SetPoints(task.cloud->GetPoints());
    filter_->SetInputData(input_);
    filter_->SetConfigurationStyleToLeafSize();
    filter_->SetLeafSize(leaf_, leaf_, leaf_);
  }
  void before() override { input_->Modified(); }
  void run() override { filter_->Update(); }
  /// The lattice it used: bounds over the truncated number of leaves.
  ResampleAnswer answer() const override
  {
    ResampleAnswer answer;
    double bounds[6];
    input_->GetBounds(bounds);
    for (int axis = 0; axis < 3; ++axis)
    {
      const double length = bounds[2 * axis + 1] - bounds[2 * axis];
      const double divisions = std::fmax(1.0, std::trunc(length / leaf_));
      answer.lattice.origin[axis] = bounds[2 * axis];
      answer.lattice.spacing[axis] = length / divisions;
      answer.lattice.dimensions[std::size_t(axis)] = std::int64_t(divisions);
      if (answer.fault.empty() && std::fabs(length / divisions / leaf_ - 1.0) > 1e-6)
      {
        answer.fault = fmt::format("voxels {:.2f} % too large (it truncates the leaf count)",
          100.0 * (length / divisions / leaf_ - 1.0));
      }
    }
    vtkPolyData* output = filter_->GetOutput();
    for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
    {
      double p[3];
      output->GetPoint(i, p);
      answer.xyz.insert(answer.xyz.end(), p, p + 3);
    }
    return answer;
  }
  std::int64_t resultBytes() const override
  {
    return std::int64_t(1024 * filter_->GetOutput()->GetActualMemorySize());
  }

private:
  double leaf_ = 0.0;
  vtkNew<vtkPolyData> input_;
  vtkNew<vtkVoxelGrid> filter_;
};

} // namespace

std::unique_ptr<Rival> makeVtkVoxelGrid()
{
  return std::make_unique<VtkVoxelGrid>();
}

} // namespace resample
} // namespace bench
} // namespace pointhaptics
