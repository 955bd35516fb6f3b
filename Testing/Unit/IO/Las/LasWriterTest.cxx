#include "CloudFiles.h"

#include "Core/Base/FieldNames.h"
#include "IO/Info/FieldText.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkPointCloudWriter.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnsignedShortArray.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <utility>

namespace
{

using pointhaptics::io::addFieldText;
using pointhaptics::io::fieldText;

class LasWriting : public CloudFiles
{
protected:
  std::string bytesOf(const std::string& name) const
  {
    std::ifstream file(path(name), std::ios::binary);
    return { std::istreambuf_iterator<char>(file), {} };
  }
};

/// A LAS file of @p points points whose every byte is random, but for what must be within range.
std::string makeRandomLas(int minor, int format, std::size_t recordLength, int points)
{
  std::string las = makeLas(minor, format, recordLength);
  const std::size_t start = las.size() - 2 * recordLength;
  las.resize(start);
  std::mt19937 random(static_cast<unsigned>(format));
  const bool extended = format >= 6;
  const std::size_t gpsTime = extended ? 22 : format == 1 || format >= 3 ? 20 : 0;
  for (int i = 0; i < points; ++i)
  {
    std::string record(recordLength, '\0');
    for (char& c : record)
    {
      c = static_cast<char>(random() & 255);
    }
    if (gpsTime != 0)
    {
      put(record, gpsTime, 1e5 + 0.001 * i);
    }
    las += record;
  }
  put(las, 107, static_cast<std::uint32_t>(extended ? 0 : points));
  if (minor == 4)
  {
    put(las, 247, static_cast<std::uint64_t>(points));
  }
  return las;
}

TEST_F(LasWriting, GivesBackEveryByteOfEveryRecord)
{
  struct Case
  {
    int minor, format;
    std::size_t length;
  };
  for (const Case& each : { Case{ 2, 0, 20 }, { 2, 1, 28 }, { 2, 2, 26 }, { 2, 3, 34 }, { 4, 6, 30 },
         { 4, 7, 36 }, { 4, 8, 38 }, { 2, 3, 41 }, { 4, 8, 47 } })
  {
    constexpr int kPoints = 300;
    const std::string original = makeRandomLas(each.minor, each.format, each.length, kPoints);
    const ReadResult first = readCloud(write("a.las", original));
    ASSERT_EQ(first.error, "");
    std::vector<std::string> notes;
    ASSERT_EQ(writeCloud(first.cloud, path("b.las"), &notes), "");
    EXPECT_EQ(notes, std::vector<std::string>());
    const std::string copy = bytesOf("b.las");
    // RGB repeats what Color16 has, and extra bytes get a description.
    const std::size_t records = kPoints * each.length;
    ASSERT_GT(copy.size(), records);
    EXPECT_TRUE(copy.substr(copy.size() - records) == original.substr(original.size() - records))
      << "point format " << each.format << ", record of " << each.length;
    const ReadResult second = readCloud(path("b.las"));
    EXPECT_EQ(second.format, first.format);
    EXPECT_EQ(
      second.cloud->GetPointData()->GetNumberOfArrays(), first.cloud->GetPointData()->GetNumberOfArrays());
  }
}

TEST_F(LasWriting, WholeNumbersOfOtherTypesBecomeTheFieldsOfTheirNames)
{
  ReadResult text = readCloud(write("a.csv", "x,y,z,Intensity,Classification\n1,2,3,65535,2\n4,5,6,7,9\n"));
  ASSERT_EQ(text.error, "");
  ASSERT_EQ(text.array("Intensity")->GetDataType(), VTK_INT);
  ASSERT_EQ(writeCloud(text.cloud, path("a.las")), "");
  ReadResult las = readCloud(path("a.las"));
  EXPECT_EQ(las.value("Intensity", 0), 65535);
  EXPECT_EQ(las.value("Classification", 1), 9);
  EXPECT_EQ(las.array("IntensityExtra"), nullptr);
  // Values that do not fit stay in an array of their own.
  text = readCloud(write("b.csv", "x,y,z,Intensity\n1,2,3,65536\n4,5,6,7\n"));
  ASSERT_EQ(writeCloud(text.cloud, path("b.las")), "");
  las = readCloud(path("b.las"));
  EXPECT_EQ(las.value("Intensity", 0), 0);
  EXPECT_EQ(las.value("IntensityExtra", 0), 65536);
}

TEST_F(LasWriting, RoundsMetresToATenthOfAMillimetreOrWhatIsAskedFor)
{
  vtkNew<vtkPolyData> cloud;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToFloat();
  std::mt19937 random(7);
  std::uniform_real_distribution<float> unit(0.5f, 1.0f);
  for (int i = 0; i < 1000; ++i)
  {
    points->InsertNextPoint(unit(random), -unit(random), 100.0f + unit(random));
  }
  cloud->SetPoints(points);
  std::vector<std::string> notes;
  ASSERT_EQ(writeCloud(cloud, path("a.las"), &notes), "");
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("steps of 1e-04, by at most 5e-05; "), std::string::npos) << notes[0];
  vtkNew<vtkPointCloudWriter> writer;
  writer->SetInputData(cloud);
  writer->SetFileName(path("b.las").c_str());
  writer->SetLasScale(0.003);
  ASSERT_EQ(writer->Write(), 1);
  for (const auto& [file, step] : { std::pair{ "a.las", 0.0001 }, { "b.las", 0.003 } })
  {
    const ReadResult result = readCloud(path(file));
    EXPECT_EQ(result.cloud->GetFieldData()->GetArray("LasScale")->GetComponent(0, 0), step);
    for (vtkIdType i = 0; i < 1000; ++i)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        ASSERT_NEAR(result.cloud->GetPoint(i)[axis], points->GetPoint(i)[axis], 0.51 * step);
      }
    }
  }
}

