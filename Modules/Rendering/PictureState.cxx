#include "PictureState.h"

#include "vtkOverlayActor.h"
#include "vtkSplatMapper.h"

#include "vtkActor.h"
#include "vtkActor2D.h"
#include "vtkCamera.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMatrix4x4.h"
#include "vtkProp3D.h"
#include "vtkPropCollection.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"

#include <cstdint>
#include <functional>
#include <string>

namespace pointhaptics
{
namespace
{

/// Adds a time of modification, which is a count and exact as a double.
void add(std::vector<double>& state, vtkMTimeType time)
{
  state.push_back(double(time));
}

void add(std::vector<double>& state, const double* values, int count)
{
  state.insert(state.end(), values, values + count);
}

void addProp(std::vector<double>& state, vtkProp* prop)
{
  state.push_back(double(reinterpret_cast<std::uintptr_t>(prop)));
  add(state, prop->GetRedrawMTime());
  // A matrix that is changed in place does not change its actor's time.
  if (auto* placed = vtkProp3D::SafeDownCast(prop))
  {
    placed->ComputeMatrix();
    add(state, placed->GetMatrix()->GetData(), 16);
  }
  // Sizes of splats do not change the time of their mapper either.
  auto* actor = vtkActor::SafeDownCast(prop);
  if (auto* splats = actor ? vtkSplatMapper::SafeDownCast(actor->GetMapper()) : nullptr)
  {
    const SplatSettings& drawn = splats->Settings();
    state.insert(state.end(),
      { drawn.sizeScale, drawn.smallestPixels, drawn.largestPixels, drawn.largestRatio, drawn.normalUnit,
        drawn.fixedPixels, drawn.gap, drawn.pointPixels, drawn.surfacePixels, drawn.lightStrength,
        double(drawn.ambientLight), double(drawn.surfaces), double(drawn.hidesBackFaces),
        double(drawn.foreshortens), double(drawn.closesAll),
        double(std::hash<std::string>()(drawn.sizeArray + '\n' + drawn.normalArray)) });
    add(state, drawn.sky.data(), 3);
    add(state, drawn.clipBox.data(), 6);
    for (const auto& range : splats->GetRanges())
    {
      state.insert(state.end(), { double(range[0]), double(range[1]) });
    }
  }
}

} // namespace

bool isDrawnOver(vtkProp* prop)
{
  return vtkActor2D::SafeDownCast(prop) || vtkOverlayActor::SafeDownCast(prop);
}

std::vector<double> pictureState(vtkRenderer* renderer)
{
  std::vector<double> state;
  vtkCamera* camera = renderer->GetActiveCamera();
  add(state, camera->GetViewTransformMatrix()->GetData(), 16);
  add(state, camera->GetClippingRange(), 2);
  const double lens = camera->GetParallelProjection() ? -camera->GetParallelScale() : camera->GetViewAngle();
  state.push_back(lens);
  add(state, camera->GetWindowCenter(), 2);
  vtkRenderWindow* window = renderer->GetRenderWindow();
  state.push_back(window && window->GetStereoRender() ? camera->GetEyeAngle() : 0.0);
  const int* size = renderer->GetSize();
  const int* origin = renderer->GetOrigin();
  state.insert(state.end(), { double(size[0]), double(size[1]), double(origin[0]), double(origin[1]) });
  add(state, renderer->GetBackground(), 3);
  add(state, renderer->GetBackground2(), 3);
  state.push_back(double(renderer->GetGradientBackground()));

  vtkCollectionSimpleIterator cookie;
  renderer->GetLights()->InitTraversal(cookie);
  while (vtkLight* light = renderer->GetLights()->GetNextLight(cookie))
  {
    state.insert(state.end(), { double(light->GetSwitch()), light->GetIntensity() });
    add(state, light->GetDiffuseColor(), 3);
    add(state, light->GetPosition(), 3);
  }
  renderer->GetViewProps()->InitTraversal(cookie);
  while (vtkProp* prop = renderer->GetViewProps()->GetNextProp(cookie))
  {
    if (prop->GetVisibility() && !isDrawnOver(prop))
    {
      addProp(state, prop);
    }
  }
  return state;
}

} // namespace pointhaptics
