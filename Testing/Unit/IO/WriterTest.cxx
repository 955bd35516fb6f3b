#include "CloudFiles.h"
#include "IO/Info/FieldText.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkStringArray.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnsignedShortArray.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#ifdef __unix__
#include <csignal>
#include <sys/resource.h>
#endif

namespace
{

constexpr int kPoints = 100;

template <typename Array, typename Make>
void addArray(vtkPolyData* cloud, const char* name, int components, Make make)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(kPoints);
  for (vtkIdType i = 0; i < kPoints * components; ++i)
  {
    array->SetValue(i, make(i));
  }
  cloud->GetPointData()->AddArray(array);
}

/// A cloud at UTM coordinates with arrays of many types; point 7 is NaN.
vtkSmartPointer<vtkPolyData> makeCloud(int pointType)
{
  std::mt19937_64 random(42);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataType(pointType);
  for (int i = 0; i < kPoints; ++i)
  {
    points->InsertNextPoint(684766.39 + unit(random), 5017773.08 + unit(random), 100.0 * unit(random));
  }
  points->SetPoint(7, std::nan(""), 1.0, std::numeric_limits<double>::infinity());
  cloud->SetPoints(points);
  addArray<vtkUnsignedCharArray>(
    cloud, "RGB", 3, [](vtkIdType i) { return static_cast<unsigned char>(i * 7); });
  addArray<vtkFloatArray>(cloud, "Normals", 3, [&](vtkIdType) { return static_cast<float>(unit(random)); });
  addArray<vtkDoubleArray>(cloud, "Bandwidth", 1, [&](vtkIdType) { return unit(random); });
  addArray<vtkFloatArray>(
    cloud, "Density", 1, [&](vtkIdType) { return static_cast<float>(1e6 * unit(random)); });
  addArray<vtkUnsignedShortArray>(
    cloud, "Intensity", 1, [](vtkIdType i) { return static_cast<unsigned short>(65535 - i); });
  addArray<vtkIntArray>(cloud, "Label", 1, [](vtkIdType i) { return static_cast<int>(i) - 50; });
  addArray<vtkTypeInt64Array>(cloud, "VoxelPointCount", 1, [](vtkIdType i) { return (1ll << 40) + i; });
  addArray<vtkDoubleArray>(cloud, "VoxelCovariance", 6, [&](vtkIdType) { return unit(random); });
  cloud->GetPointData()->SetActiveScalars("RGB");
  cloud->GetPointData()->SetActiveNormals("Normals");
  return cloud;
}

bool same(double a, double b)
{
  return a == b || (std::isnan(a) && std::isnan(b));
}

void expectSameValues(vtkDataArray* expected, vtkDataArray* actual, bool asFloat)
{
  ASSERT_NE(actual, nullptr) << expected->GetName();
  ASSERT_EQ(actual->GetNumberOfComponents(), expected->GetNumberOfComponents()) << expected->GetName();
  ASSERT_EQ(actual->GetNumberOfTuples(), expected->GetNumberOfTuples());
  for (vtkIdType i = 0; i < expected->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < expected->GetNumberOfComponents(); ++c)
    {
      const double value = actual->GetComponent(i, c);
      const double read = asFloat ? static_cast<double>(static_cast<float>(value)) : value;
      ASSERT_TRUE(same(read, expected->GetComponent(i, c))) << expected->GetName() << " " << i << " " << c;
    }
  }
}

struct RoundTrip
{
  const char* extension;
  int pointType;
};

/// How GoogleTest names a parameter.
void PrintTo(const RoundTrip& roundTrip, std::ostream* os)
{
  *os << roundTrip.extension;
}

class WriterRoundTrip
  : public CloudFiles
  , public ::testing::WithParamInterface<RoundTrip>
{
};

