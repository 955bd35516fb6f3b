/// @file
/// `view --screenshot`: one picture off the screen, with the touch along --path.
#pragma once

#include "Options/ViewOptions.h"

#include <string>

namespace pointhaptics
{
namespace app
{

class ViewScene;

/// Writes the picture, and the force chart and trace where they are asked for; says on stdout where each is.
/// @p scene must be built. False: @p message says what failed.
bool makePicture(ViewScene& scene, const ViewOptions& options, std::string& message);

} // namespace app
} // namespace pointhaptics
