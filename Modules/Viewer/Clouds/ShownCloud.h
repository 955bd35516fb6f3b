/// @file
/// The points of a file as they are drawn: their shapes, colours and the way they are looked at.
#pragma once

#include "CloudColors.h"
#include "CloudLook.h"
#include "CloudOrientation.h"

#include "PointHapticsViewerModule.h" // For export macro

#include <vtkSmartPointer.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

class vtkPolyData;
class vtkSplatMapper;

namespace pointhaptics
{

/// Names of the arrays of ShownCloud::points.
constexpr const char* kSplatLengthName = "SplatLength"; ///< Diameter of each splat, unit of the file.
constexpr const char* kSplatNormalName = "SplatNormal"; ///< Short integers: kSplatNormalUnit is flat.
constexpr const char* kSplatGrowthName = "SplatGrowth"; ///< Bytes: 64 where the spacing alone rules.
constexpr const char* kLookColorName = "LookColor";
/// All of them: nobody asks what they are at a point.
constexpr std::array<const char*, 4> kArraysOfPicture = { kSplatLengthName, kSplatNormalName,
  kSplatGrowthName, kLookColorName };
constexpr double kSplatNormalUnit = 32767.0;

/// Memory beside the file's arrays: 10 bytes a point, 3 more for colours that are made, and as many as the
/// coordinates where some points are not drawn.
struct ShownCloud
{
  vtkSmartPointer<vtkPolyData> points; ///< In the frame of the file, without cells.
  CloudLook look;
  CloudColors colors;
  double medianSpacing = 0.0; ///< Of the points, unit of the file; 0: not measured.
  /// progressiveOrder() of them, made in the thread that reads; null: left to LevelOfDetail.
  std::shared_ptr<const std::vector<std::uint32_t>> order;
};

/// How a cloud is to be shown.
struct ShownRequest
{
  CloudOrientation orientation;
  std::string keptArray;             ///< To keep beside those that the colours need; empty: none.
  bool ignoresIntensity = false;     ///< Between samples of faces even noise is coherent.
  std::optional<CloudKind> kind;     ///< Instead of cloudKind(), where somebody says it.
  std::optional<CloudColors> colors; ///< Instead of chooseColors(): those of a coarse level shown before.
};

/// Leaves out points that tell nothing, measures the others and decides how they are shown. Of more than
/// three million points those within half a pixel of the first view share one measurement. @p goesOn is asked
/// with the part that is measured, 0 to 1. Null: it said no, or no point can be drawn.
POINTHAPTICSVIEWER_EXPORT std::shared_ptr<ShownCloud> makeShownCloud(
  vtkPolyData* cloud, const ShownRequest& request, const std::function<bool(double)>& goesOn);

/// The same without measuring, at once: all points as small discs, seen and coloured by what their bounds and
/// arrays tell. Null: no point can be drawn.
POINTHAPTICSVIEWER_EXPORT std::shared_ptr<ShownCloud> makePlainCloud(
  vtkPolyData* cloud, const ShownRequest& request);

/// makeShownCloud() in a thread of its own. All functions belong to one thread, the GUI's.
class POINTHAPTICSVIEWER_EXPORT ShownMeasurement
{
public:
  /// @p cloud is nobody else's; its arrays may be read by others. What was measured before is given up.
  void start(vtkSmartPointer<vtkPolyData> cloud, const ShownRequest& request);
  bool busy() const { return result_.valid(); }
  /// What was measured, once; null: not yet, or nothing is. @param waits until it is there.
  std::shared_ptr<ShownCloud> take(bool waits);
  /// Gives up what is measured and waits for the thread.
  void cancel();

  ShownMeasurement() = default;
  ~ShownMeasurement() { this->cancel(); }
  ShownMeasurement(const ShownMeasurement&) = delete;
  ShownMeasurement& operator=(const ShownMeasurement&) = delete;

private:
  std::atomic<bool> cancelled_{ false };
  std::future<std::shared_ptr<ShownCloud>> result_;
};

/// Lets @p mapper draw @p shown: its input, sizes, normals and light. The colours are the caller's.
POINTHAPTICSVIEWER_EXPORT void drawShown(const ShownCloud& shown, vtkSplatMapper* mapper);

/// Adds "Density" to the points, where they were measured: points in a square of one unit of the file.
POINTHAPTICSVIEWER_EXPORT void addDensity(vtkPolyData* points);

} // namespace pointhaptics
