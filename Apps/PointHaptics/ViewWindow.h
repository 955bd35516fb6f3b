/// @file
/// `view` on a display: the window with the live touch.
#pragma once

#include "ViewOptions.h"

#include <memory>
#include <string>

namespace pointhaptics
{
namespace app
{

class CloudLoader;
class ViewScene;
class ViewWindow;

/// One window from the moment it opens, which may be before there is a cloud.
class ViewSession
{
public:
  /// Opens nothing yet. @p scene must outlive this.
  ViewSession(ViewScene& scene, const ViewOptions& options);
  ~ViewSession();
  ViewSession(const ViewSession&) = delete;
  ViewSession& operator=(const ViewSession&) = delete;

  /// Opens the window, empty but for a bar, until @p loader has something to take. False: the user closed the
  /// window or pressed Escape.
  bool awaitCloud(const CloudLoader& loader);
  /// Shows the window until the user closes it. The scene must be built. False: @p message says what failed.
  bool run(std::string& message);

private:
  std::unique_ptr<ViewWindow> window_;
};

} // namespace app
} // namespace pointhaptics
