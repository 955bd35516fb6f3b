#include "vtkDistributedVoxelMeanResampler.h"

#include "MpiRanks.h"

#include "PolyDataAccess.h"
#include "ResamplerInput.h"
#include "SmpExecutor.h"
#include "VoxelArrays.h"
#include "VoxelOutput.h"

#include "Core/Distributed/SharedVoxels.h"
#include "Core/Resample/AttributeReducer.h"
#include "Core/Resample/VoxelMean.h"

#include "vtkAbstractTransform.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

using namespace pointhaptics;

vtkStandardNewMacro(vtkDistributedVoxelMeanResampler);

namespace
{

/// A point array in the voxels of this rank's points, and in those of this rank's range.
struct SharedArray
{
  VoxelArray from;
  VoxelAttribute attribute; ///< It knows the range of the values of all ranks.
  std::unique_ptr<AttributeReducer> merged;
};

/// The steps of one update. Each returns what is wrong, the same on all ranks, or nothing.
class DistributedUpdate
{
public:
  DistributedUpdate(Ranks& ranks, const VoxelMeanSettings& settings, vtkPointSet* input)
    : ranks_(ranks)
    , settings_(settings)
    , input_(input)
    , points_(input->GetPoints())
  {
  }

  std::string prepare(vtkAbstractTransform* transform);
  /// Fills the outputs of the levels from @p outputs on. @return how many it filled, 0 with a @p problem.
  int run(const vtkSmartPointer<vtkPolyData>* outputs, int levels, std::string& problem);
  const SharedVoxels& shared() const { return shared_; }
  const std::vector<std::string>& dropped() const { return dropped_; }

private:
  bool all(bool own)
  {
    return ranks_.reduce(own, [](bool a, bool b) { return a && b; });
  }
  bool agree(const std::string& text)
  {
    const std::vector<std::string> texts = ranks_.gather(text);
    return std::all_of(texts.begin(), texts.end(), [&](const std::string& t) { return t == texts.front(); });
  }
  std::string chooseArrays();
  void choosePrecision();
  std::string shareArrays(int levels);
  void fill(int level, vtkPolyData* output);

