#include "vtkVoxelMeanResampler.h"

#include "PolyDataAccess.h"
#include "SmpExecutor.h"
#include "VoxelAttribute.h"

#include "Core/VoxelMean.h"

#include "vtkAbstractTransform.h"
#include "vtkCellArray.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <sstream>

using namespace pointhaptics;

vtkStandardNewMacro(vtkVoxelMeanResampler);

namespace
{

vtkSmartPointer<vtkPoints> makePoints(const VoxelMeans& voxels, int type)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataType(type);
  points->SetNumberOfPoints(vtkIdType(voxels.means.size()));
  if (voxels.means.empty())
  {
    return points;
  }
  if (auto* doubles = vtkDoubleArray::FastDownCast(points->GetData()))
  {
    const double* xyz = &voxels.means.front().x;
    std::copy(xyz, xyz + 3 * voxels.means.size(), doubles->GetPointer(0));
  }
  else if (auto* floats = vtkFloatArray::FastDownCast(points->GetData()))
  {
    float* out = floats->GetPointer(0);
    for (std::size_t v = 0; v < voxels.means.size(); ++v)
    {
      const auto index = voxels.lattice.indexOf(voxels.keys[v]);
      for (int axis = 0; axis < 3; ++axis)
      {
        // Rounding to float must not carry a mean into the next voxel: resampled again it would join that
        // one.
        *out++ = voxels.lattice.keptInVoxel(float(voxels.means[v][axis]), axis, index[std::size_t(axis)]);
      }
    }
  }
  return points;
}

void addCounts(const VoxelMeans& voxels, vtkPointData* output)
{
  vtkNew<vtkIdTypeArray> counts;
  counts->SetName("VoxelPointCount");
  counts->SetNumberOfValues(vtkIdType(voxels.means.size()));
  for (std::size_t v = 0; v < voxels.means.size(); ++v)
  {
    counts->SetValue(vtkIdType(v), vtkIdType(voxels.count(v)));
  }
  output->AddArray(counts);
}

void addCovariances(const VoxelMeans& voxels, vtkPointData* output)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName("VoxelCovariance");
  array->SetNumberOfComponents(6);
  const char* names[6] = { "XX", "YY", "ZZ", "XY", "YZ", "XZ" };
  for (int c = 0; c < 6; ++c)
  {
    array->SetComponentName(c, names[c]);
  }
  array->SetNumberOfTuples(vtkIdType(voxels.covariances.size()));
  for (std::size_t v = 0; v < voxels.covariances.size(); ++v)
  {
    const SymMat3& m = voxels.covariances[v];
    const double tuple[6] = { m.xx, m.yy, m.zz, m.xy, m.yz, m.xz };
    array->SetTypedTuple(vtkIdType(v), tuple);
  }
  output->AddArray(array);
}

void addField(vtkFieldData* field, const char* name, const double* values, int count)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(count);
  array->SetNumberOfTuples(1);
  array->SetTypedTuple(0, values);
  field->AddArray(array);
}

/// What the lattice and the transform were: a scene is built from it.
void addLattice(const Lattice& lattice, const AffineTransform& transform, vtkFieldData* field)
{
  addField(field, "LatticeOrigin", &lattice.origin.x, 3);
  addField(field, "LatticeSpacing", &lattice.spacing.x, 3);
  vtkNew<vtkIntArray> dimensions;
  dimensions->SetName("LatticeDimensions");
  dimensions->SetNumberOfComponents(3);
  dimensions->SetNumberOfTuples(1);
  for (int axis = 0; axis < 3; ++axis)
  {
    dimensions->SetValue(axis, int(lattice.dimensions[std::size_t(axis)]));
  }
  field->AddArray(dimensions);
  double matrix[16] = { 0 };
  std::copy(&transform.m[0][0], &transform.m[0][0] + 12, matrix);
  matrix[15] = 1.0;
  addField(field, "ModelToWorkspace", matrix, 16);
}

std::string latticeText(double voxelSize, const int dimensions[3])
{
  std::ostringstream text;
  if (voxelSize != 0.0)
  {
    text << "Lattice of voxel size " << voxelSize;
  }
  else
  {
    text << "Lattice of " << dimensions[0] << " x " << dimensions[1] << " x " << dimensions[2] << " voxels";
  }
  return text.str();
}

/// Identifiers and ghost flags mean nothing once points are merged, and what an earlier resampling said of
/// its voxels says nothing of these.
bool isBookkeeping(vtkDataSetAttributes* attributes, int index)
{
  const int type = attributes->IsArrayAnAttribute(index);
  const char* name = attributes->GetArrayName(index);
  return type == vtkDataSetAttributes::GLOBALIDS || type == vtkDataSetAttributes::PEDIGREEIDS ||
    (name &&
      (std::string(name) == vtkDataSetAttributes::GhostArrayName() ||
        std::string(name) == "VoxelPointCount" || std::string(name) == "VoxelCovariance"));
}

}

vtkVoxelMeanResampler::vtkVoxelMeanResampler()
  : AutomaticWorkspace(true)
  , VoxelSize(0.0)
  , OutputPointsPrecision(vtkAlgorithm::DEFAULT_PRECISION)
  , ComputeCovariance(false)
  , PassAttributes(true)
  , CategoricalArrays{ "Classification" }
  , NumberOfClippedPoints(0)
  , NumberOfInvalidPoints(0)
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

vtkMTimeType vtkVoxelMeanResampler::GetMTime()
{
  const vtkMTimeType own = this->Superclass::GetMTime();
  return this->Transform ? std::max(own, this->Transform->GetMTime()) : own;
}

