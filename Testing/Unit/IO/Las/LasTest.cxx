#include "CloudFiles.h"

#include "IO/Info/FieldText.h"
#include "IO/MergedCloud.h"

#include <cstdint>
#include <initializer_list>

namespace
{

using pointhaptics::io::addFieldText;
using pointhaptics::io::fieldText;
using pointhaptics::io::mergeClouds;

class Las : public CloudFiles
{
};

TEST_F(Las, PositionsAreScaledInDouble)
{
  const ReadResult result = readCloud(write("a.las", makeLas(2, 0, 20)));
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(result.format, "LAS 1.2 (point format 0)");
  ASSERT_EQ(result.points(), 2);
  EXPECT_EQ(result.cloud->GetPoints()->GetDataType(), VTK_DOUBLE);
  EXPECT_DOUBLE_EQ(result.cloud->GetPoint(1)[0], 1.0);
  EXPECT_DOUBLE_EQ(result.cloud->GetPoint(1)[1], 1002.0);
  EXPECT_DOUBLE_EQ(result.cloud->GetPoint(1)[2], 1997.0);
  EXPECT_EQ(result.array("GpsTime"), nullptr);
  EXPECT_EQ(result.array("RGB"), nullptr);
}

TEST_F(Las, LegacyBitFieldsAndColorsAreUnpacked)
{
  std::string las = makeLas(2, 3, 36); // two extra bytes
  put(las, 227 + 36 + 12, std::uint16_t{ 777 });
  las[227 + 36 + 14] = static_cast<char>(0b11010011); // return 3 of 2, scan direction and edge set
  las[227 + 36 + 15] = static_cast<char>(0xe2);       // class 2 with all flags
  las[227 + 36 + 16] = static_cast<char>(-15);
  put(las, 227 + 36 + 18, std::uint16_t{ 65000 });
  put(las, 227 + 36 + 20, 123456.789);
  put(las, 227 + 36 + 30, std::uint16_t{ 0xabcd });
  const ReadResult result = readCloud(write("a.las", las));
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(result.value("Intensity", 1), 777);
  EXPECT_EQ(result.array("Intensity")->GetDataType(), VTK_UNSIGNED_SHORT);
  EXPECT_EQ(result.value("ReturnNumber", 1), 3);
  EXPECT_EQ(result.value("NumberOfReturns", 1), 2);
  EXPECT_EQ(result.value("Classification", 1), 2);
  EXPECT_EQ(result.value("ScanAngle", 1), -15);
  EXPECT_EQ(result.value("PointSourceId", 1), 65000);
  EXPECT_EQ(result.value("GpsTime", 1), 123456.789);
  EXPECT_EQ(result.value("Color16", 1, 1), 0xabcd);
  EXPECT_EQ(result.value("RGB", 1, 1), 0xab);
  EXPECT_STREQ(result.cloud->GetPointData()->GetScalars()->GetName(), "RGB");
}

TEST_F(Las, ExtendedFormatsHaveWideFields)
{
  std::string las = makeLas(4, 8, 38);
  las[375 + 14] = static_cast<char>(0xca); // return 10 of 12
  las[375 + 16] = static_cast<char>(200);
  put(las, 375 + 18, std::int16_t{ -15000 });
  put(las, 375 + 22, 5.5);
  put(las, 375 + 30, std::uint16_t{ 200 });
  put(las, 375 + 36, std::uint16_t{ 9 });
  const ReadResult result = readCloud(write("a.las", las));
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(result.value("ReturnNumber", 0), 10);
  EXPECT_EQ(result.value("NumberOfReturns", 0), 12);
  EXPECT_EQ(result.value("Classification", 0), 200);
  EXPECT_FLOAT_EQ(static_cast<float>(result.value("ScanAngle", 0)), -90.0f);
  EXPECT_EQ(result.value("GpsTime", 0), 5.5);
  EXPECT_EQ(result.value("RGB", 0, 0), 200); // 8 bit values in 16 bit fields
  EXPECT_EQ(result.value("NearInfrared", 0), 9);
}

TEST_F(Las, EveryPointFormatIsRead)
{
  const std::size_t lengths[] = { 20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67 };
  for (int format = 0; format <= 10; ++format)
  {
    const ReadResult result = readCloud(write("a.las", makeLas(4, format, lengths[format])));
    EXPECT_EQ(result.error, "") << format;
    EXPECT_EQ(result.points(), 2) << format;
    const ReadResult tooShort = readCloud(write("b.las", makeLas(4, format, lengths[format] - 1)));
    expectRefused(tooShort, "too short");
  }
}

TEST_F(Las, CompressedPointsWithoutADescriptionAreRefused)
{
  expectRefused(readCloud(write("a.las", makeLas(2, 0x80, 20))), "no record says how");
  std::string las = makeLas(2, 0, 20);
  std::string record(54, '\0');
  record.replace(2, 14, "laszip encoded");
  put(record, 18, std::uint16_t{ 22204 });
  las.insert(227, record);
  put(las, 96, std::uint32_t{ 227 + 54 });
  put(las, 100, std::uint32_t{ 1 });
  expectRefused(readCloud(write("b.las", las)), "LAZ");
  std::string copc = las;
  put(copc, 227 + 18, std::uint16_t{ 1 });
  copc.replace(227 + 2, 14, std::string("copc").append(10, '\0'));
  expectRefused(readCloud(write("c.las", copc)), "COPC");
}

TEST_F(Las, TruncationsAndHostileHeadersAreRefused)
{
  const std::string whole = makeLas(2, 3, 34);
  for (std::size_t size = 0; size < whole.size(); ++size)
  {
    EXPECT_NE(readCloud(write("cut.las", whole.substr(0, size))).error, "") << size;
  }
  std::string las = makeLas(4, 6, 30);
  put(las, 247, std::uint64_t{ 0xffffffffffffffff });
  expectRefused(readCloud(write("h.las", las)), "bytes follow");
  put(las, 247, std::uint64_t{ 0 });
  expectRefused(readCloud(write("h.las", las.substr(0, 375))), "holds no points");
  las = makeLas(2, 0, 20);
  put(las, 131, 0.0);
  expectRefused(readCloud(write("h.las", las)), "scale");
  las = makeLas(2, 0, 20);
  put(las, 96, std::uint32_t{ 4000000000u });
  expectRefused(readCloud(write("h.las", las)), "byte 96");
  las = makeLas(2, 0, 20);
  put(las, 100, std::uint32_t{ 0xffffffffu });
  EXPECT_EQ(readCloud(write("h.las", las)).points(), 2);
  expectRefused(readCloud(write("h.las", makeLas(2, 11, 80))), "point format 11");
}

TEST_F(Las, HeightsInAnotherUnitAreSaidToBeSo)
{
  const std::string ground = "PROJCS[\"p\",GEOGCS[\"g\",UNIT[\"degree\",0.017]],UNIT[\"metre\",1]]";
  const auto systemOf = [&](const std::string& unit)
  { return "COMPD_CS[\"c\"," + ground + ",VERT_CS[\"v\",VERT_DATUM[\"d\",2005],UNIT[\"" + unit + "\",1]]]"; };
  const ReadResult plain = readCloud(write("plain.las", makeLas(2, 0, 20)));
  const auto readWith = [&](const std::string& system)
  {
    addFieldText(plain.cloud, "CoordinateSystem", system);
    EXPECT_EQ(writeCloud(plain.cloud, path("a.las")), "");
    return readCloud(path("a.las"));
  };
  for (const std::string& level : { ground, systemOf("metre") })
  {
    const ReadResult result = readWith(level);
    EXPECT_TRUE(result.notes.empty());
    EXPECT_EQ(fieldText(result.cloud->GetFieldData(), "HeightUnit"), "");
  }
  const ReadResult feet = readWith(systemOf("US survey foot"));
  ASSERT_EQ(feet.notes.size(), 1u);
  EXPECT_EQ(feet.notes[0],
    "heights are in US survey foot, x and y in metre: lengths and voxels are wrong until heights are "
    "converted");
  std::vector<std::string> notes;
  EXPECT_EQ(writeCloud(feet.cloud, path("b.las"), &notes), "");
  EXPECT_TRUE(notes.empty()) << "the coordinate system says it";
  EXPECT_EQ(mergeClouds({ plain.cloud, feet.cloud }, { "plain", "feet" }, notes), nullptr);
  EXPECT_NE(notes.back().find("'plain' and 'feet' cannot be one cloud"), std::string::npos);
  EXPECT_NE(mergeClouds({ feet.cloud, feet.cloud }, { "feet", "feet" }, notes), nullptr);
}

/// A LAS file of two points whose record of GeoTIFF keys has @p numbers.
std::string makeLasWithKeys(std::initializer_list<int> numbers)
{
  std::string record(54, '\0');
  record.replace(2, 15, "LASF_Projection");
  put(record, 18, std::uint16_t{ 34735 });
  for (const int number : numbers)
  {
    append(record, static_cast<std::uint16_t>(number));
  }
  put(record, 20, static_cast<std::uint16_t>(record.size() - 54));
  std::string las = makeLas(2, 0, 20);
  las.insert(227, record);
  put(las, 96, static_cast<std::uint32_t>(227 + record.size()));
  put(las, 100, std::uint32_t{ 1 });
  return las;
}

TEST_F(Las, HeightsOfGeoTiffKeysHaveTheirUnit)
{
  const ReadResult result = readCloud(
    write("a.las", makeLasWithKeys({ 1, 1, 0, 3, 1024, 0, 1, 1, 3076, 0, 1, 9001, 4099, 0, 1, 9003 })));
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(fieldText(result.cloud->GetFieldData(), "LengthUnit"), "metre");
  EXPECT_EQ(fieldText(result.cloud->GetFieldData(), "HeightUnit"), "US survey foot");
}

TEST_F(Las, FirstOfTwoGeographicSystemsCounts)
{
  const ReadResult result =
    readCloud(write("a.las", makeLasWithKeys({ 1, 1, 0, 2, 2048, 0, 1, 4326, 2048, 0, 1, 4269 })));
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(fieldText(result.cloud->GetFieldData(), "CoordinateSystem"), "EPSG:4326");
}

TEST_F(Las, PointsThatTheHeaderDoesNotCountAreSalvaged)
{
  std::string las = makeLas(2, 0, 20) + "cut";
  put(las, 107, std::uint32_t{ 0 });
  vtkNew<vtkPointCloudReader> reader;
  const std::string refused = readCloudBy(reader, write("a.las", las)).error;
  EXPECT_NE(refused.find("counts 0 points of 20 bytes, but 43 bytes follow (2 points)"), std::string::npos);
  EXPECT_NE(refused.find("--salvage"), std::string::npos);
  reader->SalvageOn();
  EXPECT_EQ(readCloudBy(reader, path("a.las")).points(), 2);
}

TEST_F(Las, PointsBeyondTheCountAreSaidToBeLeftOut)
{
  std::string las = makeLas(2, 0, 20);
  put(las, 107, std::uint32_t{ 1 });
  const ReadResult result = readCloud(write("a.las", las));
  EXPECT_EQ(result.points(), 1);
  ASSERT_EQ(result.notes.size(), 1u);
  EXPECT_NE(result.notes[0].find("20 bytes follow what the header counts"), std::string::npos);
  put(las, 6, std::uint16_t{ 2 });
  EXPECT_TRUE(readCloud(write("a.las", las)).notes.empty()) << "waveforms may follow";
}

} // namespace
