#include "vtkHapticOverlay.h"

#include "vtkCoordinate.h"
#include "vtkInteractorStyleHaptic.h"
#include "vtkObjectFactory.h"
#include "vtkRenderer.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"

#include <algorithm>
#include <sstream>
#include <vector>

vtkStandardNewMacro(vtkHapticOverlay);

namespace
{

void styleText(vtkTextProperty* text, int size, double plateOpacity)
{
  text->SetFontSize(size);
  text->SetColor(0.08, 0.08, 0.10);
  text->SetBackgroundColor(1.0, 1.0, 1.0);
  text->SetBackgroundOpacity(plateOpacity);
  text->SetLineSpacing(1.15);
}

/// Lines of one length: centred as a block, their columns stay in line; with a margin around.
std::string padded(const std::string& text)
{
  std::vector<std::string> lines;
  std::istringstream stream(text);
  std::size_t longest = 0;
  for (std::string line; std::getline(stream, line);)
  {
    longest = std::max(longest, line.size());
    lines.push_back(line);
  }
  std::string result(longest + 4, ' ');
  for (const std::string& line : lines)
  {
    result += "\n  " + line + std::string(longest - line.size() + 2, ' ');
  }
  return result + "\n" + std::string(longest + 4, ' ');
}

} // namespace

vtkHapticOverlay::vtkHapticOverlay()
{
  styleText(this->Status->GetTextProperty(), 15, 0.6);
  this->Status->GetTextProperty()->SetVerticalJustificationToTop();
  this->Status->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  this->Status->SetPosition(0.012, 0.985);
  this->Status->VisibilityOff();
  styleText(this->Help->GetTextProperty(), 16, 0.92);
  this->Help->GetTextProperty()->SetFontFamilyToCourier();
  this->Help->GetTextProperty()->SetJustificationToCentered();
  this->Help->GetTextProperty()->SetVerticalJustificationToCentered();
  this->Help->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  this->Help->SetPosition(0.5, 0.5);
  this->Help->VisibilityOff();
  this->SetHelp(vtkInteractorStyleHaptic::GetHelpText());
}

vtkHapticOverlay::~vtkHapticOverlay() = default;

bool vtkHapticOverlay::SetStatus(const std::string& text)
{
  if (text == this->StatusText)
  {
    return false;
  }
  this->StatusText = text;
  this->Status->SetInput(text.c_str());
  this->Status->SetVisibility(!text.empty());
  return true;
}

void vtkHapticOverlay::SetHelp(const std::string& text)
{
  this->Help->SetInput(padded(text).c_str());
}

void vtkHapticOverlay::SetHelpVisibility(bool visible)
{
  this->Help->SetVisibility(visible);
}

bool vtkHapticOverlay::GetHelpVisibility() const
{
  return const_cast<vtkTextActor*>(this->Help.Get())->GetVisibility() != 0;
}

void vtkHapticOverlay::AddTo(vtkRenderer* renderer)
{
  renderer->AddActor2D(this->Status);
  renderer->AddActor2D(this->Help);
}

void vtkHapticOverlay::RemoveFrom(vtkRenderer* renderer)
{
  renderer->RemoveActor2D(this->Status);
  renderer->RemoveActor2D(this->Help);
}

void vtkHapticOverlay::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Status: " << this->StatusText << "\n";
  os << indent << "HelpVisibility: " << this->GetHelpVisibility() << "\n";
}
