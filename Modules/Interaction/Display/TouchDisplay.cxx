#include "TouchDisplay.h"

#include "HandDistance.h"
#include "ScreenView.h"
#include "SteadyTime.h"

#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <limits>

namespace pointhaptics
{
namespace
{

/// A background darker than this has light texts.
constexpr double kDarkGround = 0.5;

/// All but its curves that the picture of a chart depends on.
std::vector<double> placeOf(vtkRenderer* chart)
{
  const int* size = chart->GetVTKWindow() ? chart->GetVTKWindow()->GetActualSize() : nullptr;
  std::vector<double> place(4);
  chart->GetViewport(place.data());
  place.push_back(size ? size[0] : 0);
  place.push_back(size ? size[1] : 0);
  return place;
}

} // namespace

void TouchDisplay::setChart(vtkHapticChart* chart)
{
  chart_ = chart;
  wish_ = chart && chart->GetVisibility() ? Wish::On : Wish::Off;
}

void TouchDisplay::setChartVisibility(bool visible)
{
  wish_ = visible ? Wish::On : Wish::Off;
  this->placeChart();
}

void TouchDisplay::setFigure(bool on)
{
  isFigure_ = on;
  this->placeChart();
}

void TouchDisplay::hideChartUntilTouch()
{
  wish_ = Wish::UntilTouch;
  if (chart_)
  {
    chart_->SetVisibility(false); // no picture has made room for it yet
  }
}

bool TouchDisplay::showChartIfFelt(const std::vector<ServoSample>& samples, bool isDragged)
{
  const auto isFelt = [](const ServoSample& sample) { return norm(sample.state.force) > 0.0; };
  if (wish_ == Wish::UntilTouch && std::any_of(samples.begin(), samples.end(), isFelt))
  {
    wish_ = Wish::Touched;
  }
  if (wish_ != Wish::Touched || isDragged)
  {
    return false;
  }
  this->setChartVisibility(true);
  return !isFigure_;
}

void TouchDisplay::placeChart()
{
  vtkRenderer* renderer = screen_.renderer();
  const bool visible = wish_ == Wish::On && !isFigure_;
  if (chart_ && renderer && chart_->GetVisibility() != visible)
  {
    chart_->SetVisibility(visible);
    chartChanged_ = true;
    const double* strip = chart_->GetRenderer()->GetViewport();
    renderer->SetViewport(0.0, visible ? strip[3] : 0.0, 1.0, renderer->GetViewport()[3]);
    this->requestRender();
  }
}

bool TouchDisplay::update(const std::vector<ServoSample>& samples, const ServoSample& latest)
{
  bool changed = false;
  if (chart_)
  {
    for (const ServoSample& sample : samples)
    {
      const double ideal = idealForce_ ? idealForce_(sample) : std::numeric_limits<double>::quiet_NaN();
      chart_->AddSample(sample.timeSeconds, norm(sample.state.force), sample.state.radius, ideal);
    }
    // A chart that is drawn seldom costs little: it is updated only where a render would show it.
    changed = this->isDue() && chart_->GetVisibility() && chart_->Update();
    chartChanged_ = chartChanged_ || changed;
  }
  if (props_ && latest.tick > 0)
  {
    changed = props_->Update(latest.state) || changed;
  }
  return changed;
}

bool TouchDisplay::showDistance(const HandDistance& distance)
{
  if (!props_)
  {
    return false;
  }
  return distance.nearest() ? props_->ShowNearest(&distance.hand().x, &distance.nearest()->x)
                            : props_->HideNearest();
}

bool TouchDisplay::isDue() const
{
  return steadySeconds() - frameEnd_ >= frameSeconds_;
}

void TouchDisplay::renderIfDue()
{
  if (isRequested_ && this->isDue())
  {
    isRequested_ = false;
    const double begin = steadySeconds();
    this->render();
    frameEnd_ = steadySeconds();
    frameSeconds_ = frameEnd_ - begin;
  }
}

void TouchDisplay::render()
{
  if (!screen_.interactor())
  {
    return;
  }
  if (vtkRenderer* renderer = screen_.renderer())
  {
    renderer->ResetCameraClippingRange();
  }
  vtkRenderer* chart = chart_ ? chart_->GetRenderer() : nullptr;
  bool isKept = false; // the window keeps the picture of a chart that has not changed
  if (chart)
  {
    // The chart has the ground of the picture above it, which a key may change.
    const double* ground = screen_.renderer() ? screen_.renderer()->GetBackground() : nullptr;
    const bool isOther =
      ground && chart_->SetDark(0.2126 * ground[0] + 0.7152 * ground[1] + 0.0722 * ground[2] < kDarkGround);
    const std::vector<double> place = chart->GetDraw() ? placeOf(chart) : std::vector<double>();
    isKept = chart->GetDraw() && !isOther && !chartChanged_ && place == chartPlace_;
    chart->SetDraw(chart->GetDraw() && !isKept);
    chartPlace_ = place;
  }
  chartChanged_ = false;
  screen_.interactor()->Render();
  if (isKept)
  {
    chart->DrawOn();
  }
}

} // namespace pointhaptics
