#include "Benchmark/Scenery/SceneWindow.h"

#include <vtkRenderer.h>

namespace pointhaptics
{
namespace app
{

SceneWindow::~SceneWindow()
{
  window_->RemoveRenderer(scene_.renderer());
}

bool SceneWindow::open(const std::string& file, int width, int height, std::string& message)
{
  const HapticViewerOptions options;
  if (!scene_.open({ file }, options, message))
  {
    return false;
  }
  window_->SetOffScreenRendering(1);
  window_->SetMultiSamples(0);
  window_->SetSize(width, height);
  window_->AddRenderer(scene_.renderer());
  scene_.placeCamera();
  return true;
}

} // namespace app
} // namespace pointhaptics
