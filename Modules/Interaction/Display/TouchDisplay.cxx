#include "TouchDisplay.h"

#include "HandDistance.h"
#include "ScreenView.h"
#include "SteadyTime.h"

#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace pointhaptics
{
namespace
{

/// A background darker than this has light texts.
constexpr double kDarkGround = 0.5;

/// Keeps an unchanged chart from being drawn while it lives: the window keeps its picture.
class ChartPause
{
public:
  ChartPause(vtkRenderer* chart, bool changed, std::vector<double>& picture)
  {
    const int* size = chart->GetVTKWindow() ? chart->GetVTKWindow()->GetActualSize() : nullptr;
    std::vector<double> wanted(4);
    chart->GetViewport(wanted.data());
    wanted.push_back(size ? size[0] : 0);
    wanted.push_back(size ? size[1] : 0);
    if (chart->GetDraw() && !changed && wanted == picture)
    {
      chart_ = chart;
      chart_->DrawOff();
    }
    picture = chart->GetDraw() || chart_ ? wanted : std::vector<double>();
  }
  ~ChartPause()
  {
    if (chart_)
    {
      chart_->DrawOn();
    }
  }
  ChartPause(const ChartPause&) = delete;
  ChartPause& operator=(const ChartPause&) = delete;

private:
  vtkRenderer* chart_ = nullptr;
};

} // namespace

TouchDisplay::TouchDisplay(const ScreenView& screen)
  : screen_(screen)
{
}

TouchDisplay::~TouchDisplay() = default;

void TouchDisplay::setProps(vtkHapticProps* props)
{
  props_ = props;
}

void TouchDisplay::setChart(vtkHapticChart* chart)
{
  chart_ = chart;
  wantsChart_ = chart && chart->GetVisibility();
}

void TouchDisplay::setChartVisibility(bool visible)
{
  wantsChart_ = visible;
  chartWaits_ = false;
  this->placeChart();
}

void TouchDisplay::setFigure(bool on)
{
  isFigure_ = on;
  this->placeChart();
}

void TouchDisplay::hideChartUntilTouch()
{
  wantsChart_ = false;
  chartWaits_ = true;
  isFelt_ = false;
  if (chart_)
  {
    chart_->SetVisibility(false); // no picture has made room for it yet
  }
}

bool TouchDisplay::showChartIfFelt(const std::vector<ServoSample>& samples, bool isDragged)
{
  const auto isFelt = [](const ServoSample& sample) { return norm(sample.state.force) > 0.0; };
  isFelt_ = chartWaits_ && (isFelt_ || std::any_of(samples.begin(), samples.end(), isFelt));
  if (!isFelt_ || isDragged)
  {
    return false;
  }
  this->setChartVisibility(true);
  return !isFigure_;
}

void TouchDisplay::placeChart()
{
  vtkRenderer* renderer = screen_.renderer();
  const bool visible = wantsChart_ && !isFigure_;
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
  std::optional<ChartPause> pause;
  if (chart_)
  {
    // The chart has the ground of the picture above it, which a key may change.
    const double* ground = screen_.renderer() ? screen_.renderer()->GetBackground() : nullptr;
    chartChanged_ =
      (ground &&
        chart_->SetDark(0.2126 * ground[0] + 0.7152 * ground[1] + 0.0722 * ground[2] < kDarkGround)) ||
      chartChanged_;
    pause.emplace(chart_->GetRenderer(), chartChanged_, chartPicture_);
  }
  chartChanged_ = false;
  screen_.interactor()->Render();
}

} // namespace pointhaptics
