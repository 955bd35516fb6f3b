#include "vtkVoxelMeanResamplerInternals.h"

#include "Core/Resample/VoxelMean.h"

#include "vtkAbstractArray.h"
#include "vtkAbstractTransform.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkHomogeneousTransform.h"
#include "vtkIdTypeArray.h"
#include "vtkMatrix4x4.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <mutex>
#include <sstream>
#include <string>

using namespace pointhaptics;

namespace
{

/// Parts of an update's progress: the means are known, the outputs are filled.
constexpr double kRunEnd = 0.9;
constexpr double kFillEnd = 0.99;

std::string latticeText(const LatticeSettings& lattice)
{
  std::ostringstream text;
  if (lattice.voxelSize != 0.0)
  {
    text << "Lattice of voxel size " << lattice.voxelSize;
  }
  else
  {
    const std::array<std::int64_t, 3>& n = lattice.dimensions;
    text << "Lattice of " << n[0] << " x " << n[1] << " x " << n[2] << " voxels";
  }
  return text.str();
}

/// Such a matrix is often not affine either: NaN times 0 is NaN.
bool holdsNonFinite(vtkAbstractTransform* transform)
{
  auto* homogeneous = vtkHomogeneousTransform::SafeDownCast(transform);
  const double* elements = homogeneous ? homogeneous->GetMatrix()->GetData() : nullptr;
  return elements && !std::all_of(elements, elements + 16, [](double e) { return std::isfinite(e); });
}

std::string nameOf(vtkAbstractArray* array)
{
  return array->GetName() ? array->GetName() : "";
}

/// Identifiers and ghost flags are meaningless once points are merged, and so are counts and covariances of
/// an earlier resampling.
bool isBookkeeping(vtkDataSetAttributes* attributes, vtkAbstractArray* array)
{
  const std::string name = nameOf(array);
  return array == attributes->GetGlobalIds() || array == attributes->GetPedigreeIds() ||
    name == vtkDataSetAttributes::GhostArrayName() || name == "VoxelPointCount" || name == "VoxelCovariance";
}

std::string whyDropped(vtkAbstractArray* array, vtkIdType points)
{
  std::ostringstream text;
  text << "Array \"" << nameOf(array) << "\" ";
  if (!vtkDataArray::SafeDownCast(array))
  {
    text << "is not numeric: it has no mean and is dropped.";
  }
  else
  {
    text << "has " << array->GetNumberOfTuples() << " tuples for " << points << " points: it is dropped.";
  }
  return text.str();
}

/// An array may be the active one of several types.
std::vector<int> rolesOf(vtkDataSetAttributes* attributes, vtkAbstractArray* array)
{
  std::vector<int> roles;
  for (int type = 0; type < vtkDataSetAttributes::NUM_ATTRIBUTES; ++type)
  {
    if (attributes->GetAbstractAttribute(type) == array)
    {
      roles.push_back(type);
    }
  }
  return roles;
}

}

/// The scope of an update: caches are not freed within it, and the input is released at its end.
class vtkVoxelMeanResampler::Internals::UpdateScope
{
public:
  explicit UpdateScope(Internals& owner)
    : Owner(owner)
  {
    this->Owner.IsRunning = true;
  }
  ~UpdateScope()
  {
    this->Owner.Release();
    this->Owner.IsRunning = false;
    if (this->Owner.ReleaseCachesAtEnd)
    {
      this->Owner.ReleaseCaches();
    }
  }
  UpdateScope(const UpdateScope&) = delete;
  UpdateScope& operator=(const UpdateScope&) = delete;

private:
  Internals& Owner;
};

