#include "DrawPace.h"
#include "vtkSplatMapper.h"

#include "OffscreenWindow.h"
#include "Unit/SkipWithoutDisplay.h"

#include <gtest/gtest.h>
#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkChartXY.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkPlot.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkTable.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

namespace
{

constexpr int kSplatSize = 200;

/// Points in a row, 30 mm apart, with lengths of 2, 4 and 6 mm.
vtkSmartPointer<vtkPolyData> threePoints()
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> vertices;
  vtkNew<vtkFloatArray> lengths;
  lengths->SetName("Length");
  for (vtkIdType i = 0; i < 3; ++i)
  {
    points->InsertNextPoint(0.03 * double(i) - 0.03, 0.0, 0.0);
    vertices->InsertNextCell(1, &i);
    lengths->InsertNextValue(float(0.002 * double(i + 1))); // 2, 4, 6 mm
  }
  auto three = vtkSmartPointer<vtkPolyData>::New();
  three->SetPoints(points);
  three->SetVerts(vertices);
  three->GetPointData()->AddArray(lengths);
  return three;
}

/// An actor of black splats in a white window.
struct SplatWindow : pointhaptics::OffscreenWindow
{
  explicit SplatWindow(vtkPolyData* input)
    : OffscreenWindow(kSplatSize, kSplatSize)
  {
    splats->SetInputData(input);
    splats->ScalarVisibilityOff();
    actor->SetMapper(splats);
    actor->GetProperty()->SetColor(0, 0, 0);
    renderer->AddActor(actor);
    renderer->SetBackground(1, 1, 1);
  }

  vtkNew<vtkSplatMapper> splats;
  vtkNew<vtkActor> actor;
};

/// Dark pixels within 25 columns of @p middle.
int darkPixels(const std::vector<unsigned char>& seen, int middle)
{
  int dark = 0;
  for (int y = 0; y < kSplatSize; ++y)
  {
    for (int x = middle - 25; x < middle + 25; ++x)
    {
      dark += x >= 0 && x < kSplatSize && seen[std::size_t(3 * (y * kSplatSize + x))] < 128;
    }
  }
  return dark;
}

TEST(SplatMapper, SplatsAreDiscsAsLargeAsTheirLengthSays)
{
  SKIP_WITHOUT_DISPLAY();
  SplatWindow view(threePoints());
  vtkSplatMapper* const splats = view.splats;
  vtkRenderer* const renderer = view.renderer;
  splats->SetSizeArrayName("Length");
  splats->SetSizeScale(2.0);
  for (const bool parallel : { false, true })
  {
    renderer->GetActiveCamera()->SetParallelProjection(parallel);
    renderer->GetActiveCamera()->SetParallelScale(0.2 * std::tan(0.5 * 30.0 * 3.14159265358979 / 180.0));
    renderer->ResetCameraClippingRange();
    const std::vector<unsigned char> seen = view.picture();
    const double perMetre = kSplatSize / (2.0 * 0.2 * std::tan(0.5 * 30.0 * 3.14159265358979 / 180.0));
    for (int i = 0; i < 3; ++i)
    {
      const int dark = darkPixels(seen, int(kSplatSize / 2 + (0.03 * i - 0.03) * perMetre));
      const double radius = 0.002 * (i + 1) * perMetre;
      EXPECT_NEAR(dark, 3.14159 * radius * radius, 0.1 * 3.14159 * radius * radius + 8.0) << i << parallel;
    }
  }
  // A point far from all others is no ball.
  splats->SetLargestRatio(1.0);
  const std::vector<unsigned char> cut = view.picture();
  EXPECT_LT(std::count(cut.begin(), cut.end(), 0), 3 * 900);
}

/// A ring of many points, with one cell of all or without cells.
vtkSmartPointer<vtkPolyData> ring(vtkIdType count, bool hasCells)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> vertices;
  vertices->InsertNextCell(int(count));
  for (vtkIdType i = 0; i < count; ++i)
  {
    points->InsertNextPoint(0.05 * std::cos(double(i)), 0.04 * std::sin(double(i)), 0.0);
    vertices->InsertCellPoint(i);
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(points);
  if (hasCells)
  {
    result->SetVerts(vertices);
  }
  return result;
}

/// Only a few points at a time are under way where the processor draws many.
TEST(SplatMapper, PointsAreDrawnInStepsWhereTheProcessorDrawsThem)
{
  SKIP_WITHOUT_DISPLAY();
  constexpr vtkIdType kCount = 50000;
  constexpr auto kPointsAStep = pointhaptics::DrawPace::kStep;
  SplatWindow view(ring(kCount, true));
  view.window->Render();
  auto& pace = pointhaptics::DrawPace::of(vtkOpenGLRenderWindow::SafeDownCast(view.window));
  const std::int64_t before = pace.steps();
  view.window->Render();
  EXPECT_EQ(pace.steps() - before >= kCount / kPointsAStep, pace.isNeeded());
  EXPECT_LE(pace.underWay(), pointhaptics::DrawPace::kAhead);
  const std::string library = view.window->ReportCapabilities();
  EXPECT_EQ(pace.isNeeded(), library.find("llvmpipe") != std::string::npos);
  const std::int64_t whole = pace.steps();
  view.splats->SetRanges({ { 0, 10 }, { 20, kCount } });
  view.window->Render();
  EXPECT_NEAR(double(pace.steps() - whole), pace.isNeeded() ? double(kCount) / kPointsAStep : 0.0, 1.0);
}