  Ranks& ranks_;
  const VoxelMeanSettings& settings_;
  vtkPointSet* input_;
  PointAccess points_;
  SmpExecutor smp_;
  ArrayPool pool_;
  ArrayAllocator allocator_{ pool_ };
  AffineTransform transform_;
  Lattice lattice_;
  bool singlePrecision_ = true;
  std::vector<SharedArray> arrays_;
  std::vector<std::string> dropped_;
  SharedVoxels shared_;
  VoxelResampler made_; ///< Of this rank's range.
};

std::string signatureOf(const std::vector<VoxelArray>& arrays)
{
  std::ostringstream text;
  for (const VoxelArray& found : arrays)
  {
    text << found.array->GetName() << " of " << found.array->GetNumberOfComponents() << " "
         << found.array->GetDataTypeAsString() << "; ";
  }
  return text.str();
}

std::string DistributedUpdate::chooseArrays()
{
  if (!settings_.passAttributes)
  {
    return {};
  }
  const std::vector<VoxelArray> found =
    voxelArrays(input_, settings_.categoricalArrays, settings_.representative, dropped_);
  const std::string signature = signatureOf(found);
  if (!this->agree(signature))
  {
    return "Ranks have different point arrays; this one has: " + signature +
      "give all ranks pieces of one cloud.";
  }
  for (const VoxelArray& array : found)
  {
    AttributeValues values =
      VoxelAttribute(array.array, array.kind, nullptr, settings_.instructionSet, smp_).values();
    values.range = commonRange(ranks_, values.range);
    arrays_.push_back(
      { array, VoxelAttribute(array.array, array.kind, &values, settings_.instructionSet, smp_), nullptr });
  }
  return {};
}

/// That of the input on ranks which have points.
void DistributedUpdate::choosePrecision()
{
  const vtkPoints* points = input_->GetPoints();
  const bool isSingle = !points || points->GetDataType() == VTK_FLOAT;
  const bool hasPoints = points_.view().size() > 0;
  const bool somePoints = !this->all(!hasPoints);
  singlePrecision_ = this->all(isSingle || (somePoints && !hasPoints));
  if (settings_.outputPointsPrecision != PointsPrecision::OfInput)
  {
    singlePrecision_ = settings_.outputPointsPrecision == PointsPrecision::Single;
  }
}

std::string DistributedUpdate::prepare(vtkAbstractTransform* transform)
{
  if (settings_.representative != pointhaptics::Representative::Mean || settings_.computeVoxelIndex ||
    settings_.keepOriginalPointIds)
  {
    return "Processes share means only; set RepresentativeToMean, ComputeVoxelIndexOff and "
           "KeepOriginalPointIdsOff, or use vtkVoxelMeanResampler.";
  }
  const std::string problem = readTransform(transform, transform_);
  if (!problem.empty())
  {
    return problem;
  }
  Bounds cloud;
  if (settings_.lattice.automaticWorkspace)
  {
    cloud = commonBounds(ranks_, transformedBounds(points_.view(), transform_, smp_));
  }
  const Status status = makeLattice(settings_.lattice, cloud, lattice_);
  if (status != Status::Ok)
  {
    return latticeProblem(settings_.lattice, status);
  }
  this->choosePrecision();
  return this->chooseArrays();
}

int DistributedUpdate::run(const vtkSmartPointer<vtkPolyData>* outputs, int levels, std::string& problem)
{
  // As in vtkVoxelMeanResampler: further levels take another pass over the points.
  const int exact = VoxelResampler::exactLevels(lattice_, levels);
  VoxelAccumulator own(lattice_, settings_.computeCovariance);
  Status status = own.add(points_.view(), transform_, smp_);
  if (!this->all(status == Status::Ok))
  {
    problem = std::string(message(status == Status::Ok ? Status::InvalidParameter : status)) + ".";
    return 0;
  }
  status = shared_.share(ranks_, own, exact);
  VoxelAccumulator::Request wanted;
  wanted.singlePrecision = singlePrecision_;
  wanted.keys = true;
  wanted.levels = exact;
  wanted.instructions = settings_.instructionSet;
  wanted.allocator = &allocator_;
  status = status == Status::Ok ? shared_.voxels().finish(wanted, made_, smp_) : status;
  if (!this->all(status == Status::Ok))
  {
    problem = std::string(message(status == Status::Ok ? Status::InvalidParameter : status)) + ".";
    return 0;
  }
  problem = this->shareArrays(exact);
  for (int level = 0; problem.empty() && level < exact; ++level)
  {
    this->fill(level, outputs[level]);
  }
  lattice_ = coarserLattice(made_.lattice(exact - 1));
  return problem.empty() ? exact : 0;
}

std::string DistributedUpdate::shareArrays(int levels)
{
  if (arrays_.empty())
  {
    return {};
  }
  const std::int64_t mostPoints = ranks_.reduce(
    made_.mostPoints(levels - 1), [](std::int64_t a, std::int64_t b) { return std::max(a, b); });
  VoxelRequest request;
  request.points = points_.view();
  request.transform = transform_;
  request.lattice = shared_.voxels().lattice();
  request.keys = true;
  request.keepPointRecords = true;
  request.instructions = settings_.instructionSet;
  std::vector<AttributeReducer> own;
  for (const SharedArray& array : arrays_)
  {
    own.emplace_back(array.attribute.request(), transform_, settings_.instructionSet, smp_);
    request.tuples.push_back(AttributeReducer::sourceOf(array.attribute.view()));
  }
  VoxelResampler engine;
  Status status = engine.run(request, smp_);
  for (AttributeReducer& reducer : own)
  {
    reducer.prepare(engine.counts(), engine.size(), mostPoints, smp_);
  }
  const auto add = [&own](const PointRows& rows, const std::int64_t* voxels, int count)
  {
    for (std::size_t i = 0; i < own.size(); ++i)
    {
      own[i].add(rows.tuples(i), rows.bytes, voxels, count);
    }
  };
  status = status == Status::Ok ? engine.visitPointsByVoxel(request, add, smp_) : status;
  if (!this->all(status == Status::Ok))
  {
    return "A rank could not average its arrays: " + std::string(message(status)) + ".";
  }
  bool fits = true;
  for (std::size_t i = 0; i < own.size(); ++i)
  {
    SharedArray& array = arrays_[i];
    array.merged = std::make_unique<AttributeReducer>(own[i].another());
    array.merged->prepare(made_.counts(), made_.size(), mostPoints, smp_);
    fits = shared_.exchange(ranks_, own[i], *array.merged) && fits;
  }
  return this->all(fits) ? std::string() : "Sums of arrays got lost between ranks; are all of one build?";
}

void DistributedUpdate::fill(int level, vtkPolyData* output)
{
  vtkPointData* data = output->GetPointData();
  output->SetPoints(makePoints(made_, level, singlePrecision_, allocator_, smp_));
  output->SetVerts(makeVertices(vtkIdType(made_.size(level)), pool_, smp_));
  const auto counts = makeCounts(made_, level, allocator_, smp_);
  for (SharedArray& array : arrays_)
  {
    if (level > 0)
    {
      array.merged->coarsen(made_.parents(level), made_.size(level));
    }
    const vtkSmartPointer<vtkDataArray> tuples = array.attribute.emptyArray();
    pool_.allocate(tuples, made_.size(level));
    array.merged->write(
      reinterpret_cast<const std::int64_t*>(counts->GetPointer(0)), tuples->GetVoidPointer(0), smp_, nullptr);
    const int index = data->AddArray(array.attribute.inOwnType(tuples));
    for (const int role : array.from.roles)
    {
      data->SetActiveAttribute(index, role);
    }
  }
  data->AddArray(counts);
  if (settings_.computeCovariance)
  {
    data->AddArray(makeCovariances(made_, level, allocator_, smp_));
  }
  keepVoxels(output, counts, settings_.minimumPointsPerVoxel, pool_, smp_);
  addLattice(made_.lattice(level), transform_, output->GetFieldData());
}

}

