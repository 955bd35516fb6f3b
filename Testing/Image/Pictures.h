/// @file
/// The pictures of the image regressions: generated clouds and fixed cameras, and what OverlayPictures.h puts
/// over them.
#pragma once

#include <string>

class vtkRenderer;

namespace pointhaptics
{
namespace testing
{

/// Fills @p renderer with the picture @p name, with the fault @p mutation in it ("": none): dropped-point,
/// shifted-proxy, wrong-color, equal-radii or one of OverlayPictures.h. False: there is no such picture, or
/// it does not know that fault. @p data: the folder Data.
bool buildPicture(
  const std::string& name, const std::string& mutation, const std::string& data, vtkRenderer* renderer);

} // namespace testing
} // namespace pointhaptics
