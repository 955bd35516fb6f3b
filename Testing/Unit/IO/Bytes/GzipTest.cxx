#include "CloudFiles.h"

#include "vtk_zlib.h"

#include <random>

namespace
{

std::string gzip(const std::string& content)
{
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, 9, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY), Z_OK);
  std::string packed(deflateBound(&stream, static_cast<uLong>(content.size())) + 64, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data()));
  stream.avail_in = static_cast<uInt>(content.size());
  stream.next_out = reinterpret_cast<Bytef*>(&packed[0]);
  stream.avail_out = static_cast<uInt>(packed.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  packed.resize(packed.size() - stream.avail_out);
  deflateEnd(&stream);
  return packed;
}

std::string manyLines(int count)
{
  std::mt19937 random(5);
  std::string text;
  for (int i = 0; i < count; ++i)
  {
    text += std::to_string(random() % 1000) + " " + std::to_string(random() % 1000) + " 0.25\n";
  }
  return text;
}

class Gzip : public CloudFiles
{
};

TEST_F(Gzip, EveryFormatIsReadAsIfItWereUnpacked)
{
  std::string ply =
    "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
    "property float z\nend_header\n";
  append(ply, 1.0f);
  append(ply, 2.0f);
  append(ply, 3.0f);
  const std::string pcd = "FIELDS x y z\nWIDTH 1\nDATA ascii\n1 2 3\n";
  for (const std::string& content :
    { ply, pcd, std::string("1 2 3\n"), std::string("v 1 2 3\n"), makeLas(2, 0, 20) })
  {
    const ReadResult plain = readCloud(write("a", content));
    const ReadResult packed = readCloud(write("b.gz", gzip(content)));
    EXPECT_EQ(packed.error, "");
    EXPECT_EQ(packed.format, plain.format);
    ASSERT_EQ(packed.points(), plain.points());
    EXPECT_EQ(packed.cloud->GetPoint(0)[2], plain.cloud->GetPoint(0)[2]);
  }
}

TEST_F(Gzip, LongAndJoinedFilesAreReadToTheirEnd)
{
  const std::string text = manyLines(100000);
  const ReadResult result = readCloud(write("a.xyz.gz", gzip(text) + gzip("7 8 9\n")));
  ASSERT_EQ(result.error, "");
  ASSERT_EQ(result.points(), 100001);
  EXPECT_EQ(result.cloud->GetPoint(100000)[2], 9.0);
}

TEST_F(Gzip, WhatIsCutIsSalvaged)
{
  const std::string text = manyLines(5000);
  const std::string whole = gzip(text);
  vtkNew<vtkPointCloudReader> reader;
  reader->SalvageOn();
  const ReadResult rows = readCloudBy(reader, write("a.xyz.gz", whole.substr(0, whole.size() / 2)));
  ASSERT_EQ(rows.error, "");
  EXPECT_EQ(rows.notes.size(), 1u);
  ASSERT_GT(rows.points(), 1000);
  ASSERT_LT(rows.points(), 5000);
  const ReadResult all = readCloud(write("b.xyz", text));
  for (vtkIdType i = 0; i < rows.points(); ++i) // the last one is whole
  {
    EXPECT_EQ(rows.cloud->GetPoint(i)[2], all.cloud->GetPoint(i)[2]);
  }
  const std::string head = "ply\nformat ascii 1.0\nelement vertex 5000\nproperty float x\nproperty float "
                           "y\nproperty float z\nend_header\n";
  const std::string ply = gzip(head + text);
  expectRefused(
    readCloud(write("a.ply.gz", ply.substr(0, ply.size() / 2))), "or read what is there by --salvage");
  const ReadResult points = readCloudBy(reader, write("a.ply.gz", ply.substr(0, ply.size() / 2)));
  ASSERT_EQ(points.error, "");
  EXPECT_GT(points.points(), 1000);
  EXPECT_EQ(points.notes.size(), 1u);
  // Where the last number of an OBJ is torn, its vertex is left out.
  std::string obj;
  for (int i = 0; i < 5000; ++i)
  {
    obj += "v 1 2 123456789\n";
  }
  const std::string packed = gzip(obj);
  for (std::size_t size = packed.size() / 2; size < packed.size() / 2 + 30; ++size)
  {
    const ReadResult torn = readCloudBy(reader, write("a.obj.gz", packed.substr(0, size)));
    ASSERT_EQ(torn.error, "") << size;
    ASSERT_GT(torn.points(), 100) << size;
    for (vtkIdType i = 0; i < torn.points(); ++i)
    {
      ASSERT_FLOAT_EQ(torn.cloud->GetPoint(i)[2], 123456789.0) << size;
    }
  }
}

TEST_F(Gzip, TruncatedAndDamagedFilesAreRefused)
{
  const std::string whole = gzip(manyLines(50));
  for (std::size_t size = 2; size < whole.size(); ++size)
  {
    const ReadResult result = readCloud(write("cut.gz", whole.substr(0, size)));
    EXPECT_NE(result.error.find("gz"), std::string::npos) << size << result.error;
    EXPECT_EQ(result.points(), 0);
  }
  std::string wrong = whole;
  wrong[wrong.size() - 6] = static_cast<char>(wrong[wrong.size() - 6] + 1); // its checksum
  expectRefused(readCloud(write("wrong.gz", wrong)), "incorrect data check");
  expectRefused(readCloud(write("twice.gz", gzip(whole))), "gzip file inside a gzip file");
  expectRefused(readCloud(write("none.gz", gzip(""))), "0 bytes");
}

TEST_F(Gzip, BombsAreRefusedBeforeTheyFillTheMemory)
{
  // Nothing known at the beginning: given up after the first bytes.
  expectRefused(readCloud(write("zero.gz", gzip(std::string(20000000, '\0')))), "unknown format");
  // A cloud at the beginning, and then 80 MB from 80 kB.
  expectRefused(
    readCloud(write("bomb.gz", gzip("1 2 3\n" + std::string(80000000, '\n')))), "unpacks to more than");
}

TEST_F(Gzip, XmlOfVtkIsReadAsAnyOtherFormat)
{
  const std::string start = "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\">";
  expectRefused(readCloud(write("a.vtp.gz", gzip(start))), "without </VTKFile>");
  const ReadResult result = readCloud(write("b.vtp.gz",
    gzip(start +
      "<PolyData><Piece NumberOfPoints=\"1\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
      "NumberOfPolys=\"0\"><Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">1 2 "
      "3</DataArray></Points></Piece></PolyData></VTKFile>")));
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(result.cloud->GetPoint(0)[2], 3.0);
}

TEST_F(Gzip, ThatIsNoCloudIsRefusedByItsStart)
{
  std::mt19937 random(5);
  std::string noise(12000000, '\0');
  for (char& c : noise)
  {
    c = static_cast<char>(random());
  }
  const auto reportsOf = [&](std::size_t size)
  {
    int reports = 0;
    vtkNew<vtkCallbackCommand> observer;
    observer->SetCallback(&countEvent);
    observer->SetClientData(&reports);
    vtkNew<vtkPointCloudReader> reader;
    reader->AddObserver(vtkCommand::ProgressEvent, observer);
    expectRefused(readCloudBy(reader, write("noise.gz", gzip(noise.substr(0, size)))), "unknown format");
    return reports;
  };
  EXPECT_EQ(reportsOf(noise.size()), reportsOf(noise.size() / 2)) << "nothing behind the start is read";
}

} // namespace
