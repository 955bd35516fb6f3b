#include "PointPicking.h"
#include "CloudAppearance.h"
#include "CoordinateText.h"
#include "Interaction/OffscreenWindow.h"
#include "Unit/SkipWithoutDisplay.h"
#include "vtkSplatMapper.h"

#include <gtest/gtest.h>
#include <vtkActor.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include <string>
#include <vector>

using pointhaptics::describePicked;
using pointhaptics::PickedPoint;
using pointhaptics::Vec3;

namespace
{

void addField(vtkPolyData* cloud, const char* name, const std::vector<double>& values)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  for (double value : values)
  {
    array->InsertNextValue(value);
  }
  cloud->GetFieldData()->AddArray(array);
}

void addArray(vtkPolyData* cloud, const char* name, double value)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->InsertNextValue(value);
  cloud->GetPointData()->AddArray(array);
}

/// The means of a cloud of which @p edge units of the file are the edge of a voxel of 1 mm.
void setVoxel(vtkPolyData* cloud, double edge)
{
  const double scale = 1e-3 / edge;
  addField(cloud, "ModelToWorkspace", { scale, 0, 0, 0, 0, scale, 0, 0, 0, 0, scale, 0, 0, 0, 0, 1 });
  addField(cloud, "LatticeSpacing", { 1e-3, 1e-3, 1e-3 });
}

/// Text for a place in a file with voxels of @p edge; 0: the voxels are not known.
std::string placeText(const Vec3& place, double edge)
{
  vtkNew<vtkPolyData> cloud;
  if (edge > 0.0)
  {
    setVoxel(cloud, edge);
  }
  PickedPoint picked;
  picked.index = 0;
  picked.inCloud = place;
  const std::string text = describePicked(cloud, picked);
  return text.substr(0, text.find('\n'));
}

/// Text for the value of an array.
std::string arrayText(const char* name, double value, double edge)
{
  vtkNew<vtkPolyData> cloud;
  setVoxel(cloud, edge);
  addArray(cloud, name, value);
  PickedPoint picked;
  picked.index = 0;
  const std::string text = describePicked(cloud, picked);
  return text.substr(text.rfind(' ') + 1);
}

TEST(PointPicking, ShowsTheMillimetresOfANorthing)
{
  const Vec3 place{ 439112.25, 5017900.1234, -12.0 };
  EXPECT_EQ(placeText(place, 1.85), "in the file  439112.250  5017900.123  -12.000");
  EXPECT_EQ(placeText(place, 40.0), "in the file  439112.250  5017900.123  -12.000");
  EXPECT_EQ(placeText(place, 0.0), "in the file  439112.250  5017900.123  -12.000");
}

TEST(PointPicking, ShowsMoreDecimalsWhereVoxelsAreSmaller)
{
  EXPECT_EQ(placeText({ 0.123456789, -0.1, 0.0 }, 7e-4), "in the file  0.1234568  -0.1000000  0.0000000");
  EXPECT_EQ(
    placeText({ 1e-7, 0.0, 0.0 }, 1e-10), "in the file  0.0000001000000  0.0000000000000  0.0000000000000");
}

TEST(PointPicking, ShowsNoMoreDigitsThanADoubleHas)
{
  EXPECT_EQ(placeText({ 123456789.125, 0.0, 0.0 }, 1e-7),
    "in the file  123456789.125000  0.0000000000  0.0000000000");
}

TEST(PointPicking, ShowsNoCoordinateBelowABillionWithAnExponent)
{
  for (double size = 1.0; size < 1e9; size *= 7.3)
  {
    for (double edge : { 1e-6, 1.0, 1e6 })
    {
      const std::string text = placeText({ size, -size, 0.3 * size }, edge).substr(11);
      EXPECT_EQ(text.find('e'), std::string::npos) << text;
    }
  }
  EXPECT_EQ(placeText({ 2.5e12, 0.0, 0.0 }, 1.0), "in the file  2.5e+12  0.000  0.000");
}

