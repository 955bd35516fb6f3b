#include "PointPicker.h"

#include "PointPicking.h"
#include "ScenePipeline.h"
#include "ScreenView.h"
#include "StatusText.h"

#include "vtkActor.h"
#include "vtkMatrix4x4.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkRenderer.h"

namespace pointhaptics
{
namespace
{

constexpr double kPickPixels = 8.0;
/// Reach of a pick on a surface, pixels: holes between sparse points must not let it through.
constexpr double kSurfacePixels = 24.0;
/// Without a picture of depths: a slope is nearer to the person beside the pointer than under it, so nearer
/// points tell better,
constexpr double kNearPixels[] = { 2.0, 4.0, 8.0 };
/// unless they are deeper than this times those pixels, and so seen through a hole.
constexpr double kSteepest = 3.0;

} // namespace

PickedOfFile PointPicker::pickOfFile(int x, int y) const
{
  auto* mapper = fileActor_ && fileActor_->GetVisibility()
    ? vtkPolyDataMapper::SafeDownCast(fileActor_->GetMapper())
    : nullptr;
  vtkPolyData* points = mapper ? mapper->GetInput() : nullptr;
  PickedPoint picked;
  PickedOfFile result;
  if (points &&
    pickPoint(
      points, screen_.renderer(), x, y, kPickPixels, picked, fileActor_->GetMatrix(), drawnBy(fileActor_)))
  {
    result = { points, picked.index, leftOut_ };
  }
  return result;
}

std::optional<Vec3> PointPicker::surfaceAt(int x, int y) const
{
  vtkRenderer* renderer = screen_.renderer();
  PickedPoint picked;
  if (!renderer || !scenes_.cloud() || scenes_.isChanged() ||
    !pickPoint(scenes_.cloud(), renderer, x, y, kSurfacePixels, picked))
  {
    return std::nullopt;
  }
  if (picked.shown)
  {
    return screen_.toWorkspace(x, y, screen_.toDisplay(*picked.shown).z);
  }
  const auto asDeepAs = [&](const PickedPoint& point, double aside)
  { return screen_.toWorkspace(x + aside, y, screen_.toDisplay(point.inWorkspace).z); };
  const double reach = kSteepest * norm(asDeepAs(picked, kSurfacePixels) - asDeepAs(picked, 0.0));
  for (const double pixels : kNearPixels)
  {
    PickedPoint near;
    if (pickPoint(scenes_.cloud(), renderer, x, y, pixels, near) &&
      norm(near.inWorkspace - picked.inWorkspace) < reach)
    {
      return asDeepAs(near, 0.0);
    }
  }
  return asDeepAs(picked, 0.0);
}

bool PointPicker::pickAt(int x, int y)
{
  vtkRenderer* renderer = screen_.renderer();
  vtkPolyData* cloud = scenes_.cloud();
  PickedPoint picked;
  if (!renderer || !cloud || !pickPoint(cloud, renderer, x, y, kPickPixels, picked))
  {
    this->forget();
    return false;
  }
  if (scenes_.bandwidthFilter())
  {
    // A neighbourhood without a bandwidth leaves it at 0, which is not shown.
    static_cast<void>(measurePicked(cloud, scenes_.bandwidthFilter()->GetSettings(), picked));
  }
  marker_.addTo(renderer);
  marker_.mark(picked.inWorkspace, picked.voxelBounds, picked.bandwidth);
  if (vtkHapticOverlay* overlay = status_.overlay())
  {
    overlay->SetDetail(describePicked(cloud, picked, this->pickOfFile(x, y)));
  }
  return true;
}

bool PointPicker::forget()
{
  if (vtkHapticOverlay* overlay = status_.overlay())
  {
    overlay->SetDetail("");
  }
  return marker_.hide();
}

} // namespace pointhaptics
