#include "NearScene.h"

#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include "PolyDataAccess.h"

#include "vtkPointSet.h"
#include "vtkPoints.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace pointhaptics
{
namespace
{

/// Part of the cells near the hand from which on it does not pay.
constexpr double kMostNear = 0.7;

AffineTransform affineFromRows(const std::array<double, 16>& rows)
{
  AffineTransform transform;
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      transform.m[row][column] = rows[std::size_t(4 * row + column)];
    }
  }
  return transform;
}

template <typename Real>
std::vector<Vec3> meansOf(const VoxelResampler& engine)
{
  const std::size_t size = std::size_t(engine.size());
  std::vector<Real> coordinates(3 * size);
  engine.copyMeans(0, coordinates.data());
  std::vector<Vec3> means(size);
  for (std::size_t i = 0; i < size; ++i)
  {
    means[i] = { double(coordinates[3 * i]), double(coordinates[3 * i + 1]), double(coordinates[3 * i + 2]) };
  }
  return means;
}

} // namespace

NearSceneBuilder::NearSceneBuilder() = default;
NearSceneBuilder::~NearSceneBuilder() = default;

void NearSceneBuilder::setCloud(vtkSmartPointer<vtkPointSet> cloud)
{
  cloud_ = std::move(cloud);
  index_.reset();
  follower_.reset();
  finer_.setCloud(nullptr);
}

std::shared_ptr<const HapticScene> NearSceneBuilder::build(
  const SceneRequest& request, std::shared_ptr<const HapticScene> whole)
{
  const Bounds hand = request.hand ? request.hand() : Bounds();
  if (hand.empty() || !whole || !this->prepare(request))
  {
    return nullptr;
  }
  std::optional<LocalRegion> region =
    LocalRegion::about(hand, std::move(whole), voxels_.transform, voxels_.lattice);
  if (!region || region->fraction() > kMostNear || !this->index())
  {
    return nullptr;
  }
  voxels_.points = index_->points();
  voxels_.index = index_.get();
  voxels_.part = region->voxels();
  if (engine_.run(voxels_, smp_) != Status::Ok || engine_.size() == 0)
  {
    return nullptr;
  }
  HapticSceneInput input = this->input(request);
  input.region = std::move(region);
  Status status = Status::Ok;
  return HapticScene::create(std::move(input), status, smp_);
}

std::shared_ptr<const HapticScene> NearSceneBuilder::refine(
  const SceneRequest& request, const std::shared_ptr<const HapticScene>& whole)
{
  const Bounds hand = request.hand ? request.hand() : Bounds();
  if (hand.empty() || !this->follow(request, whole) || !follower_->update(hand, smp_))
  {
    return nullptr;
  }
  return follower_->scene() == whole ? nullptr : follower_->scene();
}

/// False: there is nothing to make finer scenes of.
bool NearSceneBuilder::follow(const SceneRequest& request, const std::shared_ptr<const HapticScene>& whole)
{
  if (follower_ && follower_->global() == whole)
  {
    return true;
  }
  follower_.reset();
  if (!whole || !this->index())
  {
    return false;
  }
  for (const SceneRequest::Setting& setting : request.settings)
  {
    setting(resampler_, bandwidth_);
  }
  Bounds workspace;
  if (!resampler_->GetAutomaticWorkspace())
  {
    const double* bounds = resampler_->GetWorkspaceBounds();
    workspace.include({ bounds[0], bounds[2], bounds[4] });
    workspace.include({ bounds[1], bounds[3], bounds[5] });
  }
  finer_.setCloud(index_);
  finer_.setWorkspace(workspace);
  finer_.setBandwidth(
    request.hasBandwidth ? std::optional<LocalBandwidthSettings>(bandwidth_->GetSettings()) : std::nullopt);
  follower_.emplace(finer_, whole);
  return true;
}

bool NearSceneBuilder::index()
{
  if (!index_ && cloud_ && cloud_->GetNumberOfPoints() > 0)
  {
    const PointAccess access(cloud_->GetPoints());
    const auto made = std::make_shared<PointIndex>();
    index_ = made->build(access.view(), smp_) == Status::Ok ? made : nullptr;
  }
  return index_ != nullptr;
}

/// What to resample, points and part aside. False: there is nothing, or the lattice hangs on the whole cloud.
bool NearSceneBuilder::prepare(const SceneRequest& request)
{
  for (const SceneRequest::Setting& setting : request.settings)
  {
    setting(resampler_, bandwidth_);
  }
  if (!cloud_ || cloud_->GetNumberOfPoints() == 0 || resampler_->GetAutomaticWorkspace())
  {
    return false;
  }
  LatticeSettings settings;
  settings.voxelSize = resampler_->GetVoxelSize();
  settings.automaticWorkspace = false;
  for (int axis = 0; axis < 3; ++axis)
  {
    settings.dimensions[std::size_t(axis)] = resampler_->GetDimensions()[axis];
    settings.workspace.minimum[axis] = resampler_->GetWorkspaceBounds()[2 * axis];
    settings.workspace.maximum[axis] = resampler_->GetWorkspaceBounds()[2 * axis + 1];
  }
  const int precision = resampler_->GetOutputPointsPrecision();
  voxels_ = VoxelRequest();
  voxels_.transform = affineFromRows(request.modelToWorkspace);
  voxels_.singlePrecision = precision == vtkAlgorithm::DEFAULT_PRECISION
    ? cloud_->GetPoints()->GetDataType() == VTK_FLOAT
    : precision == vtkAlgorithm::SINGLE_PRECISION;
  voxels_.covariances = resampler_->GetComputeCovariance();
  voxels_.instructions = InstructionSet(resampler_->GetInstructionSet());
  return voxels_.transform.check() == Status::Ok &&
    makeLattice(settings, Bounds(), voxels_.lattice) == Status::Ok;
}

/// The voxels, as makeHapticScene() reads them from the filter's output.
HapticSceneInput NearSceneBuilder::input(const SceneRequest& request) const
{
  const std::size_t size = std::size_t(engine_.size());
  HapticSceneInput input;
  input.points = voxels_.singlePrecision ? meansOf<float>(engine_) : meansOf<double>(engine_);
  std::vector<std::int64_t> counts(size);
  engine_.copyCounts(0, counts.data());
  input.counts.assign(counts.begin(), counts.end());
  if (request.useCovariance && voxels_.covariances)
  {
    input.covariances.resize(size);
    engine_.copyCovariances(0, input.covariances.data());
  }
  if (request.hasBandwidth)
  {
    input.bandwidth = bandwidth_->GetSettings();
  }
  const Vec3& spacing = voxels_.lattice.spacing;
  input.cellSize = std::max({ spacing.x, spacing.y, spacing.z });
  input.corner = voxels_.lattice.origin;
  input.modelToWorkspace = voxels_.transform;
  return input;
}

} // namespace pointhaptics
