#include "vtkVoxelMeanResampler.h"

#include "vtkVoxelMeanResamplerInternals.h"

#include "vtkAbstractTransform.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <vector>

using namespace pointhaptics;

vtkStandardNewMacro(vtkVoxelMeanResampler);

vtkVoxelMeanResampler::vtkVoxelMeanResampler()
  : AutomaticWorkspace(true)
  , VoxelSize(0.0)
  , OutputPointsPrecision(vtkAlgorithm::DEFAULT_PRECISION)
  , ComputeCovariance(false)
  , PassAttributes(true)
  , CategoricalArrays{ "Classification" }
  , NumberOfLevels(1)
  , UsePointIndex(true)
  , InstructionSet(InstructionSetAutomatic)
  , NumberOfClippedPoints(0)
  , NumberOfInvalidPoints(0)
  , Impl(std::make_unique<Internals>(this))
{
  for (int axis = 0; axis < 3; ++axis)
  {
    this->WorkspaceBounds[2 * axis] = -0.5 * kDefaultWorkspaceEdge;
    this->WorkspaceBounds[2 * axis + 1] = 0.5 * kDefaultWorkspaceEdge;
    this->Dimensions[axis] = int(kDefaultLatticeDimension);
  }
}

vtkVoxelMeanResampler::~vtkVoxelMeanResampler() = default;

void vtkVoxelMeanResampler::SetTransform(vtkAbstractTransform* transform)
{
  if (this->Transform != transform)
  {
    this->Transform = transform;
    this->Modified();
  }
}

vtkAbstractTransform* vtkVoxelMeanResampler::GetTransform()
{
  return this->Transform;
}

void vtkVoxelMeanResampler::SetWorkspaceBounds(const double bounds[6])
{
  if (this->AutomaticWorkspace || !std::equal(bounds, bounds + 6, this->WorkspaceBounds))
  {
    std::copy(bounds, bounds + 6, this->WorkspaceBounds);
    this->AutomaticWorkspace = false;
    this->Modified();
  }
}

void vtkVoxelMeanResampler::SetWorkspaceBounds(
  double x0, double x1, double y0, double y1, double z0, double z1)
{
  const double bounds[6] = { x0, x1, y0, y1, z0, z1 };
  this->SetWorkspaceBounds(bounds);
}

void vtkVoxelMeanResampler::SetDimensions(const int dimensions[3])
{
  if (this->VoxelSize != 0.0 || !std::equal(dimensions, dimensions + 3, this->Dimensions))
  {
    std::copy(dimensions, dimensions + 3, this->Dimensions);
    this->VoxelSize = 0.0;
    this->Modified();
  }
}

void vtkVoxelMeanResampler::SetDimensions(int nx, int ny, int nz)
{
  const int dimensions[3] = { nx, ny, nz };
  this->SetDimensions(dimensions);
}

void vtkVoxelMeanResampler::SetVoxelSize(double size)
{
  if (this->VoxelSize != size)
  {
    this->VoxelSize = size;
    this->Modified();
  }
}

void vtkVoxelMeanResampler::AddCategoricalArray(const char* name)
{
  if (name && this->CategoricalArrays.insert(name).second)
  {
    this->Modified();
  }
}

void vtkVoxelMeanResampler::RemoveCategoricalArray(const char* name)
{
  if (name && this->CategoricalArrays.erase(name) > 0)
  {
    this->Modified();
  }
}

void vtkVoxelMeanResampler::ClearCategoricalArrays()
{
  this->CategoricalArrays.clear();
  this->Modified();
}

bool vtkVoxelMeanResampler::IsCategoricalArray(const char* name) const
{
  return name && this->CategoricalArrays.count(name) > 0;
}

void vtkVoxelMeanResampler::SetNumberOfLevels(int levels)
{
  constexpr int kMostLevels = 22;
  const int clamped = std::min(std::max(levels, 1), kMostLevels);
  if (this->NumberOfLevels != clamped)
  {
    this->NumberOfLevels = clamped;
    this->SetNumberOfOutputPorts(clamped);
    this->Modified();
  }
}

unsigned long vtkVoxelMeanResampler::GetScratchMemorySize() const
{
  return static_cast<unsigned long>(this->Impl->ScratchBytes() / 1024);
}

void vtkVoxelMeanResampler::ReleaseScratch()
{
  this->Impl->ReleaseCaches();
}

vtkMTimeType vtkVoxelMeanResampler::GetMTime()
{
  vtkMTimeType time = this->Superclass::GetMTime();
  if (this->Transform)
  {
    time = std::max(time, this->Transform->GetMTime());
  }
  if (this->Impl->Aborted)
  {
    // The pipeline would take the result of an aborted execution for valid: request another one.
    this->Impl->RetryTime.Modified();
  }
  return std::max(time, this->Impl->RetryTime.GetMTime());
}

int vtkVoxelMeanResampler::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
  return 1;
}

int vtkVoxelMeanResampler::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  auto* input = vtkPointSet::GetData(inputVector[0]);
  this->NumberOfClippedPoints = 0;
  this->NumberOfInvalidPoints = 0;
  // Observers of progress may ask for another number of levels, which is then that of the next update.
  std::vector<vtkSmartPointer<vtkPolyData>> outputs;
  for (int level = 0; level < this->NumberOfLevels; ++level)
  {
    outputs.emplace_back(vtkPolyData::GetData(outputVector, level));
    outputs.back()->GetFieldData()->PassData(input->GetFieldData());
  }
  if (this->Impl->Update(input, outputs))
  {
    this->UpdateProgress(1.0);
  }
  else
  {
    this->NumberOfClippedPoints = 0;
    this->NumberOfInvalidPoints = 0;
  }
  return 1;
}

void vtkVoxelMeanResampler::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Transform: " << (this->Transform ? this->Transform->GetClassName() : "(none)") << "\n";
  os << indent << "AutomaticWorkspace: " << this->AutomaticWorkspace << "\n";
  os << indent << "WorkspaceBounds:";
  for (const double bound : this->WorkspaceBounds)
  {
    os << " " << bound;
  }
  os << "\n";
  os << indent << "Dimensions: " << this->Dimensions[0] << " " << this->Dimensions[1] << " "
     << this->Dimensions[2] << "\n";
  os << indent << "VoxelSize: " << this->VoxelSize << "\n";
  os << indent << "OutputPointsPrecision: " << this->OutputPointsPrecision << "\n";
  os << indent << "ComputeCovariance: " << this->ComputeCovariance << "\n";
  os << indent << "PassAttributes: " << this->PassAttributes << "\n";
  os << indent << "CategoricalArrays:";
  for (const std::string& name : this->CategoricalArrays)
  {
    os << " " << name;
  }
  os << "\n";
  os << indent << "NumberOfLevels: " << this->NumberOfLevels << "\n";
  os << indent << "UsePointIndex: " << this->UsePointIndex << "\n";
  os << indent << "InstructionSet: " << this->InstructionSet << "\n";
  os << indent << "NumberOfClippedPoints: " << this->NumberOfClippedPoints << "\n";
  os << indent << "NumberOfInvalidPoints: " << this->NumberOfInvalidPoints << "\n";
}
