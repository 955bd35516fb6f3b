#include "CloudFiles.h"

#include "vtkFieldData.h"

#include <cmath>
#include <cstdint>

namespace
{

std::string header(const std::string& points, const std::string& data)
{
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z rgb label hist\nSIZE 4 4 4 4 "
         "2 8\n"
         "TYPE F F F F U F\nCOUNT 1 1 1 1 1 2\nWIDTH " +
    points + "\nHEIGHT 1\nVIEWPOINT 1 2 3 0 1 0 0\nPOINTS " + points + "\nDATA " + data + "\n";
}

std::string makeBinary()
{
  std::string pcd = header("3", "binary");
  for (int i = 0; i < 3; ++i)
  {
    append(pcd, i == 1 ? std::nanf("") : 1.5f * static_cast<float>(i));
    append(pcd, 2.0f);
    append(pcd, 3.0f);
    append(pcd, std::uint32_t{ 0x00102030 });
    append(pcd, static_cast<std::uint16_t>(40000 + i));
    append(pcd, 0.1);
    append(pcd, 0.2 * i);
  }
  return pcd;
}

class Pcd : public CloudFiles
{
};

TEST_F(Pcd, BinaryKeepsFieldsPackedColorsAndViewpoint)
{
  const ReadResult result = readCloud(write("a.pcd", makeBinary()));
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(result.format, "PCD (binary)");
  ASSERT_EQ(result.points(), 3);
  EXPECT_TRUE(std::isnan(result.cloud->GetPoint(1)[0]));
  EXPECT_EQ(result.value("RGB", 2, 0), 0x10);
  EXPECT_EQ(result.value("RGB", 2, 2), 0x30);
  EXPECT_EQ(result.array("label")->GetDataType(), VTK_UNSIGNED_SHORT);
  EXPECT_EQ(result.value("label", 2), 40002);
  EXPECT_EQ(result.array("hist")->GetNumberOfComponents(), 2);
  EXPECT_EQ(result.value("hist", 2, 1), 0.4);
  vtkDataArray* viewpoint = result.cloud->GetFieldData()->GetArray("Viewpoint");
  ASSERT_NE(viewpoint, nullptr);
  EXPECT_EQ(viewpoint->GetComponent(0, 2), 3.0);
  EXPECT_EQ(viewpoint->GetComponent(0, 4), 1.0);
}

TEST_F(Pcd, AsciiReadsPackedColorsAndNan)
{
  const std::string body = "1 2 3 1.47e-39 7 0.5 0.25\nnan nan nan 0 8 1 2\n";
  const ReadResult result = readCloud(write("a.pcd", header("2", "ascii") + body));
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(result.format, "PCD (ascii)");
  ASSERT_EQ(result.points(), 2);
  float packed = 1.47e-39f;
  std::uint32_t bits = 0;
  std::memcpy(&bits, &packed, 4);
  EXPECT_EQ(result.value("RGB", 0, 0), (bits >> 16) & 255);
  EXPECT_EQ(result.value("RGB", 0, 2), bits & 255);
  EXPECT_TRUE(std::isnan(result.cloud->GetPoint(1)[2]));
  EXPECT_EQ(result.value("hist", 0, 1), 0.25);
}

TEST_F(Pcd, AsciiNamesTheLineOfAMalformedNumber)
{
  expectRefused(readCloud(write("a.pcd", header("2", "ascii") + "1 2 3 0 7 0.5 0.25\n1 2 x 0 7 0.5 0.25\n")),
    "line 13: field 'z' is 'x'");
  expectRefused(
    readCloud(write("a.pcd", header("2", "ascii") + "1 2 3 0 7 0.5 0.25\n1 2 3\n     \n      ")), "line 13");
}

TEST_F(Pcd, EveryTruncationIsRefusedWithAMessage)
{
  const std::string whole = makeBinary();
  for (std::size_t size = 0; size < whole.size(); ++size)
  {
    const ReadResult result = readCloud(write("cut.pcd", whole.substr(0, size)));
    EXPECT_NE(result.error, "") << size;
    EXPECT_EQ(result.points(), 0) << size;
  }
}

TEST_F(Pcd, HostileHeadersAllocateNothing)
{
  for (const char* count : { "4294967295", "4294967296", "18446744073709551615" })
  {
    for (const char* data : { "ascii", "binary", "binary_compressed" })
    {
      EXPECT_NE(readCloud(write("h.pcd", header(count, data) + "12345678901234567890")).error, "");
    }
  }
  std::string wrong = makeBinary();
  wrong.replace(wrong.find("WIDTH 3"), 7, "WIDTH 2");
  expectRefused(readCloud(write("w.pcd", wrong)), "WIDTH");
  std::string twice = makeBinary();
  twice.replace(twice.find("HEIGHT 1"), 8, "POINTS 9");
  expectRefused(readCloud(write("t.pcd", twice)), "second entry");
  std::string missing = makeBinary();
  missing.replace(missing.find("DATA binary"), 11, "DOTA binary");
  expectRefused(readCloud(write("m.pcd", missing)), "'DOTA'");
  std::string sizes = makeBinary();
  sizes.replace(sizes.find("SIZE 4 4 4 4 2 8"), 16, "SIZE 4 4 4      ");
  expectRefused(readCloud(write("s.pcd", sizes)), "one entry per field");
  expectRefused(readCloud(write("e.pcd", "VERSION 0.7\nFIELDS\nWIDTH 1\nDATA ascii\n1 2 3\n")), "FIELDS");
}

/// Field after field, as literals of LZF.
TEST_F(Pcd, CompressedFilesMayHoldTheirPadding)
{
  for (const bool hasPadding : { false, true })
  {
    std::string fields;
    for (const float value : { 1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f })
    {
      append(fields, value); // x of two points, y and z
    }
    fields += hasPadding ? std::string(8, '\x55') : "";
    append(fields, 7.0f);
    append(fields, 8.0f);
    std::string pcd = "VERSION 0.7\nFIELDS x y z _ gain\nSIZE 4 4 4 1 4\nTYPE F F F U F\nCOUNT 1 1 1 4 1\n"
                      "WIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA binary_compressed\n";
    append(pcd, static_cast<std::uint32_t>(fields.size() + (fields.size() + 31) / 32));
    append(pcd, static_cast<std::uint32_t>(fields.size()));
    for (std::size_t i = 0; i < fields.size(); i += 32)
    {
      const std::string run = fields.substr(i, 32);
      pcd += static_cast<char>(run.size() - 1) + run;
    }
    const ReadResult result = readCloud(write("a.pcd", pcd));
    ASSERT_EQ(result.error, "");
    EXPECT_EQ(result.cloud->GetPoint(1)[2], 6.0);
    EXPECT_EQ(result.value("gain", 1), 8.0);
    EXPECT_EQ(result.cloud->GetPointData()->GetNumberOfArrays(), 1);
  }
}

TEST_F(Pcd, CompressedSizesThatDoNotFitAreRefused)
{
  for (const std::uint32_t packed : { 0u, 4u, 4000000000u })
  {
    for (const std::uint32_t unpacked : { 0u, 102u, 4000000000u })
    {
      std::string pcd = header("3", "binary_compressed");
      append(pcd, packed);
      append(pcd, unpacked);
      pcd += "\xff\xff\xff\xff";
      EXPECT_NE(readCloud(write("c.pcd", pcd)).error, "");
    }
  }
}

TEST_F(Pcd, AsciiKeepsEveryDigitOfLongIntegers)
{
  const ReadResult result = readCloud(write("a.pcd",
    "VERSION 0.7\nFIELDS x y z id\nSIZE 4 4 4 8\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH 3\nHEIGHT 1\n"
    "POINTS 3\nDATA ascii\n1 2 3 9007199254740993\n1 2 4 18446744073709551615\n1 2 5 1e17\n"));
  ASSERT_EQ(result.error, "");
  vtkDataArray* ids = result.array("id");
  ASSERT_NE(ids, nullptr);
  EXPECT_EQ(ids->GetVariantValue(0).ToUnsignedLongLong(), 9007199254740993ULL);
  EXPECT_EQ(ids->GetVariantValue(1).ToUnsignedLongLong(), 18446744073709551615ULL);
  EXPECT_EQ(ids->GetVariantValue(2).ToUnsignedLongLong(), 100000000000000000ULL);
}

TEST_F(Pcd, MoreNumbersInALineThanFieldsAreRefused)
{
  const std::string start = "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT "
                            "1\nPOINTS 2\nDATA ascii\n";
  expectRefused(
    readCloud(write("six.pcd", start + "1 2 3 0.1 0.2 0.3\n4 5 6 0.1 0.2 0.3\n")), "follows the last");
  expectRefused(
    readCloud(write("four.pcd", start + "1 2 3 0.1\n4 5 6 0.1\n7 8 9 0.1\n")), "follows the last");
  const ReadResult both = readCloud(write("both.pcd", start + "1 2 3 4 5 6\n"));
  EXPECT_EQ(both.error, "");
  EXPECT_EQ(both.points(), 2);
}

} // namespace
