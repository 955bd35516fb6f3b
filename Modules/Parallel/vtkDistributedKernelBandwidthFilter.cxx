#include "vtkDistributedKernelBandwidthFilter.h"

#include "MpiRanks.h"

#include "SmpExecutor.h"

#include "Core/Distributed/SharedBandwidths.h"

#include "vtkObjectFactory.h"

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

Status vtkDistributedKernelBandwidthFilter::Estimate(
  const PointView& points, const std::vector<double>& counts, BandwidthsOfPoints& found)
{
  MpiRanks ranks(this->Controller);
  this->NumberOfBytesSent = 0;
  if (ranks.size() == 1)
  {
    return this->Superclass::Estimate(points, counts, found);
  }
  const Status status = sharedBandwidths(ranks, points, counts, this->GetSettings(), found, SmpExecutor());
  this->NumberOfBytesSent = ranks.bytesSent();
  return status;
}

void vtkDistributedKernelBandwidthFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Controller: " << (this->Controller ? this->Controller->GetClassName() : "(none)") << "\n";
  os << indent << "NumberOfBytesSent: " << this->NumberOfBytesSent << "\n";
}