TEST_F(LasWriting, RefusesStepsThatDoNotSpanTheCloud)
{
  const ReadResult text = readCloud(write("a.csv", "x,y,z\n0,0,0\n1000,0,0\n"));
  vtkNew<vtkPointCloudWriter> writer;
  writer->SetInputData(text.cloud);
  writer->SetFileName(path("a.las").c_str());
  writer->SetLasScale(1e-9);
  vtkObject::GlobalWarningDisplayOff();
  EXPECT_EQ(writer->Write(), 0);
  vtkObject::GlobalWarningDisplayOn();
  EXPECT_NE(std::string(writer->GetErrorMessage()).find("do not span the cloud"), std::string::npos);
}

TEST_F(LasWriting, FieldsAreKnownInAnySpelling)
{
  const ReadResult text = readCloud(write("a.csv",
    "x,y,z,classification,INTENSITY,return_number,gps_time,Scan "
    "Angle\n1,2,3,5,77,1,1.5,-3.5\n4,5,6,6,78,2,2.5,4\n"));
  ASSERT_EQ(writeCloud(text.cloud, path("a.las")), "");
  const ReadResult las = readCloud(path("a.las"));
  EXPECT_EQ(las.value("Classification", 1), 6);
  EXPECT_EQ(las.value("Intensity", 0), 77);
  EXPECT_EQ(las.value("ReturnNumber", 1), 2);
  EXPECT_EQ(las.value("GpsTime", 1), 2.5);
  EXPECT_NEAR(las.value("ScanAngle", 0), -3.5, 0.003);
  EXPECT_EQ(las.array("classification"), nullptr);
}

