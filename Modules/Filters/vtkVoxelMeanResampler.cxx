#include "vtkVoxelMeanResampler.h"

#include "FieldPoses.h"
#include "PolyDataAccess.h"
#include "SettingText.h"
#include "SmpExecutor.h"
#include "VoxelAttribute.h"
#include "VoxelOutput.h"

#include "Core/Base/FieldNames.h"
#include "Core/Base/Host/InterpreterLock.h"
#include "Core/Base/Host/OutOfMemory.h"
#include "Core/Distributed/FarPoints.h"
#include "Core/Distributed/Ranks.h"
#include "Core/Neighbors/PointIndex.h"
#include "Core/Resample/TransformedBounds.h"
#include "Core/Resample/VoxelResampler.h"

#include "vtkAbstractTransform.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <deque>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>

using namespace pointhaptics;

vtkStandardNewMacro(vtkVoxelMeanResampler);

static_assert(int(vtkAlgorithm::SINGLE_PRECISION) == int(PointsPrecision::Single) &&
    int(vtkAlgorithm::DOUBLE_PRECISION) == int(PointsPrecision::Double) &&
    int(vtkAlgorithm::DEFAULT_PRECISION) == int(PointsPrecision::OfInput),
  "Core's precisions are VTK's, in the same order");
static_assert(int(vtkVoxelMeanResampler::InstructionSetAVX2) == int(InstructionSet::Avx2),
  "the filter's instruction sets are Core's, in the same order");

namespace
{

/// The part of an update's progress after which the means are known.
constexpr double kRunEnd = 0.9;
/// The part of an update's progress after which the outputs are filled.
constexpr double kFillEnd = 0.99;

/// What tells the points of an input from others, for as long as whoever writes to them calls Modified():
/// array, its memory, size and time. The time is that of the data set itself, without that of its arrays:
/// some write coordinates and mark nothing else.
using PointsSeen = std::tuple<const void*, const void*, vtkIdType, vtkMTimeType>;

PointsSeen seenPoints(vtkPointSet* input)
{
  vtkPoints* points = input->GetPoints();
  vtkDataArray* array = points ? points->GetData() : nullptr;
  return array ? PointsSeen(array, array->HasStandardMemoryLayout() ? array->GetVoidPointer(0) : nullptr,
                   array->GetNumberOfTuples(),
                   std::max({ array->GetMTime(), points->GetMTime(), input->vtkObject::GetMTime() }))
               : PointsSeen();
}

}

/// One update's steps, and what is kept from one to the next. Steps are false after an error was reported, or
/// the execution aborted.
class vtkVoxelMeanResampler::Internals : public ProgressObserver
{
public:
  explicit Internals(vtkVoxelMeanResampler* filter)
    : Filter(filter)
  {
  }

  bool Begin(const Clouds& clouds);
  bool Update(vtkPointSet* input, vtkPolyData* means, vtkPolyData* index);
  /// Lets go of the input and its arrays.
  void Release();

  /// Maps the fraction to the current part of the update and passes it to the filter.
  bool report(double fraction) override
  {
    this->Filter->UpdateProgress(this->PartBegin + (this->PartEnd - this->PartBegin) * fraction);
    runSignalHandlers();
    this->Aborted = this->Filter->GetAbortExecute() != 0;
    return !this->Aborted;
  }

  vtkIdType NumberOfPoints = 0; ///< Number of points of all clouds.

private:
  /// Starts a part of the update of a cloud, from the end of the previous part to @p end.
  void BeginPart(double end)
  {
    this->PartBegin = this->PartEnd;
    this->PartEnd = end;
  }
  void WarnOfNames(const Clouds& clouds);
  Bounds BoundsOf(const Clouds& clouds);
  bool UseIndex(vtkPointSet* input);
  void MakeRequest(vtkPointSet* input);
  bool Resample();
  bool Fill(vtkPointSet* input, vtkPolyData* means, vtkPolyData* index);

