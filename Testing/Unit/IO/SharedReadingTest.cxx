// Ranks that read a file together: their parts, one after the other, are the cloud that one reader gives, to
// the last bit, in every format; a fault of one ends the reading of all.
#include "CloudFiles.h"
#include "Las/LazFiles.h"
#include "Unit/Core/ThreadRanks.h"

#include <random>

namespace
{

using pointhaptics::Ranks;
using pointhaptics::trial::ThreadJob;

struct PartRead
{
  ReadResult result;
  bool failedElsewhere = false;
  vtkTypeInt64 bytesRead = 0;
};

PartRead readAsRank(const std::string& file, Ranks* ranks)
{
  vtkNew<vtkPointCloudReader> reader;
  reader->SetRanks(ranks);
  PartRead part;
  part.result = readCloudBy(reader, file);
  part.failedElsewhere = reader->FailedElsewhere();
  part.bytesRead = reader->GetNumberOfBytesRead();
  return part;
}

/// @p fileOf: what each rank reads.
std::vector<PartRead> readTogether(int size, const std::function<std::string(int)>& fileOf)
{
  std::vector<PartRead> parts(static_cast<std::size_t>(size));
  ThreadJob(size).run([&](Ranks& ranks)
    { parts[static_cast<std::size_t>(ranks.rank())] = readAsRank(fileOf(ranks.rank()), &ranks); });
  return parts;
}

std::string bytesOf(vtkDataArray* array)
{
  const auto bytes = static_cast<std::size_t>(array->GetNumberOfValues() * array->GetDataTypeSize());
  return bytes == 0 ? std::string() : std::string(static_cast<const char*>(array->GetVoidPointer(0)), bytes);
}

std::vector<vtkDataArray*> arraysOf(vtkPolyData* cloud)
{
  std::vector<vtkDataArray*> arrays{ cloud->GetPoints()->GetData() };
  for (int i = 0; i < cloud->GetPointData()->GetNumberOfArrays(); ++i)
  {
    arrays.push_back(cloud->GetPointData()->GetArray(i));
  }
  return arrays;
}

void expectSameArrays(const std::vector<PartRead>& parts, vtkPolyData* whole)
{
  const std::vector<vtkDataArray*> expected = arraysOf(whole);
  std::vector<std::string> together(expected.size());
  for (const PartRead& part : parts)
  {
    ASSERT_EQ(part.result.error, "");
    ASSERT_FALSE(part.failedElsewhere);
    const std::vector<vtkDataArray*> arrays = arraysOf(part.result.cloud);
    ASSERT_EQ(arrays.size(), expected.size());
    for (std::size_t i = 0; i < arrays.size(); ++i)
    {
      EXPECT_STREQ(arrays[i]->GetName(), expected[i]->GetName());
      EXPECT_EQ(arrays[i]->GetDataType(), expected[i]->GetDataType()) << arrays[i]->GetName();
      EXPECT_EQ(arrays[i]->GetNumberOfComponents(), expected[i]->GetNumberOfComponents());
      together[i] += bytesOf(arrays[i]);
    }
    EXPECT_EQ(
      part.result.cloud->GetFieldData()->GetNumberOfArrays(), whole->GetFieldData()->GetNumberOfArrays());
    EXPECT_EQ(part.result.cloud->GetNumberOfVerts(), part.result.points());
  }
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    EXPECT_TRUE(together[i] == bytesOf(expected[i])) << expected[i]->GetName();
  }
}

class SharedReading : public CloudFiles
{
protected:
  void expectPartsOf(const std::string& file) const
  {
    SCOPED_TRACE(file);
    const PartRead whole = readAsRank(file, nullptr);
    ASSERT_EQ(whole.result.error, "");
    for (const int size : { 1, 2, 3, 7 })
    {
      SCOPED_TRACE(size);
      const std::vector<PartRead> parts = readTogether(size, [&](int) { return file; });
      expectSameArrays(parts, whole.result.cloud);
      for (const PartRead& part : parts)
      {
        const vtkIdType even = whole.result.points() / size;
        EXPECT_TRUE(part.result.points() >= even && part.result.points() <= even + 1);
      }
    }
  }
  /// Content of @p file as vtkPointCloudWriter converts it.
  std::string converted(const std::string& file, const std::string& name) const
  {
    vtkNew<vtkPointCloudWriter> writer;
    writer->SetInputData(readAsRank(file, nullptr).result.cloud);
    writer->SetFileName(path(name).c_str());
    EXPECT_EQ(writer->Write(), 1);
    return path(name);
  }
};