/// Values that differ by more than rounding does.
std::size_t differences(const std::vector<unsigned char>& a, const std::vector<unsigned char>& b)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    count += std::size_t(std::abs(int(a[i]) - int(b[i])) > 2);
  }
  return count;
}

/// Cells cost 8 bytes a point, here and in the renderer's memory, and 8 more where bounds are asked for.
TEST(SplatMapper, WithoutCellsAllPointsAreDrawn)
{
  SKIP_WITHOUT_DISPLAY();
  constexpr vtkIdType kCount = 200;
  SplatWindow with(ring(kCount, true));
  SplatWindow without(ring(kCount, false));
  const std::vector<unsigned char> expected = with.picture();
  const auto dark = std::size_t(std::count(expected.begin(), expected.end(), 0));
  EXPECT_GT(dark, 500u);
  EXPECT_LT(differences(without.picture(), expected), dark / 20);
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_EQ(without.splats->GetBounds()[i], with.splats->GetBounds()[i]);
  }
  for (SplatWindow* view : { &with, &without })
  {
    view->splats->SetRanges({ { 10, 30 }, { 120, kCount } });
  }
  const std::vector<unsigned char> parts = with.picture();
  EXPECT_GT(differences(parts, expected), dark / 5);
  EXPECT_LT(differences(without.picture(), parts), dark / 20);
}

TEST(SplatMapper, SettersKeepToTheirRangesAndMoveTheTimeOfWhatIsUploaded)
{
  vtkNew<vtkSplatMapper> splats;
  for (const double wrong : { 0.0, -1.0, double(NAN) })
  {
    splats->SetSizeScale(wrong);
    splats->SetLargestRatio(wrong);
    splats->SetSurfacePixels(wrong);
    splats->SetPixelRange(wrong, 5.0);
    splats->CopySizes(splats, wrong);
  }
  splats->SetSizeScale(INFINITY);
  splats->SetLightStrength(1.5);
  EXPECT_EQ(splats->GetSizeScale(), 3.6);
  EXPECT_EQ(splats->GetLargestRatio(), 2.5);
  EXPECT_EQ(splats->GetSmallestPixels(), 2.0);
  EXPECT_EQ(splats->GetLightStrength(), 1.0);
  splats->SetSurfacePixels(10.0);
  splats->SetSurfacePixels(INFINITY); // the default
  EXPECT_EQ(splats->GetSurfacePixels(), INFINITY);
  const auto moves = [&splats](const auto& set)
  {
    const vtkMTimeType before = splats->GetMTime();
    set();
    return splats->GetMTime() > before;
  };
  EXPECT_TRUE(moves([&] { splats->SetSizeArrayName("Length"); }));
  EXPECT_FALSE(moves([&] { splats->SetSizeArrayName("Length"); }));
  EXPECT_TRUE(moves([&] { splats->SetNormalArrayName("N"); }));
  EXPECT_TRUE(moves([&] { splats->SetAmbientLight(true); }));
  EXPECT_TRUE(moves([&] { splats->SetSurfaces(true); }));
  EXPECT_FALSE(moves([&] { splats->SetSizeScale(2.0); })); // a uniform of the shader
}

TEST(SplatMapper, DiscsTiltAsBeforeAfterTheMarkersOfAChart)
{
  SKIP_WITHOUT_DISPLAY();
  const vtkSmartPointer<vtkPolyData> three = threePoints();
  vtkNew<vtkFloatArray> normals;
  normals->SetName("N");
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(3);
  normals->Fill(0.58); // towards the upper right
  three->GetPointData()->AddArray(normals);
  SplatWindow view(three);
  view.splats->SetSizeArrayName("Length");
  view.splats->SetNormalArrayName("N");
  view.splats->SetAmbientLight(true);
  view.splats->SetSurfaces(true);
  const std::vector<unsigned char> expected = view.picture();
  vtkNew<vtkTable> table;
  table->AddColumn(three->GetPointData()->GetArray("Length"));
  vtkNew<vtkChartXY> chart;
  chart->AddPlot(vtkChart::POINTS)->SetInputData(table, 0, 0);
  vtkNew<vtkContextActor> actor;
  actor->GetScene()->AddItem(chart);
  vtkNew<vtkRenderer> over;
  over->AddActor(actor);
  actor->GetScene()->SetRenderer(over);
  view.window->AddRenderer(over);
  EXPECT_GT(differences(view.picture(), expected), 1000u) << "the chart is seen";
  view.window->RemoveRenderer(over);
  EXPECT_EQ(differences(view.picture(), expected), 0u);
}

} // namespace