TEST_P(WriterRoundTrip, GivesBackPointsAndEveryArray)
{
  const std::string extension = GetParam().extension;
  const bool typesAreStored = extension != "csv" && extension != "xyz";
  const auto cloud = makeCloud(GetParam().pointType);
  const std::string file = path("cloud." + extension);
  ASSERT_EQ(writeCloud(cloud, file), "");
  const ReadResult result = readCloud(file);
  ASSERT_EQ(result.error, "");
  if (typesAreStored)
  {
    EXPECT_EQ(result.cloud->GetPoints()->GetDataType(), GetParam().pointType);
  }
  expectSameValues(
    cloud->GetPoints()->GetData(), result.cloud->GetPoints()->GetData(), GetParam().pointType == VTK_FLOAT);
  EXPECT_EQ(result.cloud->GetPointData()->GetNumberOfArrays(), cloud->GetPointData()->GetNumberOfArrays());
  for (int i = 0; i < cloud->GetPointData()->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* expected = cloud->GetPointData()->GetArray(i);
    vtkDataArray* actual = result.array(expected->GetName());
    expectSameValues(expected, actual, expected->GetDataType() == VTK_FLOAT);
    const bool isLong = expected->GetDataTypeSize() == 8 && expected->GetDataType() != VTK_DOUBLE;
    if (typesAreStored && !(extension == "ply" && isLong))
    {
      EXPECT_EQ(actual->GetDataType(), expected->GetDataType()) << expected->GetName();
    }
  }
  ASSERT_NE(result.cloud->GetPointData()->GetScalars(), nullptr);
  EXPECT_STREQ(result.cloud->GetPointData()->GetScalars()->GetName(), "RGB");
  ASSERT_NE(result.cloud->GetPointData()->GetNormals(), nullptr);
  EXPECT_EQ(result.cloud->GetNumberOfVerts(), kPoints);
}

INSTANTIATE_TEST_SUITE_P(Formats, WriterRoundTrip,
  ::testing::Values(RoundTrip{ "vtp", VTK_FLOAT }, RoundTrip{ "vtp", VTK_DOUBLE },
    RoundTrip{ "ply", VTK_FLOAT }, RoundTrip{ "ply", VTK_DOUBLE }, RoundTrip{ "pcd", VTK_FLOAT },
    RoundTrip{ "pcd", VTK_DOUBLE }, RoundTrip{ "csv", VTK_FLOAT }, RoundTrip{ "csv", VTK_DOUBLE },
    RoundTrip{ "xyz", VTK_FLOAT }, RoundTrip{ "xyz", VTK_DOUBLE }),
  [](const ::testing::TestParamInfo<RoundTrip>& test)
  { return std::string(test.param.extension) + (test.param.pointType == VTK_FLOAT ? "_float" : "_double"); });

/// Arrays of @p types with random bits: every NaN, denormal and -0 is among them sooner or later.
vtkSmartPointer<vtkPolyData> makeRandomBits(std::initializer_list<int> types)
{
  std::mt19937_64 random(11);
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(kPoints);
  for (vtkIdType i = 0; i < kPoints; ++i)
  {
    points->SetPoint(i, static_cast<double>(i) / 4.0, -0.0, 1e6 - static_cast<double>(i) / 8.0);
  }
  cloud->SetPoints(points);
  for (const int type : types)
  {
    const auto array = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
    array->SetName(("type" + std::to_string(type)).c_str());
    array->SetNumberOfComponents(2);
    array->SetNumberOfTuples(kPoints);
    char* bytes = static_cast<char*>(array->GetVoidPointer(0));
    for (vtkIdType i = 0; i < array->GetNumberOfValues() * array->GetDataTypeSize(); ++i)
    {
      bytes[i] = static_cast<char>(random());
    }
    cloud->GetPointData()->AddArray(array);
  }
  return cloud;
}

class BitRoundTrip
  : public CloudFiles
  , public ::testing::WithParamInterface<const char*>
{
};