/// Integers at first, then what they cannot hold; colours; blank lines and comments.
std::string table(int rows)
{
  std::mt19937 random(5);
  std::string text = "# made up\nx,y,z,red,green,blue,count,Time\n";
  for (int i = 0; i < rows; ++i)
  {
    const bool isLate = i > rows / 2;
    text += std::to_string(i) + "," + std::to_string(0.25 * (i % 7)) + "," + std::to_string(i % 11) + ",";
    text += std::to_string(random() % 256) + ",0,255," + std::to_string(i) + (isLate ? ".5," : ",");
    text += (isLate          ? "300000000.125"
                : i % 5 == 3 ? ""
                             : "7") +
      std::string(i % 50 == 9 ? "\r\n\n# next\n" : "\n");
  }
  return text;
}

TEST_F(SharedReading, TextIsReadWholeByEachAndCut)
{
  expectPartsOf(write("table.csv", table(1000)));
  expectPartsOf(write("few.csv", "x,y,z\n1,2,3\n4,5,6"));
  expectPartsOf(write("wide.xyz", "0 0 0 1 2 3\n1 0 0 1 2 3\n0 1 0 1 2 300\n"));
  expectPartsOf(write("block.pts", "3\n0 0 0\n1 0 0\n0 1 0\n"));
}

TEST_F(SharedReading, NotesOnTextsAreThoseOfTheWholeFile)
{
  std::string rows = "x,y,z,class,gain\n";
  for (int i = 0; i < 300; ++i)
  {
    rows += std::to_string(i) + ",0,0," + (i < 170 ? "ground," : "7,") + (i % 100 == 80 ? "gap\n" : "1\n");
  }
  const std::string file = write("class.csv", rows);
  expectPartsOf(file);
  const std::vector<std::string> notes = readAsRank(file, nullptr).result.notes;
  ASSERT_EQ(notes.size(), 2U);
  EXPECT_NE(notes[0].find("'class' holds texts, such as 'ground' in line 2"), std::string::npos) << notes[0];
  EXPECT_NE(notes[1].find("3 of 300 cells of column 'gain'"), std::string::npos) << notes[1];
  EXPECT_NE(notes[1].find("'gap' in line 82"), std::string::npos) << notes[1];
  for (const PartRead& part : readTogether(4, [&](int) { return file; }))
  {
    EXPECT_EQ(part.result.notes, notes);
  }
  const std::string bad = write("bad.csv", rows + "1,2,up,3,4\n");
  for (const PartRead& part : readTogether(4, [&](int) { return bad; }))
  {
    EXPECT_NE(part.result.error.find("line 302, column 3: 'up' is not a number"), std::string::npos)
      << part.result.error;
  }
}

TEST_F(SharedReading, ColoursAreScaledByTheLargestOfAllParts)
{
  expectPartsOf(write("words.csv", "x,y,z,r,g,b\n0,0,0,1,2,3\n1,0,0,1,2,3\n2,0,0,1,2,3000\n"));
  expectPartsOf(write("floats.csv", "x,y,z,r,g,b\n0,0,0,0.5,1,0\n1,0,0,1,0.5,1\n2,0,0,1.5,200,3\n"));
}

TEST_F(SharedReading, RecordsAreCutEvenly)
{
  const std::string csv = write("table.csv", table(1001));
  for (const char* name : { "a.ply", "a.pcd", "a.las", "a.laz", "a.vtp" })
  {
    expectPartsOf(converted(csv, name));
  }
}

TEST_F(SharedReading, AsciiPlyAndPcdAreReadWholeByEachAndCut)
{
  std::string rows;
  for (int i = 0; i < 400; ++i)
  {
    rows += std::to_string(i) + " 0.5 " + std::to_string(i * i) + " 3 1 2 3\n" + (i % 9 == 4 ? "\n" : "");
  }
  expectPartsOf(write("a.ply",
    "ply\nformat ascii 1.0\nelement vertex 400\nproperty float x\nproperty float y\nproperty double "
    "z\nproperty list uchar int neighbors\nelement face 3\nproperty list uchar int "
    "vertex_indices\nend_header\n" +
      rows + "3 0 1 2\n3 1 2 3\n3 2 3 4\n"));
  expectPartsOf(write("a.pcd",
    "VERSION .7\nFIELDS x y z _ rgb\nSIZE 4 4 8 4 4\nTYPE F F F F U\nCOUNT 1 1 1 3 1\nWIDTH 20\nHEIGHT "
    "20\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 400\nDATA ascii\n" +
      rows));
}

