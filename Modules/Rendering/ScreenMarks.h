/// @file
/// Lines and texts in pixels of the viewport, placed anew for each picture.
#pragma once

#include "Core/Base/Vector3.h"

#include "PointHapticsRenderingModule.h" // For export macro

#include "vtkActor2D.h"
#include "vtkCellArray.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper2D.h"
#include "vtkTextActor.h"
#include "vtkUnsignedCharArray.h"

#include <array>
#include <string>
#include <vector>

class vtkCamera;
class vtkRenderer;

namespace pointhaptics
{

/// Where a camera is and how it looks; the directions are unit vectors.
struct POINTHAPTICSRENDERING_EXPORT CameraView
{
  explicit CameraView(vtkCamera* camera);
  Vec3 eye;
  Vec3 focus;
  Vec3 forward;
  Vec3 up; ///< As it was set: not across the view.
};

/// Transforms @p place by the affine @p matrix.
inline Vec3 transformed(vtkMatrix4x4* matrix, const Vec3& place)
{
  const double in[4] = { place.x, place.y, place.z, 1.0 };
  double out[4];
  matrix->MultiplyPoint(in, out);
  return { out[0], out[1], out[2] };
}

/// Color of a person's marks in a picture, and of the dark rim that shows on light points.
constexpr unsigned char kMarkColor[3] = { 255, 196, 40 };
constexpr unsigned char kMarkRim[3] = { 30, 30, 34 };

/// Pixels per point in the window of @p renderer, by its dots per inch.
POINTHAPTICSRENDERING_EXPORT double pixelsPerPoint(vtkRenderer* renderer);

/// Finds the place in the whole picture of an eye for a place of the window, both in pixels from the window's
/// lower left corner: two pictures may stand side by side.
POINTHAPTICSRENDERING_EXPORT std::array<double, 2> placeInPicture(vtkRenderer* renderer, double x, double y);
/// Gets the matrix from the picture's coordinates to -1 ... 1 across and up, and @p nearest ... @p farthest
/// along the view, for picking at @p x: that of the eye whose picture is there, or of one between both.
POINTHAPTICSRENDERING_EXPORT void pointerProjection(
  vtkRenderer* renderer, double x, double nearest, double farthest, vtkMatrix4x4* matrix);

struct Pixel
{
  double x = 0.0;
  double y = 0.0;
  bool seen = false; ///< True if it is in front of the camera.
};

/// Projects coordinates of the picture to pixels of the viewport, for the present camera and eye.
class POINTHAPTICSRENDERING_EXPORT ScreenProjection
{
public:
  explicit ScreenProjection(vtkRenderer* renderer);
  /// Projects for picking at @p x: see pointerProjection().
  ScreenProjection(vtkRenderer* renderer, double x);
  Pixel operator()(const Vec3& p) const;
  /// Cuts the line from @p a to @p b at the camera: moves the end that is not in front of it. False: none is.
  bool leaveSeenPart(Vec3& a, Vec3& b) const;

private:
  vtkNew<vtkMatrix4x4> matrix_;
  double width_ = 0.0;
  double height_ = 0.0;
};

/// Draws lines, each in its own colour.
class POINTHAPTICSRENDERING_EXPORT ScreenLines
{
public:
  explicit ScreenLines(float width);
  void clear();
  void add(double x0, double y0, double x1, double y1, const unsigned char color[3]);
  /// Completes the lines. Call it after the last add().
  void finish();
  vtkActor2D* actor() { return actor_; }

private:
  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> cells_;
  vtkNew<vtkUnsignedCharArray> colors_;
  vtkNew<vtkPolyData> shape_;
  vtkNew<vtkPolyDataMapper2D> mapper_;
  vtkNew<vtkActor2D> actor_;
};

/// Draws texts none of which lies over another or over the edge of the viewport.
class ScreenTexts
{
public:
  static constexpr int kMost = 48;

  ScreenTexts();
  void addTo(vtkRenderer* renderer);
  void removeFrom(vtkRenderer* renderer);
  /// Hides the texts until the next put().
  void hide();

  /// Begins a new picture, with room everywhere.
  void clear(vtkRenderer* renderer, int fontSize);
  /// Puts a text with its nearest corner or side at (@p x, @p y), on the side of the direction out. False:
  /// there is no room.
  bool put(
    const std::string& words, double x, double y, double outX, double outY, const unsigned char color[3]);
  /// Takes a place: left, bottom, right, top. No text is put there.
  void take(const std::array<double, 4>& place)
  {
    taken_.push_back({ place[0], place[2], place[1], place[3] });
  }
  /// Completes the texts. Call it after the last put().
  void finish();
  /// Pixels per point, by the window's dots per inch.
  double pixelsPerPoint() const { return pixels_; }
  /// Estimated width, pixels.
  double widthOf(const std::string& words) const;

private:
  struct Rectangle
  {
    double left;
    double right;
    double bottom;
    double top;
  };

  std::array<vtkNew<vtkTextActor>, kMost> texts_;
  int used_ = 0;
  int fontSize_ = 13;
  double pixels_ = 1.0;
  double width_ = 0.0;
  double height_ = 0.0;
  std::vector<Rectangle> taken_;
};

} // namespace pointhaptics
