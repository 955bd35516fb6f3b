#include "vtkVoxelMeanResampler.h"

#include "PolyDataAccess.h"
#include "SmpExecutor.h"
#include "VoxelAttribute.h"

#include "Core/PointIndex.h"
#include "Core/VoxelMean.h"
#include "Core/VoxelResampler.h"

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
#include "vtkTimeStamp.h"

#include <algorithm>
#include <sstream>
#include <vector>

using namespace pointhaptics;

vtkStandardNewMacro(vtkVoxelMeanResampler);

namespace
{

vtkSmartPointer<vtkPoints> makePoints(
  const VoxelResampler& engine, int level, bool singlePrecision, const Executor& executor)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataType(singlePrecision ? VTK_FLOAT : VTK_DOUBLE);
  points->SetNumberOfPoints(vtkIdType(engine.size(level)));
  if (singlePrecision)
  {
    engine.copyMeans(level, vtkFloatArray::FastDownCast(points->GetData())->GetPointer(0), executor);
  }
  else
  {
    engine.copyMeans(level, vtkDoubleArray::FastDownCast(points->GetData())->GetPointer(0), executor);
  }
  return points;
}

vtkSmartPointer<vtkIdTypeArray> makeCounts(const VoxelResampler& engine, int level, const Executor& executor)
{
  static_assert(sizeof(vtkIdType) == sizeof(std::int64_t), "VTK must be built with 64-bit ids");
  auto counts = vtkSmartPointer<vtkIdTypeArray>::New();
  counts->SetName("VoxelPointCount");
  counts->SetNumberOfValues(vtkIdType(engine.size(level)));
  engine.copyCounts(level, reinterpret_cast<std::int64_t*>(counts->GetPointer(0)), executor);
  return counts;
}

vtkSmartPointer<vtkDoubleArray> makeCovariances(
  const VoxelResampler& engine, int level, const Executor& executor)
{
  static_assert(sizeof(SymMat3) == 6 * sizeof(double), "six numbers, xx yy zz xy yz xz");
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName("VoxelCovariance");
  array->SetNumberOfComponents(6);
  const char* names[6] = { "XX", "YY", "ZZ", "XY", "YZ", "XZ" };
  for (int c = 0; c < 6; ++c)
  {
    array->SetComponentName(c, names[c]);
  }
  array->SetNumberOfTuples(vtkIdType(engine.size(level)));
  engine.copyCovariances(level, reinterpret_cast<SymMat3*>(array->GetPointer(0)), executor);
  return array;
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

/// The point arrays of the input that are averaged, and where their means go.
struct NamedAttribute
{
  VoxelAttribute attribute;
  int role; ///< vtkDataSetAttributes::AttributeTypes, or -1.
};

}

/// One update's steps, and what is kept from one to the next.
class vtkVoxelMeanResampler::Internals : public Watcher
{
public:
  explicit Internals(vtkVoxelMeanResampler* filter)
    : Filter(filter)
  {
  }

  // The steps of RequestData; false after an error was reported, or the execution aborted.
  bool ReadTransform();
  bool MakeLattice(vtkPointSet* input);
  bool Run(vtkPointSet* input);
  void Fill(int level, vtkPointSet* input, vtkPolyData* output);
  /// Lets go of the input and its arrays.
  void Release();
  void Forget();

  /// Watcher: passes progress on within [this->From, this->To].
  bool proceed(double fraction) override;

  VoxelResampler Engine;
  PointIndex Index;
  bool Aborted = false;
  vtkTimeStamp RetryTime;

private:
  void ChooseArrays(vtkPointSet* input);
  void UseIndex(vtkPointSet* input);
  bool Resample(vtkPointSet* input);
  bool AverageArrays();

  vtkVoxelMeanResampler* Filter;
  SmpExecutor Smp;
  VoxelRequest Request;
  std::unique_ptr<PointAccess> Points;
  std::vector<NamedAttribute> Attributes;
  double From = 0.0;
  double To = 1.0;
  // Which input was seen last, and how often a part of it.
  vtkMTimeType PointsTime = 0;
  int PartialViews = 0;
  bool Indexed = false;
};

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
  , Inside(std::make_unique<Internals>(this))
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
  return static_cast<unsigned long>(
    (this->Inside->Engine.scratchBytes() + this->Inside->Index.bytes()) / 1024);
}

void vtkVoxelMeanResampler::ReleaseScratch()
{
  this->Inside->Forget();
}

vtkMTimeType vtkVoxelMeanResampler::GetMTime()
{
  vtkMTimeType time = this->Superclass::GetMTime();
  if (this->Transform)
  {
    time = std::max(time, this->Transform->GetMTime());
  }
  if (this->Inside->Aborted)
  {
    // The pipeline takes what an aborted execution leaves for an output; ask it for another.
    this->Inside->RetryTime.Modified();
  }
  return std::max(time, this->Inside->RetryTime.GetMTime());
}

