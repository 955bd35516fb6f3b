#include "vtkDistributedKernelBandwidthFilter.h"

#include "MpiRanks.h"

#include "BandwidthArrays.h"
#include "PolyDataAccess.h"
#include "SmpExecutor.h"

#include "Core/Distributed/SharedBandwidths.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <vector>

using namespace pointhaptics;

vtkStandardNewMacro(vtkDistributedKernelBandwidthFilter);

vtkDistributedKernelBandwidthFilter::vtkDistributedKernelBandwidthFilter()
  : Controller(vtkMultiProcessController::GetGlobalController())
{
}

vtkDistributedKernelBandwidthFilter::~vtkDistributedKernelBandwidthFilter() = default;

void vtkDistributedKernelBandwidthFilter::SetController(vtkMultiProcessController* controller)
{
  if (this->Controller != controller)
  {
    this->Controller = controller;
    this->Modified();
  }
}

vtkMultiProcessController* vtkDistributedKernelBandwidthFilter::GetController()
{
  return this->Controller;
}

int vtkDistributedKernelBandwidthFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  auto* input = vtkPolyData::GetData(inputVector[0]);
  auto* output = vtkPolyData::GetData(outputVector);
  MpiRanks ranks(this->Controller);
  const BandwidthSettings settings = this->GetSettings();
  const PointAccess points(input->GetPoints());
  BandwidthsOfPoints found;
  const Status status = sharedBandwidths(
    ranks, points.view(), voxelCounts(input, settings.usePointCounts), settings, found, SmpExecutor());
  this->NumberOfBytesSent = ranks.bytesSent();
  if (status != Status::Ok)
  {
    vtkErrorMacro(<< bandwidthProblem(settings, status));
    return 1;
  }
  output->ShallowCopy(input);
  addBandwidthArrays(output, settings, found.densities, found.ofMeans, found.bandwidths, found.radii);
  this->UpdateProgress(1.0);
  return 1;
}

void vtkDistributedKernelBandwidthFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Controller: " << (this->Controller ? this->Controller->GetClassName() : "(none)") << "\n";
  os << indent << "NumberOfBytesSent: " << this->NumberOfBytesSent << "\n";
}