int vtkVoxelMeanResampler::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
  return 1;
}

bool vtkVoxelMeanResampler::ReadTransform(AffineTransform& transform)
{
  if (!affineFromTransform(this->Transform, transform))
  {
    vtkErrorMacro("Transform " << this->Transform->GetClassName()
                               << " is not affine; use a vtkTransform or vtkMatrixToLinearTransform.");
    return false;
  }
  const Status status = transform.check();
  if (status != Status::Ok)
  {
    vtkErrorMacro("SetTransform: " << sentence(status) << ".");
    return false;
  }
  return true;
}

bool vtkVoxelMeanResampler::MakeLattice(
  const PointView& points, const AffineTransform& transform, Lattice& lattice)
{
  LatticeSettings settings;
  settings.voxelSize = this->VoxelSize;
  settings.automaticWorkspace = this->AutomaticWorkspace;
  for (int axis = 0; axis < 3; ++axis)
  {
    settings.dimensions[std::size_t(axis)] = this->Dimensions[axis];
    settings.workspace.minimum[axis] = this->WorkspaceBounds[2 * axis];
    settings.workspace.maximum[axis] = this->WorkspaceBounds[2 * axis + 1];
  }
  const Bounds cloud =
    this->AutomaticWorkspace ? transformedBounds(points, transform, SmpExecutor()) : Bounds();
  const Status status = makeLattice(settings, cloud, lattice);
  if (status != Status::Ok)
  {
    vtkErrorMacro(<< latticeText(this->VoxelSize, this->Dimensions) << ": " << sentence(status) << ".");
    return false;
  }
  return true;
}

bool vtkVoxelMeanResampler::AverageArrays(
  vtkPointSet* input, const VoxelMeans& voxels, const AffineTransform& transform, vtkPolyData* output)
{
  vtkPointData* inputData = input->GetPointData();
  vtkPointData* outputData = output->GetPointData();
  for (int i = 0; i < inputData->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = inputData->GetArray(i);
    if (!array)
    {
      vtkWarningMacro(
        "Array " << inputData->GetArrayName(i) << " is not numeric: it has no mean and is dropped.");
      continue;
    }
    if (isBookkeeping(inputData, i))
    {
      continue;
    }
    AttributeKind kind = AttributeKind::Mean;
    if (this->IsCategoricalArray(array->GetName()))
    {
      kind = AttributeKind::Category;
    }
    else if (array == inputData->GetNormals() && array->GetNumberOfComponents() == 3)
    {
      kind = AttributeKind::Normal;
    }
    const int index = outputData->AddArray(voxelAttribute(array, kind, voxels, transform, SmpExecutor()));
    const int attribute = inputData->IsArrayAnAttribute(i);
    if (attribute >= 0)
    {
      outputData->SetActiveAttribute(index, attribute);
    }
    this->UpdateProgress(0.6 + 0.35 * double(i + 1) / double(inputData->GetNumberOfArrays()));
    if (this->GetAbortExecute())
    {
      return false;
    }
  }
  return true;
}

int vtkVoxelMeanResampler::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  auto* input = vtkPointSet::GetData(inputVector[0]);
  auto* output = vtkPolyData::GetData(outputVector);
  this->NumberOfClippedPoints = 0;
  this->NumberOfInvalidPoints = 0;
  output->GetFieldData()->PassData(input->GetFieldData());
  if (input->GetNumberOfPoints() == 0)
  {
    return 1;
  }
  const PointAccess points(input->GetPoints());
  AffineTransform transform;
  Lattice lattice;
  if (!this->ReadTransform(transform) || !this->MakeLattice(points.view(), transform, lattice))
  {
    return 1;
  }
  this->UpdateProgress(0.1);

  VoxelMeans voxels;
  const Status status =
    voxelMeans(points.view(), transform, lattice, this->ComputeCovariance, voxels, SmpExecutor());
  if (status != Status::Ok)
  {
    vtkErrorMacro(<< sentence(status) << ".");
    return 1;
  }
  this->NumberOfClippedPoints = vtkIdType(voxels.clippedPoints);
  this->NumberOfInvalidPoints = vtkIdType(voxels.invalidPoints);
  this->UpdateProgress(0.6);
  if (this->GetAbortExecute())
  {
    return 1;
  }

  int type = input->GetPoints()->GetDataType() == VTK_FLOAT ? VTK_FLOAT : VTK_DOUBLE;
  if (this->OutputPointsPrecision != vtkAlgorithm::DEFAULT_PRECISION)
  {
    type = this->OutputPointsPrecision == vtkAlgorithm::SINGLE_PRECISION ? VTK_FLOAT : VTK_DOUBLE;
  }
  output->SetPoints(makePoints(voxels, type));
  output->SetVerts(makeVertices(vtkIdType(voxels.means.size())));
  if (this->PassAttributes && !this->AverageArrays(input, voxels, transform, output))
  {
    output->Initialize();
    return 1;
  }
  addCounts(voxels, output->GetPointData());
  if (this->ComputeCovariance)
  {
    addCovariances(voxels, output->GetPointData());
  }
  addLattice(lattice, transform, output->GetFieldData());
  this->UpdateProgress(1.0);
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
  os << indent << "NumberOfClippedPoints: " << this->NumberOfClippedPoints << "\n";
  os << indent << "NumberOfInvalidPoints: " << this->NumberOfInvalidPoints << "\n";
}