bool vtkVoxelMeanResampler::Internals::Update(
  vtkPointSet* input, const std::vector<vtkSmartPointer<vtkPolyData>>& outputs)
{
  const UpdateScope scope(*this);
  this->Aborted = false;
  this->PassBegin = 0.0;
  this->PassEnd = 1.0;
  this->PartBegin = this->PartEnd = 0.0;
  if (!this->ReadTransform() || !this->MakeLattice(input) || !this->UseIndex(input))
  {
    return false;
  }
  // Levels that would not equal the resampling of the points at their spacing take a second pass over the
  // points.
  const int levels = int(outputs.size());
  const double begin = this->PartEnd;
  for (int first = 0; first < levels; first += this->Request.levels)
  {
    this->Request.levels = VoxelResampler::exactLevels(this->Request.lattice, levels - first);
    this->BeginPass(begin + (1.0 - begin) * first / levels,
      begin + (1.0 - begin) * (first + this->Request.levels) / levels);
    if (!this->Run(input, first == 0) || !this->FillAll(input, &outputs[std::size_t(first)]))
    {
      for (vtkPolyData* output : outputs)
      {
        output->Initialize();
        output->GetFieldData()->PassData(input->GetFieldData());
      }
      return false;
    }
    this->Request.lattice = coarserLattice(this->Engine.lattice(this->Request.levels - 1));
  }
  return true;
}

bool vtkVoxelMeanResampler::Internals::ReadTransform()
{
  vtkAbstractTransform* transform = this->Filter->Transform;
  if (!affineFromTransform(transform, this->Request.transform))
  {
    if (holdsNonFinite(transform))
    {
      vtkErrorWithObjectMacro(this->Filter, "SetTransform: " << message(Status::NonFiniteTransform) << ".");
      return false;
    }
    vtkErrorWithObjectMacro(this->Filter,
      "SetTransform: " << transform->GetClassName()
                       << " is not affine; use a vtkTransform or vtkMatrixToLinearTransform whose matrix has "
                          "the last row 0, 0, 0, 1.");
    return false;
  }
  const Status status = this->Request.transform.check();
  if (status != Status::Ok)
  {
    vtkErrorWithObjectMacro(this->Filter, "SetTransform: " << message(status) << ".");
    return false;
  }
  return true;
}

bool vtkVoxelMeanResampler::Internals::MakeLattice(vtkPointSet* input)
{
  this->Points = std::make_unique<PointAccess>(input->GetPoints());
  this->Request.points = this->Points->view();
  const LatticeSettings settings = this->Filter->Settings.lattice;
  Bounds cloud;
  if (settings.automaticWorkspace)
  {
    this->BeginPart(0.1);
    cloud = transformedBounds(this->Request.points, this->Request.transform, this->Smp, this);
    if (this->Aborted)
    {
      return false;
    }
  }
  const Status status = makeLattice(settings, cloud, this->Request.lattice);
  if (status != Status::Ok)
  {
    vtkErrorWithObjectMacro(this->Filter, << latticeText(settings) << ": " << message(status) << ".");
    return false;
  }
  return true;
}

vtkVoxelMeanResampler::Internals::ArraySeen::ArraySeen(vtkDataArray* array, vtkMTimeType ownersTime)
  : data(array)
  , address(array->HasStandardMemoryLayout() ? array->GetVoidPointer(0) : nullptr)
  , size(array->GetNumberOfTuples())
  , time(std::max(array->GetMTime(), ownersTime))
{
}

bool vtkVoxelMeanResampler::Internals::ArraySeen::operator==(const ArraySeen& other) const
{
  return this->data == other.data && this->address == other.address && this->size == other.size &&
    this->time == other.time;
}

vtkVoxelMeanResampler::Internals::ArraySeen vtkVoxelMeanResampler::Internals::SeenPoints(vtkPointSet* input)
{
  vtkPoints* points = input->GetPoints();
  // The data set's own time, without that of its arrays: some write coordinates and mark nothing else.
  return points ? ArraySeen(points->GetData(), std::max(points->GetMTime(), input->vtkObject::GetMTime()))
                : ArraySeen();
}