TEST_F(LasWriting, TextAndLasTurnIntoEachOtherWithTheSameColumns)
{
  ReadResult cloud = readCloud(write("a.las", makeRandomLas(4, 8, 38, 50)));
  std::string header;
  for (int round = 0; round < 3; ++round)
  {
    ASSERT_EQ(writeCloud(cloud.cloud, path("a.csv")), "");
    const std::string text = bytesOf("a.csv");
    EXPECT_TRUE(round == 0 || text.substr(0, text.find('\n')) == header) << text.substr(0, text.find('\n'));
    header = text.substr(0, text.find('\n'));
    cloud = readCloud(path("a.csv"));
    ASSERT_EQ(writeCloud(cloud.cloud, path("b.laz")), "");
    cloud = readCloud(path("b.laz"));
    ASSERT_EQ(cloud.error, "");
  }
}

TEST_F(LasWriting, KeepsTheDecimalsOfATextWithoutAWord)
{
  std::mt19937 random(3);
  for (const double offset : { 0.0, 500000.0 })
  {
    std::string text;
    for (int i = 0; i < 500; ++i)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        text += std::to_string(int(offset) + int(random() % 5)) + "." +
          std::to_string(10000 + random() % 10000).substr(1) + (axis < 2 ? " " : "\n");
      }
    }
    const ReadResult from = readCloud(write("a.xyz", text));
    ASSERT_EQ(from.cloud->GetPoints()->GetDataType(), offset == 0.0 ? VTK_FLOAT : VTK_DOUBLE);
    std::vector<std::string> notes;
    ASSERT_EQ(writeCloud(from.cloud, path("a.las"), &notes), "");
    EXPECT_TRUE(notes.empty()) << notes[0];
    const ReadResult result = readCloud(path("a.las"));
    EXPECT_EQ(result.cloud->GetFieldData()->GetArray("LasScale")->GetComponent(0, 0), 0.0001);
    for (vtkIdType i = 0; i < 500; ++i)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        const double wanted = from.cloud->GetPoint(i)[axis];
        const double given = result.cloud->GetPoint(i)[axis];
        ASSERT_TRUE(offset == 0.0 ? float(given) == float(wanted) : std::abs(given - wanted) < 2e-10) << i;
      }
    }
  }
}

TEST_F(LasWriting, SaysHowFarCoordinatesAreRounded)
{
  vtkNew<vtkPolyData> cloud;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->InsertNextPoint(1.0 / 3.0, 0.0, 0.0);
  points->InsertNextPoint(684766.123456789, 1.0, 2.0);
  cloud->SetPoints(points);
  std::vector<std::string> notes;
  ASSERT_EQ(writeCloud(cloud, path("a.las"), &notes), "");
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("rounded"), std::string::npos);
  const ReadResult result = readCloud(path("a.las"));
  EXPECT_NEAR(result.cloud->GetPoint(0)[0], 1.0 / 3.0, 5.1e-4);
  EXPECT_NEAR(result.cloud->GetPoint(1)[0], 684766.123456789, 5.1e-4);
  EXPECT_EQ(result.cloud->GetPoint(1)[2], 2.0);
}

/// Points of doubles that are on no grid, within @p half of @p centre on each axis, as from a file with that
/// scale and offset (0: none).
vtkSmartPointer<vtkPolyData> makeMeans(double centre, double half, double scale, double offset)
{
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> within(centre - half, centre + half);
  for (int i = 0; i < 500; ++i)
  {
    points->InsertNextPoint(within(random), within(random), within(random));
  }
  cloud->SetPoints(points);
  for (const auto& [name, value] : { std::pair{ "LasScale", scale }, std::pair{ "LasOffset", offset } })
  {
    vtkNew<vtkDoubleArray> triple;
    triple->SetName(name);
    triple->SetNumberOfComponents(3);
    triple->InsertNextTuple3(value, value, value);
    if (scale != 0.0)
    {
      cloud->GetFieldData()->AddArray(triple);
    }
  }
  return cloud;
}

struct WrittenGrid
{
  double scale, offset, largestError;
  std::vector<std::string> notes;
};

