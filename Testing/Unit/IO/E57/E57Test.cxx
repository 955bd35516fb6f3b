#include "CloudFiles.h"
#include "E57File.h"

#include "IO/Info/FieldText.h"

#include "vtkFieldData.h"
#include "vtk_zlib.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace
{

using pointhaptics::io::fieldText;

class E57 : public CloudFiles
{
protected:
  ReadResult read(const E57TestFile& file) const { return readCloud(write("a.e57", file.bytes())); }
  /// A file of the shared folder; skips the test where that is not there.
  static std::string shared(const std::string& name) { return sharedData() + "/formats/" + name; }
};

#define NEEDS_SHARED_DATA()                                                                                  \
  if (sharedData().empty() || !std::filesystem::exists(sharedData() + "/formats"))                           \
  GTEST_SKIP() << "set POINTHAPTICS_SHARED_DATA to the folder with formats/"

/// x = i, y = 10 i, z = -i as doubles.
E57TestScan rampScan(std::size_t count)
{
  std::vector<double> x, y, z;
  for (std::size_t i = 0; i < count; ++i)
  {
    x.push_back(static_cast<double>(i));
    y.push_back(10.0 * static_cast<double>(i));
    z.push_back(-static_cast<double>(i));
  }
  return { { e57Double("cartesianX", x), e57Double("cartesianY", y), e57Double("cartesianZ", z) }, "", "" };
}

/// CRC-32 of the values, to be compared with that of a decoder of 40 lines which shares no code with this
/// one: it joins the streams and takes each record's bits out of a long integer.
std::uint32_t checksumOf(vtkDataArray* array)
{
  const std::size_t size =
    static_cast<std::size_t>(array->GetNumberOfValues()) * static_cast<std::size_t>(array->GetDataTypeSize());
  return static_cast<std::uint32_t>(
    crc32(0, static_cast<const unsigned char*>(array->GetVoidPointer(0)), static_cast<unsigned>(size)));
}

double fieldValue(const ReadResult& result, const char* name, vtkIdType row, int component = 0)
{
  return result.cloud->GetFieldData()->GetArray(name)->GetComponent(row, component);
}

TEST_F(E57, BunnyOfScaledIntegersIsRead)
{
  NEEDS_SHARED_DATA();
  const ReadResult bunny = readCloud(shared("bunnyInt32.e57"));
  ASSERT_EQ(bunny.error, "");
  EXPECT_EQ(bunny.format, "E57 1.0");
  EXPECT_EQ(bunny.points(), 30571);
  double bounds[6];
  bunny.cloud->GetBounds(bounds);
  // cartesianBounds of the file's XML.
  const double expected[6] = { -0.094689, 0.061009, 0.040011, 0.187321, -0.061873, 0.058799 };
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_NEAR(bounds[i], expected[i], 1e-9);
  }
  EXPECT_EQ(checksumOf(bunny.cloud->GetPoints()->GetData()), 0x79b176e8u);
  EXPECT_EQ(bunny.array("InvalidState"), nullptr) << "no point is invalid";
  EXPECT_EQ(fieldText(bunny.cloud->GetFieldData(), "ScanNames"), "bunny");
  EXPECT_EQ(fieldText(bunny.cloud->GetFieldData(), "Generator"),
    "InteliSum-LD3-Studio-V5.1-E57RefImpl-1.0.154-x86-windows");
}

TEST_F(E57, CubeOfDoublesHasItsColors)
{
  NEEDS_SHARED_DATA();
  const ReadResult cube = readCloud(shared("ColouredCubeDouble.e57"));
  ASSERT_EQ(cube.error, "");
  ASSERT_EQ(cube.points(), 7680);
  vtkDataArray* colors = cube.array("RGB");
  ASSERT_NE(colors, nullptr);
  EXPECT_EQ(colors->GetDataType(), VTK_UNSIGNED_CHAR);
  EXPECT_EQ(cube.cloud->GetPointData()->GetScalars(), colors);
  EXPECT_EQ(cube.cloud->GetPoints()->GetDataType(), VTK_DOUBLE);
  EXPECT_EQ(checksumOf(cube.cloud->GetPoints()->GetData()), 0xc417886eu);
  EXPECT_EQ(checksumOf(colors), 0x97533a15u);
}

