#include "CloudFiles.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkStringArray.h"
#include "vtkXMLPolyDataWriter.h"

#include <cstdint>

namespace
{

class HostileFiles : public CloudFiles
{
};

TEST_F(HostileFiles, HugeLinesAndHeadersAreRefusedAtOnce)
{
  std::string wide;
  for (int i = 0; i < 200000; ++i)
  {
    wide += "1 ";
  }
  expectRefused(readCloud(write("a.xyz", wide + "\n" + wide)), "more than 4096 columns");
  expectRefused(readCloud(write("a.xyz", "1 2 3\n" + wide)), "columns");
  expectRefused(readCloud(write("a.xyz", std::string(3000000, '7'))), "");
  std::string names;
  std::string properties;
  for (int i = 0; i < 100000; ++i)
  {
    names += " f" + std::to_string(i);
    properties += "property float f" + std::to_string(i) + "\n";
  }
  expectRefused(readCloud(write("a.pcd", "FIELDS" + names + "\nWIDTH 1\nDATA ascii\n")), "more than 4096");
  expectRefused(
    readCloud(write("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\n" + properties + "end_header\n1\n")),
    "more than 4096");
}

TEST_F(HostileFiles, CoordinatesThatNothingMeasuresAreRefused)
{
  expectRefused(readCloud(write("a.xyz", "1 2 3\n4 3e38 6\n")), "point 1 of 2: y is 3e+38");
  expectRefused(readCloud(write("a.xyz", "1 2 3\n4 5 -1.23456789e300\n")), "point 1 of 2: z");
  std::string ply =
    "ply\nformat binary_little_endian 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
    "property float z\nend_header\n";
  for (const float value : { 1.0f, 2.0f, 3.0f, 4.0f, 3.39e38f, 6.0f })
  {
    append(ply, value);
  }
  expectRefused(readCloud(write("a.ply", ply)), "point 1 of 2: y");
  EXPECT_EQ(readCloud(write("b.xyz", "1 2 3\n4 9e29 6\n")).points(), 2);
  EXPECT_EQ(readCloud(write("c.xyz", "1 2 3\n4 nan -inf\n")).points(), 2) << "not measured, and known to be";
}

TEST_F(HostileFiles, CorruptModelOfDebianIsRefused)
{
  const std::string pond = "/usr/share/assimp/models/PLY/pond.0.ply";
  if (!std::filesystem::exists(pond))
  {
    GTEST_SKIP() << "install assimp-testmodels to read " << pond;
  }
  expectRefused(readCloud(pond), "PLY");
}

TEST_F(HostileFiles, DamagedLzfDataAreRefused)
{
  const std::string header =
    "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 1\nPOINTS 2\n"
    "DATA binary_compressed\n";
  const auto file = [&](const std::string& packed, std::uint32_t unpacked = 24)
  {
    std::string pcd = header;
    append(pcd, static_cast<std::uint32_t>(packed.size()));
    append(pcd, unpacked);
    return pcd + packed;
  };
  std::string values;
  for (const float value : { 1.0f, 4.0f, 2.0f, 5.0f, 3.0f, 6.0f }) // field after field
  {
    append(values, value);
  }
  const std::string literal = std::string(1, static_cast<char>(23)) + values;
  const ReadResult good = readCloud(write("a.pcd", file(literal)));
  ASSERT_EQ(good.error, "");
  EXPECT_EQ(good.cloud->GetPoint(1)[0], 4.0);
  EXPECT_EQ(good.cloud->GetPoint(0)[2], 3.0);
  // One value, then 20 bytes that repeat it from 4 bytes back: length 20 = 2 + 7 + 11.
  const std::string repeated = std::string("\x03", 1) + values.substr(0, 4) + std::string("\xe0\x0b\x03", 3);
  const ReadResult same = readCloud(write("a.pcd", file(repeated)));
  ASSERT_EQ(same.error, "");
  EXPECT_EQ(same.cloud->GetPoint(1)[2], 1.0);
  const std::string before = std::string("\x03", 1) + values.substr(0, 4) + std::string("\xe0\x0b\x04", 3);
  expectRefused(readCloud(write("a.pcd", file(before))), "damaged LZF data");
  expectRefused(readCloud(write("a.pcd", file(literal.substr(0, 20)))), "damaged LZF data");
  expectRefused(readCloud(write("a.pcd", file(literal + std::string("\x00z", 2)))), "more compressed data");
  expectRefused(readCloud(write("a.pcd", file(literal, 25))), "header needs 24");
}

/// A VTP file of two points whose array starts with @p words and goes on with @p data.
std::string makeVtp(const std::vector<std::uint32_t>& words, const std::string& data, bool isPacked,
  const std::string& offset = "0", const std::string& before = "")
{
  std::string vtp = "<?xml version=\"1.0\"?>\n" + before +
    "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\"" +
    (isPacked ? " compressor=\"vtkZLibDataCompressor\"" : "") +
    ">\n<PolyData>\n<Piece NumberOfPoints=\"2\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
    "NumberOfPolys=\"0\">\n<Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"appended\" "
    "offset = \"" +
    offset + "\"/></Points>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
  for (const std::uint32_t word : words)
  {
    append(vtp, word);
  }
  return vtp + data + "\n</AppendedData>\n</VTKFile>\n";
}

TEST_F(HostileFiles, SizesThatVtkWouldBelieveAreCheckedFirst)
{
  std::string points;
  for (const float value : { 1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f })
  {
    append(points, value);
  }
  const ReadResult plain = readCloud(write("a.vtp", makeVtp({ 24 }, points, false)));
  ASSERT_EQ(plain.error, "");
  EXPECT_EQ(plain.cloud->GetPoint(1)[2], 6.0);
  expectRefused(
    readCloud(write("a.vtp", makeVtp({ 4000000000u }, points, false))), "array of 4000000000 bytes");
  expectRefused(readCloud(write("a.vtp", makeVtp({ 24 }, points, false, "9999"))), "which is not there");
  expectRefused(readCloud(write("a.vtp", makeVtp({ 24 }, points, false, "-1"))), "which is not there");
  const std::string packed(60, 'z');
  expectRefused(
    readCloud(write("a.vtp", makeVtp({ 0xffffffff, 24, 0, 9 }, packed, true))), "blocks, but only");
  std::string other = makeVtp({ 0xffffffff, 24, 0, 9 }, packed, true);
  other.replace(other.find("\"appended\""), 10, "\"ascii\""); // VTK looks for the offset alone
  expectRefused(readCloud(write("a.vtp", other)), "blocks, but only");
  expectRefused(
    readCloud(write("a.vtp", makeVtp({ 1, 0xffffffff, 24, 9 }, packed, true))), "blocks of 4294967295");
  expectRefused(
    readCloud(write("a.vtp", makeVtp({ 1, 24, 0xffffffff, 9 }, packed, true))), "said to be packed");
  expectRefused(
    readCloud(write("a.vtp", makeVtp({ 2, 24, 0, 50, 0xfffffff0 }, packed, true))), "that follow");
  expectRefused(readCloud(write("a.vtp", makeVtp({ 0, 24, 9 }, packed, true))), "array of no blocks");
  expectRefused(readCloud(write("a.vtp", makeVtp({ 0, 0, 24 }, packed, true))), "array of no blocks");
  expectRefused(
    readCloud(write("a.vtp", makeVtp({ 24 }, points, false, "0", "<!DOCTYPE a [<!ENTITY b \"c\">]>\n"))),
    "entities");
}

TEST_F(HostileFiles, XmlIsCheckedAsVtkReadsItWhateverStandsAround)
{
  std::string points;
  for (const float value : { 1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f })
  {
    append(points, value);
  }
  const auto around = [&](const std::string& before, const std::vector<std::uint32_t>& words = { 24 })
  { return readCloud(write("a.vtp", makeVtp(words, points, false, "0", before))); };
  std::string deep;
  for (int i = 0; i < 1000000; ++i)
  {
    deep += "<a>";
  }
  for (int i = 0; i < 1000000; ++i)
  {
    deep += "</a>";
  }
  std::string vtp = makeVtp({ 24 }, points, false);
  vtp.insert(vtp.find("<Points>"), deep);
  expectRefused(readCloud(write("a.vtp", vtp)), "more than 64 XML elements inside each other");
  // Elements that only look closed, and text that only looks like tags.
  std::string hidden;
  for (int i = 0; i < 100; ++i)
  {
    hidden += "<a b='/>'><!-- </a> --><![CDATA[</a>]]>";
  }
  vtp = makeVtp({ 24 }, points, false);
  vtp.insert(vtp.find("<Points>"), hidden);
  expectRefused(readCloud(write("a.vtp", vtp)), "more than 64 XML elements inside each other");
  EXPECT_EQ(around("<!-- <a><VTKFile> -->\n").points(), 2);
  expectRefused(
    around("<!-- <VTKFile compressor='none'> -->\n", { 4000000000u }), "array of 4000000000 bytes");
  expectRefused(around("<!-- <AppendedData encoding='raw'>_ -->\n", { 4000000000u }), "where it is no tag");
  expectRefused(around("<!-- no end "), "where it is no tag");
  vtp = makeVtp({ 24 }, points, false);
  vtp.replace(
    vtp.find("NumberOfPoints=\"2\""), 18, "x=\" NumberOfPoints='2'\" NumberOfPoints=\"1000000000000\"");
  expectRefused(readCloud(write("a.vtp", vtp)), "NumberOfPoints is '1000000000000'");
}

TEST_F(HostileFiles, TagsThatVtksParserWouldReadAgainAndAgainAreRefused)
{
  std::string points;
  for (const float value : { 1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f })
  {
    append(points, value);
  }
  const std::string many(30000000, '>');
  const auto with = [&](const std::string& inserted)
  {
    std::string vtp = makeVtp({ 24 }, points, false);
    vtp.insert(vtp.find("<Points>"), inserted);
    return readCloud(write("a.vtp", vtp));
  };
  for (const std::string& tag : { "<!-- " + many + " -->", "<?a " + many + "?>", "<a b='" + many + "'/>",
         "<a></a" + std::string(many.size(), ' ') + ">" })
  {
    expectRefused(with(tag), "a tag or comment of more than 65536 bytes");
  }
  EXPECT_EQ(with("<!-- " + many.substr(0, 60000) + " -->").points(), 2);
}

TEST_F(HostileFiles, LasRecordsThatLieAreKeptAsBytes)
{
  // A description of 8 bytes where a record has 2 to spare.
  std::string las = makeLas(2, 0, 22);
  std::string record(54 + 192, '\0');
  record.replace(2, 9, "LASF_Spec");
  put(record, 18, std::uint16_t{ 4 });
  put(record, 20, std::uint16_t{ 192 });
  record[54 + 2] = 10; // double
  record.replace(54 + 4, 5, "wrong");
  las.insert(227, record);
  put(las, 96, static_cast<std::uint32_t>(227 + record.size()));
  put(las, 100, std::uint32_t{ 1 });
  const ReadResult result = readCloud(write("a.las", las));
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(result.array("wrong"), nullptr);
  ASSERT_NE(result.array("ExtraBytes"), nullptr);
  EXPECT_EQ(result.array("ExtraBytes")->GetNumberOfComponents(), 2);
}

/// Two points whose coordinates are @p base64 with an array's size before them, and @p inserted before them.
std::string inlineVtp(const std::string& base64, const std::string& inserted = "")
{
  return "<?xml version=\"1.0\"?><VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\">"
         "<PolyData>" +
    inserted +
    "<Piece NumberOfPoints=\"2\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
    "NumberOfPolys=\"0\"><Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"binary\">" +
    base64 + "</DataArray></Points></Piece></PolyData></VTKFile>";
}

TEST_F(HostileFiles, Base64ThatIsNoneIsNotReadAsPoints)
{
  const std::string base64 = "GAAAAAAAgD8AAABAAABAQAAAgEAAAKBAAADAQA==";
  const ReadResult good = readCloud(write("a.vtp", inlineVtp(base64)));
  ASSERT_EQ(good.error, "");
  EXPECT_EQ(good.cloud->GetPoint(1)[2], 6.0);
  for (std::size_t at = 8; at < base64.size(); ++at)
  {
    for (const char wrong : { '*', '\n', '-' })
    {
      std::string changed = base64;
      changed[at] = wrong;
      expectRefused(readCloud(write("a.vtp", inlineVtp(changed))), "base64");
    }
  }
  expectRefused(readCloud(write("a.vtp", inlineVtp(base64.substr(0, 20)))), "base64");
  std::string early = base64;
  early[20] = '=';
  expectRefused(readCloud(write("a.vtp", inlineVtp(early))), "'=' is no digit of base64");
}

TEST_F(HostileFiles, ArraysOfVtkThatItCannotMakeAreRefused)
{
  const std::string base64 = "GAAAAAAAgD8AAABAAABAQAAAgEAAAKBAAADAQA==";
  const auto with = [&](const std::string& inserted)
  { return readCloud(write("a.vtp", inlineVtp(base64, "<FieldData>" + inserted + "</FieldData>"))); };
  const std::string rest = "Name=\"a\" NumberOfTuples=\"1\" format=\"ascii\">1</DataArray>";
  const ReadResult good = with("<DataArray type=\"Int32\" " + rest);
  ASSERT_EQ(good.error, "");
  EXPECT_EQ(good.points(), 2);
  expectRefused(with("<DataArray type=\"Foo\" " + rest), "an array of the type 'Foo'");
  expectRefused(with("<DataArray " + rest), "an array of the type ''");
  expectRefused(with("<Foo type=\"Int32\"/>"), "'Foo' in the place of an array");
  std::string flat = inlineVtp(base64);
  flat.replace(flat.find("Components=\"3"), 13, "Components=\"2");
  expectRefused(readCloud(write("a.vtp", flat)), "points of '2' components");
}

TEST_F(HostileFiles, TextsOfVtkThatHaveNoEndAreRefused)
{
  const auto with = [&](const std::string& texts)
  {
    std::string vtp = inlineVtp("GAAAAAAAgD8AAABAAABAQAAAgEAAAKBAAADAQA==");
    vtp.insert(vtp.find("<Points>"),
      "<PointData><Array type=\"String\" Name=\"words\" format=\"ascii\">" + texts + "</Array></PointData>");
    return readCloud(write("a.vtp", vtp));
  };
  EXPECT_EQ(with("97 0 98 0").points(), 2);
  expectRefused(with("97 98"), "Cannot read the texts of 'words'");
  expectRefused(with("97 0 98 0 99 0"), "3 strings where its tags say 2");
}

TEST_F(HostileFiles, MarksWithinTagsOfVtkAreRefused)
{
  std::string vtp = inlineVtp("GAAAAAAAgD8AAABAAABAQAAAgEAAAKBAAADAQA==");
  vtp.insert(vtp.find("format=\"binary\""), "Note=\">\" ");
  expectRefused(readCloud(write("a.vtp", vtp)), "'>' within a tag; write &gt; for it");
}

/// @p cloud as VTK writes it, with @p encoding and the compressor @p packing (of vtkXMLWriter).
std::string vtkXmlOf(vtkPolyData* cloud, int encoding, int packing)
{
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(cloud);
  writer->SetDataMode(encoding);
  writer->SetCompressorType(packing);
  writer->WriteToOutputStringOn();
  writer->Write();
  return writer->GetOutputString();
}

TEST_F(HostileFiles, MoreTextsOfVtkThanItHasRoomForAreRefused)
{
  vtkNew<vtkPolyData> cloud;
  vtkNew<vtkPoints> points;
  vtkNew<vtkStringArray> words;
  words->SetName("words");
  vtkNew<vtkStringArray> ofPoints;
  ofPoints->SetName("of points");
  for (int i = 0; i < 4000; ++i)
  {
    words->InsertNextValue(i % 7 == 0 ? "" : "word " + std::to_string(i));
    if (i < 3)
    {
      points->InsertNextPoint(i, 2, 3);
      ofPoints->InsertNextValue("point " + std::to_string(i));
    }
  }
  cloud->SetPoints(points);
  cloud->GetFieldData()->AddArray(words);
  cloud->GetPointData()->AddArray(ofPoints);
  // VTK reads texts of cells in as many parts as there are kinds.
  vtkNew<vtkCellArray> vertices;
  vertices->InsertNextCell({ 0 });
  cloud->SetVerts(vertices);
  vtkNew<vtkCellArray> faces;
  faces->InsertNextCell({ 0, 1, 2 });
  cloud->SetPolys(faces);
  vtkNew<vtkStringArray> ofCells;
  ofCells->SetName("of cells");
  ofCells->InsertNextValue("vertex");
  ofCells->InsertNextValue("face");
  cloud->GetCellData()->AddArray(ofCells);
  const std::string count = "NumberOfTuples=\"4000\"";
  for (const int encoding : { vtkXMLWriter::Ascii, vtkXMLWriter::Binary, vtkXMLWriter::Appended })
  {
    for (const int packing :
      { vtkXMLWriter::NONE, vtkXMLWriter::ZLIB, vtkXMLWriter::LZ4, vtkXMLWriter::LZMA })
    {
      SCOPED_TRACE(std::to_string(encoding) + " " + std::to_string(packing));
      const std::string vtp = vtkXmlOf(cloud, encoding, packing);
      const ReadResult good = readCloud(write("a.vtp", vtp));
      ASSERT_EQ(good.error, "");
      const auto* read = vtkStringArray::SafeDownCast(good.cloud->GetFieldData()->GetAbstractArray("words"));
      ASSERT_NE(read, nullptr);
      EXPECT_EQ(const_cast<vtkStringArray*>(read)->GetValue(3999), words->GetValue(3999));
      read = vtkStringArray::SafeDownCast(good.cloud->GetPointData()->GetAbstractArray("of points"));
      ASSERT_NE(read, nullptr);
      EXPECT_EQ(const_cast<vtkStringArray*>(read)->GetValue(2), "point 2");
      ASSERT_NE(vtp.find(count), std::string::npos);
      for (const char* wrong : { "1", "3999", "4001" })
      {
        std::string changed = vtp;
        changed.replace(vtp.find(count), count.size(), std::string("NumberOfTuples=\"") + wrong + "\"");
        expectRefused(
          readCloud(write("b.vtp", changed)), std::string("4000 strings where its tags say ") + wrong);
      }
    }
  }
}

TEST_F(HostileFiles, PiecesOfVtkHaveTheSameArrays)
{
  const auto pieceOf = [](const char* array)
  {
    return std::string("<Piece NumberOfPoints=\"1\"><PointData>") + array +
      "</PointData><Points><DataArray "
      "type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">1 2 3</DataArray></Points></Piece>";
  };
  const auto vtpOf = [](const std::string& pieces)
  { return "<VTKFile type=\"PolyData\" version=\"0.1\"><PolyData>" + pieces + "</PolyData></VTKFile>"; };
  const char* const a = "<DataArray type=\"Float32\" Name=\"a\" format=\"ascii\">7</DataArray>";
  const ReadResult same = readCloud(write("a.vtp", vtpOf(pieceOf(a) + pieceOf(a))));
  EXPECT_EQ(same.error, "");
  EXPECT_EQ(same.value("a", 1), 7.0);
  expectRefused(
    readCloud(write("b.vtp", vtpOf(pieceOf(a) + pieceOf("")))), "other arrays than in the pieces before");
}

} // namespace