/// An index pays off where parts of the same points are resampled repeatedly.
bool vtkVoxelMeanResampler::Internals::UseIndex(vtkPointSet* input)
{
  const ArraySeen seen = SeenPoints(input);
  if (!(seen == this->Seen) || !this->Filter->Settings.usePointIndex)
  {
    this->Index = PointIndex();
    this->Indexed = false;
    this->PartialViews = 0;
    this->Seen = seen;
  }
  if (!this->Indexed && this->PartialViews > 0)
  {
    this->BeginPart(0.3);
    this->Indexed = this->Index.build(this->Request.points, this->Smp, this) == Status::Ok;
    if (this->Aborted)
    {
      return false;
    }
    this->PartialViews = 0;
  }
  this->Request.index = this->Indexed ? &this->Index : nullptr;
  return true;
}

bool vtkVoxelMeanResampler::Internals::Resample(vtkPointSet* input, bool isFirst)
{
  const VoxelMeanSettings& settings = this->Filter->Settings;
  const vtkPoints* points = input->GetPoints();
  this->Request.singlePrecision = settings.outputPointsPrecision == PointsPrecision::OfInput
    ? !points || points->GetDataType() == VTK_FLOAT
    : settings.outputPointsPrecision == PointsPrecision::Single;
  this->Request.covariances = settings.computeCovariance;
  this->Request.instructions = settings.instructionSet;
  this->Request.keys = !this->Attributes.empty();
  this->Request.keepPointRecords = !this->Attributes.empty();
  this->Request.tuples.clear();
  for (const NamedAttribute& named : this->Attributes)
  {
    this->Request.tuples.push_back(named.attribute.source());
  }
  this->Request.allocator = &this->Allocator;
  this->BeginPart(this->Attributes.empty() ? kRunEnd : 0.5);
  const Status status = this->Engine.run(this->Request, this->Smp, this);
  if (status == Status::Aborted)
  {
    return false;
  }
  if (status != Status::Ok)
  {
    vtkErrorWithObjectMacro(this->Filter, << message(status) << ".");
    return false;
  }
  if (isFirst)
  {
    this->Filter->NumberOfClippedPoints = vtkIdType(this->Engine.clippedPoints());
    this->Filter->NumberOfInvalidPoints = vtkIdType(this->Engine.invalidPoints());
    this->PartialViews += 2 * this->Engine.clippedPoints() > this->Request.points.size();
  }
  return true;
}

void vtkVoxelMeanResampler::Internals::ChooseArrays(vtkPointSet* input, bool warns)
{
  this->Attributes.clear();
  if (!this->Filter->Settings.passAttributes)
  {
    this->Known.clear();
    return;
  }
  vtkPointData* data = input->GetPointData();
  std::vector<KnownValues> known;
  known.swap(this->Known);
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* any = data->GetAbstractArray(i);
    if (isBookkeeping(data, any))
    {
      continue;
    }
    vtkDataArray* array = vtkDataArray::SafeDownCast(any);
    if (!array || array->GetNumberOfTuples() != input->GetNumberOfPoints())
    {
      if (warns)
      {
        vtkWarningWithObjectMacro(this->Filter, << whyDropped(any, input->GetNumberOfPoints()));
      }
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
    const ArraySeen seen(array, std::max(data->vtkObject::GetMTime(), input->vtkObject::GetMTime()));
    const auto old = std::find_if(known.begin(), known.end(),
      [&](const KnownValues& values) { return values.seen == seen && values.kind == kind; });
    VoxelAttribute attribute(array, kind, old == known.end() ? nullptr : &old->values,
      this->Filter->Settings.instructionSet, this->Smp);
    if (this->Filter->Settings.usePointIndex)
    {
      this->Known.push_back({ seen, kind, attribute.values() });
    }
    this->Attributes.push_back({ std::move(attribute), rolesOf(data, array) });
  }
}

