#include "CameraSteps.h"

#include "ScreenMarks.h"
#include "vtkDepthShadingPass.h"

#include "vtkCamera.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"

namespace pointhaptics
{
namespace
{

/// Radius of the disc that is searched for a surface, over the picture's height.
constexpr double kReach = 0.06;
/// Cosine of the widest angle between the view and a place that was found before. A place farther aside was
/// seen before the view turned.
constexpr double kAhead = 0.99;

} // namespace

void CameraSteps::look(vtkRenderer* renderer, double x, double y)
{
  const CameraView view(renderer->GetActiveCamera());
  Vec3 shown;
  if (vtkDepthShadingPass::FindShown(renderer, x, y, kReach * renderer->GetSize()[1], &shown.x))
  {
    seen_ = shown;
  }
  else if (seen_ && dot(*seen_ - view.eye, view.forward) < kAhead * norm(*seen_ - view.eye))
  {
    seen_.reset();
  }
}

void CameraSteps::run(vtkRenderer* renderer, double farthest, const std::function<void()>& step)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  const CameraView before(camera);
  const double away = seen_ ? dot(*seen_ - before.eye, before.forward) : 0.0;
  const bool isMeasured = away > 0.0 && away < farthest && !camera->GetParallelProjection() &&
    !renderer->GetRenderWindow()->GetStereoRender(); // eyes converge at the focal point
  if (isMeasured)
  {
    camera->SetDistance(away);
  }
  step();
  if (isMeasured)
  {
    const Vec3 way = CameraView(camera).eye - before.eye;
    const Vec3 pivot = before.focus + way - dot(way, before.forward) * before.forward;
    camera->SetFocalPoint(&pivot.x);
  }
}

} // namespace pointhaptics
