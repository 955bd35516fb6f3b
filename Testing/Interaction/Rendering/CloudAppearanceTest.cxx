#include "CloudAppearance.h"

#include "AsprsClasses.h"
#include "ColorMaps.h"
#include "MadeClouds.h"

#include <gtest/gtest.h>
#include <vtkActor.h>
#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

using namespace pointhaptics;

namespace
{

vtkSmartPointer<vtkPolyData> makeColumn()
{
  return trial::cloudOf({ { 0, 0, 5 }, { 0, 0, 7 }, { NAN, 0, 0 } });
}

TEST(CloudAppearance, TakesTheCoordinatesOfTheFileForHeights)
{
  const auto cloud = makeColumn();
  addHeightArray(cloud, { 0, 0, 1 });
  vtkDataArray* height = cloud->GetPointData()->GetArray(kHeightArrayName);
  ASSERT_TRUE(height);
  EXPECT_EQ(height->GetTuple1(0), 5.0);
  EXPECT_EQ(height->GetTuple1(1), 7.0);
  EXPECT_TRUE(std::isnan(height->GetTuple1(2)));
}

TEST(CloudAppearance, PrefersTheCloudsOwnColors)
{
  const auto cloud = makeColumn();
  addHeightArray(cloud, { 0, 0, 1 });
  vtkNew<vtkPolyDataMapper> mapper;
  vtkNew<vtkActor> actor;
  EXPECT_TRUE(applyCloudAppearance(cloud, mapper, actor));
  EXPECT_STREQ(mapper->GetArrayName(), kHeightArrayName);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("RGB");
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(3);
  colors->Fill(200);
  cloud->GetPointData()->SetScalars(colors);
  EXPECT_TRUE(hasColors(cloud));
  EXPECT_TRUE(applyCloudAppearance(cloud, mapper, actor));
  EXPECT_EQ(mapper->GetColorMode(), VTK_COLOR_MODE_DIRECT_SCALARS);
}

TEST(CloudAppearance, DrawsAndNamesTheClassesOfLidarPoints)
{
  const auto cloud = makeColumn();
  vtkNew<vtkUnsignedCharArray> classes;
  classes->SetName("Classification");
  for (const unsigned char number : { 6, 2, 6 })
  {
    classes->InsertNextValue(number);
  }
  cloud->GetPointData()->AddArray(classes);
  vtkNew<vtkPolyDataMapper> mapper;
  vtkNew<vtkActor> actor;
  EXPECT_TRUE(applyCloudAppearance(cloud, mapper, actor, "Classification"));
  applyColorMap(mapper);
  for (const int number : { 2, 6, 17, 255 })
  {
    double color[3];
    mapper->GetLookupTable()->GetColor(number, color);
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(color[c], asprsClass(number).color[c], 0.003) << number;
    }
  }
  const auto legend = vtkSmartPointer<vtkLookupTable>::Take(newClassLegend(classes));
  ASSERT_EQ(legend->GetNumberOfAnnotatedValues(), 2);
  EXPECT_EQ(legend->GetAnnotation(0), "2 ground");
  EXPECT_EQ(legend->GetAnnotation(1), "6 building");
  double color[4];
  legend->GetAnnotationColor(6, color);
  EXPECT_NEAR(color[0], asprsClass(6).color[0], 0.003);
}

TEST(CloudAppearance, HasAMapOfItsOwnForEachName)
{
  std::set<std::vector<double>> ends;
  for (const std::string& name : colorMapNames())
  {
    const auto map = vtkSmartPointer<vtkLookupTable>::Take(newColorMap(name));
    std::vector<double> colors(9);
    map->GetColor(0.0, &colors[0]);
    map->GetColor(0.5, &colors[3]);
    map->GetColor(1.0, &colors[6]);
    EXPECT_TRUE(ends.insert(colors).second) << name;
    double nan[3];
    map->GetColor(NAN, nan);
    EXPECT_NEAR(nan[0], 0.5, 0.003) << name;
    EXPECT_NEAR(nan[1], 0.5, 0.003) << name;
  }
  const auto unknown = vtkSmartPointer<vtkLookupTable>::Take(newColorMap("none such"));
  double color[3];
  unknown->GetColor(0.0, color);
  EXPECT_NEAR(color[2], groundColor(0.0).z, 0.003);
}

TEST(CloudAppearance, TakesAMapOverARange)
{
  const auto cloud = makeColumn();
  addHeightArray(cloud, { 0.0, 0.0, 1.0 });
  vtkNew<vtkPolyDataMapper> mapper;
  vtkNew<vtkActor> actor;
  ASSERT_TRUE(applyCloudAppearance(cloud, mapper, actor, kHeightArrayName));
  applyColorMap(mapper, "cool-warm", { -1.0, 3.0 });
  EXPECT_EQ(mapper->GetLookupTable()->GetRange()[0], -1.0);
  EXPECT_EQ(mapper->GetLookupTable()->GetRange()[1], 3.0);
  double color[3];
  mapper->GetLookupTable()->GetColor(-2.0, color);
  EXPECT_NEAR(color[0], 0.230, 0.01);
  EXPECT_NEAR(color[2], 0.754, 0.01);
}

TEST(CloudAppearance, SaysThatAnArrayIsNotThere)
{
  const auto cloud = makeColumn();
  vtkNew<vtkPolyDataMapper> mapper;
  vtkNew<vtkActor> actor;
  EXPECT_FALSE(applyCloudAppearance(cloud, mapper, actor, "Temperature"));
  EXPECT_FALSE(applyCloudAppearance(cloud, mapper, actor, "rgb"));
}