TEST_F(E57, ValidFilesWithoutPointsAreSaidToBeSo)
{
  NEEDS_SHARED_DATA();
  const ReadResult empty = readCloud(shared("empty.e57"));
  expectRefused(empty, "E57 1.0: the file is valid, but it holds no scan; ");
  EXPECT_TRUE(empty.validWithoutPoints);
  const ReadResult zero = readCloud(shared("ZeroPoints.e57"));
  expectRefused(zero, "E57 1.0: the file is valid, but its 1 scan holds no points; ");
  EXPECT_TRUE(zero.validWithoutPoints);
  EXPECT_EQ(fieldText(zero.cloud->GetFieldData(), "Generator"), "E57Format-3.1.1-x86_64-AppleClang140");
  const ReadResult bad = readCloud(shared("bad-crc.e57"));
  expectRefused(bad, "byte 0: page 1 of 1 does not have the content of its checksum (CRC-32C); ");
  EXPECT_FALSE(bad.validWithoutPoints);
}

TEST_F(E57, IntegersOfAllWidthsAreExact)
{
  // Values at both ends and between, of every number of bits and with a minimum that is no power of two.
  std::mt19937_64 random(1);
  for (unsigned bits = 0; bits <= 64; ++bits)
  {
    SCOPED_TRACE(bits);
    const std::uint64_t range = bits == 64 ? ~std::uint64_t{ 0 } : (std::uint64_t{ 1 } << bits) - 1;
    const std::int64_t minimum = bits == 64 ? std::numeric_limits<std::int64_t>::min()
      : bits == 63                          ? -5
                                            : -static_cast<std::int64_t>(range / 3);
    const std::int64_t maximum = static_cast<std::int64_t>(static_cast<std::uint64_t>(minimum) + range);
    std::vector<std::int64_t> values;
    for (int i = 0; i < 300; ++i)
    {
      const std::uint64_t some = i == 0 ? 0
        : i == 1                        ? range
        : range == ~std::uint64_t{ 0 }  ? random()
                                        : random() % (range + 1);
      values.push_back(static_cast<std::int64_t>(static_cast<std::uint64_t>(minimum) + some));
    }
    E57TestScan scan = rampScan(values.size());
    scan.fields.push_back(e57Integer("value", minimum, maximum, values));
    scan.fields.push_back(e57Scaled("scaled", minimum, maximum, 0.001, -7.5, values));
    const ReadResult result = read({ { scan } });
    ASSERT_EQ(result.error, "");
    vtkDataArray* read = result.array("value");
    ASSERT_NE(read, nullptr);
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      const vtkIdType row = static_cast<vtkIdType>(i);
      ASSERT_EQ(read->GetVariantValue(row).ToTypeInt64(), values[i]) << i;
      ASSERT_EQ(result.value("scaled", row), static_cast<double>(values[i]) * 0.001 + -7.5) << i;
      ASSERT_EQ(result.cloud->GetPoint(row)[1], 10.0 * static_cast<double>(i));
    }
  }
}

