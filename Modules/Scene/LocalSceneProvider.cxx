#include "LocalSceneProvider.h"

#include "PolyDataAccess.h"

#include "Core/Base/Boxes.h"

#include "vtkPointSet.h"
#include "vtkPoints.h"

#include <algorithm>
#include <mutex>
#include <utility>
#include <vector>

namespace pointhaptics
{
namespace
{

/// A local scene with more than this fraction of the cells does not pay.
constexpr double kLargestFraction = 0.7;
constexpr std::int64_t kPointsAPiece = 1 << 15;

/// The points of @p points in @p box, x y z together, in any order: sums of voxels are exact.
template <typename Real>
std::vector<Real> pointsWithin(
  const Real* first, const PointView& points, const Bounds& box, const Executor& executor)
{
  std::vector<Real> found;
  std::mutex mutex;
  forRange(executor, points.size(), kPointsAPiece,
    [&](std::int64_t begin, std::int64_t end)
    {
      std::vector<Real> own;
      for (const Real* p = first + points.stride() * begin; begin < end; ++begin, p += points.stride())
      {
        // One branch that is rarely taken: six would be mispredicted.
        if ((p[0] >= box.minimum.x) & (p[0] <= box.maximum.x) & (p[1] >= box.minimum.y) &
          (p[1] <= box.maximum.y) & (p[2] >= box.minimum.z) & (p[2] <= box.maximum.z))
        {
          own.insert(own.end(), p, p + 3);
        }
      }
      const std::lock_guard<std::mutex> lock(mutex);
      found.insert(found.end(), own.begin(), own.end());
    });
  return found;
}

/// Smallest box of the model's frame that covers @p box after @p transform.
Bounds boxOfModel(const AffineTransform& transform, const Bounds& box)
{
  const AffineTransform back = transform.inverse();
  return boxOfCorners(box, [&](const Vec3& p) { return back.apply(p); });
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
  if (hand.empty() || !this->prepare(request))
  {
    return nullptr;
  }
  std::optional<LocalRegion> region = global
    ? LocalRegion::about(hand, std::move(global), voxels_.transform, voxels_.lattice)
    : LocalRegion::alone(hand, voxels_.lattice);
  if (!region || !this->resample(*region))
  {
    return nullptr;
  }
  HapticSceneInput input;
  takeVoxels(engine_, voxels_, input);
  input.bandwidth = request.bandwidth;
  auto origin = std::make_shared<SceneOrigin>();
  origin->kind = SceneOrigin::Kind::Region;
  origin->voxels = request.voxels;
  origin->bandwidth = request.bandwidth;
  origin->useCovariance = request.useCovariance;
  origin->modelToWorkspace = voxels_.transform;
  origin->hand = hand;
  if (region->globalScene())
  {
    origin->globalCloud = region->globalScene()->cloudNumber();
    origin->global = region->globalScene()->origin();
  }
  input.origin = std::move(origin);
  input.region = std::move(region);
  Status status = Status::Ok;
  return HapticScene::create(std::move(input), status, smp_);
}

/// Resamples the voxels of @p region. False: there are none, or most of the cloud is in it.
bool LocalSceneProvider::resample(const LocalRegion& region)
{
  std::vector<float> floats;
  std::vector<double> doubles;
  if (!region.globalScene())
  {
    // To look at each point costs less than an index, which is not needed yet.
    const PointAccess access(cloud_->GetPoints());
    const PointView& all = access.view();
    const Bounds box = boxOfModel(voxels_.transform, region.voxels().bounds());
    if (all.floats())
    {
      floats = pointsWithin(all.floats(), all, box, smp_);
      voxels_.points = PointView(floats.data(), std::int64_t(floats.size() / 3));
    }
    else
    {
      doubles = pointsWithin(all.doubles(), all, box, smp_);
      voxels_.points = PointView(doubles.data(), std::int64_t(doubles.size() / 3));
    }
  }
  else if (region.fraction() <= kLargestFraction && this->index())
  {
    voxels_.points = index_->points();
    voxels_.index = index_.get();
    voxels_.part = region.voxels();
  }
  else
  {
    return false;
  }
  const bool isMade = engine_.run(voxels_, smp_) == Status::Ok && engine_.size() > 0;
  voxels_.points = PointView();
  return isMade;
}

std::shared_ptr<const HapticScene> LocalSceneProvider::refine(
  const SceneRequest& request, const std::shared_ptr<const HapticScene>& global)
{
  const Bounds hand = request.hand ? request.hand() : Bounds();
  const auto now = std::chrono::steady_clock::now();
  const std::chrono::duration<double> seconds = now - std::exchange(lastLook_, now);
  const bool mayServe = isIndexed() || (global && finer_.isUseful(hand, *global));
  if (hand.empty() || !mayServe || !this->follow(request, global) ||
    !follower_->update(hand, seconds.count(), smp_))
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
    std::copy_n(model.m[0], 12, request.modelToWorkspace.begin());
    return this->build(request, global);
  }
  Status status = Status::Ok;
  const bool isThere = global->modelToWorkspace() == model;
  const std::shared_ptr<const HapticScene> beside = isThere ? global : global->moved(model, status);
  return beside && this->follow(request, beside) ? finer_.build(origin.hand, beside, smp_) : nullptr;
}

/// Prepares finer scenes. False: the scene or the cloud cannot have any.
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

/// Prepares lattice and transform of the resampling. False: there is no cloud, or the lattice depends on the
/// whole cloud.
bool LocalSceneProvider::prepare(const SceneRequest& request)
{
  const VoxelMeanSettings& settings = request.voxels;
  if (!cloud_ || cloud_->GetNumberOfPoints() == 0 || settings.lattice.automaticWorkspace)
  {
    return false;
  }
  voxels_ = VoxelRequest();
  voxels_.transform = AffineTransform::fromRows(request.modelToWorkspace.data());
  voxels_.singlePrecision = settings.outputPointsPrecision == PointsPrecision::OfInput
    ? cloud_->GetPoints()->GetDataType() == VTK_FLOAT
    : settings.outputPointsPrecision == PointsPrecision::Single;
  voxels_.covariances = settings.computeCovariance && request.useCovariance;
  voxels_.instructions = settings.instructionSet;
  return voxels_.transform.check() == Status::Ok &&
    makeLattice(settings.lattice, Bounds(), voxels_.lattice) == Status::Ok;
}

} // namespace pointhaptics
