#include "vtkVoxelMeanResamplerInternals.h"

#include "FieldPoses.h"

#include "Core/Base/FieldNames.h"
#include "Core/Base/Host/InterpreterLock.h"
#include "Core/Distributed/FarPoints.h"
#include "Core/Distributed/Ranks.h"
#include "Core/Resample/TransformedBounds.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cstdint>
#include <deque>
#include <string>

using namespace pointhaptics;

namespace
{

/// The part of an update's progress after which the outputs are filled: see kRunEnd.
constexpr double kFillEnd = 0.99;

}

bool vtkVoxelMeanResampler::Internals::Begin(const Clouds& clouds)
{
  this->IsRunning = true;
  this->Aborted = false;
  this->Settings = this->Filter->Settings;
  this->Smp = SmpExecutor(unsigned(this->Filter->NumberOfThreads));
  this->PartBegin = this->PartEnd = 0.0;
  this->NumberOfPoints = 0;
  for (vtkPointSet* cloud : clouds)
  {
    this->NumberOfPoints += cloud->GetNumberOfPoints();
  }
  const std::string problem = readTransform(this->Filter->Transform, this->Transform);
  if (!problem.empty())
  {
    this->Filter->Fail(problem);
    return false;
  }
  this->WarnOfNames(clouds);
  return this->FindWorkspace(clouds);
}

/// The box that an automatic lattice of the points is about.
Bounds vtkVoxelMeanResampler::Internals::BoundsOf(const std::vector<PointView>& parts)
{
  Bounds all;
  for (const PointView& part : parts)
  {
    const Bounds own = transformedBounds(part, this->Transform, this->Smp, this);
    if (!own.empty())
    {
      all.include(own.minimum);
      all.include(own.maximum);
    }
  }
  if (this->Aborted)
  {
    return all;
  }
  Ranks alone;
  std::string note;
  const Bounds bounds = boundsForLattice(this->Settings.lattice, parts, all, alone, this->Transform, note);
  this->Filter->Warn(note);
  return bounds;
}

bool vtkVoxelMeanResampler::Internals::FindWorkspace(const Clouds& clouds)
{
  this->Workspace.reset();
  if (!this->Settings.lattice.automaticWorkspace || this->Filter->LatticePerBlock || clouds.size() == 1)
  {
    return true;
  }
  std::deque<PointAccess> points;
  std::vector<PointView> parts;
  for (vtkPointSet* cloud : clouds)
  {
    parts.push_back(points.emplace_back(cloud->GetPoints()).view());
  }
  this->Workspace = this->BoundsOf(parts);
  return !this->Aborted;
}

void vtkVoxelMeanResampler::Internals::WarnOfNames(const Clouds& clouds)
{
  const auto isNamed = [&](const std::string& name)
  {
    return std::any_of(clouds.begin(), clouds.end(),
      [&](vtkPointSet* cloud)
      {
        vtkPointData* data = cloud->GetPointData();
        for (int i = 0; i < data->GetNumberOfArrays(); ++i)
        {
          if (data->GetArrayName(i) && isSameField(name, data->GetArrayName(i)))
          {
            return true;
          }
        }
        return false;
      });
  };
  for (const std::string& name : this->Settings.categoricalArrays)
  {
    if (this->NumberOfPoints > 0 && this->Settings.passAttributes &&
      VoxelMeanSettings().categoricalArrays.count(name) == 0 && !isNamed(name))
    {
      this->Filter->Warn("CategoricalArrays: the input has no point array \"" + name + "\".");
    }
  }
}

bool vtkVoxelMeanResampler::Internals::Update(vtkPointSet* input, vtkPolyData* means, vtkPolyData* index)
{
  this->PartBegin = this->PartEnd = 0.0;
  this->Request.representative = this->Settings.representative;
  this->Request.transform = this->Transform;
  this->Request.voxelIndex = this->Settings.computeVoxelIndex;
  means->GetFieldData()->PassData(input->GetFieldData());
  if (!this->MakeLattice(input) || !this->UseIndex(input))
  {
    return false;
  }
  this->Filter->Warn(lostPoses(this->Transform, input->GetFieldData()));
  if (this->Settings.keepOriginalPointIds && !this->KeepsPoints())
  {
    this->Filter->Warn("KeepOriginalPointIds: a mean or median is no point of the input; choose "
                       "Representative NearestToMean or NearestToCenter.");
  }
  this->ChooseArrays(input);
  if (!this->Resample(input) || !this->Fill(input, means))
  {
    return false;
  }
  if (this->Settings.computeVoxelIndex)
  {
    this->FillIndex(input, index);
  }
  this->Release();
  return true;
}

void vtkVoxelMeanResampler::Internals::End(bool succeeded)
{
  if (succeeded)
  {
    this->Filter->WarnOfNothing(this->NumberOfPoints);
  }
  this->Release();
  this->IsRunning = false;
  if (this->ReleaseCachesAtEnd)
  {
    this->ReleaseCaches();
  }
}

