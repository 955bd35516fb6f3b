/// @file
/// Clipping ranges in steps, for vtkDepthShadingPass.
#pragma once

#include "vtkCamera.h"

#include <cmath>

namespace pointhaptics
{

/// Moves the end of a clipping range outward to a step: four steps double it.
inline double clippingStep(double distance, bool isNear)
{
  constexpr double kStepsPerDoubling = 4.0;
  constexpr double kOnStep = 1e-6; // a step stays where it is
  const double at = kStepsPerDoubling * std::log2(distance);
  const double step = isNear ? std::floor(at + kOnStep) : std::ceil(at - kOnStep);
  return std::exp2(step / kStepsPerDoubling);
}

/// Sets the clipping range in steps. Shades depend on depths, and their last bits on the clipping range,
/// which follows all that is in the scene and is reset before most frames: with steps, an equal view has an
/// equal picture.
inline void setClippingRangeToSteps(vtkCamera* camera)
{
  const double* range = camera->GetClippingRange();
  if (range[0] > 0.0 && std::isfinite(range[1]))
  {
    camera->SetClippingRange(clippingStep(range[0], true), clippingStep(range[1], false));
  }
}

} // namespace pointhaptics
