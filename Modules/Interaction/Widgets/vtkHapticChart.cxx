#include "vtkHapticChart.h"

#include "PngFile.h"

#include "vtkAxis.h"
#include "vtkBrush.h"
#include "vtkChartLegend.h"
#include "vtkChartXY.h"
#include "vtkContextActor.h"
#include "vtkContextScene.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPen.h"
#include "vtkPlot.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkTable.h"
#include "vtkTextProperty.h"
#include "vtkTextRenderer.h"
#include "vtkWindow.h"
#include "vtkWindowToImageFilter.h"

#include <algorithm>
#include <deque>
#include <initializer_list>

namespace
{

constexpr int kSlices = 600;
constexpr int kIdealPlot = 2; // of the chart; 0 and 1 are radius and force
/// A chart lower than this, points, has few labels beside it.
constexpr double kLow = 150.0;
constexpr double kPointsPerInch = 72.0;
constexpr int kFontSize = 13;
constexpr int kSmallestFontSize = 7;
constexpr int kVtkBorder = 20; // pixels, beside an axis that is not shown

struct Sample
{
  double seconds;
  double newtons;
  double metres;
  double idealNewtons; // NaN: not known
};

void styleAxis(vtkAxis* axis, const char* title, const unsigned char color[3])
{
  axis->SetTitle(title);
  vtkTextProperty* texts[2] = { axis->GetTitleProperties(), axis->GetLabelProperties() };
  for (vtkTextProperty* text : texts)
  {
    text->SetColor(color[0] / 255.0, color[1] / 255.0, color[2] / 255.0);
    text->SetFontSize(kFontSize);
    text->BoldOff();
  }
  axis->GetPen()->SetColor(90, 90, 90);
}

/// Returns the next number at or above @p value that is one of @p steps times a power of ten.
double roundUp(double value, std::initializer_list<double> steps)
{
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (double step : steps)
  {
    if (value <= step * power * (1.0 + 1e-12))
    {
      return step * power;
    }
  }
  return 10.0 * power;
}

/// Sets the range of an axis. Beside a @p low axis VTK has room for two labels, 1, 2 or 5 apart: other ranges
/// would have only the label of 0.
void setRange(vtkAxis* axis, double largest, double smallestRange, bool low)
{
  const double needed = std::max(smallestRange, 1.05 * largest);
  axis->SetBehavior(vtkAxis::FIXED);
  axis->SetRange(0.0,
    low ? roundUp(needed, { 1.0, 2.0, 5.0 }) : roundUp(needed, { 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0 }));
}

} // namespace

struct vtkHapticChart::Internals
{
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkContextActor> actor;
  vtkNew<vtkChartXY> chart;
  vtkNew<vtkTable> table;
  vtkNew<vtkFloatArray> time;
  vtkNew<vtkFloatArray> force;
  vtkNew<vtkFloatArray> radius;
  vtkNew<vtkFloatArray> ideal;
  std::deque<Sample> samples;
  bool isDark = false;
  bool wasFlat = false;
  int fittedHeight = 0; // of the renderer whose texts fit, pixels,
  int fittedDpi = 0;    // and of its window

  void fill(double begin, double end);
  bool isFlat() const;
  bool isLow() const;
  void fitTexts();
};

bool vtkHapticChart::Internals::isLow() const
{
  vtkRenderer* drawn = this->renderer;
  vtkWindow* window = drawn->GetVTKWindow();
  return window && drawn->GetSize()[1] * kPointsPerInch < kLow * window->GetDPI();
}