bool vtkVoxelMeanResampler::Internals::MakeLattice(vtkPointSet* input)
{
  this->Points = std::make_unique<PointAccess>(input->GetPoints());
  this->Request.points = this->Points->view();
  Bounds cloud = this->Workspace.value_or(Bounds());
  if (this->Settings.lattice.automaticWorkspace && !this->Workspace)
  {
    this->BeginPart(0.1);
    cloud = this->BoundsOf({ this->Request.points });
    if (this->Aborted)
    {
      return false;
    }
  }
  const Status status = makeLattice(this->Settings.lattice, cloud, this->Request.lattice);
  if (status != Status::Ok)
  {
    this->Filter->Fail(latticeProblem(this->Settings.lattice, status));
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
  if (!(seen == this->Seen) || !this->Settings.usePointIndex)
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

bool vtkVoxelMeanResampler::Internals::Resample(vtkPointSet* input)
{
  const vtkPoints* points = input->GetPoints();
  this->Request.singlePrecision = this->Settings.outputPointsPrecision == PointsPrecision::OfInput
    ? !points || points->GetDataType() == VTK_FLOAT
    : this->Settings.outputPointsPrecision == PointsPrecision::Single;
  this->Request.covariances = this->Settings.computeCovariance;
  this->Request.instructions = this->Settings.instructionSet;
  for (const NamedAttribute& named : this->Attributes)
  {
    this->KeepsPoints() ? this->Request.tieBreakers.push_back(named.attribute.view())
                        : this->Request.attributes.push_back(named.attribute.request());
  }
  this->Request.allocator = &this->Pool;
  this->BeginPart(kRunEnd);
  const Status status = this->Engine.run(this->Request, this->Smp, this);
  if (status != Status::Ok)
  {
    if (status != Status::Aborted)
    {
      this->Filter->Fail(std::string(message(status)) + ".");
    }
    return false;
  }
  this->Filter->NumberOfClippedPoints += vtkIdType(this->Engine.clippedPoints());
  this->Filter->NumberOfInvalidPoints += vtkIdType(this->Engine.invalidPoints());
  this->PartialViews += 2 * this->Engine.clippedPoints() > this->Request.points.size();
  return true;
}

void vtkVoxelMeanResampler::Internals::Release()
{
  this->Attributes.clear();
  for (KnownValues& known : this->Known)
  {
    // As large as the input: worth its memory only where parts are resampled repeatedly.
    known.values.copy = this->Indexed ? known.values.copy : nullptr;
  }
  this->Pool.trim(); // memory of earlier outputs that this one did not reuse
  this->Request = VoxelRequest();
  this->Points.reset();
}

bool vtkVoxelMeanResampler::Internals::Fill(vtkPointSet* input, vtkPolyData* output)
{
  OutputFiller filler{ this->Engine, this->Transform, this->Pool, this->Smp, this->Request.singlePrecision,
    this->Request.covariances, this->Settings.minimumPointsPerVoxel, {} };
  if (this->Settings.keepOriginalPointIds && this->KeepsPoints())
  {
    filler.pointIds = this->Engine.chosenPoints();
  }
  output->GetFieldData()->PassData(input->GetFieldData());
  const auto addArrays = [&](vtkPointData* data)
  {
    const auto steps = double(this->Attributes.size() + 1);
    for (std::size_t i = 0; i < this->Attributes.size() && !this->Aborted; ++i)
    {
      this->BeginPart(kRunEnd + (kFillEnd - kRunEnd) * double(i + 1) / steps);
      filler.addReduced(data, i, this->Attributes[i].attribute, this->Attributes[i].found, this->Request);
      this->report(1.0);
    }
    return !this->Aborted;
  };
  return filler.fill(output, addArrays, this->Kept);
}

void vtkVoxelMeanResampler::Internals::FillIndex(vtkPointSet* input, vtkPolyData* output)
{
  std::vector<std::int64_t> places(this->Kept ? std::size_t(this->Engine.size()) : 0, -1);
  for (std::size_t i = 0; this->Kept && i < this->Kept->size(); ++i)
  {
    places[std::size_t((*this->Kept)[i])] = std::int64_t(i);
  }
  fillVoxelIndex(output, input, this->Engine.voxelIndex(), places, this->Pool, this->Smp);
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

void vtkVoxelMeanResampler::Internals::BeginPart(double end)
{
  this->PartBegin = this->PartEnd;
  this->PartEnd = end;
}

bool vtkVoxelMeanResampler::Internals::report(double fraction)
{
  this->Filter->UpdateProgress(this->PartBegin + (this->PartEnd - this->PartBegin) * fraction);
  pointhaptics::runSignalHandlers();
  this->Aborted = this->Filter->GetAbortExecute() != 0;
  return !this->Aborted;
}

bool vtkVoxelMeanResampler::Internals::KeepsPoints() const
{
  return keepsPoints(this->Request.representative);
}

void vtkVoxelMeanResampler::Internals::ChooseArrays(vtkPointSet* input)
{
  this->Attributes.clear();
  if (!this->Settings.passAttributes)
  {
    this->Known.clear();
    return;
  }
  const vtkMTimeType ownersTime =
    std::max(input->GetPointData()->vtkObject::GetMTime(), input->vtkObject::GetMTime());
  std::vector<KnownValues> known;
  known.swap(this->Known);
  std::vector<std::string> dropped;
  for (const VoxelArray& found : voxelArrays(input, this->Settings, dropped))
  {
    const ArraySeen seen(found.array, ownersTime);
    const auto old = std::find_if(known.begin(), known.end(),
      [&](const KnownValues& values) { return values.seen == seen && values.statistic == found.statistic; });
    VoxelAttribute attribute(found.array, found.statistic, old == known.end() ? nullptr : &old->values);
    if (this->Settings.usePointIndex)
    {
      this->KeepsPoints() ? void() : attribute.findRange(this->Smp);
      this->Known.push_back({ seen, found.statistic, attribute.values() });
    }
    this->Attributes.push_back({ std::move(attribute), found });
  }
  for (const std::string& text : dropped)
  {
    this->Filter->Warn(text);
  }
}
