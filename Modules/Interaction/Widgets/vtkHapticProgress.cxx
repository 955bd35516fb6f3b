#include "vtkHapticProgress.h"

#include "vtkCoordinate.h"
#include "vtkObjectFactory.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkHapticProgress);

namespace
{

// Pixels from the middle of the renderer.
constexpr double kHalfPlate = 190.0;
constexpr double kPlateTop = 54.0;
constexpr double kPlateBottom = -34.0;
constexpr double kHalfBar = 170.0;
constexpr double kBarTop = -6.0;
constexpr double kBarBottom = -20.0;
constexpr std::size_t kLongestText = 38;
constexpr int kFont = 15;
/// At which a point is a pixel.
constexpr double kPointsOfInch = 72.0;

/// The middle is what names of files of one series have in common.
std::string shortened(const std::string& text)
{
  if (text.size() <= kLongestText)
  {
    return text;
  }
  // Not within a character of UTF-8.
  const auto goesOn = [&](std::size_t i)
  { return i < text.size() && (static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80U; };
  std::size_t begin = kLongestText * 2 / 3;
  std::size_t end = text.size() - kLongestText / 3 + 3;
  while (begin > 0 && goesOn(begin))
  {
    --begin;
  }
  while (goesOn(end))
  {
    ++end;
  }
  return text.substr(0, begin) + "..." + text.substr(end);
}

} // namespace

vtkHapticProgress::vtkHapticProgress()
{
  this->PlaceBoxes();
  vtkTextProperty* style = this->Text->GetTextProperty();
  style->SetFontSize(kFont);
  style->SetColor(0.08, 0.08, 0.10);
  style->SetLineSpacing(1.15);
  style->SetJustificationToCentered();
  style->SetVerticalJustificationToBottom();
  for (vtkActor2D* actor : this->All())
  {
    actor->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
    actor->SetPosition(0.5, 0.5);
    actor->VisibilityOff();
  }
}

vtkHapticProgress::~vtkHapticProgress() = default;

void vtkHapticProgress::PlaceBoxes()
{
  const double s = this->Scale;
  const double end = -kHalfBar + 2.0 * kHalfBar * this->Percent / 100.0;
  this->Plate.place(-s * kHalfPlate, s * kHalfPlate, s * kPlateBottom, s * kPlateTop);
  this->Trough.place(-s * kHalfBar, s * kHalfBar, s * kBarBottom, s * kBarTop);
  this->Bar.place(-s * kHalfBar, s * end, s * kBarBottom, s * kBarTop);
}

std::array<vtkActor2D*, 4> vtkHapticProgress::All() const
{
  return { this->Plate.actor(), this->Trough.actor(), this->Bar.actor(), this->Text };
}

void vtkHapticProgress::Measure(vtkRenderer* renderer, double part, double size[2])
{
  const double pixels = renderer->GetVTKWindow() ? renderer->GetVTKWindow()->GetDPI() / kPointsOfInch : 1.0;
  const double scale = part * pixels;
  this->Text->GetTextProperty()->SetFontSize(std::max(1, int(part * kFont)));
  if (scale != this->Scale)
  {
    this->Scale = scale;
    this->PlaceBoxes();
  }
  size[0] = 2.0 * kHalfPlate * scale;
  size[1] = (kPlateTop - kPlateBottom) * scale;
}

void vtkHapticProgress::Place(vtkRenderer* renderer, double x, double y)
{
  const int* size = renderer->GetSize();
  const double middle = y - 0.5 * (kPlateTop + kPlateBottom) * this->Scale;
  for (vtkActor2D* actor : this->All())
  {
    actor->SetPosition(x / size[0], middle / size[1]);
  }
}

bool vtkHapticProgress::SetProgress(const std::string& what, double part)
{
  const double done = std::isfinite(part) ? std::clamp(part, 0.0, 1.0) : 0.0;
  const int percent = static_cast<int>(100.0 * done); // 100 only when all of it is done
  const std::string text = shortened(what) + "  " + std::to_string(percent) + " %\nEscape: cancel";
  if (text == this->ShownText)
  {
    return false;
  }
  this->ShownText = text;
  this->Text->SetInput(text.c_str());
  this->Percent = percent;
  this->PlaceBoxes();
  for (vtkActor2D* actor : this->All())
  {
    actor->VisibilityOn();
  }
  return true;
}

bool vtkHapticProgress::Hide()
{
  const bool wasSeen = !this->ShownText.empty();
  this->ShownText.clear();
  for (vtkActor2D* actor : this->All())
  {
    actor->VisibilityOff();
  }
  return wasSeen;
}

void vtkHapticProgress::AddTo(vtkRenderer* renderer)
{
  for (vtkActor2D* actor : this->All())
  {
    renderer->AddActor2D(actor);
  }
}

void vtkHapticProgress::RemoveFrom(vtkRenderer* renderer)
{
  for (vtkActor2D* actor : this->All())
  {
    renderer->RemoveActor2D(actor);
  }
}
