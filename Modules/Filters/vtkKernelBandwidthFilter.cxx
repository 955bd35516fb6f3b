#include "vtkKernelBandwidthFilter.h"

#include "PolyDataAccess.h"
#include "SmpExecutor.h"

#include "Core/LocalBandwidth.h"
#include "Core/Density.h"

#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>

using namespace pointhaptics;

vtkStandardNewMacro(vtkKernelBandwidthFilter);

static_assert(
  int(vtkKernelBandwidthFilter::SilvermanMultivariate) == int(BandwidthRule::SilvermanMultivariate),
  "the filter's rules are Core's, in the same order");

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

int vtkKernelBandwidthFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  auto* input = vtkPolyData::GetData(inputVector[0]);
  auto* output = vtkPolyData::GetData(outputVector);

  LocalBandwidthSettings settings;
  settings.fixedRadius = this->Neighborhood == FixedRadius;
  settings.numberOfNeighbors = this->NumberOfNeighbors;
  settings.radius = this->Radius;
  settings.rule = BandwidthRule(this->Rule);
  settings.radiusScale = this->RadiusScale;
  settings.minimumRadius = this->MinimumRadius;
  settings.maximumRadius = this->MaximumRadius;
  const Status status = settings.check();
  if (status != Status::Ok)
  {
    vtkErrorMacro("NumberOfNeighbors "
      << this->NumberOfNeighbors << ", Radius " << this->Radius << ", RadiusScale " << this->RadiusScale
      << ", MinimumRadius " << this->MinimumRadius << ", MaximumRadius " << this->MaximumRadius << ": "
      << sentence(status) << ".");
    return 1;
  }
  output->ShallowCopy(input);
  const bool wanted = this->ComputeBandwidth || this->ComputeProxyRadius || this->ComputeDensity;
  if (!wanted)
  {
    return 1;
  }

  const PointAccess points(input->GetPoints());
  const SmpExecutor executor;
  NeighborQuery query;
  query.build(points.view());
  this->UpdateProgress(0.3);
  std::vector<double> bandwidths;
  std::vector<double> radii;
  if (localBandwidths(points.view(), query, settings, bandwidths, radii, executor) != Status::Ok)
  {
    return 1;
  }
  this->UpdateProgress(this->ComputeDensity ? 0.6 : 0.95);
  if (this->GetAbortExecute())
  {
    output->Initialize();
    return 1;
  }
  if (this->ComputeDensity)
  {
    std::vector<double> densities;
    surfaceDensities(points.view(), query, bandwidths, densities, executor);
    addArray(output, "Density", densities);
  }
  if (this->ComputeBandwidth)
  {
    addArray(output, "Bandwidth", bandwidths);
  }
  if (this->ComputeProxyRadius)
  {
    addArray(output, "ProxyRadius", radii);
  }
  this->UpdateProgress(1.0);
  return 1;
}

void vtkKernelBandwidthFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Neighborhood: " << this->Neighborhood << "\n";
  os << indent << "NumberOfNeighbors: " << this->NumberOfNeighbors << "\n";
  os << indent << "Radius: " << this->Radius << "\n";
  os << indent << "Rule: " << this->Rule << "\n";
  os << indent << "RadiusScale: " << this->RadiusScale << "\n";
  os << indent << "MinimumRadius: " << this->MinimumRadius << "\n";
  os << indent << "MaximumRadius: " << this->MaximumRadius << "\n";
  os << indent << "ComputeBandwidth: " << this->ComputeBandwidth << "\n";
  os << indent << "ComputeProxyRadius: " << this->ComputeProxyRadius << "\n";
  os << indent << "ComputeDensity: " << this->ComputeDensity << "\n";
}
