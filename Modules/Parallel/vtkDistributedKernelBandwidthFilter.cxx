#include "vtkDistributedKernelBandwidthFilter.h"

#include "MpiRanks.h"

#include "BandwidthArrays.h"
#include "PolyDataAccess.h"
#include "SmpExecutor.h"

#include "Core/Distributed/SharedBandwidths.h"

#include "vtkObjectFactory.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

#include <string>
#include <vector>

using namespace pointhaptics;

vtkStandardNewMacro(vtkDistributedKernelBandwidthFilter);

vtkDistributedKernelBandwidthFilter::vtkDistributedKernelBandwidthFilter()
  : Controller(vtkMultiProcessController::GetGlobalController())
{
}

vtkDistributedKernelBandwidthFilter::~vtkDistributedKernelBandwidthFilter() = default;

std::string vtkDistributedKernelBandwidthFilter::ProblemOf(vtkDataObject* input)
{
  return problemOnRanks(this->Controller, input);
}

bool vtkDistributedKernelBandwidthFilter::SaysAgain() const
{
  return this->RepeatsErrors && MpiRanks(this->Controller).size() == 1;
}

bool vtkDistributedKernelBandwidthFilter::RunCloud(vtkPointSet* cloud, const Outputs& outputs)
{
  MpiRanks ranks(this->Controller);
  this->NumberOfBytesSent = 0;
  if (ranks.size() == 1)
  {
    return this->Superclass::RunCloud(cloud, outputs);
  }
  const BandwidthSettings settings = this->GetSettings();
  const PointAccess points(cloud->GetPoints());
  BandwidthsOfPoints found;
  std::string problem;
  const std::vector<double> counts = voxelCounts(cloud, settings.usePointCounts, problem);
  this->Warn(problem);
  const Status status = sharedBandwidths(ranks, points.view(), counts, settings, found, SmpExecutor());
  this->NumberOfBytesSent = ranks.bytesSent();
  if (status != Status::Ok)
  {
    this->Fail(bandwidthProblem(settings, status));
    return false;
  }
  passCloud(cloud, outputs[0]);
  addBandwidthArrays(outputs[0], settings, found.densities, found.ofMeans, found.bandwidths, found.radii);
  return true;
}

void vtkDistributedKernelBandwidthFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Controller: " << (this->Controller ? this->Controller->GetClassName() : "(none)") << "\n";
  os << indent << "NumberOfBytesSent: " << this->NumberOfBytesSent << "\n";
}
