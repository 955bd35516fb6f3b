#include "vtkDistributedVoxelMeanResampler.h"

#include "MpiRanks.h"
#include "PieceOfCloud.h"

#include "FieldPoses.h"
#include "PolyDataAccess.h"
#include "SmpExecutor.h"
#include "VoxelAttribute.h"
#include "VoxelOutput.h"

#include "Core/Distributed/FarPoints.h"
#include "Core/Distributed/SharedVoxels.h"
#include "Core/Resample/TransformedBounds.h"
#include "Core/Resample/VoxelMeanSettings.h"
#include "Core/Resample/VoxelResampler.h"

#include "vtkAbstractTransform.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

using namespace pointhaptics;

namespace
{

std::vector<std::uint64_t> keysOf(const VoxelResampler& voxels)
{
  return { voxels.keys(), voxels.keys() + voxels.size() };
}

/// Where all ranks share a status that is not Ok.
std::string problemOf(Status status)
{
  return std::string(message(status == Status::Ok ? Status::InvalidParameter : status)) + ".";
}

std::string signatureOf(const std::vector<VoxelAttribute>& arrays)
{
  std::ostringstream text;
  for (const VoxelAttribute& found : arrays)
  {
    text << (found.array->GetName() ? found.array->GetName() : "") << " of "
         << found.array->GetNumberOfComponents() << " " << found.array->GetDataTypeAsString() << "; ";
  }
  return text.str();
}

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

  /// @p field: of the output, that of the input so far.
  std::string prepare(vtkAbstractTransform* transform, vtkFieldData* field)
  {
    if (settings_.keepOriginalPointIds && !keepsPoints(settings_.representative))
    {
      return "A mean or median is no point of the input and has no id; choose Representative "
             "NearestToMean or NearestToCenter.";
    }
    const std::string problem = readTransform(transform, transform_);
    if (!problem.empty())
    {
      return problem;
    }
    Bounds cloud;
    if (settings_.lattice.automaticWorkspace)
    {
      std::string note;
      cloud = boundsForLattice(settings_.lattice, { points_.view() },
        transformedBounds(points_.view(), transform_, smp_), ranks_, transform_, note);
      if (!note.empty())
      {
        dropped_.push_back(note);
      }
    }
    const Status status = makeLattice(settings_.lattice, cloud, lattice_);
    if (status != Status::Ok)
    {
      return latticeProblem(settings_.lattice, status);
    }
    this->choosePrecision();
    const std::string lost = movePoses(transform_, field);
    const std::string wrong = this->chooseArrays();
    if (!lost.empty())
    {
      dropped_.push_back(lost);
    }
    return wrong;
  }

  std::string run(vtkPolyData* output)
  {
    return settings_.representative == Representative::Mean ? this->runOfSums(output)
                                                            : this->runOfPoints(output);
  }

  /// Fills the output with the index of this rank's points in the @p voxels that run() has just
  /// given to this rank's output, and those of the others.
  std::string fillIndex(vtkPolyData* output, vtkIdType voxels)
  {
    VoxelResampler own;
    const std::string problem = this->findOwnVoxels(made_.lattice(), own);
    if (!problem.empty())
    {
      return problem;
    }
    const std::int64_t first = ranks_.sumBefore(voxels);
    std::vector<std::int64_t> rows(std::size_t(made_.size()), -1);
    for (std::size_t i = 0; i < std::size_t(voxels); ++i)
    {
      rows[kept_ ? std::size_t((*kept_)[i]) : i] = first + std::int64_t(i);
    }
    const std::vector<std::int64_t> ofOwn = numbersOfKeys(ranks_, ranges_, keysOf(own), keysOf(made_), rows);
    fillVoxelIndex(output, input_, own.voxelIndex(), ofOwn, smp_);
    return {};
  }

  std::int64_t clippedPoints() const { return clipped_; }
  std::int64_t invalidPoints() const { return invalid_; }
  const std::vector<std::string>& dropped() const { return dropped_; }

private:
  std::string chooseArrays()
  {
    if (!settings_.passAttributes)
    {
      return {};
    }
    found_ = voxelArrays(input_, settings_, dropped_);
    const std::string own = signatureOf(found_);
    const std::vector<std::string> all = ranks_.gather(own);
    const bool areSame =
      std::all_of(all.begin(), all.end(), [&](const std::string& each) { return each == all.front(); });
    return areSame
      ? std::string()
      : "Ranks have different point arrays; this one has: " + own + "give all ranks pieces of one cloud.";
  }

  /// Takes the precision of the input on ranks which have points.
  void choosePrecision()
  {
    const vtkPoints* points = input_->GetPoints();
    const bool isSingle = !points || points->GetDataType() == VTK_FLOAT;
    const bool hasPoints = points_.view().size() > 0;
    const bool somePoints = !ranks_.all(!hasPoints);
    singlePrecision_ = ranks_.all(isSingle || (somePoints && !hasPoints));
    if (settings_.outputPointsPrecision != PointsPrecision::OfInput)
    {
      singlePrecision_ = settings_.outputPointsPrecision == PointsPrecision::Single;
    }
  }

