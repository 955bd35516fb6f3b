// The bar that explains the colours: its labels and its place.
#include "CloudAppearance.h"

#include "vtkLookupTable.h"
#include "vtkRenderer.h"
#include "vtkScalarBarActor.h"
#include "vtkTextProperty.h"
#include "vtkWindow.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <string>

namespace pointhaptics
{

static constexpr int kScalarBarFont = 15;
static constexpr double kLongest = 1e6; // others are written with an exponent

double widthOfOneValue(double value)
{
  return std::max(1e-12, 1e-9 * std::abs(value)); // a step of heights is far more, also of a northing
}

/// Format with which neighbouring labels, @p step apart, differ: three digits as a rule, and no point behind
/// the last. The step alone decides about the decimals and an exponent: a northing is large.
static std::string labelFormat(const double range[2], double step)
{
  constexpr double kThreeDigits = 99.5;
  constexpr double kLeastOfThree = 0.01;
  const double largest = std::max(std::abs(range[0]), std::abs(range[1]));
  if (!(step >= 1e-6 && step < kLongest) || (largest < kThreeDigits && step >= kLeastOfThree * largest))
  {
    return "%#.3g";
  }
  return "%." + std::to_string(std::clamp(int(std::ceil(-std::log10(step))), 0, 6)) + "f";
}

std::string rangeText(double low, double high)
{
  constexpr double kSteps = 3.0; // as between the labels of the bar
  const double range[2] = { low, high };
  std::string format = labelFormat(range, (high - low) / kSteps);
  format.erase(
    std::remove(format.begin(), format.end(), '#'), format.end()); // no zeros behind the last digit
  const auto text = [&format](double value)
  {
    char written[400]; // 309 digits at most
    std::snprintf(written, sizeof written, format.c_str(), value);
    return std::string(written);
  };
  return text(low) + " to " + text(high);
}

/// Sets the labels. Between whole numbers, such as counts and returns, all are whole. An array of one value
/// has one.
static void labelScalarBar(vtkScalarBarActor* bar)
{
  constexpr double kFew = 100.0;
  constexpr int kUsualLabels = 4;
  const double* range = bar->GetLookupTable() ? bar->GetLookupTable()->GetRange() : nullptr;
  const auto isWhole = [](double end) { return end == std::floor(end) && std::abs(end) < kLongest; };
  const bool areWhole = range && isWhole(range[0]) && isWhole(range[1]) && range[0] < range[1];
  if (range && range[1] - range[0] < 1.5 * widthOfOneValue(range[0]))
  {
    const double size = std::abs(range[0]);
    bar->SetNumberOfLabels(1);
    bar->SetLabelFormat(isWhole(range[0]) ? "%.0f " : size > 1e-4 && size < kLongest ? "%.6g " : "%.3g ");
    return;
  }
  int labels = kUsualLabels;
  if (areWhole && range[1] - range[0] < kFew)
  {
    const auto divides = [&](int count) { return std::fmod(range[1] - range[0], count - 1) == 0.0; };
    const int counts[] = { kUsualLabels, 5, 3, 6, 2 };
    labels = *std::find_if(std::begin(counts), std::end(counts), divides);
  }
  bar->SetNumberOfLabels(labels);
  const std::string format =
    areWhole || !range ? "%.0f " : labelFormat(range, (range[1] - range[0]) / std::max(1, labels - 1)) + " ";
  bar->SetLabelFormat(format.c_str());
}

void setUpScalarBar(vtkScalarBarActor* bar)
{
  bar->UnconstrainedFontSizeOn();
  for (vtkTextProperty* text :
    { bar->GetTitleTextProperty(), bar->GetLabelTextProperty(), bar->GetAnnotationTextProperty() })
  {
    text->SetFontSize(kScalarBarFont);
    text->SetColor(0.1, 0.1, 0.1);
    text->ItalicOff();
    text->BoldOff();
    text->ShadowOff();
  }
  labelScalarBar(bar);
}

/// True if names stand beside @p bar in the place of numbers.
static bool hasNames(vtkScalarBarActor* bar)
{
  return bar->GetLookupTable() && bar->GetLookupTable()->GetIndexedLookup();
}

namespace
{

constexpr double kPointsPerInch = 72.0; // at which a point is a pixel
constexpr double kTitleAbove = 0.75;    // VTK's title ends this much above its box, of the font's size
constexpr double kBarWidth = 24.0;      // points
constexpr double kNumberLetters = 9.0;  // -1.23e-05
constexpr double kLetterWidth = 0.57;   // of the font's size

/// Widths in points: of the box with the colours, over the middle of which the title stands, and of the names
/// beside it.
struct BarWidths
{
  double box = 0.0;
  double names = 0.0;
};

BarWidths widthsOf(vtkScalarBarActor* bar, double font)
{
  const double letter = kLetterWidth * font;
  const double title = letter * double(bar->GetTitle() ? std::strlen(bar->GetTitle()) : 0);
  BarWidths widths;
  widths.box = std::max(title, kBarWidth + (hasNames(bar) ? 0.0 : letter * kNumberLetters));
  for (vtkIdType i = 0; hasNames(bar) && i < bar->GetLookupTable()->GetNumberOfAnnotatedValues(); ++i)
  {
    constexpr double kLeader = 24.0;
    const double name = letter * double(bar->GetLookupTable()->GetAnnotation(i).size());
    widths.names = std::max(widths.names, kLeader + name);
  }
  return widths;
}

} // namespace

static void putScalarBar(
  vtkScalarBarActor* bar, vtkRenderer* renderer, double font, double pixelsPerPoint, const double box[4])
{
  labelScalarBar(bar);
  const BarWidths widths = widthsOf(bar, font);
  const double left = hasNames(bar) ? std::max(box[0], box[2] - pixelsPerPoint * widths.box) : box[0];
  const double width = box[2] - left;
  if (width > 0.0)
  {
    const int* size = renderer->GetSize();
    for (vtkTextProperty* text :
      { bar->GetTitleTextProperty(), bar->GetLabelTextProperty(), bar->GetAnnotationTextProperty() })
    {
      text->SetFontSize(int(font));
    }
    bar->SetPosition(left / size[0], box[1] / size[1]);
    bar->SetWidth(width / size[0]);
    bar->SetHeight((box[3] - box[1]) / size[1]);
    bar->SetBarRatio(std::min(1.0, kBarWidth * pixelsPerPoint / width));
    // All text stands away from the window's edge: numbers at the given position, names opposite to it.
    bar->SetTextPosition(
      hasNames(bar) ? vtkScalarBarActor::SucceedScalarBar : vtkScalarBarActor::PrecedeScalarBar);
  }
}

void placeScalarBar(vtkScalarBarActor* bar, vtkRenderer* renderer)
{
  constexpr double kMargin = 12.0;
  const double pixels = renderer->GetVTKWindow() ? renderer->GetVTKWindow()->GetDPI() / kPointsPerInch : 1.0;
  const double size = renderer->GetSize()[0];
  const double width = std::min(size, pixels * widthsOf(bar, kScalarBarFont).box);
  const double left = std::max(0.0, size - pixels * kMargin - width);
  const double height = renderer->GetSize()[1];
  const double box[4] = { left, 0.28 * height, left + width, 0.78 * height };
  putScalarBar(bar, renderer, kScalarBarFont, pixels, box);
}

void measureScalarBar(vtkScalarBarActor* bar, double font, double pixelsPerPoint, double size[2])
{
  constexpr double kLine = 1.5; // of the font's size
  constexpr double kLeastLines = 6.0;
  const BarWidths widths = widthsOf(bar, font);
  const double names = hasNames(bar) ? double(bar->GetLookupTable()->GetNumberOfAnnotatedValues()) : 0.0;
  size[0] = pixelsPerPoint * (widths.box + widths.names);
  size[1] = pixelsPerPoint * font * kLine * std::max(kLeastLines, names + 2.0);
}

void placeScalarBar(
  vtkScalarBarActor* bar, vtkRenderer* renderer, double font, double pixelsPerPoint, const double box[4])
{
  const double above = kTitleAbove * font * pixelsPerPoint;
  const double inner[4] = { box[0], box[1], box[2], box[3] - above };
  putScalarBar(bar, renderer, font, pixelsPerPoint, inner);
}

} // namespace pointhaptics
