#include "HeightProfile.h"

#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkChartXY.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkPen.h>
#include <vtkPlotPoints.h>
#include <vtkRenderer.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

namespace pointhaptics
{
namespace
{

constexpr int kFontSize = 12;
constexpr float kPointPixels = 2.0F;

} // namespace

HeightProfile::HeightProfile()
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

void HeightProfile::show(const ProfilePoints& points, const std::string& unit)
{
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
}

} // namespace pointhaptics
