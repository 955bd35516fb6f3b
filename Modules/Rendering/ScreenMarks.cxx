#include "ScreenMarks.h"

#include "vtkCamera.h"
#include "vtkCellData.h"
#include "vtkProperty2D.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkTextProperty.h"
#include "vtkWindow.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace
{
/// Estimated sizes of letters, over the font's size.
constexpr double kLetterWidth = 0.62;
constexpr double kLetterHeight = 1.25;
/// Dots per inch at which a point is a pixel.
constexpr double kPointsPerInch = 72.0;
/// Number of halvings that find the end of a line near the camera's plane, far outside the window.
constexpr int kHalvings = 12;

/// Projection of the eye whose picture is drawn; the camera's composite matrix leaves eyes out.
void eyeProjection(vtkRenderer* renderer, double nearest, double farthest, vtkMatrix4x4* matrix)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  vtkMatrix4x4::Multiply4x4(
    camera->GetProjectionTransformMatrix(renderer->GetTiledAspectRatio(), nearest, farthest),
    camera->GetViewTransformMatrix(), matrix);
}

bool isSideBySide(vtkRenderer* renderer)
{
  vtkRenderWindow* window = renderer->GetRenderWindow();
  return window && window->GetStereoRender() &&
    window->GetStereoType() == VTK_STEREO_SPLITVIEWPORT_HORIZONTAL;
}

} // namespace

CameraView::CameraView(vtkCamera* camera)
{
  camera->GetPosition(&eye.x);
  camera->GetFocalPoint(&focus.x);
  camera->GetDirectionOfProjection(&forward.x);
  camera->GetViewUp(&up.x);
}

double pixelsPerPoint(vtkRenderer* renderer)
{
  return renderer->GetVTKWindow() ? renderer->GetVTKWindow()->GetDPI() / kPointsPerInch : 1.0;
}

std::array<double, 2> placeInPicture(vtkRenderer* renderer, double x, double y)
{
  if (!isSideBySide(renderer))
  {
    return { x, y };
  }
  const double half = 0.5 * renderer->GetRenderWindow()->GetSize()[0];
  return { 2.0 * (x < half ? x : x - half), y };
}

void pointerProjection(vtkRenderer* renderer, double x, double nearest, double farthest, vtkMatrix4x4* matrix)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  if (!isSideBySide(renderer))
  {
    matrix->DeepCopy(
      camera->GetCompositeProjectionTransformMatrix(renderer->GetTiledAspectRatio(), nearest, farthest));
    return;
  }
  const int before = camera->GetLeftEye();
  camera->SetLeftEye(x < 0.5 * renderer->GetRenderWindow()->GetSize()[0]);
  eyeProjection(renderer, nearest, farthest, matrix);
  camera->SetLeftEye(before);
}

ScreenProjection::ScreenProjection(vtkRenderer* renderer, double x)
{
  pointerProjection(renderer, x, -1.0, 1.0, matrix_);
  width_ = renderer->GetSize()[0];
  height_ = renderer->GetSize()[1];
}

ScreenProjection::ScreenProjection(vtkRenderer* renderer)
{
  eyeProjection(renderer, -1.0, 1.0, matrix_);
  width_ = renderer->GetSize()[0];
  height_ = renderer->GetSize()[1];
}

Pixel ScreenProjection::operator()(const Vec3& p) const
{
  const double in[4] = { p.x, p.y, p.z, 1.0 };
  double out[4];
  matrix_->MultiplyPoint(in, out);
  Pixel pixel;
  pixel.seen = out[3] > 0.0;
  const double w = pixel.seen ? out[3] : 1.0;
  pixel.x = 0.5 * (out[0] / w + 1.0) * width_;
  pixel.y = 0.5 * (out[1] / w + 1.0) * height_;
  return pixel;
}

bool ScreenProjection::leaveSeenPart(Vec3& a, Vec3& b) const
{
  const bool seesA = (*this)(a).seen;
  const bool seesB = (*this)(b).seen;
  if (seesA != seesB)
  {
    Vec3 seen = seesA ? a : b;
    Vec3 behind = seesA ? b : a;
    for (int i = 0; i < kHalvings; ++i)
    {
      const Vec3 middle = 0.5 * (seen + behind);
      ((*this)(middle).seen ? seen : behind) = middle;
    }
    (seesA ? b : a) = seen;
  }
  return seesA || seesB;
}