/// Fits the texts into the chart: the label at the top of an axis, half of which is above it, and the upright
/// titles. Titles have one size, the largest that all of them fit in.
void vtkHapticChart::Internals::fitTexts()
{
  vtkRenderer* drawn = this->renderer;
  vtkWindow* window = drawn->GetVTKWindow();
  if (!window || (drawn->GetSize()[1] == this->fittedHeight && window->GetDPI() == this->fittedDpi))
  {
    return;
  }
  this->fittedHeight = drawn->GetSize()[1];
  this->fittedDpi = window->GetDPI();
  const double letter = kFontSize * this->fittedDpi / kPointsPerInch;
  const int above = std::max(kVtkBorder, static_cast<int>(std::ceil(0.75 * letter)));
  this->chart->SetHiddenAxisBorder(above);
  // Below the axis are a row of labels and a title; twice the way from its middle to the nearer edge.
  const double room = this->fittedHeight + above - 3.5 * letter;
  double fitting = kFontSize;
  for (const int which : { vtkAxis::LEFT, vtkAxis::RIGHT })
  {
    vtkAxis* axis = this->chart->GetAxis(which);
    vtkNew<vtkTextProperty> upright;
    upright->ShallowCopy(axis->GetTitleProperties());
    upright->SetOrientation(0.0);
    upright->SetFontSize(kFontSize);
    int box[4] = {};
    vtkTextRenderer* texts = vtkTextRenderer::GetInstance();
    if (texts && texts->GetBoundingBox(upright, axis->GetTitle(), box, this->fittedDpi))
    {
      fitting = std::min(fitting, kFontSize * room / std::max(1, box[1] - box[0]));
    }
  }
  for (const int which : { vtkAxis::LEFT, vtkAxis::RIGHT, vtkAxis::BOTTOM })
  {
    this->chart->GetAxis(which)->GetTitleProperties()->SetFontSize(
      std::max(kSmallestFontSize, static_cast<int>(fitting)));
  }
}

/// Fills the table: one row for each slice that has samples.
void vtkHapticChart::Internals::fill(double begin, double end)
{
  this->time->Reset();
  this->force->Reset();
  this->radius->Reset();
  this->ideal->Reset();
  bool knowsIdeal = false;
  const double width = std::max(1e-9, end - begin) / kSlices;
  std::size_t i = 0;
  while (i < this->samples.size())
  {
    const double slice = std::floor((this->samples[i].seconds - begin) / width);
    double peak = 0.0;
    double idealPeak = 0.0;
    double sum = 0.0;
    double moment = 0.0;
    std::size_t count = 0;
    for (; i < this->samples.size() && std::floor((this->samples[i].seconds - begin) / width) == slice; ++i)
    {
      peak = std::max(peak, this->samples[i].newtons);
      knowsIdeal = knowsIdeal || std::isfinite(this->samples[i].idealNewtons);
      idealPeak = std::fmax(idealPeak, this->samples[i].idealNewtons); // NaN counts as none
      sum += this->samples[i].metres;
      moment += this->samples[i].seconds;
      ++count;
    }
    this->time->InsertNextValue(static_cast<float>(moment / count));
    this->force->InsertNextValue(static_cast<float>(peak));
    this->radius->InsertNextValue(static_cast<float>(1e3 * sum / count));
    this->ideal->InsertNextValue(static_cast<float>(idealPeak));
  }
  for (int plot = 0; plot < 2; ++plot)
  {
    // vtkContext2D reports a line of fewer than two points as an error.
    this->chart->GetPlot(plot)->SetVisible(this->time->GetNumberOfTuples() > 1);
  }
  knowsIdeal = knowsIdeal && this->time->GetNumberOfTuples() > 1;
  this->chart->GetPlot(kIdealPlot)->SetVisible(knowsIdeal);
  this->chart->SetShowLegend(knowsIdeal);
  this->table->Modified();
}

bool vtkHapticChart::Internals::isFlat() const
{
  for (const Sample& sample : this->samples)
  {
    if (sample.newtons > 1e-3 || std::abs(sample.metres - this->samples.front().metres) > 1e-6)
    {
      return false;
    }
  }
  return true;
}

vtkStandardNewMacro(vtkHapticChart);

