/// @file
/// Steps of the camera by the distance to what is seen.
#pragma once

#include "Core/Base/Vector3.h"

#include <functional>
#include <optional>

class vtkRenderer;

namespace pointhaptics
{

/// VTK dollies and pans by the distance to the focal point. That point is the pivot of turns and may lie far
/// behind the surface that is seen: a dolly would pass through the surface, a pan would fling it away. Here a
/// step is measured by the surface, and the pivot stays. GUI thread only.
class CameraSteps
{
public:
  /// Finds the surface at (@p x, @p y), pixels of the window, or near it. Where the picture shows none, it is
  /// the place that was found before: a picture that was given up for the next step shows none.
  void look(vtkRenderer* renderer, double x, double y);
  /// Runs @p step, which moves the camera of @p renderer without turning it, while the focal point is as far
  /// away as the place that was found. It stays where that place is farther than @p farthest, the
  /// projection is parallel, or two eyes look at it.
  void run(vtkRenderer* renderer, double farthest, const std::function<void()>& step);

private:
  std::optional<Vec3> seen_;
};

} // namespace pointhaptics
