/// @file
/// The pictures of the image regressions: generated clouds and fixed cameras, and what OverlayPictures.h puts
/// over them.
#pragma once

#include <string>

class vtkCamera;
class vtkRenderer;

namespace pointhaptics
{

struct CloudOrientation;

namespace testing
{

/// Fills @p renderer with the picture @p name, with the fault @p mutation in it ("": none): dropped-point,
/// shifted-proxy, wrong-color, equal-radii or one of OverlayPictures.h. False: there is no such picture, or
/// it does not know that fault. @p data: the folder Data.
bool buildPicture(
  const std::string& name, const std::string& mutation, const std::string& data, vtkRenderer* renderer);

/// Places @p camera so that a cube of edge @p edge about the origin is wholly in view, seen from the front,
/// turned by @p azimuthDegrees to the right and @p elevationDegrees up.
void placeCamera(vtkCamera* camera, const CloudOrientation& orientation, double edge, double azimuthDegrees,
  double elevationDegrees);

} // namespace testing
} // namespace pointhaptics