class LasGridOfMeans : public LasWriting
{
protected:
  /// The grid in the file, the same on all axes, and what rounding did.
  WrittenGrid written(vtkPolyData* cloud) const
  {
    WrittenGrid grid{};
    EXPECT_EQ(writeCloud(cloud, path("means.las"), &grid.notes), "");
    const std::string bytes = bytesOf("means.las");
    std::memcpy(&grid.scale, bytes.data() + 131, sizeof(double));
    std::memcpy(&grid.offset, bytes.data() + 155, sizeof(double));
    EXPECT_EQ(bytes.substr(131, 8), bytes.substr(131 + 16, 8));
    const ReadResult result = readCloud(path("means.las"));
    for (vtkIdType i = 0; i < result.points(); ++i)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        grid.largestError =
          std::max(grid.largestError, std::abs(result.cloud->GetPoint(i)[axis] - cloud->GetPoint(i)[axis]));
      }
    }
    return grid;
  }
};

TEST_F(LasGridOfMeans, KeepsTheScaleAndOffsetOfTheFileTheyComeFrom)
{
  const WrittenGrid grid = written(makeMeans(515400.0, 17.0, 0.00025, 515383.25));
  EXPECT_EQ(grid.scale, 0.00025);
  EXPECT_EQ(grid.offset, 515383.25);
  EXPECT_GT(grid.largestError, 0.0001);
  EXPECT_LE(grid.largestError, 0.000125 + 1e-9);
  ASSERT_EQ(grid.notes.size(), 1u);
  EXPECT_NE(grid.notes[0].find("rounded to steps of 0.00025, by at most 0.00012"), std::string::npos)
    << grid.notes[0];
}

TEST_F(LasGridOfMeans, KeepsTheScaleWhereOnlyTheOffsetIsOutOfReach)
{
  // 2^31 steps of 0.25 mm are 537 km.
  const WrittenGrid grid = written(makeMeans(7.0e6, 50.0, 0.00025, 0.0));
  EXPECT_EQ(grid.scale, 0.00025);
  EXPECT_EQ(grid.offset, 7.0e6);
  EXPECT_LE(grid.largestError, 0.000125 + 1e-8);
}

TEST_F(LasGridOfMeans, TakesAPowerOfTenWhereTheScaleDoesNotSuitTheCloud)
{
  // A cloud of 200 m, made 100 mm: a centimetre is too much for it.
  const WrittenGrid small = written(makeMeans(0.0, 0.05, 0.01, 0.0));
  EXPECT_EQ(small.scale, 1e-7);
  EXPECT_EQ(small.offset, 0.0);
  EXPECT_LE(small.largestError, 0.51e-7);
  // One of 2e9 m: 32 bits hold no centimetres of it.
  const WrittenGrid large = written(makeMeans(0.0, 1e9, 0.01, 0.0));
  EXPECT_EQ(large.scale, 1.0);
  EXPECT_LE(large.largestError, 0.5);
}

TEST_F(LasGridOfMeans, HasStepsOfAPowerOfTenWhereThereIsNoFileWithAScale)
{
  struct Case
  {
    double centre, half, scale, offset;
  };
  for (const Case& each : { Case{ 0.3, 1.0, 1e-4, 0.0 }, { 684879.84, 113.0, 1e-4, 700000.0 },
         { -3.0e6, 2.0, 1e-4, -3.0e6 }, { 0.0, 20.0, 1e-4, 0.0 }, { 0.7123, 0.02, 1e-7, 0.0 } })
  {
    const WrittenGrid grid = written(makeMeans(each.centre, each.half, 0.0, 0.0));
    EXPECT_EQ(grid.scale, each.scale) << each.centre;
    EXPECT_EQ(grid.offset, each.offset) << each.centre;
    EXPECT_LE(grid.largestError, 0.51 * each.scale + 1e-15 * std::abs(each.centre)) << each.centre;
  }
}

TEST_F(LasGridOfMeans, HasTheDecimalsOfNumbersThatWereWrittenWithThem)
{
  const auto cloud = makeMeans(0.0, 0.0, 0.0, 0.0);
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    const double number = std::stod(std::to_string(500000 + i % 7) + "." + std::to_string(100 + i));
    cloud->GetPoints()->SetPoint(i, number, number, number);
  }
  const WrittenGrid grid = written(cloud);
  EXPECT_EQ(grid.scale, 0.001);
  EXPECT_LE(grid.largestError, 1e-9);
}

