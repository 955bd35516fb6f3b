#include "vtkVoxelMeanResampler.h"

#include "SettingText.h"
#include "vtkVoxelMeanResamplerInternals.h"

#include "Core/Base/FieldNames.h"
#include "Core/Base/Host/OutOfMemory.h"

#include "vtkAbstractTransform.h"
#include "vtkObjectFactory.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <string>
#include <utility>

using namespace pointhaptics;

vtkStandardNewMacro(vtkVoxelMeanResampler);

static_assert(int(vtkAlgorithm::SINGLE_PRECISION) == int(PointsPrecision::Single) &&
    int(vtkAlgorithm::DOUBLE_PRECISION) == int(PointsPrecision::Double) &&
    int(vtkAlgorithm::DEFAULT_PRECISION) == int(PointsPrecision::OfInput),
  "Core's precisions are VTK's, in the same order");
static_assert(int(vtkVoxelMeanResampler::InstructionSetAVX2) == int(InstructionSet::Avx2),
  "the filter's instruction sets are Core's, in the same order");

vtkVoxelMeanResampler::vtkVoxelMeanResampler()
  : NumberOfClippedPoints(0)
  , NumberOfInvalidPoints(0)
  , Impl(std::make_unique<Internals>(this))
{
  this->SetNumberOfOutputPorts(2);
  this->UpdateVectors();
}

vtkVoxelMeanResampler::~vtkVoxelMeanResampler() = default;

vtkCxxSetSmartPointerMacro(vtkVoxelMeanResampler, Transform, vtkAbstractTransform);

vtkAbstractTransform* vtkVoxelMeanResampler::GetTransform()
{
  return this->Transform;
}

void vtkVoxelMeanResampler::SetSettings(const VoxelMeanSettings& settings)
{
  VoxelMeanSettings valid = settings;
  valid.minimumPointsPerVoxel = std::max(settings.minimumPointsPerVoxel, 1);
  if (equalSettings(this->Settings, valid))
  {
    return;
  }
  this->Settings = std::move(valid);
  this->UpdateVectors();
  this->Modified();
}

void vtkVoxelMeanResampler::TakeSettings(vtkVoxelMeanResampler* other)
{
  this->SetTransform(other->Transform);
  this->SetLatticePerBlock(other->LatticePerBlock);
  this->SetNumberOfThreads(other->NumberOfThreads);
  this->SetSettings(other->Settings);
}

void vtkVoxelMeanResampler::UpdateVectors()
{
  const LatticeSettings& lattice = this->Settings.lattice;
  for (int axis = 0; axis < 3; ++axis)
  {
    this->WorkspaceBounds[2 * axis] = lattice.workspace.minimum[axis];
    this->WorkspaceBounds[2 * axis + 1] = lattice.workspace.maximum[axis];
    this->Dimensions[axis] = int(lattice.dimensions[std::size_t(axis)]);
  }
}

void vtkVoxelMeanResampler::SetWorkspaceBounds(const double bounds[6])
{
  VoxelMeanSettings settings = this->Settings;
  settings.lattice.workspace = { { bounds[0], bounds[2], bounds[4] }, { bounds[1], bounds[3], bounds[5] } };
  settings.lattice.automaticWorkspace = false;
  this->SetSettings(settings);
}

void vtkVoxelMeanResampler::SetWorkspaceBounds(
  double x0, double x1, double y0, double y1, double z0, double z1)
{
  const double bounds[6] = { x0, x1, y0, y1, z0, z1 };
  this->SetWorkspaceBounds(bounds);
}

void vtkVoxelMeanResampler::SetDimensions(const int dimensions[3])
{
  VoxelMeanSettings settings = this->Settings;
  settings.lattice.dimensions = { dimensions[0], dimensions[1], dimensions[2] };
  settings.lattice.voxelSize = 0.0;
  this->SetSettings(settings);
}

void vtkVoxelMeanResampler::SetDimensions(int nx, int ny, int nz)
{
  const int dimensions[3] = { nx, ny, nz };
  this->SetDimensions(dimensions);
}

void vtkVoxelMeanResampler::AddCategoricalArray(const char* name)
{
  if (name && this->Settings.categoricalArrays.insert(name).second)
  {
    this->Modified();
  }
}

void vtkVoxelMeanResampler::RemoveCategoricalArray(const char* name)
{
  if (name && this->Settings.categoricalArrays.erase(name) > 0)
  {
    this->Modified();
  }
}

void vtkVoxelMeanResampler::ClearCategoricalArrays()
{
  this->Settings.categoricalArrays.clear();
  this->Modified();
}

bool vtkVoxelMeanResampler::IsCategoricalArray(const char* name) const
{
  return name && pointhaptics::isCategorical(this->Settings, name);
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
  return std::max(this->Superclass::GetMTime(), this->Transform ? this->Transform->GetMTime() : 0);
}

bool vtkVoxelMeanResampler::BeginRun(const Clouds& clouds)
{
  this->NumberOfClippedPoints = 0;
  this->NumberOfInvalidPoints = 0;
  return this->Impl->Begin(clouds);
}

bool vtkVoxelMeanResampler::RunCloud(vtkPointSet* cloud, const Outputs& outputs)
{
  return this->Impl->Update(cloud, outputs[0], outputs[1]);
}

void vtkVoxelMeanResampler::WarnOfNothing(vtkIdType points)
{
  if (points > 0 && this->NumberOfClippedPoints + this->NumberOfInvalidPoints == points)
  {
    this->Warn("No point is left: " + std::to_string(this->NumberOfClippedPoints) +
      " lie outside of the workspace, " + std::to_string(this->NumberOfInvalidPoints) +
      " are NaN or infinite. Give a workspace about the points, or none for an automatic one.");
  }
}

void vtkVoxelMeanResampler::EndRun(bool succeeded)
{
  this->Impl->End(succeeded);
  if (!succeeded)
  {
    this->NumberOfClippedPoints = 0;
    this->NumberOfInvalidPoints = 0;
  }
  if (this->GetErrorCode() == pointhaptics::kOutOfMemoryCode)
  {
    this->ReleaseScratch();
  }
}

void vtkVoxelMeanResampler::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Transform: " << (this->Transform ? this->Transform->GetClassName() : "(none)") << "\n";
  keyed::printSettings(os, indent, this->Settings);
  os << indent << "LatticePerBlock: " << this->LatticePerBlock << "\n";
  os << indent << "NumberOfClippedPoints: " << this->NumberOfClippedPoints << "\n";
  os << indent << "NumberOfInvalidPoints: " << this->NumberOfInvalidPoints << "\n";
}
