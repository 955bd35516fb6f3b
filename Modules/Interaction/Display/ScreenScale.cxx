#include "ScreenScale.h"

#include "XLibrary.h"

#include "vtkRenderWindow.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

namespace pointhaptics
{
namespace
{

constexpr double kUsualDotsPerInch = 96.0;
constexpr double kUsualHeight = 1080.0;
/// On screens with more lines than this usual texts are small: they have more dots an inch, or are looked at
/// from farther away.
constexpr int kTallScreen = 1440;
/// Height of a window in which all usual texts have room at once, lines.
constexpr double kLeastHeight = 600.0;
constexpr double kLargestScale = 4.0;
/// Part of the screen that a new window takes where it would be larger than the screen.
constexpr double kBesideFrame = 0.9;
/// Dots per inch at which a point is a pixel: VTK's default.
constexpr double kPointsPerInch = 72.0;

} // namespace

double dotsPerInchOf(const char* text)
{
  const char* const name = "Xft.dpi:";
  const char* found = text ? std::strstr(text, name) : nullptr;
  const double dots = found ? std::strtod(found + std::strlen(name), nullptr) : 0.0;
  return std::isfinite(dots) && dots > 0.0 ? dots : 0.0;
}

double scaleOfScreen(int screenLines, int windowLines)
{
  const double wanted = screenLines < kTallScreen ? 1.0 : screenLines / kUsualHeight;
  return std::clamp(windowLines / kLeastHeight, 1.0, wanted);
}

int lengthOnScreen(int wanted, int screen)
{
  return screen > 0 && wanted > screen ? int(kBesideFrame * screen) : wanted;
}

double screenScale(vtkRenderWindow* window)
{
  double scale = 1.0;
  if (window->GetOffScreenRendering())
  {
    scale = window->GetSize()[1] / kUsualHeight;
  }
  else if (xDisplayOf(window))
  {
    const double dots = dotsPerInchOf(desktopResources(window));
    scale =
      dots > 0.0 ? dots / kUsualDotsPerInch : scaleOfScreen(window->GetScreenSize()[1], window->GetSize()[1]);
  }
#if defined(_WIN32) || defined(__APPLE__)
  else
  {
    scale = window->DetectDPI() ? window->GetDPI() / kUsualDotsPerInch : 1.0;
  }
#endif
  return std::clamp(scale, 1.0, kLargestScale);
}

void applyTextScale(vtkRenderWindow* window, double factor)
{
  window->SetDPI(int(std::lround(kPointsPerInch * factor * screenScale(window))));
}

} // namespace pointhaptics
