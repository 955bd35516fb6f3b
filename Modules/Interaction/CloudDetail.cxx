#include "CloudDetail.h"

#include "FairOrder.h"
#include "vtkSplatMapper.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkMatrix4x4.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
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

constexpr double kLevelRatio = 1.4142135623730951;
constexpr std::int64_t kRefinement = 4;
/// A moving picture keeps its level while the budget is between these parts of it.
constexpr double kLeastShare = 0.9;
constexpr double kMostShare = 1.6;
/// Part in view that is reckoned with at least: the next frame may show more.
constexpr double kLeastSeen = 0.1;

double steadySeconds()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// @p copy is filled where the coordinates are neither float nor double.
PointView viewOf(vtkPolyData* cloud, std::vector<Vec3>& copy)
{
  vtkDataArray* data = cloud->GetPoints()->GetData();
  if (auto* floats = vtkFloatArray::SafeDownCast(data))
  {
    return { floats->GetPointer(0), cloud->GetNumberOfPoints() };
  }
  if (auto* doubles = vtkDoubleArray::SafeDownCast(data))
  {
    return { doubles->GetPointer(0), cloud->GetNumberOfPoints() };
  }
  copy.resize(std::size_t(cloud->GetNumberOfPoints()));
  for (std::size_t i = 0; i < copy.size(); ++i)
  {
    cloud->GetPoint(vtkIdType(i), &copy[i].x);
  }
  return { copy.data(), std::int64_t(copy.size()) };
}

/// The array @p mapper colours the points of @p cloud by; null: none.
vtkDataArray* colorArray(vtkPolyData* cloud, vtkMapper* mapper)
{
  if (!mapper->GetScalarVisibility())
  {
    return nullptr;
  }
  return mapper->GetScalarMode() == VTK_SCALAR_MODE_USE_POINT_FIELD_DATA
    ? cloud->GetPointData()->GetArray(mapper->GetArrayName())
    : cloud->GetPointData()->GetScalars();
}

/// What vtkPolyDataMapper::ShallowCopy() would do, without its warnings of deprecated shaders.
void colorAlike(vtkMapper* from, vtkMapper* to)
{
  to->SetLookupTable(from->GetLookupTable());
  to->SetUseLookupTableScalarRange(from->GetUseLookupTableScalarRange());
  to->SetScalarRange(from->GetScalarRange());
  to->SetScalarVisibility(from->GetScalarVisibility());
  to->SetScalarMode(from->GetScalarMode());
  to->SetColorMode(from->GetColorMode());
  to->SetInterpolateScalarsBeforeMapping(from->GetInterpolateScalarsBeforeMapping());
  if (from->GetArrayName() && from->GetScalarMode() == VTK_SCALAR_MODE_USE_POINT_FIELD_DATA)
  {
    to->SelectColorArray(from->GetArrayName());
    to->SetArrayComponent(from->GetArrayComponent());
  }
}

/// Adds the tuples @p ids of @p array to @p part.
int addTuples(vtkDataArray* array, vtkIdList* ids, vtkPolyData* part)
{
  const auto some = vtkSmartPointer<vtkDataArray>::Take(array->NewInstance());
  some->SetName(array->GetName());
  some->SetNumberOfComponents(array->GetNumberOfComponents());
  some->SetNumberOfTuples(ids->GetNumberOfIds());
  array->GetTuples(ids, some);
  return part->GetPointData()->AddArray(some);
}

/// The points @p ids of @p cloud with the arrays of their colours, sizes and light.
vtkSmartPointer<vtkPolyData> pick(vtkPolyData* cloud, vtkMapper* mapper, vtkIdList* ids)
{
  auto part = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataType(cloud->GetPoints()->GetDataType());
  cloud->GetPoints()->GetPoints(ids, points);
  part->SetPoints(points);
  if (vtkDataArray* colors = colorArray(cloud, mapper))
  {
    const int index = addTuples(colors, ids, part);
    if (colors == cloud->GetPointData()->GetScalars())
    {
      part->GetPointData()->SetActiveAttribute(index, vtkDataSetAttributes::SCALARS);
    }
  }
  auto* splats = vtkSplatMapper::SafeDownCast(mapper);
  const std::string names[] = { splats ? splats->GetSizeArrayName() : std::string(),
    splats && splats->GetAmbientLight() ? splats->GetNormalArrayName() : std::string() };
  for (const std::string& name : names)
  {
    vtkDataArray* array = name.empty() ? nullptr : cloud->GetPointData()->GetArray(name.c_str());
    if (array && !part->GetPointData()->HasArray(name.c_str()))
    {
      addTuples(array, ids, part);
    }
  }
  vtkNew<vtkCellArray> vertices;
  vertices->InsertNextCell(static_cast<int>(ids->GetNumberOfIds()));
  for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
  {
    vertices->InsertCellPoint(i);
  }
  part->SetVerts(vertices);
  return part;
}

} // namespace