int vtkVoxelMeanResampler::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
  return 1;
}

bool vtkVoxelMeanResampler::Internals::ReadTransform()
{
  vtkAbstractTransform* transform = this->Filter->Transform;
  if (!affineFromTransform(transform, this->Request.transform))
  {
    vtkErrorWithObjectMacro(this->Filter,
      "Transform " << transform->GetClassName()
                   << " is not affine; use a vtkTransform or vtkMatrixToLinearTransform.");
    return false;
  }
  const Status status = this->Request.transform.check();
  if (status != Status::Ok)
  {
    vtkErrorWithObjectMacro(this->Filter, "SetTransform: " << sentence(status) << ".");
    return false;
  }
  return true;
}

bool vtkVoxelMeanResampler::Internals::MakeLattice(vtkPointSet* input)
{
  this->Points = std::make_unique<PointAccess>(input->GetPoints());
  this->Request.points = this->Points->view();
  LatticeSettings settings;
  settings.voxelSize = this->Filter->VoxelSize;
  settings.automaticWorkspace = this->Filter->AutomaticWorkspace;
  for (int axis = 0; axis < 3; ++axis)
  {
    settings.dimensions[std::size_t(axis)] = this->Filter->Dimensions[axis];
    settings.workspace.minimum[axis] = this->Filter->WorkspaceBounds[2 * axis];
    settings.workspace.maximum[axis] = this->Filter->WorkspaceBounds[2 * axis + 1];
  }
  const Bounds cloud = settings.automaticWorkspace
    ? transformedBounds(this->Request.points, this->Request.transform, this->Smp)
    : Bounds();
  const Status status = makeLattice(settings, cloud, this->Request.lattice);
  if (status != Status::Ok)
  {
    vtkErrorWithObjectMacro(this->Filter,
      << latticeText(this->Filter->VoxelSize, this->Filter->Dimensions) << ": " << sentence(status) << ".");
    return false;
  }
  return true;
}

/// An index pays where parts of the same points are looked at again and again.
void vtkVoxelMeanResampler::Internals::UseIndex(vtkPointSet* input)
{
  const vtkMTimeType time = input->GetMTime();
  if (time != this->PointsTime || !this->Filter->UsePointIndex)
  {
    this->Index = PointIndex();
    this->Indexed = false;
    this->PartialViews = 0;
    this->PointsTime = time;
  }
  if (!this->Indexed && this->PartialViews > 0)
  {
    this->PartialViews = 0;
    this->Indexed = this->Index.build(this->Request.points, this->Smp) == Status::Ok;
  }
  this->Request.index = this->Indexed ? &this->Index : nullptr;
}

bool vtkVoxelMeanResampler::Internals::Resample(vtkPointSet* input)
{
  this->UseIndex(input);
  const int precision = this->Filter->OutputPointsPrecision;
  this->Request.singlePrecision = precision == vtkAlgorithm::DEFAULT_PRECISION
    ? input->GetPoints()->GetDataType() == VTK_FLOAT
    : precision == vtkAlgorithm::SINGLE_PRECISION;
  this->Request.covariances = this->Filter->ComputeCovariance;
  this->Request.levels = this->Filter->NumberOfLevels;
  this->Request.instructions = pointhaptics::InstructionSet(this->Filter->InstructionSet);
  this->Request.keys = !this->Attributes.empty() || this->Request.levels > 1;
  this->From = 0.0;
  this->To = this->Attributes.empty() ? 0.95 : 0.5;
  const Status status = this->Engine.run(this->Request, this->Smp, this);
  if (status == Status::Aborted)
  {
    return false;
  }
  if (status != Status::Ok)
  {
    vtkErrorWithObjectMacro(this->Filter, << sentence(status) << ".");
    return false;
  }
  this->Filter->NumberOfClippedPoints = vtkIdType(this->Engine.clippedPoints());
  this->Filter->NumberOfInvalidPoints = vtkIdType(this->Engine.invalidPoints());
  if (2 * this->Engine.clippedPoints() > this->Request.points.size())
  {
    ++this->PartialViews;
  }
  return true;
}

void vtkVoxelMeanResampler::Internals::ChooseArrays(vtkPointSet* input)
{
  this->Attributes.clear();
  if (!this->Filter->PassAttributes)
  {
    return;
  }
  vtkPointData* data = input->GetPointData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = data->GetArray(i);
    if (!array)
    {
      vtkWarningWithObjectMacro(
        this->Filter, "Array " << data->GetArrayName(i) << " is not numeric: it has no mean and is dropped.");
      continue;
    }
    if (isBookkeeping(data, i))
    {
      continue;
    }
    if (array->GetNumberOfTuples() != input->GetNumberOfPoints())
    {
      vtkWarningWithObjectMacro(this->Filter,
        "Array " << data->GetArrayName(i) << " has " << array->GetNumberOfTuples() << " tuples for "
                 << input->GetNumberOfPoints() << " points: it is dropped.");
      continue;
    }
    AttributeKind kind = AttributeKind::Mean;
    if (this->Filter->IsCategoricalArray(array->GetName()))
    {
      kind = AttributeKind::Category;
    }
    else if (array == data->GetNormals() && array->GetNumberOfComponents() == 3)
    {
      kind = AttributeKind::Normal;
    }
    this->Attributes.push_back({ VoxelAttribute(array, kind, this->Smp), data->IsArrayAnAttribute(i) });
  }
}

