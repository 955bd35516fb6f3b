/// @file
/// The points of a file as they are drawn: their shapes, colours and the way they are looked at.
#pragma once

#include "CloudColors.h"
#include "CloudLook.h"
#include "CloudOrientation.h"
#include "PictureSettings.h"
#include "ProgressiveOrder.h"
#include "SplatLook.h"

#include "PointHapticsViewerModule.h" // For export macro

#include <vtkSmartPointer.h>

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

/// Memory beside the file's arrays: 12 bytes a point, 3 more for colours that are made, and as many as the
/// coordinates where some points are not drawn.
struct ShownCloud
{
  vtkSmartPointer<vtkPolyData> points; ///< In the frame of the file, without cells.
  CloudLook look;
  CloudColors colors;
  double medianSpacing = 0.0; ///< Median spacing of the points, unit of the file; 0: not measured.
  /// progressiveOrder() of them, made in the thread that reads; null: left to LevelOfDetail.
  std::shared_ptr<const ProgressiveOrder> order;
};

/// Request for the look of a cloud.
struct ShownRequest
{
  CloudOrientation orientation;
  std::string keptArray;            ///< Array that is kept beside those that the colours need; empty: none.
  std::vector<HiddenValues> hidden; ///< Their arrays are kept, too.
  /// Names of all arrays that are kept, as findColorSource() takes them.
  std::vector<std::string> keptArrays() const;
  bool ignoresIntensity = false; ///< Colours take no intensity: between samples of faces noise is coherent.
  std::optional<CloudKind> kind; ///< Kind in place of cloudKind(), where the user chose it.
  std::optional<CloudColors> colors; ///< Colours in place of chooseColors(): those of a coarse level shown
                                     ///< before.
};

/// Leaves out points that tell nothing, measures the others and decides how they are shown. Of more than
/// three million points those within half a pixel of the first view share one measurement. @p goesOn is asked
/// with the part that is measured, 0 to 1. Null: it said no, or no point can be drawn.
POINTHAPTICSVIEWER_EXPORT std::shared_ptr<ShownCloud> makeShownCloud(
  vtkPolyData* cloud, const ShownRequest& request, const std::function<bool(double)>& goesOn);

/// As makeShownCloud() without measuring, at once: all points are small discs, and bounds and arrays decide
/// colours and camera. Null: no point can be drawn.
POINTHAPTICSVIEWER_EXPORT std::shared_ptr<ShownCloud> makePlainCloud(
  vtkPolyData* cloud, const ShownRequest& request);

/// makeShownCloud() in a thread of its own, once. One thread at a time asks for it.
class POINTHAPTICSVIEWER_EXPORT ShownMeasurement
{
public:
  /// Starts to measure @p cloud, which nobody else holds; others may read its arrays.
  void start(vtkSmartPointer<vtkPolyData> cloud, const ShownRequest& request);
  /// @param waits until it is.
  bool isReady(bool waits) const;
  /// Part that is done, 0 to 1.
  double part() const { return part_; }
  /// The measured cloud, once; null: memory ran out. @pre isReady().
  std::shared_ptr<ShownCloud> take() { return result_.get(); }

  ShownMeasurement() = default;
  /// Gives up the measurement and waits for the thread.
  ~ShownMeasurement();
  ShownMeasurement(const ShownMeasurement&) = delete;
  ShownMeasurement& operator=(const ShownMeasurement&) = delete;

private:
  std::atomic<bool> cancelled_{ false };
  std::atomic<double> part_{ 0.0 };
  std::future<std::shared_ptr<ShownCloud>> result_;
};

/// Lets @p mapper draw @p shown: its input, sizes, normals and light. The colours are the caller's.
POINTHAPTICSVIEWER_EXPORT void drawShown(const ShownCloud& shown, vtkSplatMapper* mapper);

} // namespace pointhaptics
