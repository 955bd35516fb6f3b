#include "ColorMaps.h"

#include "CloudAppearance.h"

#include "vtkColorTransferFunction.h"
#include "vtkLookupTable.h"
#include "vtkNew.h"

namespace pointhaptics
{
namespace
{

constexpr int kColors = 256;

/// Blue at 0, red at 1, as on a thermometer.
void setRainbow(vtkLookupTable* colors)
{
  constexpr double kBlue = 2.0 / 3.0;
  colors->SetHueRange(kBlue, 0.0);
  colors->SetRampToLinear();
  colors->ForceBuild();
}

void setTable(vtkLookupTable* colors, vtkColorTransferFunction* function)
{
  for (int i = 0; i < kColors; ++i)
  {
    double color[3];
    function->GetColor(i / (kColors - 1.0), color);
    colors->SetTableValue(i, color[0], color[1], color[2], 1.0);
  }
}

} // namespace

const std::vector<std::string>& colorMapNames()
{
  static const std::vector<std::string> names = { "auto", "viridis", "cividis", "greys", "cool-warm",
    "rainbow" };
  return names;
}

vtkLookupTable* newColorMap(const std::string& name)
{
  if (name == "viridis")
  {
    return newCloudColorMap();
  }
  vtkLookupTable* colors = newGroundColorMap();
  vtkNew<vtkColorTransferFunction> function;
  if (name == "cividis")
  {
    // Ends and middle of the map of J. R. Nunez et al., 2018; between them straight in CIE L*a*b*.
    function->SetColorSpaceToLab();
    function->AddRGBPoint(0.0, 0.000, 0.135, 0.305);
    function->AddRGBPoint(0.5, 0.486, 0.482, 0.471);
    function->AddRGBPoint(1.0, 0.996, 0.909, 0.273);
    setTable(colors, function);
  }
  else if (name == "greys")
  {
    function->SetColorSpaceToRGB();
    function->AddRGBPoint(0.0, 0.22, 0.22, 0.22); // seen on black
    function->AddRGBPoint(1.0, 0.95, 0.95, 0.95);
    setTable(colors, function);
  }
  else if (name == "cool-warm")
  {
    function->SetColorSpaceToDiverging();
    function->AddRGBPoint(0.0, 0.230, 0.299, 0.754);
    function->AddRGBPoint(1.0, 0.706, 0.016, 0.150);
    setTable(colors, function);
  }
  else if (name == "rainbow")
  {
    setRainbow(colors);
  }
  return colors;
}

} // namespace pointhaptics