TEST_F(E57, IntegersGetTheSmallestTypeThatHoldsTheirLimits)
{
  E57TestScan scan = rampScan(2);
  scan.fields.push_back(e57Integer("a", 0, 255, { 0, 255 }));
  scan.fields.push_back(e57Integer("b", -1, 127, { -1, 127 }));
  scan.fields.push_back(e57Integer("c", 0, 256, { 0, 256 }));
  scan.fields.push_back(e57Integer("d", -129, 0, { -129, 0 }));
  scan.fields.push_back(e57Integer("e", 0, 4294967295, { 0, 4294967295 }));
  scan.fields.push_back(e57Integer("f", -1, 65536, { -1, 65536 }));
  scan.fields.push_back(e57Integer("g", -1, 4294967295, { -1, 4294967295 }));
  const ReadResult result = read({ { scan } });
  ASSERT_EQ(result.error, "");
  const std::pair<const char*, int> expected[] = { { "a", VTK_UNSIGNED_CHAR }, { "b", VTK_SIGNED_CHAR },
    { "c", VTK_UNSIGNED_SHORT }, { "d", VTK_SHORT }, { "e", VTK_UNSIGNED_INT }, { "f", VTK_INT },
    { "g", VTK_TYPE_INT64 } };
  for (const auto& [name, type] : expected)
  {
    EXPECT_EQ(result.array(name)->GetDataType(), type) << name;
  }
}

TEST_F(E57, FloatsKeepTheirBits)
{
  std::mt19937_64 random(2);
  std::vector<float> x, y, z;
  std::vector<double> time;
  for (int i = 0; i < 10000; ++i) // more than a block
  {
    x.push_back(static_cast<float>(random()) * 1e-10f);
    y.push_back(-static_cast<float>(random()) * 1e-15f);
    z.push_back(i == 7 ? std::numeric_limits<float>::quiet_NaN() : 1e-42f * static_cast<float>(i));
    time.push_back(static_cast<double>(random()) / 3.0);
  }
  E57TestScan scan{ { e57Float("cartesianX", x), e57Float("cartesianY", y), e57Float("cartesianZ", z),
                      e57Double("timeStamp", time) },
    "", "" };
  scan.bytesPerPart = 1021;
  const ReadResult result = read({ { scan } });
  ASSERT_EQ(result.error, "");
  ASSERT_EQ(result.points(), 10000);
  ASSERT_EQ(result.cloud->GetPoints()->GetDataType(), VTK_FLOAT);
  const float* points = static_cast<const float*>(result.cloud->GetPoints()->GetVoidPointer(0));
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    const float expected[3] = { x[i], y[i], z[i] };
    ASSERT_EQ(std::memcmp(points + 3 * i, expected, sizeof(expected)), 0) << i;
    ASSERT_EQ(result.value("TimeStamp", static_cast<vtkIdType>(i)), time[i]);
  }
}

TEST_F(E57, SeveralScansGoWhereTheirPosesSay)
{
  // A quarter turn about z, and half a turn about x, beside far map coordinates.
  const double half = std::sqrt(0.5);
  E57TestScan first = rampScan(3);
  first.xml =
    "<name type=\"String\">door</name>" + e57Pose({ half, 0, 0, half }, { 500000.25, 5017906.07, 12 });
  E57TestScan second = rampScan(5);
  second.xml = e57Pose({ 0, 1, 0, 0 }, { 0, 0, 100 });
  second.fields.push_back(e57Integer("intensity", 0, 1000, { 1, 2, 3, 4, 5 }));
  const E57TestFile file{ { first, second } };
  const ReadResult result = read(file);
  ASSERT_EQ(result.error, "");
  ASSERT_EQ(result.points(), 8);
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(result.cloud->GetPoint(i)[0], 500000.25 - 10.0 * i, 1e-9);
    EXPECT_NEAR(result.cloud->GetPoint(i)[1], 5017906.07 + i, 1e-9);
    EXPECT_NEAR(result.cloud->GetPoint(i)[2], 12.0 - i, 1e-9);
    EXPECT_EQ(result.value("ScanIndex", i), 0);
    EXPECT_EQ(result.value("Intensity", i), 0) << "what a scan lacks";
  }
  for (int i = 0; i < 5; ++i)
  {
    EXPECT_NEAR(result.cloud->GetPoint(3 + i)[0], i, 1e-12);
    EXPECT_NEAR(result.cloud->GetPoint(3 + i)[1], -10.0 * i, 1e-12);
    EXPECT_NEAR(result.cloud->GetPoint(3 + i)[2], 100.0 + i, 1e-12);
    EXPECT_EQ(result.value("ScanIndex", 3 + i), 1);
    EXPECT_EQ(result.value("Intensity", 3 + i), i + 1);
  }
  EXPECT_EQ(fieldText(result.cloud->GetFieldData(), "ScanNames", 0), "door");
  EXPECT_EQ(fieldText(result.cloud->GetFieldData(), "ScanNames", 1), "scan 2");
  EXPECT_EQ(fieldValue(result, "ScanPoints", 1), 5);
  EXPECT_EQ(fieldValue(result, "ScanPoses", 0, 1), 5017906.07);
  EXPECT_EQ(fieldValue(result, "ScanPoses", 0, 6), half);
  ASSERT_EQ(result.notes.size(), 1u);
  EXPECT_EQ(result.notes[0], "1 of 2 scans have no 'Intensity': their points have 0 there");

  vtkNew<vtkPointCloudReader> reader;
  reader->SetFileName(path("a.e57").c_str());
  reader->ApplyPosesOff();
  reader->Update();
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_EQ(reader->GetOutput()->GetPoint(i)[1], 10.0 * i) << "the scanner's own frame";
  }
  EXPECT_EQ(reader->GetOutput()->GetFieldData()->GetArray("ScanPoses")->GetComponent(0, 1), 5017906.07);
}