TEST(PointPicking, ShowsNoSignOfANumberThatIsRoundedToZero)
{
  EXPECT_EQ(placeText({ -1e-9, 0.0, 0.0 }, 1.0), "in the file  0.000  0.000  0.000");
}

TEST(PointPicking, ShowsValuesOfArraysAsTheyAreRead)
{
  EXPECT_EQ(arrayText("Height", 2917.25, 1.85), "2917.250");
  EXPECT_EQ(arrayText("Intensity", 1234567.0, 1.0), "1234567");
  EXPECT_EQ(arrayText("GpsTime", 415633123.25, 1.0), "415633123.250");
  EXPECT_EQ(arrayText("Density", 0.0123456789, 1.0), "0.0123457");
  EXPECT_EQ(arrayText("VoxelPointCount", 3.0, 1.0), "3");
}

TEST(PointPicking, TellsThePlaceOfThePointOfTheFileWithTheDecimalsOfItsGrid)
{
  vtkNew<vtkPolyData> means;
  setVoxel(means, 2.0);
  addArray(means, "VoxelPointCount", 4.0);
  addArray(means, "Intensity", 99.5);
  vtkNew<vtkPolyData> file;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->InsertNextPoint(439112.2, 5017906.07, -0.001);
  file->SetPoints(points);
  addArray(file, "Intensity", 312.0);
  addArray(file, "Classification", 6.0);
  addArray(file, "ReturnNumber", 2.0);
  addArray(file, "SplatLength", 1.5);
  addField(file, "LasScale", { 0.01, 0.01, 0.0001 });
  PickedPoint picked;
  picked.index = 0;
  picked.inCloud = Vec3{ 439112.0, 5017906.0, 0.0 };
  EXPECT_EQ(describePicked(means, picked, { file, 0, { "SplatLength" } }),
    "in the file  439112.20  5017906.07  -0.0010\nin the workspace  0.00  0.00  0.00 mm\nIntensity  312\n"
    "Classification  6 (building)\nReturnNumber  2\nVoxelPointCount  4");
  // A file without a grid: down to a thousandth of a voxel.
  file->GetFieldData()->Initialize();
  EXPECT_EQ(describePicked(means, picked, { file, 0, {} }).substr(0, 48),
    "in the file  439112.200  5017906.070  -0.001\nin ");
}

TEST(PointPicking, TellsABandwidthOnceAndWithItsUnit)
{
  vtkNew<vtkPolyData> cloud;
  addArray(cloud, "MeanBandwidth", 0.000306707);
  PickedPoint picked;
  picked.index = 0;
  EXPECT_NE(describePicked(cloud, picked).find("MeanBandwidth"), std::string::npos);
  picked.bandwidth = 0.000306707;
  const std::string text = describePicked(cloud, picked);
  EXPECT_NE(text.find("bandwidth 0.307 mm"), std::string::npos) << text;
  EXPECT_EQ(text.find("MeanBandwidth"), std::string::npos) << text;
}

TEST(PointPicking, NamesTheClassOfALidarPoint)
{
  const auto lineOf = [](double value)
  {
    vtkNew<vtkPolyData> cloud;
    addArray(cloud, "Classification", value);
    PickedPoint picked;
    picked.index = 0;
    const std::string text = describePicked(cloud, picked);
    return text.substr(text.rfind('\n') + 1);
  };
  EXPECT_EQ(lineOf(2), "Classification  2 (ground)");
  EXPECT_EQ(lineOf(6), "Classification  6 (building)");
  EXPECT_EQ(lineOf(23), "Classification  23 (reserved)");
  EXPECT_EQ(lineOf(64), "Classification  64 (user defined)");
  EXPECT_EQ(lineOf(-1), "Classification  -1 (no class)");
  EXPECT_EQ(lineOf(300), "Classification  300 (no class)");
}

