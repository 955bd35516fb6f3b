#include "BandwidthArrays.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <sstream>

namespace pointhaptics
{
namespace
{

void addArray(vtkPolyData* output, const char* name, const std::vector<double>& values)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfValues(vtkIdType(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  output->GetPointData()->AddArray(array);
}

}

std::vector<double> voxelCounts(vtkPolyData* cloud, bool use)
{
  std::vector<double> counts;
  vtkDataArray* array = use ? cloud->GetPointData()->GetArray("VoxelPointCount") : nullptr;
  if (array && array->GetNumberOfComponents() == 1 &&
    array->GetNumberOfTuples() == cloud->GetNumberOfPoints())
  {
    counts.resize(std::size_t(array->GetNumberOfTuples()));
    for (std::size_t i = 0; i < counts.size(); ++i)
    {
      counts[i] = array->GetComponent(vtkIdType(i), 0);
    }
  }
  return counts;
}

std::string bandwidthProblem(const BandwidthSettings& settings, Status status)
{
  std::ostringstream text;
  text << "NumberOfNeighbors " << settings.numberOfNeighbors << ", Radius " << settings.radius
       << ", RadiusScale " << settings.radiusScale << ", MinimumRadius " << settings.minimumRadius
       << ", MaximumRadius " << settings.maximumRadius << ": " << message(status) << ".";
  return text.str();
}

void addBandwidthArrays(vtkPolyData* output, const BandwidthSettings& settings,
  const std::vector<double>& densities, const std::vector<double>& ofMeans,
  const std::vector<double>& bandwidths, const std::vector<double>& radii)
{
  if (settings.computeDensity)
  {
    addArray(output, "Density", densities);
  }
  if (settings.computeMeanBandwidth)
  {
    addArray(output, "MeanBandwidth", ofMeans);
  }
  if (settings.computeBandwidth)
  {
    addArray(output, "Bandwidth", bandwidths);
  }
  if (settings.computeProxyRadius)
  {
    addArray(output, "ProxyRadius", radii);
  }
}

} // namespace pointhaptics