  vtkVoxelMeanResampler* Filter;
  VoxelMeanSettings Settings; ///< Settings of this run: observers of progress may set others.
  AffineTransform Transform;  ///< Transform of this run.
  Lattice LatticeOfRun;       ///< Lattice of all clouds.
  double UpdatesBegin = 0.0;  ///< The part of a cloud's progress before its update.
  SmpExecutor Smp;
  VoxelResampler Engine;
  VoxelRequest Request;
  std::unique_ptr<PointAccess> Points;
  std::vector<VoxelAttribute> Attributes;
  OutputMemory Memory;
  bool Aborted = false;
  double PartBegin = 0.0;
  double PartEnd = 0.0;
  // Which input was seen last, and how often a part of it.
  PointsSeen Seen;
  int PartialViews = 0;
  std::optional<PointIndex> Index;
};

bool vtkVoxelMeanResampler::Internals::Begin(const Clouds& clouds)
{
  this->Aborted = false;
  this->Settings = this->Filter->Settings;
  this->Smp = SmpExecutor(unsigned(this->Filter->NumberOfThreads));
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
  if (this->NumberOfPoints > 0 && this->Settings.passAttributes)
  {
    this->WarnOfNames(clouds);
  }
  const LatticeSettings& lattice = this->Settings.lattice;
  this->PartEnd = 0.0;
  this->UpdatesBegin = lattice.automaticWorkspace && clouds.size() == 1 ? 0.1 : 0.0;
  this->BeginPart(this->UpdatesBegin);
  const Bounds box = lattice.automaticWorkspace ? this->BoundsOf(clouds) : Bounds();
  if (this->Aborted)
  {
    return false;
  }
  const Status status = makeLattice(lattice, box, this->LatticeOfRun);
  if (status != Status::Ok)
  {
    this->Filter->Fail(latticeProblem(lattice, status));
  }
  return status == Status::Ok;
}

/// Warns of categories that no cloud has.
void vtkVoxelMeanResampler::Internals::WarnOfNames(const Clouds& clouds)
{
  std::set<std::string> unknown = this->Settings.categoricalArrays;
  for (const std::string& usual : VoxelMeanSettings().categoricalArrays)
  {
    unknown.erase(usual);
  }
  for (vtkPointSet* cloud : clouds)
  {
    vtkPointData* data = cloud->GetPointData();
    for (int i = 0; i < data->GetNumberOfArrays(); ++i)
    {
      for (auto name = unknown.begin(); data->GetArrayName(i) && name != unknown.end();)
      {
        name = isSameField(*name, data->GetArrayName(i)) ? unknown.erase(name) : std::next(name);
      }
    }
  }
  for (const std::string& name : unknown)
  {
    this->Filter->Warn("CategoricalArrays: the input has no point array \"" + name + "\".");
  }
}

