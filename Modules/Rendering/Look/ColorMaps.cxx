#include "ColorMaps.h"

#include "vtkColorTransferFunction.h"
#include "vtkLookupTable.h"
#include "vtkNew.h"

#include <algorithm>

namespace pointhaptics
{
namespace
{

constexpr int kColors = 256;

// Viridis at 1/8 steps (BSD, from matplotlib, CC0), its last step replaced by a darker yellow for light
// backgrounds.
constexpr double kColorPoints[9][3] = { { 0.267, 0.005, 0.329 }, { 0.278, 0.175, 0.483 },
  { 0.231, 0.322, 0.546 }, { 0.173, 0.449, 0.558 }, { 0.128, 0.567, 0.551 }, { 0.153, 0.678, 0.506 },
  { 0.361, 0.785, 0.388 }, { 0.627, 0.842, 0.224 }, { 0.890, 0.840, 0.130 } };

// From blue through green and yellow to a pale red: even on a dark ground, where viridis begins unseen.
constexpr int kGroundSteps = 8;
constexpr double kGroundColors[kGroundSteps][3] = { { 0.24, 0.40, 0.70 }, { 0.22, 0.58, 0.76 },
  { 0.30, 0.70, 0.62 }, { 0.50, 0.78, 0.47 }, { 0.75, 0.83, 0.40 }, { 0.95, 0.80, 0.42 },
  { 0.98, 0.66, 0.45 }, { 0.97, 0.75, 0.70 } };

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

Vec3 groundColor(double position)
{
  const double scaled = (position > 0.0 ? std::min(position, 1.0) : 0.0) * (kGroundSteps - 1); // not NaN
  const int lower = std::min(kGroundSteps - 2, int(scaled));
  const double t = scaled - lower;
  const double* a = kGroundColors[lower];
  const double* b = kGroundColors[lower + 1];
  return { (1.0 - t) * a[0] + t * b[0], (1.0 - t) * a[1] + t * b[1], (1.0 - t) * a[2] + t * b[2] };
}

vtkLookupTable* newGroundColorMap()
{
  vtkLookupTable* colors = newCloudColorMap();
  for (int i = 0; i < 256; ++i)
  {
    const Vec3 color = groundColor(i / 255.0);
    colors->SetTableValue(i, color.x, color.y, color.z, 1.0);
  }
  return colors;
}

vtkLookupTable* newCloudColorMap()
{
  vtkLookupTable* colors = vtkLookupTable::New();
  colors->SetNumberOfTableValues(256);
  for (int i = 0; i < 256; ++i)
  {
    const double position = i / 255.0 * 8.0;
    const int lower = std::min(7, static_cast<int>(position));
    const double t = position - lower;
    double color[3];
    for (int c = 0; c < 3; ++c)
    {
      color[c] = (1.0 - t) * kColorPoints[lower][c] + t * kColorPoints[lower + 1][c];
    }
    colors->SetTableValue(i, color[0], color[1], color[2], 1.0);
  }
  colors->SetNanColor(0.5, 0.5, 0.5, 1.0);
  return colors;
}

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