TEST_P(BitRoundTrip, GivesBackEveryTypeBitForBit)
{
  const std::string extension = GetParam();
  auto cloud = makeRandomBits({ VTK_TYPE_INT8, VTK_TYPE_UINT8, VTK_TYPE_INT16, VTK_TYPE_UINT16,
    VTK_TYPE_INT32, VTK_TYPE_UINT32, VTK_FLOAT, VTK_DOUBLE });
  if (extension != "ply") // which has no integers of 64 bits
  {
    cloud = makeRandomBits({ VTK_TYPE_INT8, VTK_TYPE_UINT8, VTK_TYPE_INT16, VTK_TYPE_UINT16, VTK_TYPE_INT32,
      VTK_TYPE_UINT32, VTK_TYPE_INT64, VTK_TYPE_UINT64, VTK_FLOAT, VTK_DOUBLE });
  }
  if (extension == "las") // whose grid of integers has no -0
  {
    for (vtkIdType i = 0; i < kPoints; ++i)
    {
      cloud->GetPoints()->SetPoint(i, cloud->GetPoint(i)[0], 0.0, cloud->GetPoint(i)[2]);
    }
  }
  std::vector<std::string> notes;
  ASSERT_EQ(writeCloud(cloud, path("a." + extension), &notes), "");
  EXPECT_TRUE(notes.empty()) << notes[0];
  const ReadResult result = readCloud(path("a." + extension));
  ASSERT_EQ(result.error, "");
  expectSameBits(cloud->GetPoints()->GetData(), result.cloud->GetPoints()->GetData());
  for (int i = 0; i < cloud->GetPointData()->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = cloud->GetPointData()->GetArray(i);
    expectSameBits(array, result.array(array->GetName()));
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, BitRoundTrip, ::testing::Values("vtp", "ply", "pcd", "las"));

TEST_P(BitRoundTrip, SaysWhatItCannotHold)
{
  const std::string extension = GetParam();
  const auto cloud = makeRandomBits({ VTK_TYPE_INT64 });
  cloud->GetPointData()->GetArray(0)->SetName("a b");
  vtkNew<vtkStringArray> words;
  words->SetName("words");
  words->SetNumberOfValues(kPoints);
  cloud->GetPointData()->AddArray(words);
  vtkNew<vtkDoubleArray> viewpoint;
  viewpoint->SetName("Viewpoint");
  viewpoint->SetNumberOfComponents(7);
  const double pose[7] = { 1, 2, 3, 0, 1, 0, 0 };
  viewpoint->InsertNextTuple(pose);
  cloud->GetFieldData()->AddArray(viewpoint);
  std::vector<std::string> notes;
  ASSERT_EQ(writeCloud(cloud, path("a." + extension), &notes), "");
  const auto isSaid = [&](const std::string& part)
  {
    return std::any_of(notes.begin(), notes.end(),
      [&](const std::string& note) { return note.find(part) != std::string::npos; });
  };
  EXPECT_EQ(isSaid("'words' holds no numbers"), extension != "vtp");
  EXPECT_FALSE(isSaid("is called a_b"));
  EXPECT_NE(readCloud(path("a." + extension)).array("a b"), nullptr);
  EXPECT_EQ(isSaid("Viewpoint"), extension == "ply" || extension == "las");
  EXPECT_EQ(isSaid("beyond 2^53"), extension == "ply");
}

class Writer : public CloudFiles
{
};

TEST_F(Writer, PcdKeepsViewpointShapeAndAlpha)
{
  const auto cloud = makeCloud(VTK_FLOAT);
  cloud->GetPointData()->RemoveArray("RGB");
  addArray<vtkUnsignedCharArray>(cloud, "RGBA", 4, [](vtkIdType i) { return static_cast<unsigned char>(i); });
  cloud->GetPointData()->SetActiveScalars("RGBA");
  vtkNew<vtkDoubleArray> viewpoint;
  viewpoint->SetName("Viewpoint");
  viewpoint->SetNumberOfComponents(7);
  const double pose[7] = { 0.1, 2, 3, 0, 1, 0, 0 };
  viewpoint->InsertNextTuple(pose);
  cloud->GetFieldData()->AddArray(viewpoint);
  vtkNew<vtkIntArray> shape;
  shape->SetName("OrganizedDimensions");
  shape->InsertNextValue(kPoints / 4);
  shape->InsertNextValue(4);
  cloud->GetFieldData()->AddArray(shape);
  ASSERT_EQ(writeCloud(cloud, path("a.pcd")), "");
  const ReadResult result = readCloud(path("a.pcd"));
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(result.value("RGBA", 10, 3), 43);
  EXPECT_EQ(result.cloud->GetFieldData()->GetArray("Viewpoint")->GetComponent(0, 0), 0.1);
  EXPECT_EQ(result.cloud->GetFieldData()->GetArray("OrganizedDimensions")->GetComponent(0, 1), 4);
}

TEST_F(Writer, CsvStartsWithTheAgreedHeader)
{
  ASSERT_EQ(writeCloud(makeCloud(VTK_FLOAT), path("a.csv")), "");
  std::ifstream file(path("a.csv"));
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(line,
    "x,y,z,RGB_0,RGB_1,RGB_2,Normals_0,Normals_1,Normals_2,Bandwidth,Density,Intensity,Label,VoxelPointCount,"
    "VoxelCovariance_0,VoxelCovariance_1,VoxelCovariance_2,VoxelCovariance_3,VoxelCovariance_4,"
    "VoxelCovariance_5");
}

TEST_F(Writer, TheUnitComesBackFromEveryFormat)
{
  for (const std::string extension : { "vtp", "ply", "pcd", "las", "laz", "csv", "xyz" })
  {
    for (const std::string unit : { "millimetre", "US survey foot", "metre", "\xc2\xb5m" })
    {
      SCOPED_TRACE(extension + ", " + unit);
      const auto cloud = makeCloud(VTK_FLOAT);
      pointhaptics::io::addFieldText(cloud, "LengthUnit", unit);
      const bool isSaid =
        !(extension.substr(0, 2) == "la" && unit[0] == '\xc2') && !(extension == "csv" && unit == "metre");
      vtkNew<vtkPointCloudWriter> writer;
      writer->SetInputData(cloud);
      writer->SetFileName(path("a." + extension).c_str());
      ASSERT_EQ(writer->Write(), 1);
      const std::vector<std::string> notes = writer->GetNotes();
      const bool isNoted = std::any_of(notes.begin(), notes.end(),
        [](const std::string& note)
        { return note.find("does not say that the unit is") != std::string::npos; });
      EXPECT_EQ(isNoted, !isSaid && unit != "metre"); // which readers take where nothing is said
      const ReadResult result = readCloud(path("a." + extension));
      ASSERT_EQ(result.error, "");
      EXPECT_EQ(pointhaptics::io::fieldText(result.cloud->GetFieldData(), "LengthUnit"), isSaid ? unit : "");
    }
  }
}

TEST_F(Writer, AUnitThatIsNoWordStaysOutOfHeaders)
{
  for (const std::string extension : { "ply", "pcd", "csv", "xyz" })
  {
    const auto cloud = makeCloud(VTK_FLOAT);
    pointhaptics::io::addFieldText(cloud, "LengthUnit", "mm\nend_header\nDATA ascii");
    ASSERT_EQ(writeCloud(cloud, path("a." + extension)), "");
    const ReadResult result = readCloud(path("a." + extension));
    ASSERT_EQ(result.error, "") << extension;
    EXPECT_EQ(result.points(), kPoints) << extension;
    EXPECT_FALSE(result.cloud->GetFieldData()->HasArray("LengthUnit")) << extension;
  }
}

TEST_F(Writer, ColumnsBetweenSpacesHaveTheirNamesInAComment)
{
  const auto cloud = makeCloud(VTK_FLOAT);
  cloud->GetPointData()->GetArray("Intensity")->SetName("Return strength");
  ASSERT_EQ(writeCloud(cloud, path("a.xyz")), "");
  std::ifstream file(path("a.xyz"));
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(line.substr(0, 26), "//x y z RGB_0 RGB_1 RGB_2 ");
  EXPECT_NE(line.find(" Return_strength "), std::string::npos);
}

TEST_F(Writer, SaysWhatIsWrongAndLeavesNothingBehind)
{
  const auto cloud = makeCloud(VTK_FLOAT);
  EXPECT_NE(
    writeCloud(cloud, path("a.xls")).find(".vtp, .ply, .pcd, .las, .laz, .csv or .xyz"), std::string::npos);
  EXPECT_NE(writeCloud(cloud, path("none/a.ply")).find("No such file"), std::string::npos);
  EXPECT_NE(writeCloud(cloud, path("none/a.vtp")).find("No such file"), std::string::npos);
  EXPECT_NE(writeCloud(cloud, "").find("file name"), std::string::npos);
  vtkNew<vtkPolyData> empty;
  EXPECT_NE(writeCloud(empty, path("a.ply")).find("no points"), std::string::npos);
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, cloud);
  EXPECT_NE(writeCloud(blocks, path("a.ply")).find("merge them first"), std::string::npos);
  std::filesystem::create_directory(path("d.ply"));
  EXPECT_NE(writeCloud(cloud, path("d.ply")).find("folder"), std::string::npos);
  std::filesystem::remove(path("d.ply"));
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

#ifdef __unix__
TEST_F(Writer, FullDiskLeavesTheOldFileAsItWas)
{
  const auto cloud = makeCloud(VTK_DOUBLE);
  cloud->GetPoints()->SetPoint(7, cloud->GetPoint(6)); // LAS takes no NaN
  rlimit before;
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  void (*handler)(int) = std::signal(SIGXFSZ, SIG_IGN);
  for (const char* name : { "a.ply", "a.pcd", "a.csv", "a.vtp", "a.las" })
  {
    write(name, "old");
    rlimit small = before;
    small.rlim_cur = 4096;
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    const std::string message = writeCloud(cloud, path(name));
    setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_NE(
      message.find("; raise the limit of file sizes (ulimit -f), or write elsewhere"), std::string::npos)
      << message;
    EXPECT_EQ(std::filesystem::file_size(path(name)), 3u) << name;
  }
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 5);
}
#endif

