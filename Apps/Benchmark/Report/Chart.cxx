#include "Benchmark/Report/Chart.h"

#include "Benchmark/Report/Table.h"

#include <fmt/format.h>

#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkChartLegend.h>
#include <vtkChartXY.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPen.h>
#include <vtkPlotLine.h>
#include <vtkPlotPoints.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace bench
{
namespace
{

/// A line of more points is drawn without their marks: they would hide it.
constexpr vtkIdType kMostMarks = 60;
/// Okabe and Ito's palette: told apart with every kind of colour vision.
constexpr unsigned char kColors[8][3] = { { 0, 0, 0 }, { 213, 94, 0 }, { 0, 114, 178 }, { 0, 158, 115 },
  { 204, 121, 167 }, { 230, 159, 0 }, { 86, 180, 233 }, { 120, 120, 120 } };
constexpr int kMarks[3] = { vtkPlotPoints::CIRCLE, vtkPlotPoints::SQUARE, vtkPlotPoints::DIAMOND };
constexpr double kDark = 0.2;

struct Range
{
  double low = INFINITY;
  double high = -INFINITY;

  void include(double value)
  {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

bool canBeDrawn(const Chart& chart, double x, double y)
{
  return std::isfinite(x) && std::isfinite(y) && !(chart.x.logarithmic && x <= 0.0) &&
    !(chart.y.logarithmic && y <= 0.0);
}

void styleText(vtkTextProperty* text, int size)
{
  text->SetColor(kDark, kDark, kDark);
  text->SetFontSize(size);
  text->BoldOff();
}

/// 0.001, 20, 100,000; powers of ten beyond them as 1e-5.
std::string labelOf(double value)
{
  if (value >= 1000.0 && value < 1e9 && value == std::floor(value))
  {
    return grouped(static_cast<long long>(value));
  }
  const int power = int(std::floor(std::log10(value) + 1e-9));
  const bool isShort = value <= 0.0 || (power >= -3 && power < 9);
  return isShort ? fmt::format("{:g}", value) : fmt::format("{:g}e{}", value / std::pow(10.0, power), power);
}

/// Powers of ten, with 2 and 5 between them where there are few. @p range is that of the logarithms.
std::vector<double> logarithmicTicks(const Range& range)
{
  const int first = int(std::floor(range.low));
  const int last = int(std::ceil(range.high));
  const int step = std::max(1, (last - first + 7) / 8);
  std::vector<double> ticks;
  for (int power = first; power <= last; power += step)
  {
    for (const int digit : { 1, 2, 5 })
    {
      if (digit == 1 || last - first <= 2)
      {
        ticks.push_back(digit * std::pow(10.0, power));
      }
    }
  }
  return ticks;
}

/// Labels of ticks too near the last one's on a horizontal axis are left out.
void placeTicks(vtkAxis* axis, const std::vector<double>& ticks, const Range& range, bool logarithmic)
{
  // Of an axis, at the size of labels and pictures here.
  constexpr double kCharacter = 0.0125;
  const double character = axis->GetPosition() == vtkAxis::BOTTOM ? kCharacter : 0.0;
  vtkNew<vtkDoubleArray> places;
  vtkNew<vtkStringArray> labels;
  double free = -1.0;
  for (const double tick : ticks)
  {
    const double place = logarithmic ? std::log10(tick) : tick;
    if (place < range.low || place > range.high)
    {
      continue;
    }
    const std::string label = labelOf(tick);
    const double middle = (place - range.low) / (range.high - range.low);
    const double half = 0.5 * character * double(label.size());
    const bool fits = middle - half >= free;
    free = fits ? middle + half + character : free;
    places->InsertNextValue(place);
    labels->InsertNextValue(fits ? label : "");
  }
  axis->SetCustomTickPositions(places, labels);
}

void styleAxis(vtkAxis* axis, const ChartAxis& wanted, Range range, bool fromZero)
{
  axis->SetTitle(wanted.title);
  styleText(axis->GetTitleProperties(), 16);
  styleText(axis->GetLabelProperties(), 14);
  axis->GetGridPen()->SetColor(225, 225, 225);
  axis->GetPen()->SetColor(90, 90, 90);
  axis->SetBehavior(vtkAxis::FIXED);
  // On a logarithmic axis the values are logarithms already: vtkAxis's own scale labels small ranges badly.
  const double margin = wanted.logarithmic ? std::max(0.04 * (range.high - range.low),
                                               0.5 * (1.0 - range.high + range.low)) // a decade at least
                                           : 0.05 * (range.high - range.low);
  range.low = wanted.logarithmic || !fromZero ? range.low - margin : std::min(0.0, range.low);
  range.high = wanted.logarithmic || !fromZero || range.high > 0.0 ? range.high + margin : 1.0;
  axis->SetRange(range.low, range.high);
  if (wanted.logarithmic || !wanted.ticks.empty())
  {
    placeTicks(
      axis, wanted.ticks.empty() ? logarithmicTicks(range) : wanted.ticks, range, wanted.logarithmic);
  }
}

vtkSmartPointer<vtkTable> tableOf(const Chart& chart, const Series& series, Range& xRange, Range& yRange)
{
  auto table = vtkSmartPointer<vtkTable>::New();
  vtkNew<vtkDoubleArray> xs, ys;
  xs->SetName("x");
  ys->SetName(series.name.c_str());
  for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i)
  {
    if (canBeDrawn(chart, series.x[i], series.y[i]))
    {
      const double x = chart.x.logarithmic ? std::log10(series.x[i]) : series.x[i];
      const double y = chart.y.logarithmic ? std::log10(series.y[i]) : series.y[i];
      xs->InsertNextValue(x);
      ys->InsertNextValue(y);
      xRange.include(x);
      yRange.include(y);
    }
  }
  table->AddColumn(xs);
  table->AddColumn(ys);
  return table;
}

void addSeries(vtkChartXY* chart, vtkTable* table, const Series& series, std::size_t index)
{
  const unsigned char* color = kColors[index % 8];
  // vtkContext2D takes a line of fewer than two points for an error.
  const bool joined = series.line && table->GetNumberOfRows() > 1;
  vtkPlot* plot = chart->AddPlot(joined ? vtkChart::LINE : vtkChart::POINTS);
  plot->SetInputData(table, 0, 1);
  plot->SetLabel(series.name);
  plot->SetColor(color[0], color[1], color[2], 255);
  plot->SetWidth(2.5f);
  if (auto* points = vtkPlotPoints::SafeDownCast(plot))
  {
    const bool dense = joined && table->GetNumberOfRows() > kMostMarks;
    points->SetMarkerStyle(dense ? int(vtkPlotPoints::NONE) : int(kMarks[index % 3]));
    points->SetMarkerSize(joined ? 9.0f : 14.0f);
  }
}

void styleLegend(vtkChartXY* chart)
{
  chart->SetShowLegend(true);
  vtkChartLegend* legend = chart->GetLegend();
  legend->SetInline(false);
  legend->SetHorizontalAlignment(vtkChartLegend::RIGHT);
  legend->SetVerticalAlignment(vtkChartLegend::TOP);
  legend->SetLabelSize(14);
  legend->GetPen()->SetColor(200, 200, 200);
}

/// Widens the range of one axis until a unit is as long on the other. @pre drawn once
void equalizeScales(vtkChartXY* chart)
{
  vtkAxis* axes[2] = { chart->GetAxis(vtkAxis::BOTTOM), chart->GetAxis(vtkAxis::LEFT) };
  double pixels[2];
  double unit = INFINITY;
  for (int i = 0; i < 2; ++i)
  {
    pixels[i] = std::abs(axes[i]->GetPoint2()[i] - axes[i]->GetPoint1()[i]);
    unit = std::min(unit, pixels[i] / (axes[i]->GetMaximum() - axes[i]->GetMinimum()));
  }
  for (int i = 0; i < 2; ++i)
  {
    const double middle = 0.5 * (axes[i]->GetMaximum() + axes[i]->GetMinimum());
    axes[i]->SetRange(middle - 0.5 * pixels[i] / unit, middle + 0.5 * pixels[i] / unit);
  }
}

/// @param chart whose scales are to be equal, or null.
bool writeImage(vtkRenderer* renderer, vtkChartXY* chart, const std::string& fileName, int width, int height)
{
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(width, height);
  window->AddRenderer(renderer);
  window->Render();
  if (chart)
  {
    equalizeScales(chart);
    window->Render();
  }
  vtkNew<vtkWindowToImageFilter> grabber;
  grabber->SetInput(window);
  grabber->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(grabber->GetOutputPort());
  writer->SetFileName(fileName.c_str());
  writer->Write();
  window->RemoveRenderer(renderer);
  return writer->GetErrorCode() == 0;
}

} // namespace

void addPoint(std::vector<Series>& series, const std::string& name, double x, double y)
{
  const auto found = std::find_if(
    series.begin(), series.end(), [&](const Series& candidate) { return candidate.name == name; });
  Series& target = found == series.end() ? series.emplace_back() : *found;
  target.name = name;
  target.x.push_back(x);
  target.y.push_back(y);
}

bool writePng(const Chart& chart, const std::string& fileName, int width, int height)
{
  vtkNew<vtkChartXY> view;
  Range xRange, yRange;
  std::size_t drawn = 0;
  for (std::size_t i = 0; i < chart.series.size(); ++i)
  {
    const vtkSmartPointer<vtkTable> table = tableOf(chart, chart.series[i], xRange, yRange);
    if (table->GetNumberOfRows() > 0)
    {
      addSeries(view, table, chart.series[i], i);
      ++drawn;
    }
  }
  if (drawn == 0)
  {
    return false;
  }
  view->SetTitle(chart.title);
  styleText(view->GetTitleProperties(), 18);
  styleAxis(view->GetAxis(vtkAxis::BOTTOM), chart.x, xRange, !chart.isMap);
  styleAxis(view->GetAxis(vtkAxis::LEFT), chart.y, yRange, !chart.isMap);
  styleLegend(view);
  view->GetBackgroundBrush()->SetColor(255, 255, 255, 255);
  vtkNew<vtkContextActor> actor;
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1.0, 1.0, 1.0);
  renderer->AddActor(actor);
  actor->GetScene()->AddItem(view);
  actor->GetScene()->SetRenderer(renderer);
  return writeImage(renderer, chart.isMap ? view.Get() : nullptr, fileName, width, height);
}

} // namespace bench
} // namespace pointhaptics
