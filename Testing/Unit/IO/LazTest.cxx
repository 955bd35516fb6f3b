// LAZ through a stand-in for LASzip (LaszipStandIn): files that are LAZ in all but the compression. They show
// that every field gets from LASzip's point to where the same point of a LAS file goes, and what happens to
// files that lie. They do not show that LASzip unpacks what it packed.
#include "CloudFiles.h"
#include "LaszipStandIn.h"

#include "vtkErrorCode.h"

#include "../../Fuzz/CloudFileFuzz.h"

#include <cstdint>
#include <random>

namespace
{

constexpr std::size_t kRecordLengths[] = { 20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67 };

struct LazFile
{
  std::string bytes;
  std::size_t description; ///< where the content of LASzip's record begins
  std::size_t points;      ///< where the offset of the table of chunks is
};

/// The LAS file of the same point records.
std::string lasOf(int format, std::size_t extra, const std::string& records)
{
  const std::size_t length = kRecordLengths[format] + extra;
  std::string las = makeLas(4, format, length);
  las.resize(375);
  put(las, 247, std::uint64_t{ records.size() / length });
  return las + records;
}

LazFile lazOf(int format, std::size_t extra, const std::string& records)
{
  std::vector<std::uint16_t> items;
  const auto add = [&](int type, std::size_t size)
  {
    for (const std::size_t value : { static_cast<std::size_t>(type), size, std::size_t{ 3 } })
    {
      items.push_back(static_cast<std::uint16_t>(value));
    }
  };
  format < 6 ? add(6, 20) : add(10, 30);
  format == 1 || (format >= 3 && format <= 5) ? add(7, 8) : void();
  format == 2 || format == 3 || format == 5 ? add(8, 6) : void();
  format == 7 ? add(11, 6) : void();
  format == 8 || format == 10 ? add(12, 8) : void();
  format == 4 || format == 5 ? add(9, 29) : void();
  format == 9 || format == 10 ? add(13, 29) : void();
  extra > 0 ? add(format < 6 ? 0 : 14, extra) : void();

  std::string record(54 + 34, '\0');
  record.replace(2, 14, "laszip encoded");
  put(record, 18, std::uint16_t{ 22204 });
  put(record, 20, static_cast<std::uint16_t>(34 + 2 * items.size()));
  put(record, 54, static_cast<std::uint16_t>(format < 6 ? 2 : 3));
  put(record, 54 + 12, std::uint32_t{ 50000 });
  put(record, 54 + 32, static_cast<std::uint16_t>(items.size() / 3));
  for (const std::uint16_t value : items)
  {
    append(record, value);
  }
  std::string header = lasOf(format, extra, records).substr(0, 375);
  header[104] = static_cast<char>(format | 0x80);
  put(header, 96, static_cast<std::uint32_t>(375 + record.size()));
  put(header, 100, std::uint32_t{ 1 });
  LazFile laz{ header + record, 375 + 54, 375 + record.size() };
  append(laz.bytes, static_cast<std::uint64_t>(laz.points + 8 + records.size()));
  laz.bytes += records;
  append(laz.bytes, std::uint32_t{ 0 });
  append(laz.bytes, std::uint32_t{ 1 });
  return laz;
}

/// Every bit of every field, but for gps times that are NaN, whose bits need not survive.
std::string randomRecords(int format, std::size_t extra, std::size_t count, std::uint64_t seed)
{
  const std::size_t length = kRecordLengths[format] + extra;
  std::mt19937_64 random(seed);
  std::string records(count * length, '\0');
  for (char& c : records)
  {
    c = static_cast<char>(random());
  }
  const std::size_t gpsTime = format < 6 ? 20 : 22;
  for (std::size_t i = 0; i < count && format != 0 && format != 2; ++i)
  {
    put(records, i * length + gpsTime, static_cast<double>(random()) * 1e-6);
  }
  return records;
}

class Laz : public CloudFiles
{
protected:
  void TearDown() override
  {
    EXPECT_EQ(openLaszipReaders(), 0);
    CloudFiles::TearDown();
  }
  ReadResult readLaz(const LazFile& laz) const { return readCloud(write("a.laz", laz.bytes)); }
};

TEST_F(Laz, GivesWhatTheUncompressedFileGivesInEveryPointFormat)
{
  for (int format = 0; format <= 10; ++format)
  {
    SCOPED_TRACE(format);
    for (const std::size_t extra : { std::size_t{ 0 }, std::size_t{ 5 } })
    {
      // More points than are unpacked at once.
      const std::string records = randomRecords(format, extra, 5000, 7);
      const ReadResult las = readCloud(write("a.las", lasOf(format, extra, records)));
      const ReadResult laz = readLaz(lazOf(format, extra, records));
      ASSERT_EQ(las.error, "");
      ASSERT_EQ(laz.error, "");
      EXPECT_EQ(laz.format, "LAZ 1.4 (point format " + std::to_string(format) + ")");
      expectSameBits(las.cloud->GetPoints()->GetData(), laz.cloud->GetPoints()->GetData());
      vtkPointData* arrays = las.cloud->GetPointData();
      ASSERT_EQ(laz.cloud->GetPointData()->GetNumberOfArrays(), arrays->GetNumberOfArrays());
      for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
      {
        expectSameBits(arrays->GetArray(i), laz.array(arrays->GetArray(i)->GetName()));
      }
    }
  }
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
  put(copc.bytes, copc.points + info.size(), std::uint64_t{ copc.points + info.size() + 8 + records.size() });
  const ReadResult result = readLaz(copc);
  EXPECT_EQ(result.error, "");
  EXPECT_EQ(result.format, "COPC 1.4 (point format 7)");
  EXPECT_EQ(result.points(), 10);
}

TEST_F(Laz, CutShortAnywhereIsRefused)
{
  const LazFile laz = lazOf(3, 2, randomRecords(3, 2, 4, 2));
  for (std::size_t size = 0; size < laz.bytes.size(); ++size)
  {
    const ReadResult result = readCloud(write("a.laz", laz.bytes.substr(0, size)));
    expectRefused(result, "a.laz: ");
  }
}

TEST_F(Laz, WhatLaszipSaysOfAPointIsHandedOn)
{
  // The table of chunks takes the place of points 2 and 3, so that only LASzip can find out.
  LazFile laz = lazOf(0, 0, randomRecords(0, 0, 4, 3));
  put(laz.bytes, 247, std::uint64_t{ 6 });
  expectRefused(readLaz(laz), "point 4 of 6: LASzip: reading point 4 of 6 total points; ");
  laz = lazOf(0, 0, randomRecords(0, 0, 4, 3));
  laz.bytes[6] = 99;
  expectRefused(readLaz(laz), "LASzip: a version this LASzip does not know; ");
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
  reader->Update();
  EXPECT_EQ(reader->GetErrorCode(), vtkErrorCode::UserError);
  EXPECT_NE(std::string(reader->GetErrorMessage()).find("stopped on request"), std::string::npos);
  EXPECT_LT(reader->GetProgress(), 0.9);
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 0);
}

TEST_F(Laz, ThatLiesIsRefusedBeforeLaszipBelievesIt)
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
  refuse(100, std::uint32_t{ 0xffffffff }, "counts 4294967295 variable length records, but only 1");
  refuse(100, std::uint32_t{ 0 }, "no record says how");
  refuse(375 + 20, std::uint16_t{ 60000 }, "variable length records");
  refuse(good.description, std::uint16_t{ 0 }, "unknown compressor 0");
  refuse(good.description + 32, std::uint16_t{ 65535 }, "not a record of point format 3 with 36 bytes");
  refuse(good.description + 34, std::uint16_t{ 10 }, "not a record of point format 3");
  refuse(good.description + 34 + 6 + 2, std::uint16_t{ 80 }, "not a record of point format 3");
  refuse(105, std::uint16_t{ 37 }, "not a record of point format 3 with 37 bytes");
  refuse(good.points, std::uint64_t{ 1 } << 60, "table of chunks is at byte");
  refuse(good.points, std::uint64_t{ 3 }, "table of chunks is at byte 3 of");
  refuse(good.bytes.size() - 4, std::uint32_t{ 0xffffffff }, "table of 4294967295 chunks");
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

} // namespace