TEST_F(Writer, VtpTruncationsAndHostileCountsAreRefused)
{
  ASSERT_EQ(writeCloud(makeCloud(VTK_DOUBLE), path("a.vtp")), "");
  std::ifstream file(path("a.vtp"), std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  EXPECT_EQ(readCloud(path("a.vtp")).points(), kPoints);
  for (std::size_t size = 1; size + 2 < whole.size(); size += 97)
  {
    const ReadResult result = readCloud(write("cut.vtp", whole.substr(0, size)));
    EXPECT_NE(result.error, "") << size;
    EXPECT_EQ(result.points(), 0) << size;
  }
  std::string hostile = whole;
  hostile.replace(hostile.find("NumberOfPoints=\"100"), 19, "NumberOfPoints=\"4000000000000");
  expectRefused(readCloud(write("h.vtp", hostile)), "NumberOfPoints");
  std::string grid = whole;
  grid.replace(grid.find("type=\"PolyData\""), 15, "type=\"ImageData\"");
  expectRefused(readCloud(write("g.vtp", grid)), "ImageData");
}

TEST_F(Writer, VtpPointsWithoutCellsGetVertices)
{
  const ReadResult result = readCloud(write("a.vtp",
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" "
    "byte_order=\"LittleEndian\">\n<PolyData>\n"
    "<Piece NumberOfPoints=\"2\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
    "NumberOfPolys=\"0\">\n"
    "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 2 "
    "3</DataArray></Points>\n"
    "</Piece>\n</PolyData>\n</VTKFile>\n"));
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(result.cloud->GetNumberOfVerts(), 2);
  EXPECT_EQ(result.cloud->GetPoint(1)[2], 3.0);
}

TEST_F(Writer, VtpHasOneValueOfEachArrayPerPoint)
{
  const vtkSmartPointer<vtkPolyData> cloud = makeCloud(VTK_FLOAT);
  const vtkIdType points = cloud->GetNumberOfPoints();
  vtkNew<vtkIntArray> longer;
  longer->SetName("longer");
  for (int i = 0; i < points + 2; ++i)
  {
    longer->InsertNextValue(i);
  }
  cloud->GetPointData()->AddArray(longer);
  ASSERT_EQ(writeCloud(cloud, path("a.vtp")), "");
  const ReadResult result = readCloud(path("a.vtp"));
  ASSERT_EQ(result.error, "");
  ASSERT_EQ(result.points(), points);
  EXPECT_EQ(result.value("longer", points - 1), double(points - 1));
  longer->SetNumberOfTuples(points - 1);
  EXPECT_NE(writeCloud(cloud, path("b.vtp")).find("give every array one value per point"), std::string::npos);
}

} // namespace
