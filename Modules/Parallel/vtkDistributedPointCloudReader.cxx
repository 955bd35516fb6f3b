#include "vtkDistributedPointCloudReader.h"

#include "MpiRanks.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <string>

using pointhaptics::MpiRanks;

vtkStandardNewMacro(vtkDistributedPointCloudReader);

vtkDistributedPointCloudReader::vtkDistributedPointCloudReader()
  : Controller(vtkMultiProcessController::GetGlobalController())
{
}

vtkDistributedPointCloudReader::~vtkDistributedPointCloudReader() = default;

int vtkDistributedPointCloudReader::RequestInformation(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  outputs->GetInformationObject(0)->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
  return this->Superclass::RequestInformation(request, inputs, outputs);
}

int vtkDistributedPointCloudReader::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkInformation* asked = outputs->GetInformationObject(0);
  MpiRanks ranks(this->Controller);
  const bool isShared = asked->Get(Pipeline::UPDATE_NUMBER_OF_PIECES()) == ranks.size() &&
    asked->Get(Pipeline::UPDATE_PIECE_NUMBER()) == ranks.rank();
  if (!isShared && asked->Get(Pipeline::UPDATE_PIECE_NUMBER()) > 0)
  {
    vtkPolyData::GetData(outputs)->Initialize();
    vtkPolyData::GetData(outputs)->SetPoints(vtkNew<vtkPoints>());
    return 1;
  }
  this->SetRanks(isShared ? &ranks : nullptr);
  const int result = this->Superclass::RequestData(request, inputs, outputs);
  this->SetRanks(nullptr);
  const std::string message =
    isShared ? pointhaptics::firstMessage(ranks, this->GetErrorMessage()) : std::string();
  if (this->FailedElsewhere() && !message.empty())
  {
    vtkErrorMacro(<< message);
  }
  return result;
}

void vtkDistributedPointCloudReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Controller: " << (this->Controller ? this->Controller->GetClassName() : "(none)") << "\n";
}