  /// The voxels of @p points, with keys.
  VoxelRequest requestOf(const PointView& points, const Lattice& lattice)
  {
    VoxelRequest request;
    request.points = points;
    request.transform = transform_;
    request.lattice = lattice;
    request.singlePrecision = singlePrecision_;
    request.keys = true;
    request.instructions = settings_.instructionSet;
    return request;
  }

  /// The voxels of this rank's points, with keys and the voxel of each point.
  std::string findOwnVoxels(const Lattice& lattice, VoxelResampler& own)
  {
    VoxelRequest request = this->requestOf(points_.view(), lattice);
    request.voxelIndex = true;
    const Status status = own.run(request, smp_);
    return ranks_.all(status == Status::Ok) ? std::string() : problemOf(status);
  }

  // Means: sums are shared.
  std::string runOfSums(vtkPolyData* output)
  {
    std::vector<VoxelAccumulator::Array> kinds;
    std::vector<AttributeView> views;
    for (VoxelAttribute& found : found_)
    {
      const AttributeRequest request = found.request();
      kinds.push_back({ request.view.type, request.view.components, request.statistic });
      views.push_back(request.view);
    }
    VoxelAccumulator own(lattice_, settings_.computeCovariance, kinds, transform_);
    Status status = own.add(points_.view(), views, smp_);
    if (!ranks_.all(status == Status::Ok))
    {
      return problemOf(status);
    }
    ranges_ = shareKeys(ranks_, own.keys());
    status = shareVoxels(ranks_, ranges_, own);
    VoxelRequest wanted = this->requestOf({}, lattice_);
    wanted.covariances = settings_.computeCovariance;
    wanted.allocator = &memory_;
    status = status == Status::Ok ? own.finish(wanted, made_, smp_) : status;
    if (!ranks_.all(status == Status::Ok))
    {
      return problemOf(status);
    }
    clipped_ = ranks_.sum(own.clippedPoints());
    invalid_ = ranks_.sum(own.invalidPoints());
    this->fill(output, wanted);
    return {};
  }

  // Others: points go to the rank that has their voxel.
  std::string runOfPoints(vtkPolyData* output)
  {
    VoxelResampler own;
    const std::string problem = this->findOwnVoxels(lattice_, own);
    if (!problem.empty())
    {
      return problem;
    }
    clipped_ = ranks_.sum(own.clippedPoints());
    invalid_ = ranks_.sum(own.invalidPoints());
    const vtkSmartPointer<vtkPolyData> points = this->sharePoints(own);
    if (auto* numbers = vtkIdTypeArray::SafeDownCast(points->GetPointData()->GetArray(kOriginalPointIds)))
    {
      numbers_.assign(numbers->GetPointer(0), numbers->GetPointer(0) + numbers->GetNumberOfValues());
    }
    const PointAccess access(points->GetPoints());
    VoxelRequest request = this->requestOf(access.view(), lattice_);
    request.covariances = settings_.computeCovariance;
    request.representative = settings_.representative;
    request.allocator = &memory_;
    for (std::size_t i = 0; i < found_.size(); ++i)
    {
      found_[i].array = points->GetPointData()->GetArray(int(i));
      found_[i].addTo(request);
    }
    const Status status = made_.run(request, smp_);
    if (!ranks_.all(status == Status::Ok))
    {
      return problemOf(status);
    }
    this->fill(output, request);
    return {};
  }

  vtkSmartPointer<vtkPolyData> sharePoints(const VoxelResampler& own)
  {
    const std::vector<std::uint64_t> keys = keysOf(own);
    ranges_ = shareKeys(ranks_, keys);
    std::vector<int> owners;
    for (const std::uint64_t key : keys)
    {
      owners.push_back(int(std::upper_bound(ranges_.begin(), ranges_.end() - 1, key) - ranges_.begin()) - 1);
    }
    std::vector<int> to;
    for (const std::int64_t voxel : own.voxelIndex())
    {
      to.push_back(voxel < 0 ? -1 : owners[std::size_t(voxel)]);
    }
    // The type must be equal on all ranks, also where some have no points.
    const bool isFloat = !input_->GetPoints() || input_->GetPoints()->GetDataType() == VTK_FLOAT;
    const bool areFloat = ranks_.all(isFloat || to.empty());
    vtkNew<vtkPoints> places;
    places->SetDataType(areFloat ? VTK_FLOAT : VTK_DOUBLE);
    if (input_->GetPoints())
    {
      places->DeepCopy(input_->GetPoints());
    }
    vtkNew<vtkPolyData> piece;
    piece->SetPoints(places);
    for (const VoxelAttribute& found : found_)
    {
      piece->GetPointData()->AddArray(found.array);
    }
    if (settings_.keepOriginalPointIds)
    {
      vtkNew<vtkIdTypeArray> numbers;
      numbers->SetName(kOriginalPointIds);
      const auto size = vtkIdType(to.size());
      vtkIdType* const first = numbers->WritePointer(0, size);
      std::iota(first, first + size, vtkIdType(ranks_.sumBefore(size)));
      piece->GetPointData()->AddArray(numbers);
    }
    return exchangePoints(ranks_, piece, to);
  }