TEST_F(E57, PosesMakeDoublesOfFloatsAndTurnNormals)
{
  const double half = std::sqrt(0.5);
  E57TestScan scan{ { e57Float("cartesianX", { 0.5f }), e57Float("cartesianY", { 0.25f }),
                      e57Float("cartesianZ", { 0 }), e57Float("nor:normalX", { 1 }),
                      e57Float("nor:normalY", { 0 }), e57Float("nor:normalZ", { 0 }) },
    e57Pose({ half, 0, 0, half }, { 0, 5017906.07, 0 }), "" };
  E57TestFile file{ { scan } };
  file.xml = "<coordinateMetadata type=\"String\"><![CDATA[PROJCS[\"x\"]]]></coordinateMetadata>";
  const ReadResult result = read(file);
  ASSERT_EQ(result.error, "");
  EXPECT_NEAR(result.cloud->GetPoint(0)[1], 5017906.57, 1e-9);
  vtkDataArray* normals = result.cloud->GetPointData()->GetNormals();
  ASSERT_NE(normals, nullptr);
  EXPECT_NEAR(normals->GetComponent(0, 0), 0, 1e-7);
  EXPECT_NEAR(normals->GetComponent(0, 1), 1, 1e-7);
  EXPECT_EQ(fieldText(result.cloud->GetFieldData(), "CoordinateSystem"), "PROJCS[\"x\"]");
  EXPECT_EQ(fieldText(result.cloud->GetFieldData(), "LengthUnit"), "metre");
}

TEST_F(E57, SphericalCoordinatesBecomePointsAndStay)
{
  const double angle = std::acos(-1.0) / 6.0; // sine 1/2
  E57TestScan scan{
    { e57Double("sphericalRange", { 2, 4, 3 }), e57Double("sphericalAzimuth", { 0, angle, 1 }),
      e57Float("sphericalElevation", { 0, 0, 1 }), e57Integer("sphericalInvalidState", 0, 2, { 0, 0, 2 }) },
    e57Pose({ 1, 0, 0, 0 }, { 10, 20, 30 }), ""
  };
  scan.fields[2] = e57Double("sphericalElevation", { angle, 0, 1 });
  const ReadResult result = read({ { scan } });
  ASSERT_EQ(result.error, "");
  const double expected[2][3] = { { 10 + std::sqrt(3.0), 20, 31 }, { 10 + 2 * std::sqrt(3.0), 22, 30 } };
  for (int i = 0; i < 2; ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_NEAR(result.cloud->GetPoint(i)[axis], expected[i][axis], 1e-12);
    }
  }
  EXPECT_TRUE(std::isnan(result.cloud->GetPoint(2)[0]));
  EXPECT_EQ(result.value("SphericalInvalidState", 2), 2);
  EXPECT_EQ(result.value("SphericalRange", 2), 3);
  EXPECT_EQ(result.value("SphericalAzimuth", 1), angle);
}

