#include "vtkPVVoxelMeanResampler.h"

#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkVariant.h"

#include <algorithm>
#include <utility>

vtkStandardNewMacro(vtkPVVoxelMeanResampler);

vtkPVVoxelMeanResampler::vtkPVVoxelMeanResampler()
  : Chosen(this->GetSettings().lattice)
{
}

void vtkPVVoxelMeanResampler::SetLatticeMode(int mode)
{
  this->LatticeMode = std::clamp<int>(mode, ByVoxelSize, ByDimensions);
  this->ApplyLattice();
}

void vtkPVVoxelMeanResampler::SetVoxelSize(double size)
{
  this->Chosen.voxelSize = size;
  this->ApplyLattice();
}

void vtkPVVoxelMeanResampler::SetDimensions(int nx, int ny, int nz)
{
  this->Chosen.dimensions = { nx, ny, nz };
  this->ApplyLattice();
}

void vtkPVVoxelMeanResampler::SetDimensions(const int dimensions[3])
{
  this->SetDimensions(dimensions[0], dimensions[1], dimensions[2]);
}

void vtkPVVoxelMeanResampler::SetAutomaticWorkspace(bool automatic)
{
  this->Chosen.automaticWorkspace = automatic;
  this->ApplyLattice();
}

void vtkPVVoxelMeanResampler::SetWorkspaceBounds(
  double x0, double x1, double y0, double y1, double z0, double z1)
{
  this->Chosen.workspace = { { x0, y0, z0 }, { x1, y1, z1 } };
  this->ApplyLattice();
}

void vtkPVVoxelMeanResampler::SetWorkspaceBounds(const double bounds[6])
{
  this->SetWorkspaceBounds(bounds[0], bounds[1], bounds[2], bounds[3], bounds[4], bounds[5]);
}

void vtkPVVoxelMeanResampler::ApplyLattice()
{
  pointhaptics::VoxelMeanSettings settings = this->GetSettings();
  settings.lattice = this->Chosen;
  if (this->LatticeMode == ByDimensions)
  {
    settings.lattice.voxelSize = 0.0;
  }
  this->SetSettings(settings);
}

std::string vtkPVVoxelMeanResampler::ProblemOf(vtkDataObject* input)
{
  // 0 would mean Dimensions to the superclass.
  if (this->LatticeMode == ByVoxelSize && !(this->Chosen.voxelSize > 0.0))
  {
    return "VoxelSize is " + vtkVariant(this->Chosen.voxelSize).ToString() +
      "; give an edge above 0 in the unit of the points, or set the lattice by its dimensions";
  }
  return this->Superclass::ProblemOf(input);
}

bool vtkPVVoxelMeanResampler::RunCloud(vtkPointSet* cloud, const Outputs& outputs)
{
  const bool succeeded = this->Superclass::RunCloud(cloud, outputs);
  const std::pair<const char*, vtkIdType> counts[] = { { "ClippedPoints", this->NumberOfClippedPoints },
    { "InvalidPoints", this->NumberOfInvalidPoints } };
  for (const auto& [name, count] : counts)
  {
    vtkNew<vtkIdTypeArray> field;
    field->SetName(name);
    field->InsertNextValue(count);
    outputs[0]->GetFieldData()->AddArray(field);
  }
  return succeeded;
}

void vtkPVVoxelMeanResampler::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "LatticeMode: " << (this->LatticeMode == ByVoxelSize ? "ByVoxelSize" : "ByDimensions")
     << "\n";
}