vtkDistributedVoxelMeanResampler::vtkDistributedVoxelMeanResampler()
  : Controller(vtkMultiProcessController::GetGlobalController())
{
}

vtkDistributedVoxelMeanResampler::~vtkDistributedVoxelMeanResampler() = default;

void vtkDistributedVoxelMeanResampler::SetController(vtkMultiProcessController* controller)
{
  if (this->Controller != controller)
  {
    this->Controller = controller;
    this->Modified();
  }
}

vtkMultiProcessController* vtkDistributedVoxelMeanResampler::GetController()
{
  return this->Controller;
}

int vtkDistributedVoxelMeanResampler::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  auto* input = vtkPointSet::GetData(inputVector[0]);
  const VoxelMeanSettings settings = this->GetSettings();
  this->NumberOfClippedPoints = 0;
  this->NumberOfInvalidPoints = 0;
  std::vector<vtkSmartPointer<vtkPolyData>> outputs;
  for (int level = 0; level < settings.numberOfLevels; ++level)
  {
    outputs.emplace_back(vtkPolyData::GetData(outputVector, level));
    outputs.back()->GetFieldData()->PassData(input->GetFieldData());
  }
  MpiRanks ranks(this->Controller);
  DistributedUpdate update(ranks, settings, input);
  std::string problem = update.prepare(this->Transform);
  for (int level = 0; problem.empty() && level < settings.numberOfLevels;)
  {
    const bool isFirst = level == 0;
    level += update.run(&outputs[std::size_t(level)], settings.numberOfLevels - level, problem);
    if (isFirst && problem.empty())
    {
      this->NumberOfClippedPoints = vtkIdType(update.shared().clippedPoints());
      this->NumberOfInvalidPoints = vtkIdType(update.shared().invalidPoints());
    }
    this->UpdateProgress(double(level) / settings.numberOfLevels);
  }
  this->NumberOfBytesSent = ranks.bytesSent();
  for (const std::string& dropped : update.dropped())
  {
    vtkWarningMacro(<< dropped);
  }
  if (!problem.empty())
  {
    vtkErrorMacro(<< problem);
    for (vtkPolyData* output : outputs)
    {
      output->Initialize();
      output->GetFieldData()->PassData(input->GetFieldData());
    }
  }
  return 1;
}

void vtkDistributedVoxelMeanResampler::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Controller: " << (this->Controller ? this->Controller->GetClassName() : "(none)") << "\n";
  os << indent << "NumberOfBytesSent: " << this->NumberOfBytesSent << "\n";
}
