/// @file
/// `view` on a display: the window with the live touch.
#pragma once

#include "Options/ViewOptions.h"

#include <cstddef>
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

  /// Opens the window, empty but for a bar, until @p loader has something to take; @p title names what it
  /// reads. Again for the next cloud where one could not be read. False: the user closed the window or
  /// pressed Escape.
  bool awaitCloud(const CloudLoader& loader, const std::string& title);
  /// Shows the window until the user closes it, and @p news in its status until there are others. The scene
  /// must be built, of ViewOptions::filesOfCloud(@p cloud). False: @p message says what failed.
  bool run(std::size_t cloud, const std::string& news, std::string& message);

private:
  std::unique_ptr<ViewWindow> window_;
};

} // namespace app
} // namespace pointhaptics
