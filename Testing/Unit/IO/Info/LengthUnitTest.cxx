#include "IO/Info/LengthUnit.h"
#include "IO/Info/CloudSummary.h"

#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointCloudReader.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

namespace
{

using namespace pointhaptics;

Bounds boxOf(const Vec3& minimum, const Vec3& maximum)
{
  Bounds bounds;
  bounds.include(minimum);
  bounds.include(maximum);
  return bounds;
}

void addArray(vtkPolyData* cloud, const char* name)
{
  vtkNew<vtkFloatArray> array;
  array->SetName(name);
  cloud->GetPointData()->AddArray(array);
}

void sayUnit(vtkPolyData* cloud, const char* unit)
{
  vtkNew<vtkStringArray> array;
  array->SetName("LengthUnit");
  array->InsertNextValue(unit);
  cloud->GetFieldData()->AddArray(array);
}

const Bounds kStatue = boxOf({ 226, -388, -606 }, { 1156, 145, 991 });
const Bounds kStreet = boxOf({ -79, -80, -10 }, { 80, 75, 3 });
const Bounds kMap = boxOf({ 684766, 5017773, 0 }, { 684993, 5018007, 30 });

TEST(LengthUnit, IsWhatTheFileSays)
{
  vtkNew<vtkPolyData> cloud;
  sayUnit(cloud, "metre");
  EXPECT_EQ(lengthUnitOf(cloud, kStatue).name, "m");
  EXPECT_EQ(lengthUnitOf(cloud, kStatue).evidence, UnitEvidence::File);
  vtkNew<vtkPolyData> thing;
  sayUnit(thing, "mm");
  EXPECT_EQ(lengthUnitOf(thing, kMap).metres, 1e-3);
  sayUnit(thing, "Centimeters");
  EXPECT_EQ(lengthUnitOf(thing, kMap).metres, 0.01);
  vtkNew<vtkPolyData> survey;
  sayUnit(survey, "US survey foot");
  EXPECT_EQ(lengthUnitOf(survey, kMap).name, "us-ft");
  EXPECT_NEAR(lengthUnitOf(survey, kMap).metres, 0.3048006096, 1e-10);
  for (const char* each : { "Foot_US", "US Feet", "Feet (US)", "usft", "sft", "US ft" })
  {
    EXPECT_STREQ(findLengthUnit(each)->name, "us-ft") << each;
  }
  EXPECT_STREQ(findLengthUnit("International Feet")->name, "ft");
  vtkNew<vtkPolyData> feet;
  sayUnit(feet, "foot");
  EXPECT_EQ(lengthUnitOf(feet, kMap).metres, 0.3048);
}

TEST(LengthUnit, OfAStatueOfManyUnitsIsMillimetres)
{
  vtkNew<vtkPolyData> cloud;
  const LengthUnit unit = lengthUnitOf(cloud, kStatue);
  EXPECT_EQ(unit.name, "mm");
  EXPECT_EQ(unit.metres, 1e-3);
  EXPECT_EQ(unit.evidence, UnitEvidence::Shape);
}

TEST(LengthUnit, OfAStreetAboutItsScannerIsNotMillimetres)
{
  vtkNew<vtkPolyData> bare;
  EXPECT_EQ(lengthUnitOf(bare, kStreet).name, "m");
  EXPECT_EQ(lengthUnitOf(bare, kStreet).evidence, UnitEvidence::None);
  vtkNew<vtkPolyData> sweep;
  addArray(sweep, "intensity");
  EXPECT_EQ(lengthUnitOf(sweep, kStreet).name, "m");
  // Intensities alone speak against millimetres, whatever the shape.
  EXPECT_EQ(lengthUnitOf(sweep, kStatue).name, "m");
}

TEST(LengthUnit, OfMapCoordinatesAndLidarArraysIsMetres)
{
  vtkNew<vtkPolyData> cloud;
  EXPECT_EQ(lengthUnitOf(cloud, kMap).evidence, UnitEvidence::Shape);
  EXPECT_EQ(lengthUnitOf(cloud, kMap).name, "m");
  addArray(cloud, "ReturnNumber");
  EXPECT_EQ(lengthUnitOf(cloud, kStatue).name, "m");
}

TEST(LengthUnit, OfSmallHugeAndEmptyCloudsIsNotTold)
{
  vtkNew<vtkPolyData> cloud;
  EXPECT_EQ(lengthUnitOf(cloud, boxOf({ 0, 0, 0 }, { 1, 1, 1 })).evidence, UnitEvidence::None);
  EXPECT_EQ(lengthUnitOf(cloud, boxOf({ 1, 1, 1 }, { 5e4, 5e4, 5e4 })).evidence, UnitEvidence::None);
  EXPECT_EQ(lengthUnitOf(cloud, Bounds()).name, "m");
  EXPECT_EQ(lengthUnitOf(nullptr, kStatue).name, "m");
}

TEST(LengthUnit, OfSharedCloudsIsRight)
{
  const std::string folder = POINTHAPTICS_SHARED_DATA;
  if (!std::filesystem::exists(folder + "/lucy_50k.ply"))
  {
    GTEST_SKIP() << "no shared clouds";
  }
  const auto unitOf = [&folder](const char* file)
  {
    vtkNew<vtkPointCloudReader> reader;
    reader->SetFileName((folder + "/" + file).c_str());
    reader->Update();
    double box[6];
    reader->GetOutput()->GetBounds(box);
    return lengthUnitOf(reader->GetOutput(), boxOf({ box[0], box[2], box[4] }, { box[1], box[3], box[5] }));
  };
  EXPECT_EQ(unitOf("lucy_50k.ply").name, "mm");
  for (const char* file : { "happy_543652.ply", "lion_takanawa.ply", "outdoor_lidar.ply", "office1.pcd" })
  {
    EXPECT_EQ(unitOf(file).name, "m") << file;
    EXPECT_EQ(unitOf(file).evidence, UnitEvidence::None) << file;
  }
  EXPECT_EQ(unitOf("Megaplot.las").evidence, UnitEvidence::File);
  EXPECT_EQ(unitOf("formats/autzen_trim.las").name, "ft");
  EXPECT_EQ(unitOf("formats/autzen_trim.las").evidence, UnitEvidence::File);
}

TEST(LengthUnit, DegreesBecomeMetresAboutTheMiddle)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int i = -5; i <= 5; ++i)
  {
    points->InsertNextPoint(11.5 + 1e-3 * i, 60.0 + 1e-3 * (i % 3), 100.0 + i);
  }
  points->InsertNextPoint(0.0, 0.0, 0.0); // a stray moves no middle
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  EXPECT_EQ(inLocalMetres(cloud).Get(), cloud.Get());
  sayUnit(cloud, "degree");
  const auto local = inLocalMetres(cloud);
  EXPECT_EQ(lengthUnitOf(local, Bounds()).name, "m");
  EXPECT_EQ(lengthUnitOf(cloud, Bounds()).name, "deg");
  EXPECT_EQ(local->GetPoints()->GetDataType(), VTK_DOUBLE);
  double first[3];
  double last[3];
  local->GetPoint(0, first);
  local->GetPoint(10, last);
  // 111,195 m a degree of a sphere of the mean radius; half of it along the parallel of 60 degrees.
  EXPECT_NEAR(last[0] - first[0], 0.01 * 111195.0 / 2.0, 0.02);
  EXPECT_NEAR(last[1] - first[1], 0.004 * 111195.0, 0.2);
  EXPECT_EQ(last[2] - first[2], 10.0);
  EXPECT_LT(std::abs(last[0] + first[0]), 120.0);
  local->GetPoint(11, last);
  EXPECT_EQ(last[0], 0.0) << "no return stays one";
  EXPECT_EQ(last[1], 0.0);
}