TEST_F(SharedReading, FaintSplatsAreLeftOutByAll)
{
  std::string rows;
  for (int i = 0; i < 400; ++i)
  {
    rows += std::to_string(i) + " 0.5 2 0.1 0.2 0.3 " + (i > 300 && i % 3 > 0 ? "-6\n" : "3\n");
  }
  const std::string file = write("splats.ply",
    "ply\nformat ascii 1.0\nelement vertex 400\nproperty float x\nproperty float y\nproperty float "
    "z\nproperty "
    "float f_dc_0\nproperty float f_dc_1\nproperty float f_dc_2\nproperty float opacity\nend_header\n" +
      rows);
  const ReadResult whole = readCloud(file);
  EXPECT_EQ(whole.points(), 334);
  for (const int size : { 2, 5 })
  {
    vtkIdType points = 0;
    for (const PartRead& part : readTogether(size, [&](int) { return file; }))
    {
      EXPECT_EQ(part.result.notes, whole.notes);
      points += part.result.points();
    }
    EXPECT_EQ(points, 334);
  }
}

TEST_F(SharedReading, LasHasTheRareArraysAndColoursThatOtherPartsNeed)
{
  std::string records(500 * 34, '\0');
  for (std::size_t i = 0; i < 500; ++i)
  {
    records[34 * i] = static_cast<char>(i % 100);
    records[34 * i + 28] = static_cast<char>(i % 256); // red, below 256
  }
  records[34 * 490 + 15] = static_cast<char>(0x80); // withheld
  records[34 * 20 + 14] = 0x40;                     // scan direction
  expectPartsOf(write("narrow.las", lasOf(3, 0, records)));
  records[34 * 499 + 29] = 0x12; // red of 16 bits
  expectPartsOf(write("wide.las", lasOf(3, 0, records)));
  expectPartsOf(write("wide.laz", lazOf(3, 0, records, { 100 }).bytes));
}

TEST_F(SharedReading, ChunksOfLazLieAnywhere)
{
  for (const int format : { 1, 7 })
  {
    const std::string records = randomRecords(format, 2, 3000, 11);
    for (const LazTable kind :
      { LazTable::Behind, LazTable::AtTheEnd, LazTable::Missing, LazTable::NoChunks })
    {
      if (format < 6 || kind != LazTable::NoChunks)
      {
        expectPartsOf(write("a.laz", lazOf(format, 2, records, { 700, false, kind }).bytes));
      }
    }
    expectPartsOf(write("variable.laz", lazOf(format, 2, records, { 700, true }).bytes));
  }
  expectPartsOf(write("a.copc.laz", makeCopc().bytes));
}

TEST_F(SharedReading, ARankReadsItsBytesAlone)
{
  std::string records(400000 * 20, '\0');
  for (std::size_t i = 0; i < 400000; ++i)
  {
    std::memcpy(&records[20 * i], &i, 4);
  }
  for (const std::string& file : { write("large.las", lasOf(0, 0, records)),
         converted(write("large.las", lasOf(0, 0, records)), "large.ply") })
  {
    const auto size = static_cast<double>(std::filesystem::file_size(file));
    for (const PartRead& part : readTogether(4, [&](int) { return file; }))
    {
      EXPECT_EQ(part.result.points(), 100000);
      // A quarter, and the start of the file.
      EXPECT_LT(static_cast<double>(part.bytesRead), 0.25 * size + 1.2e6) << file;
    }
  }
}

TEST_F(SharedReading, AFaultOfOneEndsTheReadingOfAll)
{
  std::string text = table(300);
  const std::string bad = write("bad.csv", text + "1,2,3,4,5,6,7,8,9\n");
  const std::string good = write("good.csv", text);
  const std::string longer = write("longer.csv", text + "1,2,3,4,5,6,7,8\n");
  for (const PartRead& part : readTogether(4, [&](int) { return bad; }))
  {
    EXPECT_EQ(part.result.points(), 0);
    EXPECT_NE(part.result.error.find("line 315: 9 columns where 8"), std::string::npos) << part.result.error;
  }
  const std::vector<PartRead> missing =
    readTogether(3, [&](int rank) { return rank == 1 ? path("absent.csv") : good; });
  EXPECT_NE(missing[1].result.error.find("no such file"), std::string::npos);
  EXPECT_TRUE(missing[0].failedElsewhere && missing[2].failedElsewhere);
  for (const PartRead& part : readTogether(2, [&](int rank) { return rank == 0 ? good : longer; }))
  {
    EXPECT_NE(part.result.error.find("another size on another rank"), std::string::npos) << part.result.error;
  }
  const std::string empty = write("empty.csv", "x,y,z\n");
  for (const PartRead& part : readTogether(3, [&](int) { return empty; }))
  {
    EXPECT_NE(part.result.error.find("no points"), std::string::npos) << part.result.error;
  }
}

} // namespace
