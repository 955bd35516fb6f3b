#include "LevelOfDetail.h"

#include "CloudParts.h"
#include "PictureState.h"
#include "vtkSplatMapper.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkCamera.h"
#include "vtkIdList.h"
#include "vtkMatrix4x4.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace pointhaptics
{
namespace
{

constexpr std::int64_t kRefinement = 4;
/// A moving picture keeps its level while the budget is between these parts of it.
constexpr double kLeastShare = 0.9;
constexpr double kMostShare = 1.6;
/// Moving frames that a picture at rest may take to be drawn at once.
constexpr std::int64_t kFramesAtOnce = 60;
/// Least part in view that is assumed: the next frame may show more.
constexpr double kLeastSeen = 0.1;

/// Points in one cell of this many pixels cannot be told apart: the smallest splat covers it.
constexpr double kFinestPixels = 1.0;
/// A part of the points saves nothing where it is larger than this part of all.
constexpr double kMostSaving = 0.7;

double steadySeconds()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

} // namespace

LevelOfDetail::LevelOfDetail(vtkRenderer* renderer, vtkActor* actor)
  : renderer_(renderer)
  , actor_(actor)
{
}

LevelOfDetail::~LevelOfDetail()
{
  this->dropLevels();
}

void LevelOfDetail::setEnabled(bool enabled)
{
  enabled_ = enabled;
  if (!enabled)
  {
    this->dropLevels();
    actor_->VisibilityOn();
    this->splats()->SetRanges({});
  }
}

vtkSplatMapper* LevelOfDetail::splats() const
{
  return vtkSplatMapper::SafeDownCast(actor_->GetMapper());
}

double LevelOfDetail::fragments() const
{
  vtkSplatMapper* drawn = drawn_ < total_ && !levels_.empty() ? levels_.front().splats.Get() : this->splats();
  const SplatSettings& settings = drawn->Settings();
  const double pixels =
    drawn->GetMedianPixels(renderer_, actor_, settings.closesAll ? INFINITY : settings.largestPixels);
  return double(visible_) * pixels * pixels;
}

bool LevelOfDetail::refinementDue(double now) const
{
  return enabled_ && total_ > 0 && !this->isFinest() && now - lastMotion_ >= kRestSeconds;
}

std::optional<double> LevelOfDetail::restingFrame() const
{
  const bool rests = enabled_ && !moving_ && !isKept_;
  return rests ? std::optional(steadySeconds() - frameBegin_) : std::nullopt;
}

void LevelOfDetail::watchWindow()
{
  vtkRenderWindow* window = renderer_->GetRenderWindow();
  if (window != window_)
  {
    window_ = window;
    onEnd_.follow(window, vtkCommand::EndEvent);
  }
}

bool LevelOfDetail::sceneChanged(vtkPolyData* cloud)
{
  std::vector<double> placement;
  const auto add = [&placement](vtkMatrix4x4* matrix)
  { placement.insert(placement.end(), matrix->GetData(), matrix->GetData() + 16); };
  vtkCamera* camera = renderer_->GetActiveCamera();
  add(camera->GetViewTransformMatrix());
  placement.push_back(camera->GetParallelProjection() ? -camera->GetParallelScale() : camera->GetViewAngle());
  add(actor_->GetMatrix());
  placement.push_back(renderer_->GetSize()[0]);
  placement.push_back(renderer_->GetSize()[1]);
  const std::array<double, 6>& box = this->splats()->Settings().clipBox;
  placement.insert(placement.end(), box.begin(), box.end());

  unsigned long long propsTime = 0;
  vtkActorCollection* actors = renderer_->GetActors();
  vtkCollectionSimpleIterator cookie;
  actors->InitTraversal(cookie);
  while (vtkActor* actor = actors->GetNextActor(cookie))
  {
    const auto isLevel = [actor](const Level& level) { return level.actor == actor; };
    if (actor != actor_ && actor->GetVisibility() && !isDrawnOver(actor) &&
      std::none_of(levels_.begin(), levels_.end(), isLevel))
    {
      propsTime = std::max<unsigned long long>(propsTime, actor->GetRedrawMTime());
    }
  }
  cloudChanged_ = cloud->GetMTime() != cloudTime_;
  const bool changed = cloudChanged_ || propsTime != propsTime_ || placement != placement_;
  cloudTime_ = cloud->GetMTime();
  propsTime_ = propsTime;
  placement_ = placement;
  return changed;
}

/// Number of points that the coming frame may draw.
std::int64_t LevelOfDetail::wanted(double now)
{
  if (finestOnce_)
  {
    return finest_;
  }
  if (moving_)
  {
    const bool wentOn = now - lastMotion_ < kRestSeconds && drawn_ < total_;
    lastMotion_ = now;
    // The level changes only for a reason: points that grow and shrink catch the eye.
    const double seen =
      double(std::max<std::int64_t>(1, visible_)) / double(std::max<std::int64_t>(1, drawn_));
    const double fitting = double(budget_.points()) / std::max(seen, kLeastSeen);
    const double share = fitting / double(std::max<std::int64_t>(1, drawn_));
    return wentOn && share > kLeastShare && share < kMostShare ? drawn_ : std::int64_t(fitting);
  }
  if (now - lastMotion_ < kRestSeconds)
  {
    return drawn_;
  }
  // The last level before the whole cloud would hold most of it, and be kept beside it.
  const std::int64_t finer = kRefinement * drawn_;
  return finer > total_ / kRefinement ? total_ : finer;
}

void LevelOfDetail::beginFrame(double now)
{
  vtkPolyData* cloud = this->splats()->GetInput();
  const bool wasFinest = this->isFinest();
  frameIsTypical_ = inMotion_ = false;
  if (!enabled_ || !renderer_ || !cloud || cloud->GetNumberOfPoints() == 0)
  {
    total_ = finest_ = drawn_ = visible_ = cloud ? cloud->GetNumberOfPoints() : 0;
    return;
  }
  this->watchWindow();
  const double height = renderer_->GetViewport()[3] - renderer_->GetViewport()[1];
  const bool isOther = std::exchange(isRecolored_, false) || height != height_;
  height_ = height;
  const bool rests = isOther && wasFinest && total_ == cloud->GetNumberOfPoints() &&
    total_ <= kFramesAtOnce * budget_.points();
  moving_ = this->sceneChanged(cloud) && !rests;
  if (cloudChanged_)
  {
    this->dropLevels();
  }
  total_ = cloud->GetNumberOfPoints();
  finest_ = this->finestFor(cloud);
  before_ = drawn_;
  isKept_ = finestOnce_;
  const std::int64_t before = cloudChanged_ ? -1 : drawn_;
  inMotion_ = !finestOnce_ && (moving_ || now - lastMotion_ < kRestSeconds);
  this->show(cloud, this->wanted(now));
  // A frame at rest may reuse the last picture, or draw it several times.
  frameIsTypical_ = moving_ && drawn_ == before;
  frameBegin_ = steadySeconds();
}

void LevelOfDetail::endFrame()
{
  if (window_ && window_->GetAbortRender())
  {
    drawn_ = before_; // that is seen still
    inMotion_ = true;
    frameIsTypical_ = false;
  }
  if (frameIsTypical_ && window_)
  {
    window_->WaitForCompletion();
    budget_.add(visible_, steadySeconds() - frameBegin_);
  }
  frameIsTypical_ = finestOnce_ = false; // both eyes have been drawn
}

const ProgressiveOrder& LevelOfDetail::order(vtkPolyData* cloud)
{
  if (!order_)
  {
    std::vector<Vec3> copy;
    const bool isGiven = givenOrder_ && std::int64_t(givenOrder_->indices.size()) == total_;
    order_ =
      isGiven ? givenOrder_ : std::make_shared<const ProgressiveOrder>(progressiveOrder(viewOf(cloud, copy)));
  }
  return *order_;
}

/// The largest step of at most @p points, or the first of enough to see anything.
ProgressiveOrder::Step LevelOfDetail::stepFor(vtkPolyData* cloud, std::int64_t points)
{
  if (points >= total_)
  {
    return { total_, 0.0 };
  }
  const std::vector<ProgressiveOrder::Step>& steps = this->order(cloud).steps;
  auto step = steps.begin();
  while (step + 1 != steps.end() && (step->end < FrameBudget::kFewestPoints || (step + 1)->end <= points))
  {
    ++step;
  }
  return *step;
}

void LevelOfDetail::show(vtkPolyData* cloud, std::int64_t points)
{
  const ProgressiveOrder::Step step = this->stepFor(cloud, std::min(points, finest_));
  drawn_ = step.end;
  const bool all = drawn_ >= total_;
  while (!all && this->keptPoints() < drawn_)
  {
    this->addLevel(cloud);
  }
  actor_->SetVisibility(all);
  std::int64_t begin = 0;
  for (const Level& level : levels_)
  {
    level.actor->SetVisibility(!all && begin < drawn_);
    level.actor->SetUserMatrix(actor_->GetUserMatrix());
    level.splats->CopySizes(this->splats(), step.gap);
    begin = level.end;
  }
  visible_ = drawn_;
  if (all)
  {
    this->leaveOutOfView(cloud);
  }
  else
  {
    this->cullOutsideFrustum();
  }
  coarse_->SetOpacity(actor_->GetProperty()->GetOpacity());
  coarse_->SetColor(actor_->GetProperty()->GetColor());
  coarse_->SetLighting(actor_->GetProperty()->GetLighting());
}

/// Left, right, bottom and top of the frustum, @p pixels outside of the picture. The clipping range holds the
/// whole scene, so near and far are left out.
std::vector<HalfSpace> LevelOfDetail::sides(double pixels) const
{
  vtkMatrix4x4* toClip = renderer_->GetActiveCamera()->GetCompositeProjectionTransformMatrix(
    renderer_->GetTiledAspectRatio(), -1, 1);
  std::vector<HalfSpace> result;
  for (int axis = 0; axis < 2; ++axis)
  {
    const double wider = 1.0 + 2.0 * pixels / std::max(1, renderer_->GetSize()[axis]);
    for (const double sign : { 1.0, -1.0 })
    {
      HalfSpace side{};
      for (int column = 0; column < 4; ++column)
      {
        side[std::size_t(column)] =
          wider * toClip->GetElement(3, column) + sign * toClip->GetElement(axis, column);
      }
      result.push_back(side);
    }
  }
  return result;
}

/// Sides of the frustum and of the workspace.
std::vector<HalfSpace> LevelOfDetail::view() const
{
  std::vector<HalfSpace> result = this->sides(0.0);
  for (int axis = 0; axis < 3 && !workspace_.empty(); ++axis)
  {
    HalfSpace lower{};
    HalfSpace upper{};
    lower[std::size_t(axis)] = 1.0;
    lower[3] = -workspace_.minimum[axis];
    upper[std::size_t(axis)] = -1.0;
    upper[3] = workspace_.maximum[axis];
    result.push_back(lower);
    result.push_back(upper);
  }
  return result;
}

/// Leaves out the rows of the cloud that no pixel shows, where its own mapper draws it.
void LevelOfDetail::leaveOutOfView(vtkPolyData* cloud)
{
  vtkSplatMapper* splats = this->splats();
  if (!hasRows_)
  {
    std::vector<Vec3> copy;
    rows_ = drawsInOrder(cloud) ? makeRows(viewOf(cloud, copy)) : std::vector<SplatBrick>();
    hasRows_ = true;
  }
  if (rows_.empty())
  {
    splats->SetRanges({});
    return;
  }
  vtkDataArray* lengths = cloud->GetPointData()->GetArray(splats->Settings().sizeArray.c_str());
  const double margin = lengths ? 0.5 * splats->Settings().sizeScale * lengths->GetRange()[1] : 0.0;
  const double pixels =
    1.0 + 0.5 * std::max(splats->Settings().smallestPixels, splats->Settings().fixedPixels);
  std::vector<std::array<vtkIdType, 2>> ranges =
    visibleRanges(rows_, this->sides(pixels), actor_->GetMatrix(), margin);
  visible_ = 0;
  for (const auto& range : ranges)
  {
    visible_ += range[1] - range[0];
  }
  if (ranges.empty())
  {
    ranges.push_back({ 0, 0 }); // none is not all
  }
  splats->SetRanges(std::move(ranges));
}

/// Number of points that the picture at rest needs: all, or one in each cell of kFinestPixels where the cloud
/// is nearest.
std::int64_t LevelOfDetail::finestFor(vtkPolyData* cloud)
{
  if (this->splats()->Settings().fixedPixels > 0.0)
  {
    return total_;
  }
  vtkMatrix4x4* toClip = renderer_->GetActiveCamera()->GetCompositeProjectionTransformMatrix(
    renderer_->GetTiledAspectRatio(), -1, 1);
  const double* bounds = actor_->GetBounds();
  double nearest = INFINITY; // w of the nearest corner: 1 everywhere in a parallel projection
  for (int corner = 0; corner < 8; ++corner)
  {
    const double in[4] = { bounds[corner & 1], bounds[2 + (corner >> 1 & 1)], bounds[4 + (corner >> 2 & 1)],
      1.0 };
    double out[4];
    toClip->MultiplyPoint(in, out);
    nearest = std::min(nearest, out[3]);
  }
  const double perUnit = 0.5 * renderer_->GetSize()[1] *
    renderer_->GetActiveCamera()
      ->GetProjectionTransformMatrix(renderer_->GetTiledAspectRatio(), -1, 1)
      ->GetElement(1, 1);
  const double scale = std::cbrt(std::abs(actor_->GetMatrix()->Determinant()));
  const double pixels = scale * perUnit / nearest; // of the unit
  const double edge = cloud->GetLength() * pixels;
  if (!(nearest > 0.0) || double(total_) < edge * edge)
  {
    return total_; // and no order need be made
  }
  const std::vector<ProgressiveOrder::Step>& steps = this->order(cloud).steps;
  const auto step = std::find_if(steps.begin(), steps.end(),
    [pixels](const ProgressiveOrder::Step& each) { return each.gap * pixels <= kFinestPixels; });
  return double(step->end) < kMostSaving * double(total_) ? step->end : total_;
}

void LevelOfDetail::cullOutsideFrustum()
{
  const std::vector<HalfSpace> halfSpaces = this->view();
  visible_ = 0;
  std::int64_t begin = 0;
  for (const Level& level : levels_)
  {
    const bool isDrawn = begin < drawn_;
    begin = level.end;
    if (!isDrawn)
    {
      continue;
    }
    const SplatSettings& settings = level.splats->Settings();
    const double margin =
      0.5 * std::hypot(settings.sizeScale * level.largestLength, kClosingCells * settings.gap);
    std::vector<std::array<vtkIdType, 2>> ranges =
      visibleRanges(level.bricks, halfSpaces, actor_->GetMatrix(), margin);
    for (const auto& range : ranges)
    {
      visible_ += range[1] - range[0];
    }
    level.actor->SetVisibility(!ranges.empty());
    level.splats->SetRanges(std::move(ranges));
  }
}

void LevelOfDetail::addLevel(vtkPolyData* cloud)
{
  const ProgressiveOrder& order = this->order(cloud);
  const std::int64_t begin = this->keptPoints();
  const auto step = std::find_if(order.steps.begin(), order.steps.end(),
    [begin](const ProgressiveOrder::Step& each)
    { return each.end > begin && each.end >= FrameBudget::kFewestPoints; });
  Level level;
  level.end = step == order.steps.end() ? total_ : step->end;
  vtkNew<vtkIdList> ids;
  ids->SetNumberOfIds(level.end - begin);
  std::copy(order.indices.begin() + begin, order.indices.begin() + level.end, ids->GetPointer(0));
  level.splats = vtkSmartPointer<vtkSplatMapper>::New();
  colorAlike(this->splats(), level.splats);
  const vtkSmartPointer<vtkPolyData> part = pickPoints(cloud, this->splats(), ids);
  std::vector<Vec3> copy;
  level.bricks = makeRows(viewOf(part, copy));
  level.splats->SetInputData(part);
  vtkDataArray* sizes = part->GetPointData()->GetArray(this->splats()->Settings().sizeArray.c_str());
  level.largestLength = sizes ? sizes->GetRange()[1] : 0.0;
  level.actor = vtkSmartPointer<vtkActor>::New();
  level.actor->SetMapper(level.splats);
  level.actor->SetProperty(coarse_);
  level.actor->SetForceOpaque(actor_->GetForceOpaque());
  level.actor->PickableOff();
  renderer_->AddActor(level.actor);
  levels_.push_back(level);
}

void LevelOfDetail::recolor()
{
  this->removeLevels();
  isRecolored_ = true;
}

void LevelOfDetail::removeLevels()
{
  for (const Level& level : levels_)
  {
    if (renderer_)
    {
      renderer_->RemoveActor(level.actor);
    }
  }
  levels_.clear();
}

void LevelOfDetail::dropLevels()
{
  this->removeLevels();
  order_.reset();
  rows_.clear();
  hasRows_ = false;
}

} // namespace pointhaptics