/// The box that an automatic lattice of the points is about.
Bounds vtkVoxelMeanResampler::Internals::BoundsOf(const Clouds& clouds)
{
  Bounds all;
  std::deque<PointAccess> points;
  std::vector<PointView> parts;
  for (vtkPointSet* cloud : clouds)
  {
    parts.push_back(points.emplace_back(cloud->GetPoints()).view());
    const Bounds own = transformedBounds(parts.back(), this->Transform, this->Smp, this);
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

bool vtkVoxelMeanResampler::Internals::Update(vtkPointSet* input, vtkPolyData* means, vtkPolyData* index)
{
  this->PartEnd = this->UpdatesBegin;
  means->GetFieldData()->PassData(input->GetFieldData());
  this->Points = std::make_unique<PointAccess>(input->GetPoints());
  this->Request.points = this->Points->view();
  this->Request.lattice = this->LatticeOfRun;
  if (!this->UseIndex(input))
  {
    return false;
  }
  this->Filter->Warn(movePoses(this->Transform, means->GetFieldData()));
  this->MakeRequest(input);
  if (!this->Resample() || !this->Fill(input, means, index))
  {
    return false;
  }
  this->Release();
  return true;
}

/// An index pays off where parts of the same points are resampled repeatedly.
bool vtkVoxelMeanResampler::Internals::UseIndex(vtkPointSet* input)
{
  const PointsSeen seen = seenPoints(input);
  if (seen != this->Seen || !this->Settings.usePointIndex)
  {
    this->Index.reset();
    this->PartialViews = 0;
    this->Seen = seen;
  }
  if (!this->Index && this->PartialViews > 0)
  {
    this->BeginPart(0.3);
    PointIndex index;
    const Status status = index.build(this->Request.points, this->Smp, this);
    if (this->Aborted)
    {
      return false;
    }
    if (status == Status::Ok)
    {
      this->Index = std::move(index);
    }
    this->PartialViews = 0;
  }
  this->Request.index = this->Index ? &*this->Index : nullptr;
  return true;
}

void vtkVoxelMeanResampler::Internals::MakeRequest(vtkPointSet* input)
{
  VoxelRequest& request = this->Request;
  const vtkPoints* points = input->GetPoints();
  request.singlePrecision = this->Settings.outputPointsPrecision == PointsPrecision::OfInput
    ? !points || points->GetDataType() == VTK_FLOAT
    : this->Settings.outputPointsPrecision == PointsPrecision::Single;
  request.transform = this->Transform;
  request.covariances = this->Settings.computeCovariance;
  request.representative = this->Settings.representative;
  request.voxelIndex = this->Settings.computeVoxelIndex;
  request.instructions = this->Settings.instructionSet;
  request.allocator = &this->Memory;
  if (this->Settings.keepOriginalPointIds && !keepsPoints(request.representative))
  {
    this->Filter->Warn("KeepOriginalPointIds: a mean or median is no point of the input; choose "
                       "Representative NearestToMean or NearestToCenter.");
  }
  std::vector<std::string> dropped;
  if (this->Settings.passAttributes)
  {
    this->Attributes = voxelArrays(input, this->Settings, dropped);
  }
  for (VoxelAttribute& attribute : this->Attributes)
  {
    attribute.addTo(request);
  }
  for (const std::string& text : dropped)
  {
    this->Filter->Warn(text);
  }
}

bool vtkVoxelMeanResampler::Internals::Resample()
{
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

bool vtkVoxelMeanResampler::Internals::Fill(vtkPointSet* input, vtkPolyData* means, vtkPolyData* index)
{
  const bool hasIds = this->Settings.keepOriginalPointIds && keepsPoints(this->Request.representative);
  const OutputFiller filler{ this->Engine, this->Request, this->Memory, this->Smp,
    this->Settings.minimumPointsPerVoxel, hasIds ? &this->Engine.chosenPoints() : nullptr };
  std::optional<std::vector<std::int64_t>> kept;
  this->BeginPart(kFillEnd);
  if (!filler.fill(means, this->Attributes, this, kept))
  {
    return false;
  }
  if (this->Settings.computeVoxelIndex)
  {
    std::vector<std::int64_t> places(kept ? std::size_t(this->Engine.size()) : 0, -1);
    for (std::size_t i = 0; kept && i < kept->size(); ++i)
    {
      places[std::size_t((*kept)[i])] = std::int64_t(i);
    }
    fillVoxelIndex(index, input, this->Engine.voxelIndex(), places, this->Smp);
  }
  return true;
}

void vtkVoxelMeanResampler::Internals::Release()
{
  this->Attributes.clear();
  this->Memory = OutputMemory();
  this->Request = VoxelRequest();
  this->Points.reset();
}

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
  if (succeeded)
  {
    this->WarnOfNothing(this->Impl->NumberOfPoints);
  }
  else
  {
    this->NumberOfClippedPoints = 0;
    this->NumberOfInvalidPoints = 0;
  }
  this->Impl->Release();
  if (this->GetErrorCode() == pointhaptics::kOutOfMemoryCode)
  {
    this->Impl.reset(); // first: memory is short
    this->Impl = std::make_unique<Internals>(this);
  }
}

void vtkVoxelMeanResampler::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Transform: " << (this->Transform ? this->Transform->GetClassName() : "(none)") << "\n";
  keyed::printSettings(os, indent, this->Settings);
  os << indent << "NumberOfClippedPoints: " << this->NumberOfClippedPoints << "\n";
  os << indent << "NumberOfInvalidPoints: " << this->NumberOfInvalidPoints << "\n";
}
