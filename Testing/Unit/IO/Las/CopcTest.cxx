// Cloud optimised point clouds: by box and resolution the same points as the whole file has there, read from
// the nodes that are needed alone; and hierarchies that lie.
#include "CloudFiles.h"
#include "LazFiles.h"

#include <algorithm>
#include <array>
#include <limits>
#include <random>

namespace
{

using Box = std::array<double, 6>;

class Copc : public CloudFiles
{
protected:
  static ReadResult readPart(const std::string& file, double resolution, const Box* box = nullptr)
  {
    vtkNew<vtkPointCloudReader> reader;
    reader->SetResolution(resolution);
    if (box)
    {
      reader->SetBox(box->data());
    }
    return readCloudBy(reader, file);
  }
  /// x, y, z and gps time of each point, in an order of their own.
  static std::vector<std::array<double, 4>> sorted(const ReadResult& result, const Box* box = nullptr)
  {
    std::vector<std::array<double, 4>> points;
    for (vtkIdType i = 0; i < result.points(); ++i)
    {
      double at[3];
      result.cloud->GetPoint(i, at);
      const bool isInside = !box ||
        (at[0] >= (*box)[0] && at[0] <= (*box)[1] && at[1] >= (*box)[2] && at[1] <= (*box)[3] &&
          at[2] >= (*box)[4] && at[2] <= (*box)[5]);
      if (isInside)
      {
        points.push_back({ at[0], at[1], at[2], result.value("GpsTime", i) });
      }
    }
    std::sort(points.begin(), points.end());
    return points;
  }
  static void expectPartsOf(const std::string& file)
  {
    const ReadResult whole = readCloud(file);
    ASSERT_EQ(whole.error, "");
    double bounds[6];
    whole.cloud->GetBounds(bounds);
    std::mt19937_64 random(1);
    int found = 0;
    for (int trial = 0; trial < 30; ++trial)
    {
      Box box{};
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const double side = bounds[2 * axis + 1] - bounds[2 * axis];
        double a = bounds[2 * axis] + side * static_cast<double>(random() % 1000) / 1000.0;
        double b = bounds[2 * axis] + side * static_cast<double>(random() % 1000) / 1000.0;
        box[2 * axis] = std::min(a, b);
        box[2 * axis + 1] = std::max(a, b);
      }
      const std::vector<std::array<double, 4>> expected = sorted(whole, &box);
      const ReadResult part = readPart(file, 0.0, &box);
      EXPECT_EQ(part.error.empty(), !expected.empty()) << part.error;
      EXPECT_EQ(sorted(part), expected);
      found += expected.empty() ? 0 : 1;
    }
    EXPECT_GT(found, 5);
  }
};

TEST_F(Copc, GivesInABoxThePointsThatTheWholeFileHasThere)
{
  expectPartsOf(write("a.copc.laz", makeCopc().bytes));
}

TEST_F(Copc, OfARealCloudGivesInABoxThePointsThatTheWholeFileHasThere)
{
  if (sharedData().empty())
  {
    GTEST_SKIP() << "no real clouds beside this checkout (set POINTHAPTICS_SHARED_DATA to their folder)";
  }
  expectPartsOf(sharedData() + "/formats/1.2-with-color.copc.laz");
}

TEST_F(Copc, HasMorePointsTheFinerTheResolution)
{
  const std::string file = write("a.copc.laz", makeCopc().bytes);
  // The root has spacing 16, the next level 8; one and two nodes of 200 points.
  EXPECT_EQ(readPart(file, 100.0).points(), 200);
  EXPECT_EQ(readPart(file, 16.0).points(), 200);
  EXPECT_EQ(readPart(file, 15.9).points(), 600);
  EXPECT_EQ(readPart(file, 8.0).points(), 600);
  EXPECT_EQ(readPart(file, 4.0).points(), 800);
  EXPECT_EQ(readPart(file, 0.001).points(), 1000);
  EXPECT_EQ(readPart(file, 0.0).points(), 1000);
}

TEST_F(Copc, LeavesOutFineLevelsWhereTheirPointsAreTooMany)
{
  const std::string file = write("a.copc.laz", makeCopc().bytes);
  // Levels 0 to 3 have 200, 400, 200 and 200 points.
  const auto expectPoints = [&](vtkIdType most, vtkIdType points)
  {
    SCOPED_TRACE(most);
    vtkNew<vtkPointCloudReader> reader;
    reader->SetFileName(file.c_str());
    reader->SetMostPoints(most);
    reader->Update();
    EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), points);
    EXPECT_EQ(reader->IsCoarse(), points < 1000);
  };
  expectPoints(1, 200); // the coarsest level at least
  expectPoints(200, 200);
  expectPoints(599, 200);
  expectPoints(600, 600);
  expectPoints(999, 800);
  expectPoints(1000, 1000);
  expectPoints(0, 1000);
}

TEST_F(Copc, IsNotCoarseWhereTheResolutionAsksForNoMore)
{
  const std::string file = write("a.copc.laz", makeCopc().bytes);
  vtkNew<vtkPointCloudReader> reader;
  reader->SetFileName(file.c_str());
  reader->SetResolution(8.0);
  reader->SetMostPoints(600);
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 600);
  EXPECT_FALSE(reader->IsCoarse());
  reader->SetMostPoints(599);
  reader->Update();
  EXPECT_TRUE(reader->IsCoarse());
  // Other files are read whole.
  const std::string plain = write("a.las", lasOf(6, 0, makeCopc().records));
  reader->SetFileName(plain.c_str());
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 1000);
  EXPECT_FALSE(reader->IsCoarse());
}

