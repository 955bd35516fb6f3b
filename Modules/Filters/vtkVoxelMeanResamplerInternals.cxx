#include "vtkVoxelMeanResamplerInternals.h"

#include "FieldPoses.h"
#include "ResamplerInput.h"

#include "Core/Resample/VoxelMean.h"

#include "vtkAbstractTransform.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cstdint>
#include <string>

using namespace pointhaptics;

namespace
{

/// The part of an update's progress after which the outputs are filled: see kRunEnd.
constexpr double kFillEnd = 0.99;

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
  vtkPointSet* input, const std::vector<vtkSmartPointer<vtkPolyData>>& outputs, vtkPolyData* index)
{
  const UpdateScope scope(*this);
  this->Aborted = false;
  // Once: observers of progress may ask for another.
  this->Request.representative = this->Filter->Settings.representative;
  this->PassBegin = 0.0;
  this->PassEnd = 1.0;
  this->PartBegin = this->PartEnd = 0.0;
  if (!this->ReadTransform() || !this->MakeLattice(input) || !this->UseIndex(input))
  {
    return false;
  }
  const std::string lost = lostPoses(this->Request.transform, input->GetFieldData());
  if (!lost.empty())
  {
    vtkWarningWithObjectMacro(this->Filter, << lost);
  }
  // Levels that would not equal the resampling of the points at their spacing take a second pass over the
  // points.
  const bool isMean = this->Request.representative == pointhaptics::Representative::Mean && !index;
  const int levels = int(outputs.size());
  const double begin = this->PartEnd;
  for (int first = 0; first < levels; first += this->Request.levels)
  {
    this->Request.voxelIndex = first == 0 && index;
    this->Request.levels = isMean ? VoxelResampler::exactLevels(this->Request.lattice, levels - first) : 1;
    this->BeginPass(begin + (1.0 - begin) * first / levels,
      begin + (1.0 - begin) * (first + this->Request.levels) / levels);
    if (!this->Run(input, first == 0) || !this->FillAll(input, &outputs[std::size_t(first)]))
    {
      for (vtkPolyData* output : outputs)
      {
        output->Initialize();
        output->GetFieldData()->PassData(input->GetFieldData());
      }
      if (index)
      {
        index->Initialize();
      }
      return false;
    }
    if (first == 0 && index)
    {
      this->FillIndex(input, index);
    }
    this->Request.lattice = coarserLattice(this->Engine.lattice(this->Request.levels - 1));
  }
  return true;
}

bool vtkVoxelMeanResampler::Internals::ReadTransform()
{
  const std::string problem = readTransform(this->Filter->Transform, this->Request.transform);
  if (!problem.empty())
  {
    vtkErrorWithObjectMacro(this->Filter, << problem);
  }
  return problem.empty();
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
    vtkErrorWithObjectMacro(this->Filter, << latticeProblem(settings, status));
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
  this->Request.attributes.clear();
  this->Request.tieBreakers.clear();
  for (const NamedAttribute& named : this->Attributes)
  {
    this->KeepsPoints() ? this->Request.tieBreakers.push_back(named.attribute.view())
                        : this->Request.attributes.push_back(named.attribute.request());
  }
  this->Request.allocator = &this->Allocator;
  this->BeginPart(kRunEnd);
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

bool vtkVoxelMeanResampler::Internals::Run(vtkPointSet* input, bool isFirst)
{
  if (isFirst && this->Filter->Settings.keepOriginalPointIds && !this->KeepsPoints())
  {
    vtkWarningWithObjectMacro(this->Filter,
      "KeepOriginalPointIds: a mean or median is no point of the input; choose Representative NearestToMean "
      "or "
      "NearestToCenter.");
  }
  this->ChooseArrays(input, isFirst);
  return this->Resample(input, isFirst);
}

void vtkVoxelMeanResampler::Internals::Release()
{
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

bool vtkVoxelMeanResampler::Internals::AddArrays(int level, vtkPointData* data)
{
  // Steps of the filling of all levels.
  const auto steps = double(this->Attributes.size() + 1);
  double done = steps * level;
  for (std::size_t i = 0; i < this->Attributes.size(); ++i)
  {
    this->BeginPart(kRunEnd + (kFillEnd - kRunEnd) * ++done / (steps * this->Request.levels));
    const vtkSmartPointer<vtkDataArray> array = this->ReducedArray(i, level);
    if (!this->report(1.0))
    {
      return false;
    }
    addArray(data, array, this->Attributes[i].roles);
  }
  return true;
}

bool vtkVoxelMeanResampler::Internals::Fill(int level, vtkPointSet* input, vtkPolyData* output)
{
  const VoxelMeanSettings& settings = this->Filter->Settings;
  OutputFiller filler{ this->Engine, this->Request.transform, this->Pool, this->Allocator, this->Smp,
    this->Request.singlePrecision, this->Request.covariances, settings.minimumPointsPerVoxel, {} };
  if (settings.keepOriginalPointIds && this->KeepsPoints())
  {
    filler.pointIds = this->Engine.chosenPoints();
  }
  output->GetFieldData()->PassData(input->GetFieldData());
  return filler.fill(
    level, output, [&](vtkIdTypeArray*, vtkPointData* data) { return this->AddArrays(level, data); },
    this->Kept);
}

void vtkVoxelMeanResampler::Internals::FillIndex(vtkPointSet* input, vtkPolyData* output)
{
  std::vector<std::int64_t> places(this->Kept ? std::size_t(this->Engine.size()) : 0, -1);
  for (std::size_t i = 0; this->Kept && i < this->Kept->size(); ++i)
  {
    places[std::size_t((*this->Kept)[i])] = std::int64_t(i);
  }
  output->SetPoints(input->GetPoints());
  output->GetPointData()->PassData(input->GetPointData());
  output->GetPointData()->AddArray(
    makeIds(this->Engine.voxelIndex(), "VoxelIndex", places, this->Pool, this->Smp));
  output->GetFieldData()->PassData(input->GetFieldData());
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