TEST_F(LasWriting, FindsAGridForAnyFiniteCoordinates)
{
  for (const double size : { 0.0, 1e-280, 1e-12, 1.0 / 3.0, 1e12, 1e29 })
  {
    for (const double centre : { 0.0, 86192.56269872189, -1e29 })
    {
      vtkNew<vtkPolyData> cloud;
      vtkNew<vtkPoints> points;
      points->SetDataTypeToDouble();
      points->InsertNextPoint(centre, centre - size, -size);
      points->InsertNextPoint(centre + size, centre, size / 3.0);
      cloud->SetPoints(points);
      ASSERT_EQ(writeCloud(cloud, path("a.las")), "");
      const ReadResult result = readCloud(path("a.las"));
      ASSERT_EQ(result.error, "") << size << " about " << centre;
      for (vtkIdType i = 0; i < 2; ++i)
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          // Half a step: 0.1 mm, a hundred thousandth of a small cloud, ten 2^31th parts of half a large one,
          // or ten of a double's last digits.
          const double usual = size < 0.1 ? 1e-5 * size : 0.51e-4;
          const double tolerance = std::max(usual, 1.6e-9 * size) + 1.2e-15 * std::abs(centre);
          EXPECT_NEAR(result.cloud->GetPoint(i)[axis], points->GetPoint(i)[axis], tolerance)
            << size << " " << centre;
        }
      }
    }
  }
}

TEST_F(LasWriting, PutsOtherArraysIntoExtraBytes)
{
  vtkNew<vtkPolyData> cloud;
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(1, 2, 3);
  points->InsertNextPoint(4, 5, 6);
  cloud->SetPoints(points);
  vtkNew<vtkDoubleArray> covariance;
  covariance->SetName("VoxelCovariance");
  covariance->SetNumberOfComponents(6);
  covariance->SetNumberOfTuples(2);
  const auto count = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(VTK_TYPE_INT64));
  count->SetName("VoxelPointCount");
  vtkNew<vtkUnsignedCharArray> color;
  color->SetName("RGB");
  color->SetNumberOfComponents(3);
  color->SetNumberOfTuples(2);
  for (vtkIdType i = 0; i < 12; ++i)
  {
    covariance->SetValue(i, std::sqrt(static_cast<double>(i)));
    color->SetValue(i % 6, static_cast<unsigned char>(40 * i % 256));
  }
  count->SetNumberOfTuples(2);
  const std::int64_t values[] = { std::numeric_limits<std::int64_t>::max(), -7 };
  std::memcpy(count->GetVoidPointer(0), values, sizeof(values));
  vtkNew<vtkFloatArray> named;
  named->SetName("a name that is far longer than thirty-two bytes");
  named->InsertNextValue(0.1f);
  named->InsertNextValue(std::nanf(""));
  for (vtkDataArray* array : std::initializer_list<vtkDataArray*>{ covariance, count.Get(), color, named })
  {
    cloud->GetPointData()->AddArray(array);
  }
  std::vector<std::string> notes;
  ASSERT_EQ(writeCloud(cloud, path("a.las"), &notes), "");
  ASSERT_EQ(notes.size(), 1u) << "the name is too long";
  const ReadResult result = readCloud(path("a.las"));
  ASSERT_EQ(result.error, "");
  ASSERT_EQ(result.array("VoxelCovariance")->GetNumberOfComponents(), 6);
  EXPECT_EQ(result.value("VoxelCovariance", 1, 5), std::sqrt(11.0));
  expectSameBits(count, result.array("VoxelPointCount"));
  EXPECT_EQ(result.value("RGB", 1, 2), color->GetComponent(1, 2));
  EXPECT_EQ(static_cast<float>(result.value("a name that is far longer than t", 0)), 0.1f);
}

