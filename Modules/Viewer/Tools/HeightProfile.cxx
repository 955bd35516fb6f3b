#include "HeightProfile.h"

#include "CloudAppearance.h"
#include "CommandRegistry.h"
#include "ViewScene.h"

#include <fmt/format.h>
#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkChartXY.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkPen.h>
#include <vtkPlotPoints.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

#include <algorithm>

namespace pointhaptics
{
namespace
{

constexpr double kProfileBegin = 0.76; // of the window's height
constexpr int kFontSize = 12;
constexpr float kPointPixels = 2.0F;

} // namespace

HeightProfile::HeightProfile(const ToolContext& context)
  : context_(context)
{
  for (const char* name : { "along", "height" })
  {
    vtkNew<vtkDoubleArray> column;
    column->SetName(name);
    table_->AddColumn(column);
  }
  auto* plot = vtkPlotPoints::SafeDownCast(chart_->AddPlot(vtkChart::POINTS));
  plot->SetInputData(table_, 0, 1);
  plot->SetMarkerStyle(vtkPlotPoints::SQUARE);
  plot->SetMarkerSize(kPointPixels);
  plot->SetColor(204, 194, 178, 255);
  for (const int which : { vtkAxis::LEFT, vtkAxis::BOTTOM })
  {
    vtkAxis* axis = chart_->GetAxis(which);
    for (vtkTextProperty* text : { axis->GetTitleProperties(), axis->GetLabelProperties() })
    {
      text->SetColor(0.88, 0.89, 0.91);
      text->SetFontSize(kFontSize);
      text->BoldOff();
    }
    axis->GetGridPen()->SetColor(60, 64, 72);
    axis->GetPen()->SetColor(150, 155, 165);
  }
  chart_->GetBackgroundBrush()->SetOpacity(0);
  chart_->SetInteractive(false);
  actor_->GetScene()->AddItem(chart_);
  renderer_->AddActor(actor_);
  renderer_->SetBackground(0.125, 0.135, 0.155);
  renderer_->InteractiveOff();
  actor_->GetScene()->SetRenderer(renderer_);
}

HeightProfile::~HeightProfile() = default;

void HeightProfile::toggle()
{
  if (this->end())
  {
    return;
  }
  if (context_.scene.profile().empty())
  {
    context_.say(
      "no profile: " + context_.commands.label("measure") + " measures its line between two clicks");
    return;
  }
  context_.window->AddRenderer(renderer_);
  this->follow();
}

bool HeightProfile::end()
{
  const bool wasShown = context_.window->HasRenderer(renderer_) != 0;
  context_.window->RemoveRenderer(renderer_);
  this->endPictureAt(1.0);
  wasShown ? context_.say("profile: closed") : void();
  return wasShown;
}

void HeightProfile::follow()
{
  if (!context_.window->HasRenderer(renderer_))
  {
    return;
  }
  const ProfilePoints points = context_.scene.profile();
  if (points.empty())
  {
    this->end();
    return;
  }
  const std::string& unit = context_.scene.unit().name;
  table_->SetNumberOfRows(vtkIdType(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    table_->SetValue(vtkIdType(i), 0, points[i][0]);
    table_->SetValue(vtkIdType(i), 1, points[i][1]);
  }
  table_->Modified();
  chart_->GetAxis(vtkAxis::BOTTOM)->SetTitle("along the line (" + unit + ")");
  chart_->GetAxis(vtkAxis::LEFT)->SetTitle("height (" + unit + ")");
  chart_->RecalculateBounds();
  renderer_->SetViewport(0.0, kProfileBegin, 1.0, 1.0);
  this->endPictureAt(kProfileBegin);
  const auto [low, high] = std::minmax_element(
    points.begin(), points.end(), [](const auto& a, const auto& b) { return a[1] < b[1]; });
  context_.say(fmt::format("profile: heights {} {}", rangeText((*low)[1], (*high)[1]), unit));
}

/// Ends the picture of the cloud at this part of the window's height.
void HeightProfile::endPictureAt(double top)
{
  vtkRenderer* renderer = context_.scene.renderer();
  const double* viewport = renderer->GetViewport();
  renderer->SetViewport(viewport[0], viewport[1], viewport[2], top);
}

} // namespace pointhaptics