CloudDetail::CloudDetail(vtkRenderer* renderer, vtkActor* actor)
  : renderer_(renderer)
  , actor_(actor)
{
  onEnd_->SetClientData(this);
  onEnd_->SetCallback(
    [](vtkObject*, unsigned long, void* self, void*) { static_cast<CloudDetail*>(self)->endFrame(); });
}

CloudDetail::~CloudDetail()
{
  this->dropLevels();
  if (window_)
  {
    window_->RemoveObserver(onEnd_);
  }
}

void CloudDetail::setEnabled(bool enabled)
{
  enabled_ = enabled;
  if (!enabled)
  {
    this->dropLevels();
    actor_->VisibilityOn();
  }
}

double CloudDetail::spacingFactor() const
{
  return drawn_ > 0 ? std::sqrt(double(total_) / double(drawn_)) : 1.0;
}

void CloudDetail::setCoarsePointSize(double pixels)
{
  coarse_->SetPointSize(static_cast<float>(pixels));
}

bool CloudDetail::refinementDue(double now) const
{
  return enabled_ && total_ > 0 && !this->showsAll() && now - lastMotion_ >= kRestSeconds;
}

void CloudDetail::watchWindow()
{
  vtkRenderWindow* window = renderer_->GetRenderWindow();
  if (window != window_)
  {
    if (window_)
    {
      window_->RemoveObserver(onEnd_);
    }
    window_ = window;
    if (window)
    {
      window->AddObserver(vtkCommand::EndEvent, onEnd_);
    }
  }
}

