#include "LocalSceneProvider.h"

#include "PolyDataAccess.h"

#include "Core/Base/Boxes.h"

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

void LocalSceneProvider::setCloud(vtkSmartPointer<vtkPoints> points)
{
  points_ = std::move(points);
  index_.reset();
  fine_ = LocalSceneFollower();
}

std::shared_ptr<const HapticScene> LocalSceneProvider::build(
  const SceneOrigin& recipe, const Bounds& hand, std::shared_ptr<const HapticScene> global)
{
  if (hand.empty() || !this->prepare(recipe))
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
  input.bandwidth = recipe.bandwidth;
  auto origin = std::make_shared<SceneOrigin>(recipe);
  origin->kind = SceneOrigin::Kind::Region;
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
    const PointAccess access(points_);
    const PointView& all = access.view();
    const auto take = [&](const auto* first, auto& found)
    {
      found = pointsWithin(first, all, boxOfModel(voxels_.transform, region.voxels().bounds()), smp_);
      voxels_.points = PointView(found.data(), std::int64_t(found.size() / 3));
    };
    all.floats() ? take(all.floats(), floats) : take(all.doubles(), doubles);
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
  const Bounds& hand, const std::shared_ptr<const HapticScene>& global)
{
  const auto now = std::chrono::steady_clock::now();
  const std::chrono::duration<double> seconds = now - std::exchange(lastLook_, now);
  const bool mayServe = isIndexed() || (global && isFinerNear(hand, *global));
  if (hand.empty() || !global || !global->origin() || !mayServe || !this->index())
  {
    return nullptr;
  }
  if (fine_.global() != global)
  {
    fine_ = LocalSceneFollower(global, index_);
  }
  return fine_.update(hand, seconds.count(), smp_) && fine_.scene() != global ? fine_.scene() : nullptr;
}

std::shared_ptr<const HapticScene> LocalSceneProvider::make(
  const SceneOrigin& origin, const std::shared_ptr<const HapticScene>& global)
{
  if (origin.kind == SceneOrigin::Kind::Region)
  {
    return this->build(origin, origin.hand, global);
  }
  Status status = Status::Ok;
  const bool isThere = global->modelToWorkspace() == origin.modelToWorkspace;
  const auto beside = isThere ? global : global->moved(origin.modelToWorkspace, status);
  return beside && this->index() ? LocalSceneBuilder(index_).build(origin.hand, beside, smp_) : nullptr;
}

bool LocalSceneProvider::index()
{
  index_ = index_ ? index_ : indexOf(points_);
  return index_ != nullptr;
}

/// Prepares lattice and transform of the resampling. False: there is no cloud, or the lattice depends on the
/// whole cloud.
bool LocalSceneProvider::prepare(const SceneOrigin& recipe)
{
  const VoxelMeanSettings& settings = recipe.voxels;
  if (!points_ || points_->GetNumberOfPoints() == 0 || settings.lattice.automaticWorkspace)
  {
    return false;
  }
  voxels_ = VoxelRequest();
  voxels_.transform = recipe.modelToWorkspace;
  voxels_.singlePrecision = settings.outputPointsPrecision == PointsPrecision::OfInput
    ? points_->GetDataType() == VTK_FLOAT
    : settings.outputPointsPrecision == PointsPrecision::Single;
  voxels_.covariances = settings.computeCovariance && recipe.useCovariance;
  voxels_.instructions = settings.instructionSet;
  return voxels_.transform.check() == Status::Ok &&
    makeLattice(settings.lattice, Bounds(), voxels_.lattice) == Status::Ok;
}

} // namespace pointhaptics
