// Arrays of any name, and what PCL's point types find in a PCD file.
#include "CloudFiles.h"

#include "IO/Info/FieldText.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkInformationStringKey.h"
#include "vtkVariant.h"

namespace
{

class WrittenNames : public CloudFiles
{
};

bool isNoted(const std::vector<std::string>& notes, const std::string& part)
{
  for (const std::string& note : notes)
  {
    if (note.find(part) != std::string::npos)
    {
      return true;
    }
  }
  return false;
}

/// A cloud with one array of that name, which writers must give back.
vtkSmartPointer<vtkPolyData> named(const std::string& name)
{
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(1, 2, 3);
  points->InsertNextPoint(4, 5, 6);
  cloud->SetPoints(points);
  const auto array = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(VTK_FLOAT));
  array->SetName(name.c_str());
  array->SetNumberOfTuples(2);
  array->SetComponent(0, 0, 0.5);
  array->SetComponent(1, 0, -2.5);
  cloud->GetPointData()->AddArray(array);
  return cloud;
}

TEST_F(WrittenNames, ArraysOfAnyNameComeBackOrAreRenamedAloud)
{
  const std::string names[] = { "R&D", "a<b", "a>b", "say \"x\"", "it's", "two words", "1", "-1", "nan",
    "inf", "1e3", "", "\xc3\xa4\xc3\xb6\xc3\xbc \xe2\x82\xac", "#", "//x", "a,b", "a;b", "a|b", "100 %", "_",
    "rgb", std::string(300, 'n'), "X", "tab\there", "sep=;", "[m]" };
  for (const char* extension : { "vtp", "ply", "pcd", "las", "laz", "csv", "xyz" })
  {
    for (const std::string& name : names)
    {
      std::vector<std::string> notes;
      const std::string file = path(std::string("a.") + extension);
      ASSERT_EQ(writeCloud(named(name), file, &notes), "") << extension << " " << name;
      const ReadResult result = readCloud(file);
      ASSERT_EQ(result.error, "") << extension << " " << name;
      ASSERT_EQ(result.points(), 2) << extension << " " << name;
      EXPECT_EQ(result.cloud->GetPoint(1)[2], 6.0) << extension << " " << name;
      vtkDataArray* array = notes.empty() ? result.array(name.c_str()) : nullptr;
      for (int i = 0; !notes.empty() && i < result.cloud->GetPointData()->GetNumberOfArrays(); ++i)
      {
        vtkDataArray* each = result.cloud->GetPointData()->GetArray(i);
        array = isNoted(notes, std::string("is called ") + each->GetName()) ? each : array;
      }
      ASSERT_NE(array, nullptr) << extension << " '" << name << "' " << (notes.empty() ? "" : notes[0]);
      EXPECT_EQ(array->GetComponent(1, 0), -2.5) << extension << " " << name;
      EXPECT_TRUE(notes.empty() || name.empty() || std::string(extension) != "vtp") << name;
    }
  }
}

TEST_F(WrittenNames, BytesThatAreNoTextAreRenamed)
{
  for (const char* extension : { "vtp", "ply", "pcd", "las", "csv", "xyz" })
  {
    for (const char* name : { "h\xf6he", "\xff\xfe", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xc3", "\x01z" })
    {
      ASSERT_EQ(writeCloud(named(name), path(std::string("a.") + extension)), "") << extension << " " << name;
      const ReadResult result = readCloud(path(std::string("a.") + extension));
      ASSERT_EQ(result.error, "") << extension << " " << name;
      vtkPointData* data = result.cloud->GetPointData();
      EXPECT_EQ(data->GetArray(data->GetNumberOfArrays() - 1)->GetComponent(1, 0), -2.5) << extension << name;
    }
  }
  ASSERT_EQ(writeCloud(named("h\xf6he"), path("a.vtp")), "");
  EXPECT_NE(readCloud(path("a.vtp")).array("h\xc3\xb6he"), nullptr);
}

TEST_F(WrittenNames, NamesThatAreCutInLasStayApart)
{
  auto cloud = named(std::string(40, 'a') + "1");
  cloud->GetPointData()->AddArray(named(std::string(40, 'a') + "2")->GetPointData()->GetArray(0));
  ASSERT_EQ(writeCloud(cloud, path("a.las")), "");
  EXPECT_NE(readCloud(path("a.las")).array((std::string(30, 'a') + "_2").c_str()), nullptr);
}

TEST_F(WrittenNames, NumbersThatAFieldCannotHoldAreSaid)
{
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(named("a")->GetPoints());
  const auto normals = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(VTK_DOUBLE));
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(2);
  normals->Fill(1.0 / 3.0);
  cloud->GetPointData()->AddArray(normals);
  vtkNew<vtkPointCloudWriter> writer;
  writer->SetInputData(cloud);
  writer->SetFileName(path("a.pcd").c_str());
  ASSERT_EQ(writer->Write(), 1);
  EXPECT_EQ(writer->GetNotes().size(), 0u) << "rounding that nobody sees";
  normals->Fill(1e7 / 3.0);
  normals->Modified();
  ASSERT_EQ(writer->Write(), 1);
  EXPECT_TRUE(isNoted(writer->GetNotes(), "array Normals is rounded to floats"));
  std::vector<std::string> notes;
  const auto times = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(VTK_LONG_LONG));
  times->SetName("GpsTime");
  times->SetNumberOfTuples(2);
  times->SetVariantValue(0, vtkVariant((1LL << 53) + 1));
  times->SetVariantValue(1, vtkVariant(7));
  cloud->GetPointData()->AddArray(times);
  ASSERT_EQ(writeCloud(cloud, path("a.las"), &notes), "");
  EXPECT_TRUE(isNoted(notes, "cannot hold, and is called GpsTimeExtra in the extra bytes; scale it"));
  EXPECT_EQ(readCloud(path("a.las")).array("GpsTimeExtra")->GetVariantValue(0).ToLongLong(), (1LL << 53) + 1);
}

