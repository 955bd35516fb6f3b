#include "vtkHapticChart.h"

#include "PngFile.h"

#include "vtkAxis.h"
#include "vtkBrush.h"
#include "vtkChartLegend.h"
#include "vtkChartXY.h"
#include "vtkContextActor.h"
#include "vtkContextScene.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
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
#include <initializer_list>

namespace
{

constexpr double kTimeWindow = 5.0; // seconds
constexpr int kSlices = 600;
constexpr int kIdealPlot = 2; // of the chart; 0 and 1 are radius and force
/// A chart lower than this, points, has few labels beside it.
constexpr double kLow = 150.0;
constexpr double kPointsPerInch = 72.0;
constexpr int kFontSize = 13;
constexpr int kSmallestFontSize = 7;
/// Titles of the left and the right axis, and shorter ones for a chart that is too low for these.
constexpr const char* kTitles[] = { "force (N)", "radius (mm)", "N", "mm" };
constexpr int kVtkBorder = 20; // pixels, beside an axis that is not shown

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

vtkStandardNewMacro(vtkHapticChart);

bool vtkHapticChart::IsLow() const
{
  vtkWindow* window = this->Renderer->GetVTKWindow();
  return window && this->Renderer->GetSize()[1] * kPointsPerInch < kLow * window->GetDPI();
}

/// Fits the texts into the chart: the label at the top of an axis, half of which is above it, and the upright
/// titles. Titles have one size, the largest that all of them fit in.
void vtkHapticChart::FitTexts()
{
  vtkRenderer* drawn = this->Renderer;
  vtkWindow* window = drawn->GetVTKWindow();
  if (!window || (drawn->GetSize()[1] == this->FittedHeight && window->GetDPI() == this->FittedDpi))
  {
    return;
  }
  this->FittedHeight = drawn->GetSize()[1];
  this->FittedDpi = window->GetDPI();
  const double letter = kFontSize * this->FittedDpi / kPointsPerInch;
  const int above = std::max(kVtkBorder, static_cast<int>(std::ceil(0.75 * letter)));
  this->Chart->SetHiddenAxisBorder(above);
  // Below the axis are a row of labels and a title; twice the way from its middle to the nearer edge.
  const double room = this->FittedHeight + above - 3.5 * letter;
  double fitting = 0.0;
  for (int i = 0; i < 4 && (i % 2 != 0 || fitting < kSmallestFontSize); ++i)
  {
    fitting = i % 2 == 0 ? kFontSize : fitting;
    vtkAxis* axis = this->Chart->GetAxis(i % 2 == 0 ? vtkAxis::LEFT : vtkAxis::RIGHT);
    axis->SetTitle(kTitles[i]);
    vtkNew<vtkTextProperty> upright;
    upright->ShallowCopy(axis->GetTitleProperties());
    upright->SetOrientation(0.0);
    upright->SetFontSize(kFontSize);
    int box[4] = {};
    vtkTextRenderer* texts = vtkTextRenderer::GetInstance();
    if (texts && texts->GetBoundingBox(upright, axis->GetTitle(), box, this->FittedDpi))
    {
      fitting = std::min(fitting, kFontSize * room / std::max(1, box[1] - box[0]));
    }
  }
  for (const int which : { vtkAxis::LEFT, vtkAxis::RIGHT, vtkAxis::BOTTOM })
  {
    this->Chart->GetAxis(which)->GetTitleProperties()->SetFontSize(
      std::max(kSmallestFontSize, static_cast<int>(fitting)));
  }
}

/// Fills the table: one row for each slice that has samples, its time after @p zero.
void vtkHapticChart::Fill(double begin, double end, double zero)
{
  this->Time->Reset();
  this->Force->Reset();
  this->Radius->Reset();
  this->Ideal->Reset();
  bool knowsIdeal = false;
  const double width = std::max(1e-9, end - begin) / kSlices;
  std::size_t i = 0;
  while (i < this->Samples.size())
  {
    const double slice = std::floor((this->Samples[i].seconds - begin) / width);
    double peak = 0.0;
    double idealPeak = 0.0;
    double sum = 0.0;
    double moment = 0.0;
    std::size_t count = 0;
    for (; i < this->Samples.size() && std::floor((this->Samples[i].seconds - begin) / width) == slice; ++i)
    {
      peak = std::max(peak, this->Samples[i].newtons);
      knowsIdeal = knowsIdeal || std::isfinite(this->Samples[i].idealNewtons);
      idealPeak = std::fmax(idealPeak, this->Samples[i].idealNewtons); // NaN counts as none
      sum += this->Samples[i].metres;
      moment += this->Samples[i].seconds;
      ++count;
    }
    this->Time->InsertNextValue(static_cast<float>(moment / count - zero));
    this->Force->InsertNextValue(static_cast<float>(peak));
    this->Radius->InsertNextValue(static_cast<float>(1e3 * sum / count));
    this->Ideal->InsertNextValue(static_cast<float>(idealPeak));
  }
  for (int plot = 0; plot < 2; ++plot)
  {
    // vtkContext2D reports a line of fewer than two points as an error.
    this->Chart->GetPlot(plot)->SetVisible(this->Time->GetNumberOfTuples() > 1);
  }
  knowsIdeal = knowsIdeal && this->Time->GetNumberOfTuples() > 1;
  this->Chart->GetPlot(kIdealPlot)->SetVisible(knowsIdeal);
  this->Chart->SetShowLegend(knowsIdeal);
  this->Table->Modified();
}

bool vtkHapticChart::IsFlat() const
{
  for (const Sample& sample : this->Samples)
  {
    if (sample.newtons > 1e-3 || std::abs(sample.metres - this->Samples.front().metres) > 1e-6)
    {
      return false;
    }
  }
  return true;
}

vtkHapticChart::vtkHapticChart()
{
  this->Time->SetName("time");
  this->Force->SetName("force (N)");
  this->Radius->SetName("proxy radius (mm)");
  this->Table->AddColumn(this->Time);
  this->Table->AddColumn(this->Force);
  this->Ideal->SetName("ideal force (N)");
  this->Table->AddColumn(this->Radius);
  this->Table->AddColumn(this->Ideal);
  vtkPlot* radius = this->Chart->AddPlot(vtkChart::LINE);
  radius->SetInputData(this->Table, 0, 2);
  radius->SetWidth(2.0f);
  this->Chart->SetPlotCorner(radius, 1); // bottom and right axes
  vtkPlot* force = this->Chart->AddPlot(vtkChart::LINE);
  force->SetInputData(this->Table, 0, 1);
  force->SetWidth(2.0f);
  vtkPlot* ideal = this->Chart->AddPlot(vtkChart::LINE);
  ideal->SetInputData(this->Table, 0, 3);
  ideal->SetWidth(1.5f);
  ideal->GetPen()->SetLineType(vtkPen::DASH_LINE);
  ideal->SetVisible(false);
  vtkChartLegend* legend = this->Chart->GetLegend();
  // The legend stands beside the curves, which may be anywhere in the plot.
  legend->SetInline(false);
  legend->SetHorizontalAlignment(vtkChartLegend::RIGHT);
  legend->SetVerticalAlignment(vtkChartLegend::TOP);
  legend->GetLabelProperties()->SetFontSize(12);
  legend->GetBrush()->SetOpacityF(0.6);
  legend->GetPen()->SetLineType(vtkPen::NO_PEN);
  this->Chart->GetAxis(vtkAxis::RIGHT)->SetGridVisible(false);
  this->Chart->SetInteractive(false);
  for (int second = 0; second <= int(kTimeWindow); ++second)
  {
    this->Ticks->InsertNextValue(second - kTimeWindow);
  }
  this->Actor->GetScene()->AddItem(this->Chart);
  this->Renderer->AddActor(this->Actor);
  this->Renderer->InteractiveOff();
  this->Actor->GetScene()->SetRenderer(this->Renderer);
  this->ApplyColors();
  this->Update();
}

vtkHapticChart::~vtkHapticChart() = default;

void vtkHapticChart::SetVisibility(bool visible)
{
  this->Renderer->SetDraw(visible);
}

bool vtkHapticChart::GetVisibility() const
{
  return this->Renderer->GetDraw() != 0;
}

bool vtkHapticChart::SetDark(bool dark)
{
  const bool changes = dark != this->IsDark;
  if (changes)
  {
    this->IsDark = dark;
    this->ApplyColors();
  }
  return changes;
}

void vtkHapticChart::ApplyColors()
{
  const unsigned char ground[2][3] = { { 255, 255, 255 }, { 32, 34, 40 } };
  const unsigned char grid[2][3] = { { 225, 225, 225 }, { 62, 66, 74 } };
  const unsigned char ink[2][3] = { { 60, 60, 60 }, { 224, 227, 232 } };
  const unsigned char curves[2][3][3] = { { { 190, 30, 110 }, { 205, 85, 0 }, { 20, 90, 200 } },
    { { 255, 120, 190 }, { 255, 140, 50 }, { 110, 175, 255 } } };
  const int which = this->IsDark ? 1 : 0;
  for (int plot = 0; plot < 3; ++plot)
  {
    const unsigned char* color = curves[which][plot];
    this->Chart->GetPlot(plot)->SetColor(color[0], color[1], color[2], 255);
  }
  styleAxis(this->Chart->GetAxis(vtkAxis::LEFT), kTitles[0], curves[which][1]);
  vtkAxis* const bottom = this->Chart->GetAxis(vtkAxis::BOTTOM);
  styleAxis(bottom, std::string(bottom->GetTitle()).c_str(), ink[which]);
  styleAxis(this->Chart->GetAxis(vtkAxis::RIGHT), kTitles[1], curves[which][0]);
  for (const int axis : { vtkAxis::LEFT, vtkAxis::BOTTOM, vtkAxis::RIGHT })
  {
    this->Chart->GetAxis(axis)->GetGridPen()->SetColor(grid[which][0], grid[which][1], grid[which][2]);
  }
  const unsigned char* back = ground[which];
  this->Chart->GetBackgroundBrush()->SetColor(back[0], back[1], back[2], 255);
  this->Renderer->SetBackground(back[0] / 255.0, back[1] / 255.0, back[2] / 255.0);
  const double words = this->IsDark ? 0.88 : 0.0;
  this->Chart->GetLegend()->GetLabelProperties()->SetColor(words, words, words);
  this->Chart->GetLegend()->GetBrush()->SetColor(back[0], back[1], back[2]);
  this->FittedHeight = 0;
  this->FitTexts(); // at once: Update() may find nothing else to change
}

void vtkHapticChart::SetForceNames(const char* force, const char* other)
{
  this->Force->SetName(force);
  this->Ideal->SetName(other);
  this->Chart->GetPlot(1)->SetInputData(this->Table, 0, 1);
  this->Chart->GetPlot(kIdealPlot)->SetInputData(this->Table, 0, 3);
}

void vtkHapticChart::AddSample(double seconds, double newtons, double metres, double idealNewtons)
{
  if (std::isfinite(seconds) && std::isfinite(newtons) && std::isfinite(metres))
  {
    this->Samples.push_back({ seconds, newtons, metres, idealNewtons });
    while (this->Paused && this->Samples.front().seconds < seconds - kTimeWindow)
    {
      this->Samples.pop_front(); // nobody will see them: a long pause must not fill the memory
    }
  }
}

bool vtkHapticChart::Update()
{
  const double newest = this->Samples.empty() ? 0.0 : this->Samples.back().seconds;
  while (!this->Paused && !this->Samples.empty() && this->Samples.front().seconds < newest - kTimeWindow)
  {
    this->Samples.pop_front();
  }
  // Now is 0, so that the axis stays: VTK lays out all texts of an axis whose range changes.
  return !this->Paused && this->Draw(newest - kTimeWindow, newest, newest);
}

/// Draws the samples of this time, which is shown from @p zero on. True: the picture has changed.
bool vtkHapticChart::Draw(double begin, double end, double zero)
{
  const bool flat = this->IsFlat();
  const bool changed = !(flat && this->WasFlat);
  this->WasFlat = flat && !this->Samples.empty();
  this->Fill(begin, end, zero);
  vtkAxis* bottom = this->Chart->GetAxis(vtkAxis::BOTTOM);
  bottom->SetBehavior(vtkAxis::FIXED);
  const bool isLive = zero == end;
  bottom->SetRange(begin - zero, end - zero);
  bottom->SetTitle(isLive ? "time from now (s)" : "time (s)");
  bottom->SetCustomTickPositions(isLive ? this->Ticks.Get() : nullptr);
  double largestForce = 0.0;
  double largestRadius = 0.0;
  for (vtkIdType i = 0; i < this->Time->GetNumberOfTuples(); ++i)
  {
    largestForce = std::max<double>(largestForce, this->Force->GetValue(i));
    largestForce = std::max<double>(largestForce, this->Ideal->GetValue(i));
    largestRadius = std::max<double>(largestRadius, this->Radius->GetValue(i));
  }
  this->FitTexts();
  const bool low = this->IsLow();
  setRange(this->Chart->GetAxis(vtkAxis::LEFT), largestForce, 0.1, low);
  setRange(this->Chart->GetAxis(vtkAxis::RIGHT), largestRadius, 0.1, low);
  return changed;
}

bool vtkHapticChart::WriteImage(const char* fileName, int width, int height)
{
  const bool dark = this->IsDark;
  this->SetDark(false);
  const double begin = this->Samples.empty() ? 0.0 : this->Samples.front().seconds;
  this->Draw(begin, this->Samples.empty() ? 1.0 : std::max(this->Samples.back().seconds, begin + 1e-3), 0.0);
  this->WasFlat = false;
  vtkNew<vtkRenderWindow> renderWindow;
  renderWindow->SetOffScreenRendering(1);
  renderWindow->SetMultiSamples(0);
  renderWindow->SetSize(width, height);
  renderWindow->AddRenderer(this->Renderer);
  renderWindow->Render();
  vtkNew<vtkWindowToImageFilter> grabber;
  grabber->SetInput(renderWindow);
  grabber->ReadFrontBufferOff();
  grabber->Update();
  renderWindow->RemoveRenderer(this->Renderer);
  this->SetDark(dark);
  this->ErrorMessage.clear();
  if (!pointhaptics::writePng(grabber->GetOutput(), fileName, this->ErrorMessage))
  {
    vtkErrorMacro(<< this->ErrorMessage);
  }
  return this->ErrorMessage.empty();
}
