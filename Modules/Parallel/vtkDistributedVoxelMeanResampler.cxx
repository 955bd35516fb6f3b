#include "vtkDistributedVoxelMeanResampler.h"

#include "BlocksOfInput.h"
#include "DistributedUpdate.h"
#include "MpiRanks.h"
#include "PieceOfCloud.h"

#include "vtkAbstractTransform.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

#include <string>
#include <vector>

using namespace pointhaptics;

vtkStandardNewMacro(vtkDistributedVoxelMeanResampler);

vtkDistributedVoxelMeanResampler::vtkDistributedVoxelMeanResampler()
  : Controller(vtkMultiProcessController::GetGlobalController())
{
}

vtkDistributedVoxelMeanResampler::~vtkDistributedVoxelMeanResampler() = default;

void vtkDistributedVoxelMeanResampler::SetController(vtkMultiProcessController* controller)
{
  if (this->Controller != controller)
  {
    this->Controller = controller;
    this->Modified();
  }
}

vtkMultiProcessController* vtkDistributedVoxelMeanResampler::GetController()
{
  return this->Controller;
}

int vtkDistributedVoxelMeanResampler::FillInputPortInformation(int port, vtkInformation* info)
{
  const int filled = this->Superclass::FillInputPortInformation(port, info);
  takeBlocksAtOnce(info, this->Controller);
  return filled;
}

int vtkDistributedVoxelMeanResampler::RequestData(
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
  const vtkSmartPointer<vtkPointSet> input = withArraysOfOthers(ranks, vtkPointSet::GetData(inputVector[0]));
  const VoxelMeanSettings settings = this->GetSettings();
  this->NumberOfClippedPoints = 0;
  this->NumberOfInvalidPoints = 0;
  std::vector<vtkSmartPointer<vtkPolyData>> outputs;
  for (int level = 0; level < settings.numberOfLevels; ++level)
  {
    outputs.emplace_back(vtkPolyData::GetData(outputVector, level));
    outputs.back()->GetFieldData()->PassData(input->GetFieldData());
  }
  vtkPolyData* index =
    settings.computeVoxelIndex ? vtkPolyData::GetData(outputVector, settings.numberOfLevels) : nullptr;
  DistributedUpdate update(ranks, settings, input);
  std::string problem = update.prepare(this->Transform);
  for (int level = 0; problem.empty() && level < settings.numberOfLevels;)
  {
    const bool isFirst = level == 0;
    level += update.run(&outputs[std::size_t(level)], settings.numberOfLevels - level, problem);
    if (isFirst && problem.empty())
    {
      this->NumberOfClippedPoints = vtkIdType(update.clippedPoints());
      this->NumberOfInvalidPoints = vtkIdType(update.invalidPoints());
    }
    if (isFirst && problem.empty() && index)
    {
      problem = update.fillIndex(index, outputs[0]->GetNumberOfPoints());
    }
    this->UpdateProgress(double(level) / settings.numberOfLevels);
  }
  this->NumberOfBytesSent = ranks.bytesSent();
  for (const std::string& dropped : update.dropped())
  {
    vtkWarningMacro(<< dropped);
  }
  if (!problem.empty())
  {
    vtkErrorMacro(<< problem);
    for (vtkPolyData* output : outputs)
    {
      output->Initialize();
      output->GetFieldData()->PassData(input->GetFieldData());
    }
    if (index)
    {
      index->Initialize();
    }
  }
  return 1;
}

void vtkDistributedVoxelMeanResampler::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Controller: " << (this->Controller ? this->Controller->GetClassName() : "(none)") << "\n";
  os << indent << "NumberOfBytesSent: " << this->NumberOfBytesSent << "\n";
}
