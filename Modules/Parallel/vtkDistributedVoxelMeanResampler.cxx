#include "vtkDistributedVoxelMeanResampler.h"

#include "DistributedUpdate.h"
#include "MpiRanks.h"
#include "PieceOfCloud.h"

#include "vtkAbstractTransform.h"
#include "vtkFieldData.h"
#include "vtkObjectFactory.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

#include <string>

using namespace pointhaptics;

vtkStandardNewMacro(vtkDistributedVoxelMeanResampler);

vtkDistributedVoxelMeanResampler::vtkDistributedVoxelMeanResampler()
  : Controller(vtkMultiProcessController::GetGlobalController())
{
}

vtkDistributedVoxelMeanResampler::~vtkDistributedVoxelMeanResampler() = default;

std::string vtkDistributedVoxelMeanResampler::ProblemOf(vtkDataObject* input)
{
  return problemOnRanks(this->Controller, input);
}

bool vtkDistributedVoxelMeanResampler::SaysAgain() const
{
  return this->RepeatsErrors && MpiRanks(this->Controller).size() == 1;
}

bool vtkDistributedVoxelMeanResampler::BeginRun(const Clouds& clouds)
{
  // Else each step is that of all ranks.
  return MpiRanks(this->Controller).size() > 1 || this->Superclass::BeginRun(clouds);
}

bool vtkDistributedVoxelMeanResampler::RunCloud(vtkPointSet* cloud, const Outputs& outputs)
{
  MpiRanks ranks(this->Controller);
  this->NumberOfBytesSent = 0;
  if (ranks.size() == 1)
  {
    return this->Superclass::RunCloud(cloud, outputs);
  }
  const vtkSmartPointer<vtkPointSet> input = withArraysOfOthers(ranks, cloud);
  const VoxelMeanSettings settings = this->GetSettings();
  outputs[0]->GetFieldData()->PassData(input->GetFieldData());
  DistributedUpdate update(ranks, settings, input);
  std::string problem = update.prepare(this->Transform, outputs[0]->GetFieldData());
  problem = problem.empty() ? update.run(outputs[0]) : problem;
  if (problem.empty() && settings.computeVoxelIndex)
  {
    problem = update.fillIndex(outputs[1], outputs[0]->GetNumberOfPoints());
  }
  this->NumberOfBytesSent = ranks.bytesSent();
  this->NumberOfClippedPoints = vtkIdType(update.clippedPoints());
  this->NumberOfInvalidPoints = vtkIdType(update.invalidPoints());
  this->WarnOfNothing(vtkIdType(ranks.sum(cloud->GetNumberOfPoints())));
  for (const std::string& dropped : update.dropped())
  {
    this->Warn(dropped);
  }
  if (!problem.empty())
  {
    this->Fail(problem);
  }
  return problem.empty();
}

void vtkDistributedVoxelMeanResampler::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Controller: " << (this->Controller ? this->Controller->GetClassName() : "(none)") << "\n";
  os << indent << "NumberOfBytesSent: " << this->NumberOfBytesSent << "\n";
}