TEST(LengthUnit, DegreesGoOnAcrossTheAntimeridian)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const double longitude : { 179.999, 179.9995, -179.9995, -179.999 })
  {
    points->InsertNextPoint(longitude, -17.0, 5.0);
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  sayUnit(cloud, "degree");
  double box[6];
  inLocalMetres(cloud)->GetBounds(box);
  EXPECT_NEAR(box[1] - box[0], 0.002 * 111195.0 * 0.9563, 0.5);
}

TEST(LengthUnit, DegreesAreTakenByTheirRange)
{
  const auto cloudOf = [](double (*z)(int), double width)
  {
    vtkNew<vtkPoints> points;
    for (int i = 0; i < 900; ++i)
    {
      points->InsertNextPoint(4.0 + width / 30.0 * (i % 30), 52.0 + width / 30.0 * (i / 30), z(i));
    }
    auto cloud = vtkSmartPointer<vtkPolyData>::New();
    cloud->SetPoints(points);
    return cloud;
  };
  const auto sea = cloudOf([](int i) { return -20.0 * std::sin(0.1 * (i % 30)); }, 0.3);
  EXPECT_TRUE(looksLikeDegrees(sea));
  EXPECT_EQ(summarize(sea, "xyz").unit, "deg");
  EXPECT_EQ(summarize(sea, "xyz").hint.substr(0, 20), "degrees, as guessed,");
  EXPECT_EQ(inLocalMetres(sea), sea);
  const Bounds local = boxOf(Vec3(), Vec3());
  EXPECT_GT(inLocalMetres(sea, true)->GetBounds()[1], 9e3);
  EXPECT_EQ(lengthUnitOf(inLocalMetres(sea, true), local).evidence, UnitEvidence::File);
  EXPECT_FALSE(looksLikeDegrees(cloudOf([](int i) { return 0.013 * (7919 * i % 900); }, 0.3))) << "a pole";
  EXPECT_FALSE(looksLikeDegrees(cloudOf([](int i) { return 0.1 * (i % 7); }, 0.3))) << "a thing";
  sayUnit(sea, "m");
  EXPECT_FALSE(looksLikeDegrees(sea));
}

} // namespace