vtkHapticChart::vtkHapticChart()
  : Parts(new Internals)
{
  Internals& parts = *this->Parts;
  parts.time->SetName("time");
  parts.force->SetName("force (N)");
  parts.radius->SetName("proxy radius (mm)");
  parts.table->AddColumn(parts.time);
  parts.table->AddColumn(parts.force);
  parts.ideal->SetName("ideal force (N)");
  parts.table->AddColumn(parts.radius);
  parts.table->AddColumn(parts.ideal);
  vtkPlot* radius = parts.chart->AddPlot(vtkChart::LINE);
  radius->SetInputData(parts.table, 0, 2);
  radius->SetWidth(2.0f);
  parts.chart->SetPlotCorner(radius, 1); // bottom and right axes
  vtkPlot* force = parts.chart->AddPlot(vtkChart::LINE);
  force->SetInputData(parts.table, 0, 1);
  force->SetWidth(2.0f);
  vtkPlot* ideal = parts.chart->AddPlot(vtkChart::LINE);
  ideal->SetInputData(parts.table, 0, 3);
  ideal->SetWidth(1.5f);
  ideal->GetPen()->SetLineType(vtkPen::DASH_LINE);
  ideal->SetVisible(false);
  vtkChartLegend* legend = parts.chart->GetLegend();
  // The legend stands beside the curves, which may be anywhere in the plot.
  legend->SetInline(false);
  legend->SetHorizontalAlignment(vtkChartLegend::RIGHT);
  legend->SetVerticalAlignment(vtkChartLegend::TOP);
  legend->GetLabelProperties()->SetFontSize(12);
  legend->GetBrush()->SetOpacityF(0.6);
  legend->GetPen()->SetLineType(vtkPen::NO_PEN);
  parts.chart->GetAxis(vtkAxis::RIGHT)->SetGridVisible(false);
  parts.chart->SetInteractive(false);
  parts.actor->GetScene()->AddItem(parts.chart);
  parts.renderer->AddActor(parts.actor);
  parts.renderer->InteractiveOff();
  parts.actor->GetScene()->SetRenderer(parts.renderer);
  this->ApplyColors();
  this->Update();
}

vtkHapticChart::~vtkHapticChart() = default;

void vtkHapticChart::SetVisibility(bool visible)
{
  this->Parts->renderer->SetDraw(visible);
}

bool vtkHapticChart::GetVisibility() const
{
  return this->Parts->renderer->GetDraw() != 0;
}

bool vtkHapticChart::SetDark(bool dark)
{
  const bool changes = dark != this->Parts->isDark;
  if (changes)
  {
    this->Parts->isDark = dark;
    this->ApplyColors();
  }
  return changes;
}

void vtkHapticChart::ApplyColors()
{
  Internals& parts = *this->Parts;
  const unsigned char ground[2][3] = { { 255, 255, 255 }, { 32, 34, 40 } };
  const unsigned char grid[2][3] = { { 225, 225, 225 }, { 62, 66, 74 } };
  const unsigned char ink[2][3] = { { 60, 60, 60 }, { 224, 227, 232 } };
  const unsigned char curves[2][3][3] = { { { 190, 30, 110 }, { 205, 85, 0 }, { 20, 90, 200 } },
    { { 255, 120, 190 }, { 255, 140, 50 }, { 110, 175, 255 } } };
  const int which = parts.isDark ? 1 : 0;
  for (int plot = 0; plot < 3; ++plot)
  {
    const unsigned char* color = curves[which][plot];
    parts.chart->GetPlot(plot)->SetColor(color[0], color[1], color[2], 255);
  }
  styleAxis(parts.chart->GetAxis(vtkAxis::LEFT), "force (N)", curves[which][1]);
  styleAxis(parts.chart->GetAxis(vtkAxis::BOTTOM), "time (s)", ink[which]);
  styleAxis(parts.chart->GetAxis(vtkAxis::RIGHT), "radius (mm)", curves[which][0]);
  for (const int axis : { vtkAxis::LEFT, vtkAxis::BOTTOM, vtkAxis::RIGHT })
  {
    parts.chart->GetAxis(axis)->GetGridPen()->SetColor(grid[which][0], grid[which][1], grid[which][2]);
  }
  const unsigned char* back = ground[which];
  parts.chart->GetBackgroundBrush()->SetColor(back[0], back[1], back[2], 255);
  parts.renderer->SetBackground(back[0] / 255.0, back[1] / 255.0, back[2] / 255.0);
  const double words = parts.isDark ? 0.88 : 0.0;
  parts.chart->GetLegend()->GetLabelProperties()->SetColor(words, words, words);
  parts.chart->GetLegend()->GetBrush()->SetColor(back[0], back[1], back[2]);
  parts.fittedHeight = 0;
  parts.fitTexts(); // at once: Update() may find nothing else to change
}