TEST_F(LasWriting, KeepsTheCoordinateSystem)
{
  for (const std::string& system : { std::string("EPSG:26917"), std::string("EPSG:4326"),
         std::string("PROJCS[\"made up\",GEOGCS[\"g\",UNIT[\"degree\",0.017]],UNIT[\"metre\",1]]") })
  {
    const ReadResult plain = readCloud(write("a.las", makeLas(2, 0, 20)));
    addFieldText(plain.cloud, "CoordinateSystem", system);
    ASSERT_EQ(writeCloud(plain.cloud, path("b.las")), "");
    const ReadResult result = readCloud(path("b.las"));
    ASSERT_EQ(result.error, "");
    EXPECT_EQ(fieldText(result.cloud->GetFieldData(), "CoordinateSystem"), system);
    vtkAbstractArray* unit = result.cloud->GetFieldData()->GetAbstractArray("LengthUnit");
    EXPECT_EQ(unit != nullptr, system != "EPSG:26917") << "degrees, or as the text says";
  }
}

TEST_F(LasWriting, KeepsTheUnit)
{
  for (const std::string& system : { std::string(), std::string("EPSG:2263") })
  {
    for (std::string unit : { std::string("metre"), std::string("foot"), std::string("US survey foot"),
           std::string("millimetre"), std::string("centimetre"), std::string("degree") })
    {
      unit = unit == "degree" && !system.empty() ? "metre" : unit; // a projected system has no degrees
      const ReadResult plain = readCloud(write("a.las", makeLas(2, 0, 20)));
      addFieldText(plain.cloud, "CoordinateSystem", system);
      addFieldText(plain.cloud, "LengthUnit", unit);
      ASSERT_EQ(writeCloud(plain.cloud, path("b.las")), "");
      const ReadResult result = readCloud(path("b.las"));
      ASSERT_EQ(result.error, "");
      EXPECT_EQ(fieldText(result.cloud->GetFieldData(), "LengthUnit"), unit);
      EXPECT_EQ(fieldText(result.cloud->GetFieldData(), "CoordinateSystem"), system);
    }
  }
}

TEST_F(LasWriting, LeavesOutAndCountsPointsThatAreNotFinite)
{
  vtkNew<vtkPolyData> cloud;
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(1, 2, 3);
  points->InsertNextPoint(4, std::nan(""), 6);
  points->InsertNextPoint(7, 8, 9);
  points->InsertNextPoint(-INFINITY, 2, 3);
  cloud->SetPoints(points);
  vtkNew<vtkIntArray> numbers;
  numbers->SetName("number");
  for (const int number : { 10, 11, 12, 13 })
  {
    numbers->InsertNextValue(number);
  }
  cloud->GetPointData()->AddArray(numbers);
  for (const char* name : { "a.las", "a.laz" })
  {
    std::vector<std::string> notes;
    ASSERT_EQ(writeCloud(cloud, path(name), &notes), "");
    ASSERT_EQ(notes.size(), 1u) << name;
    EXPECT_EQ(notes[0].find("2 of 4 points are NaN or infinite and left out"), 0u) << notes[0];
    const ReadResult result = readCloud(path(name));
    ASSERT_EQ(result.error, "");
    ASSERT_EQ(result.points(), 2);
    EXPECT_EQ(result.value("number", 0), 10.0);
    EXPECT_EQ(result.value("number", 1), 12.0);
    EXPECT_EQ(result.cloud->GetPoint(1)[0], 7.0);
  }
}