bool vtkVoxelMeanResampler::Internals::AverageArrays()
{
  if (this->Attributes.empty())
  {
    return true;
  }
  this->BeginPart(kRunEnd);
  const bool canWriteSets = std::all_of(this->Attributes.begin(), this->Attributes.end(),
    [](const NamedAttribute& named) { return named.attribute.canWriteSets(); });
  if (canWriteSets && this->Engine.canVisitByVoxelSet() && this->Request.levels == 1)
  {
    this->AverageInSets();
    return this->report(1.0);
  }
  const std::int64_t mostPoints = this->Engine.mostPoints(this->Request.levels - 1);
  for (NamedAttribute& named : this->Attributes)
  {
    Buffer<std::int64_t> spare;
    if (!this->SpareSums.empty())
    {
      spare = std::move(this->SpareSums.back());
      this->SpareSums.pop_back();
    }
    named.attribute.prepare(
      this->Engine.counts(), this->Engine.size(), mostPoints, std::move(spare), this->Smp);
  }
  const Status status = this->Engine.visitPointsByVoxel(
    this->Request,
    [this](const PointRows& rows, const std::int64_t* voxels, int count)
    {
      for (std::size_t i = 0; i < this->Attributes.size(); ++i)
      {
        this->Attributes[i].attribute.add(rows.tuples(i), rows.bytes, voxels, count);
      }
    },
    this->Smp, this);
  return status == Status::Ok;
}

/// One set of voxels at a time: its sums and tuples stay in the caches, and its means are written in place.
void vtkVoxelMeanResampler::Internals::AverageInSets()
{
  for (NamedAttribute& named : this->Attributes)
  {
    named.attribute.prepareSets(this->Engine.size(), this->Request.transform, this->Pool);
  }
  const std::int64_t mostPoints = this->Engine.mostPoints();
  std::mutex mutex;
  using TuplesOfAll = std::vector<VoxelAttribute::Tuples>;
  std::vector<TuplesOfAll> idle;
  const auto take = [&]
  {
    const std::lock_guard<std::mutex> lock(mutex);
    TuplesOfAll tuples;
    if (!idle.empty())
    {
      tuples = std::move(idle.back());
      idle.pop_back();
      return tuples;
    }
    for (const NamedAttribute& named : this->Attributes)
    {
      tuples.push_back(named.attribute.tuplesOfSet());
    }
    return tuples;
  };
  this->Engine.visitPointsByVoxelSet(
    this->Request,
    [&](std::int64_t first, std::int64_t voxels, const auto& forPoints)
    {
      TuplesOfAll tuples = take();
      const std::int64_t* counts = this->Engine.counts() + first;
      for (VoxelAttribute::Tuples& ofArray : tuples)
      {
        VoxelAttribute::prepare(ofArray, counts, voxels, mostPoints);
      }
      forPoints(
        [&](const PointRows& rows, const std::int64_t* numbers, int count)
        {
          for (std::size_t i = 0; i < tuples.size(); ++i)
          {
            VoxelAttribute::add(tuples[i], rows.tuples(i), rows.bytes, numbers, count);
          }
        });
      for (std::size_t i = 0; i < tuples.size(); ++i)
      {
        this->Attributes[i].attribute.writeSet(tuples[i], first, counts);
      }
      const std::lock_guard<std::mutex> lock(mutex);
      idle.push_back(std::move(tuples));
    },
    this->Smp);
}

bool vtkVoxelMeanResampler::Internals::Run(vtkPointSet* input, bool isFirst)
{
  this->ChooseArrays(input, isFirst);
  return this->Resample(input, isFirst) && this->AverageArrays();
}

void vtkVoxelMeanResampler::Internals::Release()
{
  this->SpareSums.clear();
  for (NamedAttribute& named : this->Attributes)
  {
    this->SpareSums.push_back(named.attribute.takeSums());
  }
  this->Attributes.clear();
  for (KnownValues& known : this->Known)
  {
    // As large as the input: worth its memory only where parts are resampled repeatedly.
    known.values.copy = this->Indexed ? known.values.copy : nullptr;
  }
  this->Allocator.release();
  // Memory of earlier outputs that this one did not reuse.
  this->Pool.trim();
  this->Request = VoxelRequest();
  this->Points.reset();
}