ScreenLines::ScreenLines(float width)
{
  colors_->SetNumberOfComponents(3);
  shape_->SetPoints(points_);
  shape_->SetLines(cells_);
  shape_->GetCellData()->SetScalars(colors_);
  mapper_->SetInputData(shape_);
  mapper_->SetScalarModeToUseCellData();
  actor_->SetMapper(mapper_);
  actor_->GetProperty()->SetLineWidth(width);
  actor_->VisibilityOff();
}

void ScreenLines::clear()
{
  points_->Reset();
  cells_->Reset();
  colors_->Reset();
}

void ScreenLines::add(double x0, double y0, double x1, double y1, const unsigned char color[3])
{
  const vtkIdType ends[2] = { points_->InsertNextPoint(x0, y0, 0.0), points_->InsertNextPoint(x1, y1, 0.0) };
  cells_->InsertNextCell(2, ends);
  colors_->InsertNextTypedTuple(color);
}

void ScreenLines::finish()
{
  points_->Modified();
  cells_->Modified();
  colors_->Modified();
  shape_->Modified();
}

ScreenTexts::ScreenTexts()
{
  for (auto& text : texts_)
  {
    text->PickableOff();
    text->GetTextProperty()->SetBackgroundColor(0.93, 0.94, 0.95);
    text->GetTextProperty()->SetBackgroundOpacity(0.6);
    text->VisibilityOff();
  }
}

void ScreenTexts::addTo(vtkRenderer* renderer)
{
  for (auto& text : texts_)
  {
    renderer->AddActor2D(text);
  }
}

void ScreenTexts::removeFrom(vtkRenderer* renderer)
{
  for (auto& text : texts_)
  {
    renderer->RemoveActor2D(text);
  }
}

void ScreenTexts::hide()
{
  for (auto& text : texts_)
  {
    text->VisibilityOff();
  }
}

void ScreenTexts::clear(vtkRenderer* renderer, int fontSize)
{
  taken_.clear();
  used_ = 0;
  fontSize_ = fontSize;
  pixels_ = pointhaptics::pixelsPerPoint(renderer);
  width_ = renderer->GetSize()[0];
  height_ = renderer->GetSize()[1];
}

void ScreenTexts::finish()
{
  for (int i = used_; i < kMost; ++i)
  {
    texts_[std::size_t(i)]->VisibilityOff();
  }
}

double ScreenTexts::widthOf(const std::string& words) const
{
  return kLetterWidth * fontSize_ * pixels_ * double(words.size());
}

bool ScreenTexts::put(
  const std::string& words, double x, double y, double outX, double outY, const unsigned char color[3])
{
  const double width = widthOf(words);
  const double height = kLetterHeight * fontSize_ * pixels_;
  const int across = outX < -0.4 ? -1 : (outX > 0.4 ? 1 : 0);
  const int upward = outY < -0.4 ? -1 : (outY > 0.4 ? 1 : 0);
  const double left = x + 0.5 * (across - 1) * width;
  const double bottom = y + 0.5 * (upward - 1) * height;
  const Rectangle place{ left, left + width, bottom, bottom + height };
  const bool outside = place.left < 0.0 || place.right > width_ || place.bottom < 0.0 || place.top > height_;
  const auto meets = [&place](const Rectangle& other)
  {
    return place.left < other.right && other.left < place.right && place.bottom < other.top &&
      other.bottom < place.top;
  };
  if (used_ >= kMost || outside || std::any_of(taken_.begin(), taken_.end(), meets))
  {
    return false;
  }
  taken_.push_back(place);
  vtkTextActor* text = texts_[std::size_t(used_++)];
  vtkTextProperty* look = text->GetTextProperty();
  look->SetFontSize(fontSize_);
  look->SetColor(color[0] / 255.0, color[1] / 255.0, color[2] / 255.0);
  look->SetJustification(across < 0 ? VTK_TEXT_RIGHT : (across > 0 ? VTK_TEXT_LEFT : VTK_TEXT_CENTERED));
  look->SetVerticalJustification(
    upward < 0 ? VTK_TEXT_TOP : (upward > 0 ? VTK_TEXT_BOTTOM : VTK_TEXT_CENTERED));
  text->SetInput(words.c_str());
  text->SetPosition(std::round(x), std::round(y));
  text->VisibilityOn();
  return true;
}

} // namespace pointhaptics