TEST_F(E57, InvalidPointsAreKeptAsNaN)
{
  E57TestScan scan = rampScan(4);
  scan.fields.push_back(e57Integer("cartesianInvalidState", 0, 2, { 0, 1, 2, 0 }));
  scan.fields.push_back(e57Integer("isIntensityInvalid", 0, 1, { 0, 0, 0, 0 }));
  scan.fields.push_back(e57Integer("isColorInvalid", 0, 1, { 0, 0, 1, 0 }));
  const ReadResult result = read({ { scan } });
  ASSERT_EQ(result.error, "");
  ASSERT_EQ(result.points(), 4);
  EXPECT_EQ(result.cloud->GetPoint(0)[1], 0);
  EXPECT_TRUE(std::isnan(result.cloud->GetPoint(1)[1]));
  EXPECT_TRUE(std::isnan(result.cloud->GetPoint(2)[2]));
  EXPECT_EQ(result.cloud->GetPoint(3)[1], 30);
  EXPECT_EQ(result.value("InvalidState", 1), 1);
  EXPECT_EQ(result.value("ColorInvalid", 2), 1);
  EXPECT_EQ(result.array("IntensityInvalid"), nullptr);
}

TEST_F(E57, RowsAndColumnsOfACompleteGridAreOrganised)
{
  std::vector<std::int64_t> rows, columns, returns;
  for (int i = 0; i < 12; ++i)
  {
    rows.push_back(5 + i / 4);
    columns.push_back(i % 4);
    returns.push_back(i % 2);
  }
  E57TestScan scan = rampScan(12);
  scan.fields.push_back(e57Integer("rowIndex", 0, 1000, rows));
  scan.fields.push_back(e57Integer("columnIndex", 0, 1000, columns));
  scan.fields.push_back(e57Integer("returnIndex", 0, 255, returns));
  scan.fields.push_back(e57Integer("returnCount", 0, 255, std::vector<std::int64_t>(12, 2)));
  ReadResult result = read({ { scan } });
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(fieldValue(result, "OrganizedDimensions", 0, 0), 4);
  EXPECT_EQ(fieldValue(result, "OrganizedDimensions", 0, 1), 3);
  EXPECT_EQ(result.value("RowIndex", 11), 7);
  EXPECT_EQ(result.value("ReturnNumber", 3), 2) << "counted from 1";
  EXPECT_EQ(result.value("NumberOfReturns", 3), 2);
  std::swap(columns[2], columns[3]);
  scan.fields[4] = e57Integer("columnIndex", 0, 1000, columns);
  result = read({ { scan } });
  ASSERT_EQ(result.error, "");
  EXPECT_FALSE(result.cloud->GetFieldData()->HasArray("OrganizedDimensions"));
}

TEST_F(E57, WideColorsAreKeptBesideBytes)
{
  E57TestScan scan = rampScan(3);
  scan.fields.push_back(e57Integer("colorRed", 0, 65535, { 0, 256, 65535 }));
  scan.fields.push_back(e57Integer("colorGreen", 0, 65535, { 511, 512, 40000 }));
  scan.fields.push_back(e57Integer("colorBlue", 0, 65535, { 65280, 255, 1 }));
  ReadResult result = read({ { scan } });
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(result.value("Color16", 2, 1), 40000);
  EXPECT_EQ(result.array("Color16")->GetDataType(), VTK_UNSIGNED_SHORT);
  EXPECT_EQ(result.value("RGB", 0, 1), 1);
  EXPECT_EQ(result.value("RGB", 2, 0), 255);
  EXPECT_EQ(result.value("RGB", 0, 2), 255);

  scan.xml = "<colorLimits type=\"Structure\"><colorRedMinimum type=\"Float\">2</colorRedMinimum>"
             "<colorRedMaximum type=\"Float\">4</colorRedMaximum></colorLimits>";
  scan.fields[3] = e57Float("colorRed", { 2, 3, 4 });
  scan.fields[4] = e57Float("colorGreen", { 0, 0.5f, 1 });
  scan.fields[5] = e57Float("colorBlue", { -1, std::numeric_limits<float>::quiet_NaN(), 2 });
  result = read({ { scan } });
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(result.value("Color", 1, 0), 3);
  const double expected[3][3] = { { 0, 0, 0 }, { 128, 128, 0 }, { 255, 255, 255 } };
  for (int i = 0; i < 3; ++i)
  {
    for (int channel = 0; channel < 3; ++channel)
    {
      EXPECT_EQ(result.value("RGB", i, channel), expected[i][channel]) << i << " " << channel;
    }
  }
}