TEST_F(WrittenNames, AClassificationIsNotTakenForAnother)
{
  const std::string rows =
    "x,y,z,pred_classification,scalar_Classification,Classification\n1,2,3,-1,5,2\n4,5,6,1,6,9\n";
  const ReadResult read = readCloud(write("a.csv", rows));
  ASSERT_EQ(read.error, "");
  ASSERT_EQ(writeCloud(read.cloud, path("a.las")), "");
  const ReadResult result = readCloud(path("a.las"));
  EXPECT_EQ(result.value("Classification", 0), 2.0);
  EXPECT_EQ(result.value("Classification", 1), 9.0);
}

TEST_F(WrittenNames, VtpKeepsArraysApartWhoseNamesXmlMakesOne)
{
  auto cloud = named("a\x01");
  cloud->GetPointData()->AddArray(named("a\x02")->GetPointData()->GetArray(0));
  cloud->GetPointData()->AddArray(named("a_")->GetPointData()->GetArray(0));
  vtkDataArray* last = cloud->GetPointData()->GetArray(2);
  last->SetComponent(1, 0, 7.0);
  last->SetComponentName(0, "up & \x03 down");
  last->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), "metre");
  double range[2];
  last->GetRange(range); // VTK notes it with the array
  cloud->GetPointData()->SetActiveScalars("a_");
  std::vector<std::string> notes;
  ASSERT_EQ(writeCloud(cloud, path("a.vtp"), &notes), "");
  const ReadResult result = readCloud(path("a.vtp"));
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(result.cloud->GetPointData()->GetNumberOfArrays(), 3);
  ASSERT_NE(result.array("a__3"), nullptr);
  EXPECT_EQ(result.array("a__3")->GetComponent(1, 0), 7.0);
  EXPECT_STREQ(result.array("a__3")->GetComponentName(0), "up & _ down");
  EXPECT_EQ(result.cloud->GetPointData()->GetScalars(), result.array("a__3"));
  EXPECT_TRUE(isNoted(notes, "array 'a_' is called a__3"));
  EXPECT_TRUE(isNoted(notes, "what is noted of array 'a_' as UNITS_LABEL is left out"));
  EXPECT_EQ(notes.size(), 4u);
  cloud->GetPoints()->GetData()->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), "metre");
  vtkNew<vtkFloatArray> cells;
  cells->SetName("c");
  cells->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), "kelvin");
  cloud->GetCellData()->AddArray(cells);
  ASSERT_EQ(writeCloud(cloud, path("b.vtp"), &notes), "");
  EXPECT_TRUE(isNoted(notes, "what is noted of array 'Points' as UNITS_LABEL is left out"));
  EXPECT_TRUE(isNoted(notes, "what is noted of array 'c' as UNITS_LABEL is left out"));
  cloud->GetCellData()->RemoveArray("c");
  ASSERT_EQ(writeCloud(cloud, path("a.ply"), &notes), "");
  EXPECT_TRUE(isNoted(notes, "what is noted of array 'a_' as UNITS_LABEL is left out"));
}

TEST_F(WrittenNames, UnitsWithAHyphenAreKept)
{
  for (const char* text :
    { "x [us-ft],y [us-ft],z [us-ft]\n1,2,3\n4,5,6\n", "# units: us-ft\n1 2 3\n4 5 6\n" })
  {
    const ReadResult feet = readCloud(write("feet.txt", text));
    ASSERT_EQ(feet.error, "");
    for (const char* name : { "a.xyz", "a.ply" })
    {
      ASSERT_EQ(writeCloud(feet.cloud, path(name)), "");
      EXPECT_EQ(
        pointhaptics::io::fieldText(readCloud(path(name)).cloud->GetFieldData(), "LengthUnit"), "us-ft")
        << name;
    }
  }
}

} // namespace