/// The two lines of a distance in a cloud of that precision.
std::vector<std::string> distanceIn(int type, const Vec3& from, const Vec3& to, double spacing)
{
  vtkNew<vtkPolyData> cloud;
  vtkNew<vtkPoints> points;
  points->SetDataType(type);
  cloud->SetPoints(points);
  return pointhaptics::distanceText(cloud, from, to, "m", spacing);
}

TEST(PointPicking, TellsDistancesToTheGridOfTheFile)
{
  vtkNew<vtkPolyData> cloud;
  addField(cloud, "LasScale", { 0.01, 0.01, 0.001 });
  const std::vector<std::string> words = pointhaptics::distanceText(
    cloud, { 512000.25, 5403000.5, 100.0 }, { 512003.25, 5403004.5, 100.0 }, "ft", 0.5);
  ASSERT_EQ(words.size(), 2u);
  EXPECT_EQ(words[0], "5.000 ft");
  EXPECT_EQ(words[1], "dx 3.00   dy 4.00   dz 0.000 ft");
}

TEST(PointPicking, TellsDistancesDownToTheSpacingWhereThereIsNoGrid)
{
  const Vec3 zero;
  EXPECT_EQ(distanceIn(VTK_DOUBLE, zero, { 0.314159, 0, 0 }, 0.002)[0], "0.314 m");
  EXPECT_EQ(distanceIn(VTK_DOUBLE, zero, { 0.314159, 0, 0 }, 0.05)[0], "0.31 m");
  EXPECT_EQ(distanceIn(VTK_DOUBLE, zero, { -300, 0, -400 }, 0.2)[1], "dx -300.0   dy 0.0   dz -400.0 m");
}

TEST(PointPicking, TellsTwoToFourDigitsOfADistance)
{
  const Vec3 zero;
  EXPECT_EQ(distanceIn(VTK_DOUBLE, zero, { 0.314159, 0, 0 }, 1.0)[0], "0.31 m");
  EXPECT_EQ(distanceIn(VTK_DOUBLE, zero, { 314.159, 0, 0 }, 1e-6)[0], "314.2 m");
  EXPECT_EQ(distanceIn(VTK_DOUBLE, zero, { 0.000314159, 0, 0 }, 1e-9)[0], "0.0003142 m");
  EXPECT_EQ(distanceIn(VTK_DOUBLE, zero, { 123456.7, 0, 0 }, 0.01)[0], "123457 m");
  EXPECT_EQ(distanceIn(VTK_DOUBLE, zero, zero, 0.02)[0], "0.00 m");
}

TEST(PointPicking, TellsThreeDigitsOfADistanceWhereTheSpacingIsNotKnown)
{
  const Vec3 zero;
  EXPECT_EQ(distanceIn(VTK_DOUBLE, zero, { 0.03, 0.04, 0 }, 0.0)[0], "0.0500 m");
  EXPECT_EQ(distanceIn(VTK_DOUBLE, zero, { -300, 0, -400 }, 0.0)[0], "500 m");
  EXPECT_EQ(distanceIn(VTK_DOUBLE, zero, zero, 0.0)[0], "0.000 m");
}

TEST(PointPicking, TellsNoDigitsThatSinglePrecisionDoesNotHold)
{
  // Neighbouring numbers there are 0.06 apart.
  EXPECT_EQ(distanceIn(VTK_FLOAT, { 500000, 0, 0 }, { 500012, 0, 0 }, 0.001)[0], "12.0 m");
  EXPECT_EQ(distanceIn(VTK_DOUBLE, { 500000, 0, 0 }, { 500012, 0, 0 }, 0.001)[0], "12.00 m");
}

