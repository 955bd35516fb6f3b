#include "vtkPVVoxelMeanResampler.h"

#include "vtkCommand.h"
#include "vtkCompositeDataSet.h"
#include "vtkCompositeDataSetRange.h"
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
  this->Categorical->AddObserver(vtkCommand::ModifiedEvent, this, &vtkPVVoxelMeanResampler::ApplyChosen);
}

void vtkPVVoxelMeanResampler::SetLatticeMode(int mode)
{
  this->LatticeMode = std::clamp<int>(mode, ByVoxelSize, ByDimensions);
  this->ApplyChosen();
}

void vtkPVVoxelMeanResampler::SetVoxelSize(double size)
{
  this->Chosen.voxelSize = size;
  this->ApplyChosen();
}

void vtkPVVoxelMeanResampler::SetDimensions(int nx, int ny, int nz)
{
  this->Chosen.dimensions = { nx, ny, nz };
  this->ApplyChosen();
}

void vtkPVVoxelMeanResampler::SetDimensions(const int dimensions[3])
{
  this->SetDimensions(dimensions[0], dimensions[1], dimensions[2]);
}

void vtkPVVoxelMeanResampler::SetAutomaticWorkspace(bool automatic)
{
  this->Chosen.automaticWorkspace = automatic;
  this->ApplyChosen();
}

void vtkPVVoxelMeanResampler::SetWorkspaceBounds(const double bounds[6])
{
  this->Chosen.workspace = { { bounds[0], bounds[2], bounds[4] }, { bounds[1], bounds[3], bounds[5] } };
  this->Size = this->Chosen.workspace.extent();
  this->SetAutomaticWorkspace(false);
}

void vtkPVVoxelMeanResampler::SetWorkspacePosition(double x, double y, double z)
{
  this->Chosen.workspace = { { x, y, z }, pointhaptics::Vec3{ x, y, z } + this->Size };
  this->ApplyChosen();
}

void vtkPVVoxelMeanResampler::SetWorkspaceSize(double x, double y, double z)
{
  this->Size = { x, y, z };
  this->Chosen.workspace.maximum = this->Chosen.workspace.minimum + this->Size;
  this->ApplyChosen();
}

void vtkPVVoxelMeanResampler::AddCategoricalArray(const char* name)
{
  this->Superclass::AddCategoricalArray(name);
  this->Tick(name, true);
}

void vtkPVVoxelMeanResampler::RemoveCategoricalArray(const char* name)
{
  this->Superclass::RemoveCategoricalArray(name);
  this->Tick(name, false);
}

void vtkPVVoxelMeanResampler::ClearCategoricalArrays()
{
  this->Superclass::ClearCategoricalArrays();
  this->Categorical->DisableAllArrays();
}

/// Until arrays are known, the names of the superclass decide.
void vtkPVVoxelMeanResampler::Tick(const char* name, bool isTicked)
{
  if (this->Categorical->GetNumberOfArrays() > 0)
  {
    this->Categorical->SetArraySetting(name, isTicked);
  }
}

int vtkPVVoxelMeanResampler::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  const pointhaptics::VoxelMeanSettings before = this->GetSettings();
  const auto add = [&](vtkDataObject* block)
  {
    vtkFieldData* arrays = block ? block->GetAttributesAsFieldData(vtkDataObject::POINT) : nullptr;
    for (int i = 0; arrays && i < arrays->GetNumberOfArrays(); ++i)
    {
      const char* name = arrays->GetArrayName(i);
      if (name)
      {
        this->Categorical->AddArray(name, pointhaptics::isCategorical(before, name));
      }
    }
  };
  vtkDataObject* input = vtkDataObject::GetData(inputs[0]);
  add(input);
  if (auto* blocks = vtkCompositeDataSet::SafeDownCast(input))
  {
    for (vtkDataObject* block : vtk::Range(blocks))
    {
      add(block);
    }
  }
  this->ApplyChosen(); // The selection does not report what is added.
  return 1;
}

void vtkPVVoxelMeanResampler::ApplyChosen()
{
  pointhaptics::VoxelMeanSettings settings = this->GetSettings();
  settings.lattice = this->Chosen;
  if (this->LatticeMode == ByDimensions)
  {
    settings.lattice.voxelSize = 0.0;
  }
  if (this->Categorical->GetNumberOfArrays() > 0)
  {
    settings.categoricalArrays.clear();
    settings.exactCategoricalNames = true;
  }
  for (int i = 0; i < this->Categorical->GetNumberOfArrays(); ++i)
  {
    if (this->Categorical->GetArraySetting(i))
    {
      settings.categoricalArrays.insert(this->Categorical->GetArrayName(i));
    }
  }
  this->SetSettings(settings);
}

std::string vtkPVVoxelMeanResampler::ProblemOf(vtkDataObject* input)
{
  // 0 would mean Dimensions to the superclass.
  if (this->LatticeMode == ByVoxelSize && !(this->Chosen.voxelSize > 0.0))
  {
    return "VoxelSize is " + vtkVariant(this->Chosen.voxelSize).ToString() +
      "; give an edge above 0 in the unit of the points, set the lattice by its dimensions, or (in a script) "
      "update the input before the filter is made, whose default is a part of its size";
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