TEST_F(LasWriting, RefusesACloudWithoutAFinitePoint)
{
  vtkNew<vtkPolyData> cloud;
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(4, std::nan(""), 6);
  cloud->SetPoints(points);
  EXPECT_NE(writeCloud(cloud, path("a.las")).find("all coordinates are NaN"), std::string::npos);
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST_F(LasWriting, RealAirborneCloudComesBackAsItWas)
{
  const std::string folder = sharedData();
  if (folder.empty())
  {
    GTEST_SKIP() << "no real clouds beside this checkout (set POINTHAPTICS_SHARED_DATA to their folder)";
  }
  for (const char* name : { "Megaplot.las", "pine.las" })
  {
    const ReadResult first = readCloud(folder + "/" + name);
    std::vector<std::string> notes;
    ASSERT_EQ(writeCloud(first.cloud, path(name), &notes), "");
    EXPECT_TRUE(notes.empty()) << notes[0];
    const ReadResult second = readCloud(path(name));
    ASSERT_EQ(second.points(), first.points());
    expectSameBits(first.cloud->GetPoints()->GetData(), second.cloud->GetPoints()->GetData());
    for (int i = 0; i < first.cloud->GetPointData()->GetNumberOfArrays(); ++i)
    {
      vtkDataArray* array = first.cloud->GetPointData()->GetArray(i);
      expectSameBits(array, second.array(array->GetName()));
    }
  }
}

TEST_F(LasWriting, DegreesGetStepsOfCentimetres)
{
  vtkNew<vtkPolyData> cloud;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->InsertNextPoint(8.123456789, 47.987654321, 408.12345);
  points->InsertNextPoint(9.5, 48.75, 1200.0);
  cloud->SetPoints(points);
  vtkNew<vtkStringArray> unit;
  unit->SetName("LengthUnit");
  unit->InsertNextValue("degree");
  cloud->GetFieldData()->AddArray(unit);
  ASSERT_EQ(writeCloud(cloud, path("a.las")), "");
  const ReadResult result = readCloud(path("a.las"));
  EXPECT_NEAR(result.cloud->GetPoint(0)[0], 8.123456789, 6e-8);
  EXPECT_NEAR(result.cloud->GetPoint(0)[1], 47.987654321, 6e-8);
  EXPECT_NEAR(result.cloud->GetPoint(0)[2], 408.12345, 6e-5);
  std::ifstream file(path("a.las"), std::ios::binary);
  const std::string bytes{ std::istreambuf_iterator<char>(file), {} };
  EXPECT_NE(bytes.find(std::string("\x06\x08\0\0\1\0\x8e\x23", 8)), std::string::npos) << "2054: 9102";
  points->SetPoint(0, 8.1234567, 47.9876543, 408.5);
  std::vector<std::string> notes;
  ASSERT_EQ(writeCloud(cloud, path("b.las"), &notes), "");
  EXPECT_TRUE(notes.empty()) << "whole steps are not rounded: " << notes[0];
}

TEST_F(LasWriting, KeepsNearInfraredWithoutColors)
{
  const ReadResult plain = readCloud(write("a.las", makeLas(2, 0, 20)));
  vtkNew<vtkUnsignedShortArray> infrared;
  infrared->SetName("NearInfrared");
  infrared->InsertNextValue(258);
  infrared->InsertNextValue(65535);
  plain.cloud->GetPointData()->AddArray(infrared);
  for (const char* name : { "b.las", "b.laz" })
  {
    ASSERT_EQ(writeCloud(plain.cloud, path(name)), "");
    expectSameBits(infrared, readCloud(path(name)).array("NearInfrared"));
  }
}

TEST_F(LasWriting, DegreesAreRoundedInOtherStepsThanHeights)
{
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(vtkNew<vtkPoints>());
  cloud->GetPoints()->SetDataTypeToDouble();
  cloud->GetPoints()->InsertNextPoint(8.123456789, 47.0, 400.000012);
  cloud->GetPoints()->InsertNextPoint(8.2, 47.1, 450.0);
  pointhaptics::io::addFieldText(cloud, "LengthUnit", "degree");
  std::vector<std::string> notes;
  ASSERT_EQ(writeCloud(cloud, path("a.las"), &notes), "");
  EXPECT_NE(notes.front().find("to steps of 1e-07 in x, 1e-04 in z, by"), std::string::npos);
}

} // namespace
