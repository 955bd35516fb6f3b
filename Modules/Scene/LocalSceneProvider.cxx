#include "LocalSceneProvider.h"

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

/// Fraction of the cells in the local scene from which on it does not pay.
constexpr double kLargestFraction = 0.7;

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

LocalSceneProvider::LocalSceneProvider() = default;
LocalSceneProvider::~LocalSceneProvider() = default;

void LocalSceneProvider::setCloud(vtkSmartPointer<vtkPointSet> cloud)
{
  cloud_ = std::move(cloud);
  index_.reset();
  follower_.reset();
  finer_.setCloud(nullptr);
}

std::shared_ptr<const HapticScene> LocalSceneProvider::build(
  const SceneRequest& request, std::shared_ptr<const HapticScene> global)
{
  const Bounds hand = request.hand ? request.hand() : Bounds();
  if (hand.empty() || !global || !this->prepare(request))
  {
    return nullptr;
  }
  std::optional<LocalRegion> region =
    LocalRegion::about(hand, std::move(global), voxels_.transform, voxels_.lattice);
  if (!region || region->fraction() > kLargestFraction || !this->index())
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
  auto origin = std::make_shared<SceneOrigin>();
  origin->kind = SceneOrigin::Kind::Region;
  origin->voxels = request.voxels;
  origin->bandwidth = request.bandwidth;
  origin->useCovariance = request.useCovariance;
  origin->modelToWorkspace = voxels_.transform;
  origin->hand = hand;
  origin->globalCloud = region->globalScene()->cloudNumber();
  origin->global = region->globalScene()->origin();
  input.origin = std::move(origin);
  input.region = std::move(region);
  Status status = Status::Ok;
  return HapticScene::create(std::move(input), status, smp_);
}

std::shared_ptr<const HapticScene> LocalSceneProvider::refine(
  const SceneRequest& request, const std::shared_ptr<const HapticScene>& global)
{
  const Bounds hand = request.hand ? request.hand() : Bounds();
  if (hand.empty() || !this->follow(request, global) || !follower_->update(hand, smp_))
  {
    return nullptr;
  }
  return follower_->scene() == global ? nullptr : follower_->scene();
}

std::shared_ptr<const HapticScene> LocalSceneProvider::make(
  const SceneOrigin& origin, const std::shared_ptr<const HapticScene>& global)
{
  SceneRequest request;
  request.voxels = origin.voxels;
  if (origin.bandwidth)
  {
    static_cast<LocalBandwidthSettings&>(request.bandwidth.emplace()) = *origin.bandwidth;
  }
  request.useCovariance = origin.useCovariance;
  request.hand = [&origin] { return origin.hand; };
  const AffineTransform& model = origin.modelToWorkspace;
  if (origin.kind == SceneOrigin::Kind::Region)
  {
    for (int row = 0; row < 3; ++row)
    {
      std::copy_n(model.m[row], 4, request.modelToWorkspace.begin() + 4 * row);
    }
    return this->build(request, global);
  }
  Status status = Status::Ok;
  const bool isThere = global->modelToWorkspace() == model;
  const std::shared_ptr<const HapticScene> beside = isThere ? global : global->moved(model, status);
  return beside && this->follow(request, beside) ? finer_.build(origin.hand, beside, smp_) : nullptr;
}

/// False: there is nothing to make finer scenes of.
bool LocalSceneProvider::follow(const SceneRequest& request, const std::shared_ptr<const HapticScene>& global)
{
  if (follower_ && follower_->global() == global)
  {
    return true;
  }
  follower_.reset();
  if (!global || !this->index())
  {
    return false;
  }
  const LatticeSettings& lattice = request.voxels.lattice;
  finer_.setCloud(index_);
  finer_.setWorkspace(lattice.automaticWorkspace ? Bounds() : lattice.workspace);
  finer_.setBandwidth(request.bandwidth);
  follower_.emplace(finer_, global);
  return true;
}

bool LocalSceneProvider::index()
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
bool LocalSceneProvider::prepare(const SceneRequest& request)
{
  const VoxelMeanSettings& settings = request.voxels;
  if (!cloud_ || cloud_->GetNumberOfPoints() == 0 || settings.lattice.automaticWorkspace)
  {
    return false;
  }
  voxels_ = VoxelRequest();
  voxels_.transform = affineFromRows(request.modelToWorkspace);
  voxels_.singlePrecision = settings.outputPointsPrecision == PointsPrecision::OfInput
    ? cloud_->GetPoints()->GetDataType() == VTK_FLOAT
    : settings.outputPointsPrecision == PointsPrecision::Single;
  voxels_.covariances = settings.computeCovariance;
  voxels_.instructions = settings.instructionSet;
  return voxels_.transform.check() == Status::Ok &&
    makeLattice(settings.lattice, Bounds(), voxels_.lattice) == Status::Ok;
}

/// The voxels, as makeHapticScene() reads them from the filter's output.
HapticSceneInput LocalSceneProvider::input(const SceneRequest& request) const
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
  input.bandwidth = request.bandwidth;
  const Vec3& spacing = voxels_.lattice.spacing;
  input.cellSize = std::max({ spacing.x, spacing.y, spacing.z });
  input.corner = voxels_.lattice.origin;
  input.modelToWorkspace = voxels_.transform;
  return input;
}

} // namespace pointhaptics