TEST_F(Copc, ReadsThoseNodesOnlyThatAreNeeded)
{
  CopcFile copc = makeCopc();
  const ReadResult before = readPart(write("a.copc.laz", copc.bytes), 8.0);
  // Chunks and page of the finest level, and the table of chunks, are destroyed.
  std::fill(copc.bytes.begin() + static_cast<std::ptrdiff_t>(copc.chunks[3]),
    copc.bytes.begin() + static_cast<std::ptrdiff_t>(copc.rootPage) - 60, '\xee');
  std::fill(copc.bytes.begin() + static_cast<std::ptrdiff_t>(copc.secondPage), copc.bytes.end(), '\xee');
  const std::string file = write("b.copc.laz", copc.bytes);
  const ReadResult after = readPart(file, 8.0);
  ASSERT_EQ(after.error, "");
  EXPECT_EQ(sorted(after), sorted(before));
  EXPECT_NE(readCloud(file).error, "");
}

TEST_F(Copc, WithoutPointsInTheBoxIsRefusedWithACure)
{
  const std::string file = write("a.copc.laz", makeCopc().bytes);
  const Box far{ 5000, 6000, 5000, 6000, 5000, 6000 };
  expectRefused(readPart(file, 0.0, &far), "no node of the octree touches the box");
  const Box small{ 1023.25, 1023.5, 0, 1024, 0, 1024 };
  expectRefused(readPart(file, 0.0, &small), "no point lies in the box");
}

TEST_F(Copc, ThatLiesIsRefused)
{
  const CopcFile good = makeCopc();
  const auto refuse = [&](std::size_t at, auto value, const std::string& part)
  {
    CopcFile copc = good;
    put(copc.bytes, at, value);
    expectRefused(readPart(write("a.copc.laz", copc.bytes), 0.001), part);
  };
  const std::size_t pageEntry = good.rootPage + 3 * 32;
  refuse(pageEntry + 16, std::uint64_t{ good.rootPage },
    "a page of 64 bytes at byte " + std::to_string(good.rootPage) + " overlaps another");
  refuse(good.secondPage + 28, std::int32_t{ -1 }, "cell "); // of what is no page
  refuse(pageEntry + 16, std::uint64_t{ 1 } << 60, "which is outside the file");
  refuse(pageEntry + 24, std::int32_t{ -5 }, "a node of -1 points in -5 bytes");
  refuse(good.rootPage + 28, std::int32_t{ -2 }, "a node of -2 points");
  refuse(good.rootPage + 28, std::int32_t{ 2000000000 }, "the nodes hold");
  refuse(good.rootPage + 24, std::int32_t{ 0 }, "a node of 0 bytes");
  refuse(good.rootPage + 32 + 16, std::uint64_t{ good.chunks[0] + 5 }, "overlaps another");
  refuse(good.rootPage, std::int32_t{ 77 }, "cell 0 of level 77");
  refuse(good.rootPage + 32 + 4, std::int32_t{ 2 }, "cell 2 of level 1");
  refuse(good.info + 40, std::uint64_t{ 1 } << 40, "which is outside the file");
  refuse(good.info + 24, std::numeric_limits<double>::quiet_NaN(), "an octree of half size");
  refuse(good.info + 32, 0.0, "an octree of half size");
  refuse(247, std::uint64_t{ 1000000000000 }, "counts 1000000000000 points");
}

TEST_F(Copc, MutationsKeepThePromises)
{
  const CopcFile good = makeCopc();
  for (std::uint64_t seed = 0; seed < 500; ++seed)
  {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    std::string bytes = good.bytes;
    for (int change = 0; change < 3; ++change)
    {
      const std::size_t at = random() % 2 == 0 ? good.rootPage + random() % (bytes.size() - good.rootPage)
                                               : random() % bytes.size();
      bytes[at] = static_cast<char>(random());
    }
    const ReadResult result = readPart(write("a.copc.laz", bytes), static_cast<double>(random() % 20));
    EXPECT_EQ(result.error.empty(), result.points() > 0);
  }
}

TEST_F(Copc, OtherFilesAreReadWholeAndReducedToTheBox)
{
  const std::string file = write("a.las", lasOf(6, 0, makeCopc().records));
  const ReadResult whole = readCloud(file);
  double bounds[6];
  whole.cloud->GetBounds(bounds);
  const Box box{ bounds[0], 0.5 * (bounds[0] + bounds[1]), bounds[2], bounds[3], bounds[4], bounds[5] };
  const ReadResult part = readPart(file, 8.0, &box);
  ASSERT_EQ(part.error, "");
  EXPECT_LT(part.points(), whole.points());
  EXPECT_EQ(part.cloud->GetNumberOfVerts(), part.points());
  EXPECT_EQ(sorted(part), sorted(whole, &box));
}

TEST_F(Copc, GivesPositionsAloneWhereNoMoreIsWanted)
{
  const std::string file = write("a.copc.laz", makeCopc().bytes);
  vtkNew<vtkPointCloudReader> reader;
  reader->SetFileName(file.c_str());
  reader->OnlyPositionsOn();
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetPointData()->GetNumberOfArrays(), 0);
  expectSameBits(readCloud(file).cloud->GetPoints()->GetData(), reader->GetOutput()->GetPoints()->GetData());
}

} // namespace
