#include "CloudFiles.h"

#include <cmath>
#include <cstdint>

namespace
{

const std::string kAscii = "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 3\n"
                           "property float x\nproperty float y\nproperty float z\nproperty uchar red\n"
                           "property uchar green\nproperty uchar blue\nproperty int label\nelement face 1\n"
                           "property list uchar int vertex_indices\nend_header\n"
                           "0 0.5 1 255 0 10 -7\n1 nan 2 1 2 3 8\n2 1e-3 -inf 4 5 6 9\n3 0 1 2\n";

/// Vertex with double x y z, a list, a ushort and normals; a face element stands before it.
template <typename Append>
std::string makeBinary(const char* encoding, Append add)
{
  std::string ply = std::string("ply\r\nformat ") + encoding +
    " 1.0\r\nelement face 2\r\nproperty list uint8 int32 vertex_indices\r\nproperty float quality\r\n"
    "element vertex 2\r\nproperty float64 x\r\nproperty float64 y\r\nproperty float64 z\r\n"
    "property list uchar float unused\r\nproperty uint16 echo\r\nproperty float nx\r\nproperty float ny\r\n"
    "property float nz\r\nend_header\r\n";
  for (int face = 0; face < 2; ++face)
  {
    add(ply, std::uint8_t{ 3 });
    for (int i = 0; i < 3; ++i)
    {
      add(ply, std::int32_t{ i });
    }
    add(ply, 0.5f);
  }
  for (int i = 0; i < 2; ++i)
  {
    add(ply, 512700.123456789 + i);
    add(ply, 5403547.000000001 + i);
    add(ply, -1.0 / 3.0);
    add(ply, static_cast<std::uint8_t>(i));
    for (int k = 0; k < i; ++k)
    {
      add(ply, 1.0f);
    }
    add(ply, static_cast<std::uint16_t>(65535 - i));
    add(ply, 0.0f);
    add(ply, 0.6f);
    add(ply, 0.8f);
  }
  return ply;
}

const auto kNative = [](std::string& bytes, auto value) { append(bytes, value); };
const auto kSwapped = [](std::string& bytes, auto value) { appendSwapped(bytes, value); };

bool isLittleEndian()
{
  const std::uint16_t one = 1;
  return *reinterpret_cast<const std::uint8_t*>(&one) == 1;
}

class Ply : public CloudFiles
{
protected:
  void expectBinaryRead(const std::string& file)
  {
    const ReadResult result = readCloud(file);
    ASSERT_EQ(result.error, "");
    ASSERT_EQ(result.points(), 2);
    EXPECT_EQ(result.cloud->GetPoints()->GetDataType(), VTK_DOUBLE);
    EXPECT_EQ(result.cloud->GetPoint(1)[0], 512700.123456789 + 1);
    EXPECT_EQ(result.cloud->GetPoint(0)[1], 5403547.000000001);
    EXPECT_EQ(result.cloud->GetPoint(1)[2], -1.0 / 3.0);
    EXPECT_EQ(result.array("echo")->GetDataType(), VTK_UNSIGNED_SHORT);
    EXPECT_EQ(result.value("echo", 1), 65534);
    ASSERT_NE(result.cloud->GetPointData()->GetNormals(), nullptr);
    EXPECT_EQ(result.value("Normals", 1, 2), static_cast<double>(0.8f));
    EXPECT_EQ(result.array("unused"), nullptr);
  }
};

TEST_F(Ply, AsciiKeepsFieldsColorsAndInvalidPoints)
{
  const ReadResult result = readCloud(write("a.ply", kAscii));
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(result.format, "PLY (ascii)");
  ASSERT_EQ(result.points(), 3);
  EXPECT_EQ(result.cloud->GetPoints()->GetDataType(), VTK_FLOAT);
  EXPECT_TRUE(std::isnan(result.cloud->GetPoint(1)[1]));
  EXPECT_TRUE(std::isinf(result.cloud->GetPoint(2)[2]));
  EXPECT_EQ(result.array("label")->GetDataType(), VTK_INT);
  EXPECT_EQ(result.value("label", 0), -7);
  ASSERT_NE(result.cloud->GetPointData()->GetScalars(), nullptr);
  EXPECT_STREQ(result.cloud->GetPointData()->GetScalars()->GetName(), "RGB");
  EXPECT_EQ(result.value("RGB", 0, 2), 10);
  EXPECT_EQ(result.cloud->GetNumberOfVerts(), 3);
  EXPECT_EQ(result.cloud->GetNumberOfCells(), 3);
}

TEST_F(Ply, IsReadWhateverItsExtensionSays)
{
  EXPECT_EQ(readCloud(write("a.las", kAscii)).points(), 3);
}

TEST_F(Ply, BothBinaryOrdersGiveTheSameCloud)
{
  const bool little = isLittleEndian();
  expectBinaryRead(
    write("l.ply", makeBinary(little ? "binary_little_endian" : "binary_big_endian", kNative)));
  expectBinaryRead(
    write("b.ply", makeBinary(little ? "binary_big_endian" : "binary_little_endian", kSwapped)));
}

TEST_F(Ply, EveryTruncationIsRefusedWithAMessage)
{
  const std::string whole =
    makeBinary(isLittleEndian() ? "binary_little_endian" : "binary_big_endian", kNative);
  for (std::size_t size = 0; size < whole.size(); ++size)
  {
    const ReadResult result = readCloud(write("cut.ply", whole.substr(0, size)));
    EXPECT_NE(result.error, "") << size;
    EXPECT_EQ(result.points(), 0) << size;
  }
}

TEST_F(Ply, FacesThatAreCutAreNoted)
{
  std::string binary = std::string("ply\nformat ") +
    (isLittleEndian() ? "binary_little_endian" : "binary_big_endian") +
    " 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nelement face 2\n"
    "property list uchar int vertex_indices\nelement edge 1\nproperty int vertex1\nend_header\n";
  append(binary, 1.0f);
  append(binary, 2.0f);
  append(binary, 3.0f);
  const std::size_t faces = binary.size();
  for (std::uint8_t corners : { 3, 4 })
  {
    append(binary, corners);
    for (std::int32_t i = 0; i < corners; ++i)
    {
      append(binary, i);
    }
  }
  append(binary, std::int32_t{ 0 });
  EXPECT_EQ(readCloud(write("whole.ply", binary)).notes.size(), 1u); // the points are its vertices
  for (std::size_t size = faces; size < binary.size(); ++size)
  {
    const ReadResult result = readCloud(write("cut.ply", binary.substr(0, size)));
    EXPECT_EQ(result.error, "") << size;
    EXPECT_EQ(result.points(), 1) << size;
    ASSERT_EQ(result.notes.size(), 2u) << size;
  }
  EXPECT_EQ(readCloud(write("cut.ply", binary.substr(0, faces + 20))).notes[0],
    "all points are there, but the file ends at byte " + std::to_string(faces + 20) +
      " inside face 1 of 2; the file is cut short or its header is wrong: copy it again");
}

TEST_F(Ply, AsciiFacesThatAreCutAreNoted)
{
  EXPECT_EQ(readCloud(write("whole.ply", kAscii)).notes.size(), 1u); // the points are its vertices
  const std::string cure = "; the file is cut short or its header is wrong: copy it again";
  const ReadResult inside = readCloud(write("inside.ply", kAscii.substr(0, kAscii.rfind(" 2\n"))));
  ASSERT_EQ(inside.points(), 3);
  ASSERT_EQ(inside.notes.size(), 2u);
  EXPECT_EQ(inside.notes[0], "all points are there, but the file ends at line 18 inside face 0 of 1" + cure);
  const ReadResult before = readCloud(write("before.ply", kAscii.substr(0, kAscii.rfind("3 0 1 2"))));
  ASSERT_EQ(before.points(), 3);
  ASSERT_EQ(before.notes.size(), 2u);
  EXPECT_EQ(before.notes[0], "all points are there, but the file ends before face 0 of 1" + cure);
}

TEST_F(Ply, HostileCountsAllocateNothing)
{
  for (const char* count : { "4000000000", "9223372036854775807", "18446744073709551615" })
  {
    const std::string binary = std::string("ply\nformat binary_little_endian 1.0\nelement vertex ") + count +
      "\nproperty float x\nproperty float y\nproperty float z\nend_header\n0123456789ab";
    expectRefused(readCloud(write("h.ply", binary)), "bytes follow");
    const std::string ascii = std::string("ply\nformat ascii 1.0\nelement vertex ") + count +
      "\nproperty float x\nproperty float y\nproperty float z\nend_header\n1 2 3\n";
    expectRefused(readCloud(write("h.ply", ascii)), "bytes follow");
    const std::string faces = std::string("ply\nformat binary_little_endian 1.0\nelement face ") + count +
      "\nproperty list int int vertex_indices\nelement vertex 1\nproperty float x\nproperty float y\n"
      "property float z\nend_header\n0123456789ab";
    EXPECT_NE(readCloud(write("h.ply", faces)).error, "");
  }
  expectRefused(
    readCloud(write("n.ply", "ply\nformat ascii 1.0\nelement vertex -5\nend_header\n")), "line 3");
}

TEST_F(Ply, NamesTheLineOfAMalformedNumber)
{
  std::string bad = kAscii;
  bad.replace(bad.find("1 nan"), 5, "1 n%n");
  expectRefused(readCloud(write("a.ply", bad)), "line 16: property 'y' is 'n%n', not a number");
  std::string wide = kAscii;
  wide.replace(wide.find("255 0 10"), 3, "256");
  expectRefused(readCloud(write("a.ply", wide)), "line 15: property 'red' is 256");
  std::string missing = kAscii;
  missing.replace(missing.find(" 8\n"), 3, "\n");
  expectRefused(readCloud(write("a.ply", missing)), "line 16: property 'label' is missing");
}

TEST_F(Ply, RefusesZeroPointsAndMissingCoordinates)
{
  const std::string header = "ply\nformat ascii 1.0\nelement vertex ";
  expectRefused(readCloud(write(
                  "0.ply", header + "0\nproperty float x\nproperty float y\nproperty float z\nend_header\n")),
    "holds no points");
  expectRefused(readCloud(write("n.ply", header + "1\nproperty float x\nend_header\n1\n")), "x, y and z");
  expectRefused(
    readCloud(write("f.ply", "ply\nformat ascii 1.0\nelement face 0\nend_header\n")), "element vertex");
}

} // namespace