bool vtkVoxelMeanResampler::Internals::AverageArrays()
{
  if (this->Attributes.empty())
  {
    return true;
  }
  this->From = 0.5;
  this->To = 0.95;
  for (NamedAttribute& named : this->Attributes)
  {
    named.attribute.prepare(this->Engine.size());
  }
  const Status status = this->Engine.assign(
    this->Request,
    [this](const std::int64_t* points, const std::int64_t* voxels, int count)
    {
      for (NamedAttribute& named : this->Attributes)
      {
        named.attribute.add(points, voxels, count);
      }
    },
    this->Smp, this);
  return status == Status::Ok;
}

bool vtkVoxelMeanResampler::Internals::Run(vtkPointSet* input)
{
  this->ChooseArrays(input);
  const bool done = this->Resample(input) && this->AverageArrays();
  if (!done)
  {
    this->Release();
  }
  return done;
}

void vtkVoxelMeanResampler::Internals::Release()
{
  this->Attributes.clear();
  this->Request = VoxelRequest();
  this->Points.reset();
}

void vtkVoxelMeanResampler::Internals::Fill(int level, vtkPointSet* input, vtkPolyData* output)
{
  vtkPointData* data = output->GetPointData();
  output->SetPoints(makePoints(this->Engine, level, this->Request.singlePrecision, this->Smp));
  output->SetVerts(makeVertices(vtkIdType(this->Engine.size(level)), this->Smp));
  const auto counts = makeCounts(this->Engine, level, this->Smp);
  const auto* countValues = reinterpret_cast<const std::int64_t*>(counts->GetPointer(0));
  for (NamedAttribute& named : this->Attributes)
  {
    if (level > 0)
    {
      named.attribute.coarsen(this->Engine.parents(level), this->Engine.size(level));
    }
    const int index = data->AddArray(named.attribute.output(countValues, this->Request.transform, this->Smp));
    if (named.role >= 0)
    {
      data->SetActiveAttribute(index, named.role);
    }
  }
  data->AddArray(counts);
  if (this->Filter->ComputeCovariance)
  {
    data->AddArray(makeCovariances(this->Engine, level, this->Smp));
  }
  output->GetFieldData()->PassData(input->GetFieldData());
  addLattice(this->Engine.lattice(level), this->Request.transform, output->GetFieldData());
}

void vtkVoxelMeanResampler::Internals::Forget()
{
  this->Engine.releaseScratch();
  this->Index = PointIndex();
  this->Indexed = false;
  this->PartialViews = 0;
}

bool vtkVoxelMeanResampler::Internals::proceed(double fraction)
{
  this->Filter->UpdateProgress(this->From + (this->To - this->From) * fraction);
  this->Aborted = this->Filter->GetAbortExecute() != 0;
  return !this->Aborted;
}

int vtkVoxelMeanResampler::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  auto* input = vtkPointSet::GetData(inputVector[0]);
  Internals& inside = *this->Inside;
  inside.Aborted = false;
  this->NumberOfClippedPoints = 0;
  this->NumberOfInvalidPoints = 0;
  for (int level = 0; level < this->NumberOfLevels; ++level)
  {
    vtkPolyData::GetData(outputVector, level)->GetFieldData()->PassData(input->GetFieldData());
  }
  if (input->GetNumberOfPoints() == 0 || !inside.ReadTransform() || !inside.MakeLattice(input))
  {
    return 1;
  }
  if (!inside.Run(input))
  {
    this->NumberOfClippedPoints = 0;
    this->NumberOfInvalidPoints = 0;
    return 1;
  }
  for (int level = 0; level < this->NumberOfLevels; ++level)
  {
    inside.Fill(level, input, vtkPolyData::GetData(outputVector, level));
  }
  inside.Release();
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
  os << indent << "NumberOfLevels: " << this->NumberOfLevels << "\n";
  os << indent << "UsePointIndex: " << this->UsePointIndex << "\n";
  os << indent << "InstructionSet: " << this->InstructionSet << "\n";
  os << indent << "NumberOfClippedPoints: " << this->NumberOfClippedPoints << "\n";
  os << indent << "NumberOfInvalidPoints: " << this->NumberOfInvalidPoints << "\n";
}