vtkRenderer* vtkHapticChart::GetRenderer()
{
  return this->Parts->renderer;
}

void vtkHapticChart::SetForceNames(const char* force, const char* other)
{
  Internals& parts = *this->Parts;
  parts.force->SetName(force);
  parts.ideal->SetName(other);
  parts.chart->GetPlot(1)->SetInputData(parts.table, 0, 1);
  parts.chart->GetPlot(kIdealPlot)->SetInputData(parts.table, 0, 3);
}

void vtkHapticChart::AddSample(double seconds, double newtons, double metres, double idealNewtons)
{
  if (std::isfinite(seconds) && std::isfinite(newtons) && std::isfinite(metres))
  {
    std::deque<Sample>& samples = this->Parts->samples;
    samples.push_back({ seconds, newtons, metres, idealNewtons });
    while (this->Paused && this->TimeWindow > 0.0 && samples.front().seconds < seconds - this->TimeWindow)
    {
      samples.pop_front(); // nobody will see them: a long pause must not fill the memory
    }
  }
}

bool vtkHapticChart::Update()
{
  Internals& parts = *this->Parts;
  if (this->Paused)
  {
    return false;
  }
  double begin = 0.0;
  double end = this->TimeWindow > 0.0 ? this->TimeWindow : 1.0;
  if (!parts.samples.empty())
  {
    const double newest = parts.samples.back().seconds;
    if (this->TimeWindow > 0.0)
    {
      while (parts.samples.front().seconds < newest - this->TimeWindow)
      {
        parts.samples.pop_front();
      }
      end = std::max(newest, this->TimeWindow);
      begin = end - this->TimeWindow;
    }
    else
    {
      begin = parts.samples.front().seconds;
      end = std::max(newest, begin + 1e-3);
    }
  }
  const bool flat = parts.isFlat();
  const bool changed = !(flat && parts.wasFlat);
  parts.wasFlat = flat && !parts.samples.empty();
  parts.fill(begin, end);
  vtkAxis* bottom = parts.chart->GetAxis(vtkAxis::BOTTOM);
  bottom->SetBehavior(vtkAxis::FIXED);
  bottom->SetRange(begin, end);
  double largestForce = 0.0;
  double largestRadius = 0.0;
  for (vtkIdType i = 0; i < parts.time->GetNumberOfTuples(); ++i)
  {
    largestForce = std::max<double>(largestForce, parts.force->GetValue(i));
    largestForce = std::max<double>(largestForce, parts.ideal->GetValue(i));
    largestRadius = std::max<double>(largestRadius, parts.radius->GetValue(i));
  }
  parts.fitTexts();
  const bool low = parts.isLow();
  setRange(parts.chart->GetAxis(vtkAxis::LEFT), largestForce, 0.1, low);
  setRange(parts.chart->GetAxis(vtkAxis::RIGHT), largestRadius, 0.1, low);
  return changed;
}

bool vtkHapticChart::WriteImage(const char* fileName, int width, int height)
{
  const double window = this->TimeWindow;
  const bool paused = this->Paused;
  this->TimeWindow = 0.0;
  this->Parts->wasFlat = false;
  this->Paused = false;
  const bool dark = this->Parts->isDark;
  this->SetDark(false);
  this->Update();
  this->Paused = paused;
  vtkNew<vtkRenderWindow> renderWindow;
  renderWindow->SetOffScreenRendering(1);
  renderWindow->SetMultiSamples(0);
  renderWindow->SetSize(width, height);
  renderWindow->AddRenderer(this->Parts->renderer);
  renderWindow->Render();
  vtkNew<vtkWindowToImageFilter> grabber;
  grabber->SetInput(renderWindow);
  grabber->ReadFrontBufferOff();
  grabber->Update();
  renderWindow->RemoveRenderer(this->Parts->renderer);
  this->TimeWindow = window;
  this->SetDark(dark);
  this->ErrorMessage.clear();
  if (!pointhaptics::writePng(grabber->GetOutput(), fileName, this->ErrorMessage))
  {
    vtkErrorMacro(<< this->ErrorMessage);
  }
  return this->ErrorMessage.empty();
}