/// 1001 points whose values ascend evenly to @p most.
vtkSmartPointer<vtkPolyData> makeRamp(double most)
{
  vtkNew<vtkFloatArray> values;
  values->SetName("Density");
  for (int i = 0; i <= 1000; ++i)
  {
    values->InsertNextValue(static_cast<float>(most * i / 1000.0));
  }
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->GetPointData()->AddArray(values);
  return cloud;
}

TEST(CloudAppearance, LetsTheColorsFollowOtherValuesButNotSmallChanges)
{
  vtkNew<vtkLookupTable> colors;
  const ColorSource source{ "Density", 0 };
  EXPECT_TRUE(followColorRange(makeRamp(100.0), source, colors));
  EXPECT_NEAR(colors->GetTableRange()[0], 1.0, 1e-5);
  EXPECT_NEAR(colors->GetTableRange()[1], 99.0, 1e-5);
  EXPECT_FALSE(followColorRange(makeRamp(105.0), source, colors));
  EXPECT_NEAR(colors->GetTableRange()[1], 99.0, 1e-5);
  EXPECT_TRUE(followColorRange(makeRamp(25.0), source, colors)); // after a zoom
  EXPECT_NEAR(colors->GetTableRange()[1], 24.75, 1e-5);
}

TEST(CloudAppearance, BeginsTheColorsOfErrorsAtZero)
{
  const auto cloud = makeRamp(100.0);
  auto* values = vtkFloatArray::SafeDownCast(cloud->GetPointData()->GetArray("Density"));
  for (int i = 0; i < 500; ++i)
  {
    values->SetValue(i, 1e-6F); // by accident
  }
  double range[2];
  colorRange(cloud, { "Density", 0 }, range);
  EXPECT_EQ(range[0], 0.0);
  for (int i = 0; i < 500; ++i)
  {
    values->SetValue(i, -1e-6F);
  }
  colorRange(cloud, { "Density", 0 }, range);
  EXPECT_LT(range[0], 0.0);
}

TEST(CloudAppearance, LeavesOutRareValuesThatComeInStepWithASample)
{
  // A bad value at the end of each row of a scanner: one of 500, in clouds of which every k-th would be
  // taken.
  for (const int count : { 20000, 50000, 100000, 500000 })
  {
    vtkNew<vtkPolyData> cloud;
    vtkNew<vtkFloatArray> values;
    values->SetName("Intensity");
    for (int i = 0; i < count; ++i)
    {
      values->InsertNextValue(i % 500 == 0 ? 65535.0f : float(i % 100));
    }
    cloud->GetPointData()->AddArray(values);
    double range[2];
    colorRange(cloud, { "Intensity", 0 }, range);
    EXPECT_LT(range[1], 100.0) << count;
  }
}

TEST(CloudAppearance, GrowsLighterInEvenSteps)
{
  vtkLookupTable* colors = newCloudColorMap();
  double last = -1.0;
  for (int i = 0; i < 256; i += 16)
  {
    const double* c = colors->GetTableValue(i);
    const double luminance = 0.2126 * c[0] * c[0] + 0.7152 * c[1] * c[1] + 0.0722 * c[2] * c[2];
    EXPECT_GT(luminance, last) << i;
    last = luminance;
  }
  colors->Delete();
}

TEST(CloudAppearance, ABarBetweenWholeNumbersHasWholeLabels)
{
  struct Case
  {
    double low;
    double high;
    int labels;
    const char* format;
  };
  vtkNew<vtkLookupTable> colors;
  vtkNew<vtkScalarBarActor> bar;
  vtkNew<vtkRenderer> renderer;
  bar->SetLookupTable(colors);
  setUpScalarBar(bar);
  for (const Case& one :
    { Case{ 1, 3, 3, "%.0f " }, Case{ 1, 4, 4, "%.0f " }, Case{ 0, 8, 5, "%.0f " }, Case{ 0, 7, 2, "%.0f " },
      Case{ 0, 580, 4, "%.0f " }, Case{ 0.5, 3, 4, "%#.3g " }, Case{ 0, 2e6, 4, "%.0f " },
      Case{ 2, 2, 1, "%.0f " }, Case{ 627, 627 + widthOfOneValue(627), 1, "%.0f " },
      Case{ 0.25, 0.25 + widthOfOneValue(0.25), 1, "%.6g " }, Case{ 3.5, 812.4, 4, "%.0f " },
      Case{ 627.1, 627.9, 4, "%.1f " }, Case{ 627.1, 627.12, 4, "%.3f " },
      Case{ 5599999.7, 5600000.3, 4, "%.1f " }, Case{ 5.6e6, 5.601e6, 4, "%.0f " },
      Case{ 1.2e-6, 3.1e-6, 4, "%#.3g " }, Case{ 50.001, 50.007, 4, "%.3f " },
      Case{ 1.5e6, 9.5e6, 4, "%#.3g " } })
  {
    colors->SetRange(one.low, one.high);
    placeScalarBar(bar, renderer);
    EXPECT_EQ(bar->GetNumberOfLabels(), one.labels) << one.low << " to " << one.high;
    EXPECT_STREQ(bar->GetLabelFormat(), one.format) << one.low << " to " << one.high;
  }
}

TEST(CloudAppearance, ARangeOfLargeCoordinatesHasTwoEnds)
{
  EXPECT_EQ(rangeText(5599999.72, 5600000.31), "5599999.7 to 5600000.3");
  EXPECT_EQ(rangeText(0.01, 0.03), "0.01 to 0.03");
  EXPECT_EQ(rangeText(-1e-7, 3e-7), "-1e-07 to 3e-07");
}

} // namespace