bool CloudDetail::sceneChanged(vtkPolyData* cloud)
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

  unsigned long long propsTime = 0;
  vtkActorCollection* actors = renderer_->GetActors();
  vtkCollectionSimpleIterator cookie;
  actors->InitTraversal(cookie);
  while (vtkActor* actor = actors->GetNextActor(cookie))
  {
    const auto isLevel = [actor](const Level& level) { return level.actor == actor; };
    if (actor != actor_ && std::none_of(levels_.begin(), levels_.end(), isLevel))
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

/// How many points the coming frame may draw.
std::int64_t CloudDetail::wanted(double now)
{
  if (allOnce_)
  {
    allOnce_ = false;
    return total_;
  }
  if (moving_)
  {
    const bool wentOn = now - lastMotion_ < kRestSeconds && drawn_ < total_;
    lastMotion_ = now;
    // The level changes for a reason only: points that grow and shrink catch the eye.
    const double seen =
      double(std::max<std::int64_t>(1, visible_)) / double(std::max<std::int64_t>(1, drawn_));
    const double fitting = double(budget_.points()) / std::max(seen, kLeastSeen);
    const double share = fitting / double(std::max<std::int64_t>(1, drawn_));
    return wentOn && share > kLeastShare && share < kMostShare ? drawn_ : std::int64_t(fitting);
  }
  return now - lastMotion_ >= kRestSeconds ? kRefinement * drawn_ : drawn_;
}

void CloudDetail::beginFrame(double now)
{
  auto* mapper = vtkPolyDataMapper::SafeDownCast(actor_->GetMapper());
  vtkPolyData* cloud = mapper ? mapper->GetInput() : nullptr;
  frameIsTypical_ = false;
  if (!enabled_ || !renderer_ || !cloud || cloud->GetNumberOfPoints() == 0)
  {
    total_ = drawn_ = visible_ = cloud ? cloud->GetNumberOfPoints() : 0;
    return;
  }
  this->watchWindow();
  moving_ = this->sceneChanged(cloud);
  if (cloudChanged_)
  {
    this->dropLevels();
  }
  total_ = cloud->GetNumberOfPoints();
  const std::int64_t before = cloudChanged_ ? -1 : drawn_;
  this->show(cloud, this->wanted(now));
  frameIsTypical_ = drawn_ == before;
  frameBegin_ = steadySeconds();
}

void CloudDetail::endFrame()
{
  if (frameIsTypical_ && window_)
  {
    window_->WaitForCompletion();
    budget_.add(visible_, steadySeconds() - frameBegin_);
  }
  frameIsTypical_ = false;
}

/// The end of the largest level, made or not, that has at most @p points; all of them where no level has.
std::int64_t CloudDetail::levelFor(std::int64_t points) const
{
  if (points >= total_)
  {
    return total_;
  }
  double end = double(FrameBudget::kFewestPoints);
  while (end * kLevelRatio <= double(points))
  {
    end *= kLevelRatio;
  }
  return std::min(total_, std::int64_t(end));
}

void CloudDetail::show(vtkPolyData* cloud, std::int64_t points)
{
  drawn_ = this->levelFor(points);
  const bool all = drawn_ >= total_;
  while (!all && (levels_.empty() || levels_.back().end < drawn_))
  {
    this->addLevel(cloud);
  }
  actor_->SetVisibility(all);
  std::int64_t begin = 0;
  auto* whole = vtkSplatMapper::SafeDownCast(actor_->GetMapper());
  for (const Level& level : levels_)
  {
    level.actor->SetVisibility(!all && begin < drawn_);
    level.actor->SetUserMatrix(actor_->GetUserMatrix());
    if (auto* splats = vtkSplatMapper::SafeDownCast(level.actor->GetMapper()))
    {
      splats->CopySizes(whole, this->spacingFactor());
    }
    begin = level.end;
  }
  visible_ = drawn_;
  if (!all)
  {
    this->leaveOutUnseen();
  }
  coarse_->SetOpacity(actor_->GetProperty()->GetOpacity());
  coarse_->SetColor(actor_->GetProperty()->GetColor());
  coarse_->SetLighting(actor_->GetProperty()->GetLighting());
}

/// The sides of the frustum and of the workspace.
std::vector<HalfSpace> CloudDetail::view() const
{
  constexpr int kSides = 4; // left, right, bottom, top; the clipping range holds the whole scene
  double planes[24];
  renderer_->GetActiveCamera()->GetFrustumPlanes(renderer_->GetTiledAspectRatio(), planes);
  std::vector<HalfSpace> result;
  for (int side = 0; side < kSides; ++side)
  {
    result.push_back({ planes[4 * side], planes[4 * side + 1], planes[4 * side + 2], planes[4 * side + 3] });
  }
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

void CloudDetail::leaveOutUnseen()
{
  const std::vector<HalfSpace> halfSpaces = this->view();
  visible_ = 0;
  std::int64_t begin = 0;
  for (const Level& level : levels_)
  {
    const std::int64_t size = level.end - begin;
    const bool isDrawn = begin < drawn_;
    begin = level.end;
    auto* splats = vtkSplatMapper::SafeDownCast(level.actor->GetMapper());
    if (!isDrawn)
    {
      continue;
    }
    if (!splats)
    {
      visible_ += size;
      continue;
    }
    const double margin = 0.5 * splats->GetSizeScale() * level.largestLength;
    std::vector<std::array<vtkIdType, 2>> ranges =
      visibleRanges(level.bricks, halfSpaces, actor_->GetMatrix(), margin);
    for (const auto& range : ranges)
    {
      visible_ += range[1] - range[0];
    }
    level.actor->SetVisibility(!ranges.empty());
    splats->SetRanges(std::move(ranges));
  }
}

void CloudDetail::addLevel(vtkPolyData* cloud)
{
  std::vector<Vec3> copy;
  const PointView points = viewOf(cloud, copy);
  if (order_.empty())
  {
    order_ = fairOrder(points);
  }
  const std::int64_t begin = levels_.empty() ? 0 : levels_.back().end;
  double end = double(FrameBudget::kFewestPoints);
  while (std::int64_t(end) <= begin)
  {
    end *= kLevelRatio;
  }
  Level level;
  level.end = std::min(total_, std::int64_t(end));
  std::vector<std::int64_t> members(order_.begin() + begin, order_.begin() + level.end);
  level.bricks = makeBricks(points, members);
  vtkNew<vtkIdList> ids;
  ids->SetNumberOfIds(level.end - begin);
  std::copy(members.begin(), members.end(), ids->GetPointer(0));
  const auto mapper = vtkSmartPointer<vtkPolyDataMapper>::Take(
    vtkSplatMapper::SafeDownCast(actor_->GetMapper()) ? vtkSplatMapper::New() : vtkPolyDataMapper::New());
  colorAlike(actor_->GetMapper(), mapper);
  const vtkSmartPointer<vtkPolyData> part = pick(cloud, actor_->GetMapper(), ids);
  mapper->SetInputData(part);
  if (auto* splats = vtkSplatMapper::SafeDownCast(actor_->GetMapper()))
  {
    vtkDataArray* sizes = part->GetPointData()->GetArray(splats->GetSizeArrayName().c_str());
    level.largestLength = sizes ? sizes->GetRange()[1] : 0.0;
  }
  level.actor = vtkSmartPointer<vtkActor>::New();
  level.actor->SetMapper(mapper);
  level.actor->SetProperty(coarse_);
  level.actor->PickableOff();
  renderer_->AddActor(level.actor);
  levels_.push_back(level);
}

void CloudDetail::removeLevels()
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

void CloudDetail::dropLevels()
{
  this->removeLevels();
  order_.clear();
}

} // namespace pointhaptics
