/// @file
/// `view` on a display: the window with the live touch.
#pragma once

#include "ViewOptions.h"

#include <string>

namespace pointhaptics
{
namespace app
{

class ViewScene;

/// Shows the window until the user closes it. @p scene must be built. False: @p message says what failed.
bool runWindow(ViewScene& scene, const ViewOptions& options, std::string& message);

} // namespace app
} // namespace pointhaptics
