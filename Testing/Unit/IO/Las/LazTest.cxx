// LAZ: real files against their records, and files of random records in every layout, read by the reader and
// compared with what the uncompressed file of the same records gives.
#include "CloudFiles.h"
#include "LazFiles.h"

#include "FileProblem.h"

#include "vtkErrorCode.h"
#include "vtkSMPTools.h"

#include "Fuzz/CloudFileFuzz.h"

#include <cstdint>
#include <cstdlib>
#include <random>

#include <malloc.h>

namespace
{

class Laz : public CloudFiles
{
protected:
  static std::string contentOf(const std::string& name)
  {
    std::ifstream file(name, std::ios::binary);
    return { std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
  }
  ReadResult readLaz(const LazFile& laz) const { return readCloud(write("a.laz", laz.bytes)); }
  /// Reads both files and compares all that the clouds hold.
  void expectSameClouds(const std::string& las, const LazFile& laz) const
  {
    const ReadResult expected = readCloud(write("a.las", las));
    const ReadResult actual = readLaz(laz);
    ASSERT_EQ(expected.error, "");
    ASSERT_EQ(actual.error, "");
    expectSameBits(expected.cloud->GetPoints()->GetData(), actual.cloud->GetPoints()->GetData());
    vtkPointData* arrays = expected.cloud->GetPointData();
    ASSERT_EQ(actual.cloud->GetPointData()->GetNumberOfArrays(), arrays->GetNumberOfArrays());
    for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
    {
      expectSameBits(arrays->GetArray(i), actual.array(arrays->GetArray(i)->GetName()));
    }
  }
};

TEST(Sha256, IsThatOfTheStandard)
{
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
    "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
}

/// Records of the real files: see their MANIFEST.md.
TEST(LazManifest, EachFileGivesExactlyItsRecords)
{
  const std::string folder = sharedData() + "/formats/";
  std::ifstream manifest(folder + "MANIFEST.md");
  if (sharedData().empty() || !manifest)
  {
    GTEST_SKIP() << "no real clouds beside this checkout (set POINTHAPTICS_SHARED_DATA to their folder)";
  }
  int checked = 0;
  for (std::string line; std::getline(manifest, line);)
  {
    // | names, separated by commas; twins | what | point format | sha256 |
    const std::size_t end = line.rfind(" |");
    const std::string names = line.substr(0, line.find(';'));
    for (std::size_t at = 2; line.find(".laz") < line.find(" |", 2) && at < names.size();)
    {
      const std::size_t stop = names.find(".laz", at);
      if (stop == std::string::npos || stop > line.find(" |", 2))
      {
        break;
      }
      const std::string name = names.substr(at, stop + 4 - at);
      SCOPED_TRACE(name);
      std::ifstream file(folder + name, std::ios::binary);
      const std::string bytes{ std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
      EXPECT_EQ(sha256(recordsOf(bytes)), line.substr(end - 64, 64));
      ++checked;
      at = stop + 6;
    }
  }
  EXPECT_GE(checked, 7);
}

TEST_F(Laz, GivesWhatTheUncompressedFileGivesInEveryPointFormat)
{
  for (int format = 0; format <= 10; ++format)
  {
    for (const std::size_t extra : { std::size_t{ 0 }, std::size_t{ 5 } })
    {
      for (const bool calm : { false, true })
      {
        SCOPED_TRACE(std::to_string(format) + (calm ? " calm" : " wild"));
        // More points than are decoded at once, and several chunks.
        const std::string records = randomRecords(format, extra, 10000, 7, calm);
        LazLayout layout;
        layout.chunkSize = 6000;
        const LazFile laz = lazOf(format, extra, records, layout);
        EXPECT_EQ(recordsOf(laz.bytes) == records, true);
        expectSameClouds(lasOf(format, extra, records), laz);
        EXPECT_EQ(readLaz(laz).format, "LAZ 1.4 (point format " + std::to_string(format) + ")");
      }
    }
  }
}

TEST_F(Laz, IsReadInEveryLayoutOfItsChunks)
{
  for (const int format : { 3, 7 })
  {
    const std::string records = randomRecords(format, 2, 1001, 8, true);
    for (const LazTable table :
      { LazTable::Behind, LazTable::AtTheEnd, LazTable::Missing, LazTable::NoChunks })
    {
      for (const bool isVariable : { false, true })
      {
        // Pointwise chunks must be counted somewhere, and layered files have chunks.
        if ((isVariable && format == 3 && table == LazTable::Missing) ||
          (table == LazTable::NoChunks && (isVariable || format == 7)))
        {
          continue;
        }
        SCOPED_TRACE(std::to_string(format) + " " + std::to_string(static_cast<int>(table)) +
          (isVariable ? " variable" : ""));
        LazLayout layout;
        layout.chunkSize = 100;
        layout.isVariable = isVariable;
        layout.table = table;
        expectSameClouds(lasOf(format, 2, records), lazOf(format, 2, records, layout));
      }
    }
  }
}

TEST_F(Laz, OfOnePointIsRead)
{
  for (const int format : { 0, 3, 6, 10 })
  {
    const std::string records = randomRecords(format, 0, 1, 9);
    expectSameClouds(lasOf(format, 0, records), lazOf(format, 0, records));
  }
}

TEST_F(Laz, IsTheSameWithAnyNumberOfThreads)
{
  LazLayout layout;
  layout.chunkSize = 1000;
  const std::string records = randomRecords(8, 1, 20000, 10, true);
  const LazFile laz = lazOf(8, 1, records, layout);
  for (const int threads : { 1, 4 })
  {
    vtkSMPTools::Initialize(threads);
    expectSameClouds(lasOf(8, 1, records), laz);
  }
  vtkSMPTools::Initialize(0);
}

TEST_F(Laz, OfTheCloudOptimisedKindIsReadAndNamed)
{
  const std::string records = randomRecords(7, 0, 10, 1);
  LazFile copc = lazOf(7, 0, records);
  std::string info(54, '\0');
  info.replace(2, 4, "copc");
  put(info, 18, std::uint16_t{ 1 });
  copc.bytes.insert(375, info);
  put(copc.bytes, 96, static_cast<std::uint32_t>(copc.points + info.size()));
  put(copc.bytes, 100, std::uint32_t{ 2 });
  put(copc.bytes, copc.points + info.size(), std::uint64_t{ copc.table + info.size() });
  const ReadResult result = readLaz(copc);
  EXPECT_EQ(result.error, "");
  EXPECT_EQ(result.format, "COPC 1.4 (point format 7)");
  EXPECT_EQ(result.points(), 10);
}

/// The records of an uncompressed file.
std::string recordsOfLas(const std::string& bytes)
{
  std::uint32_t offset = 0;
  std::memcpy(&offset, &bytes[96], sizeof(offset));
  return bytes.substr(offset);
}

TEST_F(Laz, IsWrittenWithTheRecordsOfTheUncompressedFile)
{
  for (const int format : { 0, 1, 2, 3, 6, 7, 8 })
  {
    for (const std::size_t extra : { std::size_t{ 0 }, std::size_t{ 3 } })
    {
      SCOPED_TRACE(std::to_string(format) + "+" + std::to_string(extra));
      // More than one chunk.
      const std::string records = randomRecords(format, extra, 60000, 11, true);
      const ReadResult cloud = readCloud(write("a.las", lasOf(format, extra, records)));
      ASSERT_EQ(cloud.error, "");
      ASSERT_EQ(writeCloud(cloud.cloud, path("b.las")), "");
      ASSERT_EQ(writeCloud(cloud.cloud, path("b.laz")), "");
      const std::string laz = contentOf(path("b.laz"));
      EXPECT_TRUE(recordsOf(laz) == recordsOfLas(contentOf(path("b.las"))));
      // Scale, offset and all else of the header but the mark, the records and their offset.
      EXPECT_EQ(laz.substr(131, 96), contentOf(path("b.las")).substr(131, 96));
      const ReadResult again = readCloud(path("b.laz"));
      ASSERT_EQ(again.error, "");
      expectSameBits(cloud.cloud->GetPoints()->GetData(), again.cloud->GetPoints()->GetData());
    }
  }
}

TEST_F(Laz, IsUnpackedByAnotherDecoderToTheSameRecords)
{
  for (const int format : { 0, 1, 2, 3, 6, 7, 8 })
  {
    SCOPED_TRACE(format);
    const std::string records = randomRecords(format, 2, 3000, 12, true);
    LazLayout layout;
    layout.chunkSize = 1000;
    const std::string file = write("a.laz", lazOf(format, 2, records, layout).bytes);
    const int code =
      std::system(("node '" LAZ_PERF_SCRIPT "' '" + file + "' '" + path("out") + "' 2> /dev/null").c_str());
    if (!std::filesystem::exists(path("out")))
    {
      GTEST_SKIP() << "node with the package laz-perf is not here (NODE_PATH says where), code " << code;
    }
    EXPECT_TRUE(contentOf(path("out")) == records);
    std::filesystem::remove(path("out"));
  }
}

TEST_F(Laz, CutShortAnywhereIsRefused)
{
  for (const int format : { 3, 7 })
  {
    const LazFile laz = lazOf(format, 2, randomRecords(format, 2, 4, 2));
    for (std::size_t size = 0; size < laz.bytes.size(); ++size)
    {
      const ReadResult result = readCloud(write("a.laz", laz.bytes.substr(0, size)));
      expectRefused(result, "a.laz: ");
    }
  }
}

TEST_F(Laz, CutShortWithoutATableIsRefused)
{
  LazLayout layout;
  layout.table = LazTable::Missing;
  layout.chunkSize = 50;
  for (const int format : { 3, 7 })
  {
    const LazFile laz = lazOf(format, 0, randomRecords(format, 0, 200, 3), layout);
    for (const std::size_t left : { 10, 100, 1000, 4000 })
    {
      expectRefused(readCloud(write("a.laz", laz.bytes.substr(0, laz.bytes.size() - left))), "a.laz: ");
    }
  }
}

TEST_F(Laz, StopsOnRequest)
{
  const std::string file = write("a.laz", lazOf(0, 0, randomRecords(0, 0, 200000, 4)).bytes);
  vtkNew<vtkPointCloudReader> reader;
  vtkNew<vtkCallbackCommand> stop;
  stop->SetCallback(
    [](vtkObject* caller, unsigned long, void*, void* fraction)
    {
      if (*static_cast<double*>(fraction) > 0.5)
      {
        vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(1);
      }
    });
  reader->AddObserver(vtkCommand::ProgressEvent, stop);
  reader->SetFileName(file.c_str());
  for (const bool salvages : { false, true })
  {
    reader->SetSalvage(salvages);
    reader->Modified();
    reader->Update();
    EXPECT_EQ(reader->GetErrorCode(), vtkErrorCode::UserError);
    EXPECT_NE(std::string(reader->GetErrorMessage()).find("stopped on request"), std::string::npos);
    EXPECT_LT(reader->GetProgress(), 0.9);
    EXPECT_GT(reader->GetProgress(), 0.5) << "it does not start again";
    EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 0);
  }
}

TEST_F(Laz, WhoseRecordDoesNotSayTheSizeOfChunksIsRead)
{
  for (const int format : { 3, 7 })
  {
    const std::string records = randomRecords(format, 2, 200, 9);
    LazLayout several;
    several.chunkSize = format == 7 ? 50 : 50000;
    LazLayout variable;
    variable.isVariable = true;
    LazLayout run;
    run.table = format == 7 ? LazTable::Missing : LazTable::NoChunks;
    for (const LazLayout& layout : { LazLayout(), several, variable, run })
    {
      LazFile laz = lazOf(format, 2, records, layout);
      const ReadResult good = readLaz(laz);
      put(laz.bytes, laz.description + 12, std::uint32_t{ 0 });
      const ReadResult untold = readLaz(laz);
      ASSERT_EQ(untold.error, "") << format;
      expectSameBits(good.cloud->GetPoints()->GetData(), untold.cloud->GetPoints()->GetData());
      expectSameBits(good.array("GpsTime"), untold.array("GpsTime"));
    }
  }
}

TEST_F(Laz, ThatIsCutIsSalvagedAsFarAsItGoes)
{
  for (const int format : { 3, 7 })
  {
    for (const LazTable table : { LazTable::Behind, LazTable::Missing })
    {
      LazLayout layout;
      layout.chunkSize = 50;
      layout.table = table;
      LazFile laz = lazOf(format, 0, randomRecords(format, 0, 200, 3), layout);
      const ReadResult good = readLaz(laz);
      for (const std::size_t left : { std::size_t{ 500 }, laz.bytes.size() / 2 })
      {
        vtkNew<vtkPointCloudReader> reader;
        reader->SalvageOn();
        const ReadResult cut =
          readCloudBy(reader, write("cut.laz", laz.bytes.substr(0, laz.bytes.size() - left)));
        ASSERT_EQ(cut.error, "") << format << " " << left;
        EXPECT_GT(cut.points(), 40) << format << " " << left;
        EXPECT_LT(cut.points(), 200) << format << " " << left;
        EXPECT_EQ(cut.notes.size(), 1u);
        for (vtkIdType i = 0; i + 2 < cut.points(); ++i)
        {
          ASSERT_EQ(cut.cloud->GetPoint(i)[0], good.cloud->GetPoint(i)[0]) << i;
        }
      }
      put(laz.bytes, 247, std::uint64_t{ 201 });
      expectRefused(readLaz(laz), "LAZ");
      vtkNew<vtkPointCloudReader> reader;
      reader->SalvageOn();
      EXPECT_GE(readCloudBy(reader, write("more.laz", laz.bytes)).points(), 199) << format;
    }
  }
}

TEST_F(Laz, ThatLiesIsRefusedBeforeItIsBelieved)
{
  const std::string records = randomRecords(3, 2, 4, 5);
  const LazFile good = lazOf(3, 2, records);
  const auto refuse = [&](std::size_t at, auto value, const std::string& part)
  {
    LazFile laz = good;
    put(laz.bytes, at, value);
    expectRefused(readLaz(laz), part);
  };
  ASSERT_EQ(readLaz(good).error, "");
  refuse(247, std::uint64_t{ 1000000000000 }, "counts 1000000000000 points, but a file of");
  refuse(247, std::uint64_t{ 50001 }, "counts 50001 points, but the chunks hold 50000");
  refuse(100, std::uint32_t{ 0xffffffff }, "counts 4294967295 variable length records, but only 1");
  refuse(100, std::uint32_t{ 0 }, "no record says how");
  refuse(375 + 20, std::uint16_t{ 60000 }, "variable length records");
  refuse(good.description, std::uint16_t{ 0 }, "unknown compressor 0");
  refuse(good.description, std::uint16_t{ 3 }, "unknown compressor 3 for point format 3");
  refuse(good.description + 2, std::uint16_t{ 1 }, "unknown coder 1");
  refuse(good.description + 32, std::uint16_t{ 65535 }, "not a record of point format 3 with 36 bytes");
  refuse(good.description + 34, std::uint16_t{ 10 }, "not a record of point format 3");
  refuse(good.description + 34 + 6 + 2, std::uint16_t{ 80 }, "not a record of point format 3");
  refuse(105, std::uint16_t{ 37 }, "not a record of point format 3 with 37 bytes");
  refuse(good.points, std::uint64_t{ 1 } << 60, "table of chunks is at byte");
  refuse(good.points, std::uint64_t{ 3 }, "table of chunks is at byte 3 of");
  refuse(good.table + 4, std::uint32_t{ 0xffffffff }, "table of 4294967295 chunks");
  refuse(good.table + 4, std::uint32_t{ 0 }, "but the chunks hold 0");
  refuse(good.table + 8, std::uint32_t{ 0xffffffff }, "chunk 0 of 1 has");
  refuse(96, std::uint32_t{ 4000000000u }, "byte 96");

  LazFile twice = good;
  twice.bytes.insert(375, good.bytes.substr(375, good.points - 375));
  put(twice.bytes, 96, static_cast<std::uint32_t>(2 * good.points - 375));
  put(twice.bytes, 100, std::uint32_t{ 2 });
  expectRefused(readLaz(twice), "a second record says how");
  LazFile shorter = good;
  put(shorter.bytes, 375 + 20, std::uint16_t{ 20 });
  expectRefused(readLaz(shorter), "takes at least 34");
}

TEST_F(Laz, OfUnknownVersionsIsRefusedWithTheirNumber)
{
  for (const int format : { 3, 7 })
  {
    LazFile laz = lazOf(format, 0, randomRecords(format, 0, 4, 5));
    put(laz.bytes, laz.description + 34 + 6 + 4, std::uint16_t{ 4 });
    expectRefused(readLaz(laz), "is compressed in version 4, which is not supported: ");
  }
}

TEST_F(Laz, WhoseLayersDoNotFitIsRefused)
{
  LazFile laz = lazOf(7, 0, randomRecords(7, 0, 10, 6));
  const std::size_t sizes = laz.points + 8 + 36 + 4;
  put(laz.bytes, sizes + 4, std::uint32_t{ 0xfffffff0 });
  expectRefused(readLaz(laz), "the layers of a chunk take more than its");
}

TEST_F(Laz, OfGarbageIsReadOrRefusedWithinItsSize)
{
  // Behind the first point anything may come: it is decoded to something, or found to end too early.
  for (const int format : { 0, 5, 6, 10 })
  {
    for (std::uint64_t seed = 0; seed < 20; ++seed)
    {
      LazFile laz = lazOf(format, 3, randomRecords(format, 3, 300, seed, true));
      std::mt19937_64 random(seed);
      for (std::size_t at = laz.points + 8 + kRecordLengths[format] + 3; at < laz.table; ++at)
      {
        laz.bytes[at] = static_cast<char>(random() % 3 == 0 ? random() : laz.bytes[at]);
      }
      LLVMFuzzerTestOneInput(reinterpret_cast<const unsigned char*>(laz.bytes.data()), laz.bytes.size());
    }
  }
}

TEST_F(Laz, MutationsKeepThePromises)
{
  std::vector<LazFile> files;
  for (const int format : { 0, 3, 7, 10 })
  {
    files.push_back(lazOf(format, 3, randomRecords(format, 3, 3, 6)));
  }
  for (std::uint64_t seed = 0; seed < 1000; ++seed)
  {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const LazFile& file = files[random() % files.size()];
    std::string bytes = file.bytes;
    for (std::uint64_t change = random() % 3; change < 3; ++change)
    {
      // The header's fields and the description of the compression more often than the points.
      const std::size_t at = random() % 3 == 0 ? random() % bytes.size() : 94 + random() % (file.points - 86);
      bytes[at] = static_cast<char>(random() % 2 ? random() : bytes[at] ^ (1 << random() % 8));
    }
    LLVMFuzzerTestOneInput(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  }
}

/// Fills all memory that is allocated while it lives, as if it had been used before.
struct UsedMemory
{
  explicit UsedMemory(int byte) { mallopt(M_PERTURB, byte); }
  ~UsedMemory() { mallopt(M_PERTURB, 0); }
  UsedMemory(const UsedMemory&) = delete;
  UsedMemory& operator=(const UsedMemory&) = delete;
};

TEST_F(Laz, ColorsOfOneThatIsCutAreThoseOfItsPoints)
{
  std::string records = randomRecords(2, 0, 20000, 3);
  for (std::size_t at = 20; at < records.size(); at += kRecordLengths[2])
  {
    for (const std::size_t high : { 1, 3, 5 })
    {
      records[at + high] = 0; // bytes, which some writers store as they are
    }
  }
  LazLayout layout;
  layout.chunkSize = 500;
  const LazFile laz = lazOf(2, 0, records, layout);
  const std::string file = write("cut.laz", laz.bytes.substr(0, laz.bytes.size() / 2));
  for (const int byte : { 1, 77, 170 })
  {
    const UsedMemory used(byte);
    vtkNew<vtkPointCloudReader> reader;
    reader->SalvageOn();
    const ReadResult cut = readCloudBy(reader, file);
    ASSERT_EQ(cut.error, "");
    ASSERT_GT(cut.points(), 40);
    ASSERT_LT(cut.points(), 20000);
    for (vtkIdType i = 0; i + 2 < cut.points(); ++i)
    {
      ASSERT_EQ(cut.value("RGB", i, 1), cut.value("Color16", i, 1)) << i << " " << byte;
    }
    EXPECT_EQ(cut.array("Intensity")->GetNumberOfTuples(), cut.points());
  }
}

} // namespace
