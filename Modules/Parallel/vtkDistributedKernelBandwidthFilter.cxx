#include "vtkDistributedKernelBandwidthFilter.h"

#include "BlocksOfInput.h"
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

#include <string>

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

int vtkDistributedKernelBandwidthFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  const int filled = this->Superclass::FillInputPortInformation(port, info);
  takeBlocksAtOnce(info, this->Controller);
  return filled;
}

int vtkDistributedKernelBandwidthFilter::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  MpiRanks ranks(this->Controller);
  this->NumberOfBytesSent = 0;
  if (ranks.size() == 1)
  {
    return this->Superclass::RequestData(request, inputVector, outputVector);
  }
  const std::string blocks = problemOfBlocks(vtkDataObject::GetData(inputVector[0]));
  if (!blocks.empty())
  {
    vtkErrorMacro(<< blocks);
    return 1;
  }
  auto* input = vtkPolyData::GetData(inputVector[0]);
  auto* output = vtkPolyData::GetData(outputVector);
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