/// Close by, a disc is many times as wide as the reach of a pick.
TEST(PointPicking, TakesADiscWhereverItIsSeen)
{
  SKIP_WITHOUT_DISPLAY();
  pointhaptics::OffscreenWindow seen(200, 200);
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0.0, 0.0, 0.0);
  points->InsertNextPoint(0.01, 0.0, -0.3); // behind the disc of the first
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  vtkNew<vtkSplatMapper> mapper;
  mapper->SetInputData(cloud);
  mapper->SetFixedPixels(80.0);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  seen.renderer->AddActor(actor);
  pointhaptics::applyDepthShading(seen.renderer);
  seen.window->Render();
  const auto pickedAt = [&](double x, double y)
  {
    PickedPoint picked;
    return pickPoint(cloud, seen.renderer, x, y, 4.0, picked) ? picked.index : vtkIdType(-1);
  };
  EXPECT_EQ(pickedAt(100, 100), 0);
  EXPECT_EQ(pickedAt(100, 135), 0);
  EXPECT_EQ(pickedAt(75, 80), 0);
  EXPECT_EQ(pickedAt(106, 100), 0) << "the middle of the other is hidden";
  EXPECT_EQ(pickedAt(145, 100), 1) << "its rim is seen";
  EXPECT_EQ(pickedAt(100, 143), 0) << "four pixels beside it";
  EXPECT_EQ(pickedAt(100, 150), -1);
  EXPECT_EQ(pickedAt(190, 10), -1);
}

/// A wall beside the cloud and a line in front of it are drawn, too.
TEST(PointPicking, TakesNothingThatIsNoCloud)
{
  SKIP_WITHOUT_DISPLAY();
  pointhaptics::OffscreenWindow seen(400, 400);
  vtkNew<vtkPoints> points;
  for (int i = 0; i < 400; ++i)
  {
    points->InsertNextPoint(0.001 * (i % 20 - 35), 0.001 * (i / 20 - 10), 0.0);
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  vtkNew<vtkSplatMapper> mapper;
  mapper->SetInputData(cloud);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  seen.renderer->AddActor(actor);
  vtkNew<vtkPolyData> others;
  vtkNew<vtkPoints> corners;
  const double places[][3] = { { 0.01, -0.04, -0.01 }, { 0.04, -0.04, -0.01 }, { 0.04, 0.04, -0.01 },
    { 0.01, 0.04, -0.01 }, { -0.04, 0.0, 0.03 }, { 0.005, 0.0, 0.03 } };
  for (const auto& place : places)
  {
    corners->InsertNextPoint(place);
  }
  others->SetPoints(corners);
  others->AllocateExact(2, 6);
  const vtkIdType wall[] = { 0, 1, 2, 3 };
  const vtkIdType line[] = { 4, 5 };
  others->InsertNextCell(VTK_LINE, 2, line);
  others->InsertNextCell(VTK_QUAD, 4, wall);
  vtkNew<vtkPolyDataMapper> plain;
  plain->SetInputData(others);
  vtkNew<vtkActor> other;
  other->SetMapper(plain);
  other->GetProperty()->SetLineWidth(5.0F);
  seen.renderer->AddActor(other);
  pointhaptics::applyDepthShading(seen.renderer);
  seen.window->Render();
  const auto pickAt = [&](const Vec3& place, PickedPoint& picked)
  {
    seen.renderer->SetWorldPoint(place.x, place.y, place.z, 1.0);
    seen.renderer->WorldToDisplay();
    const double* at = seen.renderer->GetDisplayPoint();
    return pickPoint(cloud, seen.renderer, at[0], at[1], 8.0, picked);
  };
  PickedPoint picked;
  ASSERT_TRUE(pickAt({ -0.0205, 0.0055, 0.0 }, picked));
  ASSERT_TRUE(picked.shown);
  EXPECT_NEAR(picked.shown->z, 0.0, 1e-3);
  EXPECT_FALSE(pickAt({ 0.025, 0.0, -0.01 }, picked)) << "the wall, 100 pixels from the cloud";
  EXPECT_FALSE(pickAt({ 0.003, 0.0, 0.03 }, picked)) << "the line beside the cloud";
  ASSERT_TRUE(pickAt({ -0.02, 0.0, 0.03 }, picked)) << "the line in front of the cloud";
  EXPECT_FALSE(picked.shown) << "the cloud is behind it";
}

} // namespace
