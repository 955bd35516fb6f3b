#include "BandwidthArrays.h"

#include "SmpExecutor.h"
#include "VoxelOutput.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace pointhaptics
{
std::vector<double> voxelCounts(vtkPointSet* cloud, bool use, std::string& problem)
{
  std::vector<double> counts;
  vtkAbstractArray* any = use ? cloud->GetPointData()->GetAbstractArray("VoxelPointCount") : nullptr;
  auto* array = vtkDataArray::SafeDownCast(any);
  if (array && array->GetNumberOfComponents() == 1 &&
    array->GetNumberOfTuples() == cloud->GetNumberOfPoints())
  {
    counts.resize(std::size_t(array->GetNumberOfTuples()));
    for (std::size_t i = 0; i < counts.size(); ++i)
    {
      counts[i] = array->GetComponent(vtkIdType(i), 0);
    }
  }
  const bool areCounts = std::all_of(
    counts.begin(), counts.end(), [](double count) { return count > 0.0 && std::isfinite(count); });
  if (any && (!areCounts || vtkIdType(counts.size()) != cloud->GetNumberOfPoints()))
  {
    counts.clear();
    problem = "VoxelPointCount is not a number above 0 for each point: bandwidths are those of the points as "
              "they are. Mend the array, or remove it.";
  }
  return counts;
}

std::string invalidPoints(std::int64_t invalid, std::int64_t all)
{
  return invalid == 0 ? std::string()
                      : std::to_string(invalid) + " of " + std::to_string(all) +
      " points are NaN or infinite: they have bandwidth and radius 0. Remove them first.";
}

void passCloud(vtkPointSet* cloud, vtkPolyData* output)
{
  if (vtkPolyData::SafeDownCast(cloud))
  {
    output->ShallowCopy(cloud);
  }
  else
  {
    ArrayPool pool;
    output->SetPoints(cloud->GetPoints());
    output->SetVerts(makeVertices(cloud->GetNumberOfPoints(), pool, SmpExecutor()));
    output->GetPointData()->ShallowCopy(cloud->GetPointData());
    output->GetFieldData()->ShallowCopy(cloud->GetFieldData());
  }
  if (!output->GetPoints())
  {
    output->SetPoints(vtkNew<vtkPoints>());
  }
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
  const auto add = [output](bool isWanted, const char* name, const std::vector<double>& values)
  {
    if (isWanted)
    {
      vtkNew<vtkDoubleArray> array;
      array->SetName(name);
      array->SetNumberOfValues(vtkIdType(values.size()));
      std::copy(values.begin(), values.end(), array->GetPointer(0));
      output->GetPointData()->AddArray(array);
    }
  };
  add(settings.computeDensity, "Density", densities);
  add(settings.computeMeanBandwidth, "MeanBandwidth", ofMeans);
  add(settings.computeBandwidth, "Bandwidth", bandwidths);
  add(settings.computeProxyRadius, "ProxyRadius", radii);
}

} // namespace pointhaptics