  /// With found_: what points have beside places, counts and covariances.
  void fill(vtkPolyData* output, const VoxelRequest& request)
  {
    std::vector<std::int64_t> ids;
    if (settings_.keepOriginalPointIds)
    {
      ids = made_.chosenPoints();
    }
    for (std::int64_t& id : ids)
    {
      id = numbers_[std::size_t(id)];
    }
    const OutputFiller filler{ made_, request, memory_, smp_, settings_.minimumPointsPerVoxel,
      settings_.keepOriginalPointIds ? &ids : nullptr };
    static_cast<void>(filler.fill(output, found_, nullptr, kept_));
  }

  Ranks& ranks_;
  const VoxelMeanSettings& settings_;
  vtkPointSet* input_;
  PointAccess points_;
  SmpExecutor smp_;
  OutputMemory memory_;
  AffineTransform transform_;
  Lattice lattice_;
  bool singlePrecision_ = true;
  std::vector<VoxelAttribute> found_;
  std::vector<std::string> dropped_;
  std::int64_t clipped_ = 0; ///< Number of points outside the workspace, on all ranks.
  std::int64_t invalid_ = 0;
  std::vector<std::uint64_t> ranges_;             ///< Ranges of keys of all ranks.
  std::vector<std::int64_t> numbers_;             ///< Numbers among the points of all ranks, of those that
                                                  ///< came to this one; for KeepOriginalPointIds.
  VoxelResampler made_;                           ///< Result for this rank's range.
  std::optional<std::vector<std::int64_t>> kept_; ///< Voxels of this rank that stay, where some may be left
                                                  ///< out.
};

} // namespace

vtkStandardNewMacro(vtkDistributedVoxelMeanResampler);

vtkDistributedVoxelMeanResampler::vtkDistributedVoxelMeanResampler()
  : Controller(vtkMultiProcessController::GetGlobalController())
{
}

vtkDistributedVoxelMeanResampler::~vtkDistributedVoxelMeanResampler() = default;

std::string vtkDistributedVoxelMeanResampler::ProblemOf(vtkDataObject* input)
{
  return problemOnRanks(this->Controller, input);
}

bool vtkDistributedVoxelMeanResampler::SaysAgain() const
{
  return this->RepeatsErrors && MpiRanks(this->Controller).size() == 1;
}

bool vtkDistributedVoxelMeanResampler::BeginRun(const Clouds& clouds)
{
  // Else each step is that of all ranks.
  return MpiRanks(this->Controller).size() > 1 || this->Superclass::BeginRun(clouds);
}

bool vtkDistributedVoxelMeanResampler::RunCloud(vtkPointSet* cloud, const Outputs& outputs)
{
  MpiRanks ranks(this->Controller);
  this->NumberOfBytesSent = 0;
  if (ranks.size() == 1)
  {
    return this->Superclass::RunCloud(cloud, outputs);
  }
  const vtkSmartPointer<vtkPointSet> input = withArraysOfOthers(ranks, cloud);
  const VoxelMeanSettings settings = this->GetSettings();
  outputs[0]->GetFieldData()->PassData(input->GetFieldData());
  DistributedUpdate update(ranks, settings, input);
  std::string problem = update.prepare(this->Transform, outputs[0]->GetFieldData());
  problem = problem.empty() ? update.run(outputs[0]) : problem;
  if (problem.empty() && settings.computeVoxelIndex)
  {
    problem = update.fillIndex(outputs[1], outputs[0]->GetNumberOfPoints());
  }
  this->NumberOfBytesSent = ranks.bytesSent();
  this->NumberOfClippedPoints = vtkIdType(update.clippedPoints());
  this->NumberOfInvalidPoints = vtkIdType(update.invalidPoints());
  this->WarnOfNothing(vtkIdType(ranks.sum(cloud->GetNumberOfPoints())));
  for (const std::string& dropped : update.dropped())
  {
    this->Warn(dropped);
  }
  if (!problem.empty())
  {
    this->Fail(problem);
  }
  return problem.empty();
}

void vtkDistributedVoxelMeanResampler::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Controller: " << (this->Controller ? this->Controller->GetClassName() : "(none)") << "\n";
  os << indent << "NumberOfBytesSent: " << this->NumberOfBytesSent << "\n";
}