TEST_F(E57, ImagesAndTextsAreSaidToBeLeftOut)
{
  E57TestScan scan = rampScan(2);
  scan.fields.push_back({ "ext:label", "type=\"String\"", 8, { 'a', 'b' } });
  scan.fields.push_back(e57Integer("after", 0, 7, { 3, 5 }));
  E57TestFile file{ { scan } };
  file.xml =
    "<images2D type=\"Vector\"><vectorChild type=\"Structure\"/><vectorChild type=\"Structure\"/></images2D>";
  const ReadResult result = read(file);
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(result.value("after", 1), 5);
  ASSERT_EQ(result.notes.size(), 2u);
  EXPECT_EQ(result.notes[0], "2 images are not read: only points are");
  EXPECT_EQ(result.notes[1], "the texts of field 'ext:label' are not read: arrays hold numbers");
}

TEST_F(E57, FieldsOfExtensionsNeverTakeTheNamesOfCoordinates)
{
  E57TestScan scan = rampScan(2);
  scan.fields.insert(scan.fields.begin(), e57Double("x", { 70, 71 }));
  scan.fields.push_back(e57Double("Intensity", { 80, 81 }));
  scan.fields.push_back(e57Double("intensity", { 90, 91 }));
  const ReadResult result = read({ { scan } });
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(result.cloud->GetPoint(1)[0], 1);
  EXPECT_EQ(result.value("x_2", 1), 71);
  EXPECT_EQ(result.value("Intensity_2", 1), 81);
  EXPECT_EQ(result.value("Intensity", 1), 91);
}

TEST_F(E57, ColorsOfEachScanGoByItsOwnLimits)
{
  const auto scanOf = [](double most, bool isFloat, const std::vector<std::int64_t>& values)
  {
    E57TestScan scan = rampScan(values.size());
    for (const char* name : { "colorRed", "colorGreen", "colorBlue" })
    {
      const std::vector<float> parts(values.begin(), values.end());
      scan.fields.push_back(
        isFloat ? e57Float(name, parts) : e57Integer(name, 0, static_cast<std::int64_t>(most), values));
    }
    return scan;
  };
  const auto expectRed = [](const ReadResult& result, const std::vector<double>& expected)
  {
    ASSERT_EQ(result.error, "");
    ASSERT_NE(result.array("RGB"), nullptr);
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
      EXPECT_EQ(result.value("RGB", static_cast<vtkIdType>(i), 0), expected[i]) << i;
    }
  };
  const E57TestScan bytes = scanOf(255, false, { 0, 100, 255 });
  const E57TestScan words = scanOf(65535, false, { 0, 256, 65535 });
  expectRed(read({ { bytes, words } }), { 0, 100, 255, 0, 1, 255 });
  expectRed(read({ { bytes, scanOf(1, true, { 0, 1 }) } }), { 0, 100, 255, 0, 255 });
  expectRed(read({ { scanOf(4095, false, { 0, 2048, 4095 }) } }), { 0, 128, 255 });
  expectRed(read({ { scanOf(65535, false, { 0, 200, 199 }) } }), { 0, 0, 0 });
}

} // namespace