TEST_F(Ply, ALineOfManyVerticesIsCountedOnce)
{
  constexpr std::size_t kVertices = 200000; // whose square takes minutes
  std::string line;
  for (std::size_t i = 0; i < kVertices; ++i)
  {
    line += std::to_string(i) + " 2 3 ";
  }
  const ReadResult result = readCloud(write("a.ply",
    "ply\nformat ascii 1.0\nelement vertex 200000\nproperty float x\nproperty float y\nproperty float z\n"
    "end_header\n" +
      line + "\n"));
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(result.cloud->GetPoint(199999)[0], 199999.0);
}

TEST_F(Ply, ColoursOfFacesAreSaidToBeLeftOut)
{
  const ReadResult result = readCloud(write("a.ply",
    "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_index\nproperty uchar red\nend_header\n1 2 3\n3 0 0 0 "
    "9\n"));
  ASSERT_EQ(result.notes.size(), 2u);
  EXPECT_EQ(result.notes[0], "colours of faces are left out: 'red'");
}

TEST_F(Ply, WhatTheHeaderDoesNotCountIsSaidToBeLeftOut)
{
  const std::string properties = "property float x\nproperty float y\nproperty float z\nend_header\n";
  const std::string text = "ply\nformat ascii 1.0\nelement vertex 1\n" + properties;
  const std::string binary = "ply\nformat binary_little_endian 1.0\nelement vertex 1\n" + properties;
  const auto notesOf = [this](const std::string& bytes) { return readCloud(write("a.ply", bytes)).notes; };
  for (const std::string& twice : { text + "1 2 3\n4 5 6\n", binary + std::string(24, '?') })
  {
    const std::vector<std::string> notes = notesOf(twice);
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_NE(notes[0].find("bytes follow what the header counts"), std::string::npos);
  }
  EXPECT_TRUE(notesOf(text + "1 2 3\n \n\n").empty());
  EXPECT_TRUE(notesOf(binary + std::string(12, '?') + "\n").empty());
  EXPECT_TRUE(notesOf(binary + std::string(12, '?') + std::string(100, '\0')).empty());
}

TEST_F(Ply, ASecondElementOfVerticesIsSaidToBeLeftOut)
{
  const std::string properties = "property float x\nproperty float y\nproperty float z\n";
  const ReadResult result = readCloud(write("a.ply",
    "ply\nformat ascii 1.0\nelement vertex 1\n" + properties + "element vertex 2\n" + properties +
      "end_header\n1 2 3\n4 5 6\n7 8 9\n"));
  EXPECT_EQ(result.points(), 1);
  ASSERT_EQ(result.notes.size(), 1u);
  EXPECT_NE(result.notes[0].find("2 points of a second element vertex"), std::string::npos);
}

TEST_F(Ply, AHeaderOfListsAloneIsSaidToHaveNoCoordinates)
{
  expectRefused(readCloud(write("a.ply",
                  "ply\nformat ascii 1.0\nelement vertex 1\nproperty list uchar float position\n"
                  "end_header\n3 1 2 3\n")),
    "no columns named x, y and z; ");
}