bool vtkVoxelMeanResampler::Internals::Fill(int level, vtkPointSet* input, vtkPolyData* output)
{
  vtkPointData* data = output->GetPointData();
  output->SetPoints(
    makePoints(this->Engine, level, this->Request.singlePrecision, this->Allocator, this->Smp));
  output->SetVerts(makeVertices(vtkIdType(this->Engine.size(level)), this->Pool, this->Smp));
  const auto counts = makeCounts(this->Engine, level, this->Allocator, this->Smp);
  const auto* countValues = reinterpret_cast<const std::int64_t*>(counts->GetPointer(0));
  // Steps of the filling of all levels.
  const auto steps = double(this->Attributes.size() + 1);
  double done = steps * level;
  for (NamedAttribute& named : this->Attributes)
  {
    this->BeginPart(kRunEnd + (kFillEnd - kRunEnd) * ++done / (steps * this->Request.levels));
    if (level > 0)
    {
      named.attribute.coarsen(this->Engine.parents(level), this->Engine.size(level));
    }
    const vtkSmartPointer<vtkDataArray> array =
      named.attribute.output(countValues, this->Request.transform, this->Pool, this->Smp, this);
    if (!array || !this->report(1.0))
    {
      return false;
    }
    const int index = data->AddArray(array);
    for (const int role : named.roles)
    {
      data->SetActiveAttribute(index, role);
    }
  }
  data->AddArray(counts);
  if (this->Request.covariances)
  {
    data->AddArray(makeCovariances(this->Engine, level, this->Allocator, this->Smp));
  }
  output->GetFieldData()->PassData(input->GetFieldData());
  addLattice(this->Engine.lattice(level), this->Request.transform, output->GetFieldData());
  return true;
}

bool vtkVoxelMeanResampler::Internals::FillAll(
  vtkPointSet* input, const vtkSmartPointer<vtkPolyData>* outputs)
{
  for (int level = 0; level < this->Request.levels; ++level)
  {
    if (!this->Fill(level, input, outputs[level]))
    {
      return false;
    }
  }
  return true;
}

std::size_t vtkVoxelMeanResampler::Internals::ScratchBytes() const
{
  std::size_t sum = this->Engine.scratchBytes() + this->Index.bytes() + this->Pool.bytes();
  for (const Buffer<std::int64_t>& sums : this->SpareSums)
  {
    sum += sums.bytes();
  }
  for (const KnownValues& known : this->Known)
  {
    sum += known.values.copy ? std::size_t(1024) * known.values.copy->GetActualMemorySize() : 0;
  }
  return sum;
}

void vtkVoxelMeanResampler::Internals::ReleaseCaches()
{
  this->ReleaseCachesAtEnd = this->IsRunning;
  if (this->IsRunning)
  {
    return;
  }
  this->Engine.releaseScratch();
  this->Pool.trim();
  this->SpareSums.clear();
  this->Index = PointIndex();
  this->Indexed = false;
  this->PartialViews = 0;
  this->Known.clear();
}

void vtkVoxelMeanResampler::Internals::BeginPass(double begin, double end)
{
  this->PassBegin = begin;
  this->PassEnd = end;
  this->PartBegin = this->PartEnd = 0.0;
}

void vtkVoxelMeanResampler::Internals::BeginPart(double end)
{
  this->PartBegin = this->PartEnd;
  this->PartEnd = end;
}

bool vtkVoxelMeanResampler::Internals::report(double fraction)
{
  const double ofPass = this->PartBegin + (this->PartEnd - this->PartBegin) * fraction;
  this->Filter->UpdateProgress(this->PassBegin + (this->PassEnd - this->PassBegin) * ofPass);
  this->Aborted = this->Filter->GetAbortExecute() != 0;
  return !this->Aborted;
}
