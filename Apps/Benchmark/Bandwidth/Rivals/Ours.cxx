#include "Benchmark/Bandwidth/Rivals/Rival.h"

#include "vtkKernelBandwidthFilter.h"

#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

namespace pointhaptics
{
namespace bench
{
namespace bandwidth
{
namespace
{

std::vector<double> valuesOf(vtkPolyData* cloud, const char* name)
{
  std::vector<double> values;
  vtkDataArray* array = cloud->GetPointData()->GetArray(name);
  for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
  {
    values.push_back(array->GetComponent(i, 0));
  }
  return values;
}

class Ours : public Rival
{
public:
  std::string name() const override { return "ours"; }
  bool isOurs() const override { return true; }
  void load(const BandwidthTask& task) override
  {
    input_->SetPoints(task.cloud->GetPoints());
    filter_->SetInputData(input_);
    filter_->SetNumberOfNeighbors(task.neighbors);
    filter_->SetRadiusScale(kRadiusScale);
    filter_->ComputeDensityOff();
  }
  void run(bool) override
  {
    input_->Modified();
    filter_->Update();
  }
  BandwidthAnswer answer() const override
  {
    return { valuesOf(filter_->GetOutput(), "Bandwidth"), valuesOf(filter_->GetOutput(), "ProxyRadius") };
  }

private:
  vtkNew<vtkPolyData> input_;
  vtkNew<vtkKernelBandwidthFilter> filter_;
};

} // namespace

std::unique_ptr<Rival> makeOurs()
{
  return std::make_unique<Ours>();
}

} // namespace bandwidth
} // namespace bench
} // namespace pointhaptics
