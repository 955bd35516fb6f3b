#include "CloudLoader.h"

#include "HapticViewerOptions.h"

#include <gtest/gtest.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include <unistd.h>

namespace
{

using namespace pointhaptics;

class CloudLoaderTest : public ::testing::Test
{
protected:
  CloudLoaderTest()
    : folder_(std::filesystem::temp_directory_path() / ("CloudLoaderTest-" + std::to_string(getpid())))
  {
    std::filesystem::create_directories(folder_);
  }
  ~CloudLoaderTest() override
  {
    std::error_code error;
    std::filesystem::remove_all(folder_, error);
  }

  /// A text file of @p rows points, whose reading takes a while.
  std::string writeCloud(const std::string& name, int rows) const
  {
    const std::string path = (folder_ / name).string();
    std::ofstream file(path);
    file << "x,y,z\n";
    for (int i = 0; i < rows; ++i)
    {
      file << 0.001 * (i % 100) << ',' << 0.001 * (i / 100) << ",0.5\n";
    }
    return path;
  }

  static CloudRequest requestOf(const std::vector<std::string>& files)
  {
    CloudRequest request(files);
    request.isOnlyRead = true;
    return request;
  }

  static constexpr double kLong = 60.0;
  std::filesystem::path folder_;
};

TEST_F(CloudLoaderTest, ReadsOneCloudOfAllFiles)
{
  CloudLoader loader;
  EXPECT_FALSE(loader.busy());
  EXPECT_EQ(loader.step().part, 0.0);
  loader.start(requestOf({ this->writeCloud("a.csv", 300), this->writeCloud("b.csv", 200) }));
  EXPECT_TRUE(loader.busy());
  ASSERT_TRUE(loader.waitFor(kLong));
  EXPECT_STREQ(loader.step().name, "preparing"); // all of it is read
  LoadedCloud loaded;
  std::string message = "old";
  ASSERT_TRUE(loader.take(loaded, message));
  EXPECT_EQ(message, "");
  ASSERT_TRUE(loaded.cloud);
  EXPECT_EQ(loaded.cloud->GetNumberOfPoints(), 500);
  EXPECT_EQ(loaded.cloud->GetReferenceCount(), 1);
  EXPECT_EQ(loaded.title, "a.csv, b.csv");
  EXPECT_DOUBLE_EQ(loaded.bounds.maximum.z, 0.5);
  EXPECT_FALSE(loader.busy());
  EXPECT_FALSE(loader.take(loaded, message)); // once
}

TEST_F(CloudLoaderTest, FitsACloudWithoutRaysThatDidNotReturn)
{
  const std::string path = this->writeCloud("zeros.csv", 300);
  std::ofstream(path, std::ios::app) << "0,0,0\n0,0,0\n-0,0,0\n";
  HapticViewerOptions options;
  LoadedCloud loaded;
  std::string message;
  const auto goesOn = [](const char*, double) { return true; };
  ASSERT_TRUE(loadCloud(CloudRequest({ path }, options), goesOn, loaded, message)) << message;
  EXPECT_EQ(loaded.noReturns, 3);
  EXPECT_EQ(loaded.bounds.minimum.z, 0.5);
  ASSERT_EQ(loaded.notes.size(), 1u);
  EXPECT_EQ(loaded.notes[0],
    "zeros.csv: 3 points at (0, 0, 0), which scanners write for rays without return, are outside the "
    "workspace: neither shown nor felt");
  // The lattice about all points is the resampler's choice.
  options.fitsWorkspace = false;
  ASSERT_TRUE(loadCloud(CloudRequest({ path }, options), goesOn, loaded, message)) << message;
  EXPECT_EQ(loaded.bounds.minimum.z, 0.0);
  ASSERT_EQ(loaded.notes.size(), 1u);
  EXPECT_NE(loaded.notes[0].find("are felt but not drawn"), std::string::npos);
}

TEST_F(CloudLoaderTest, NamesTheStepThatRuns)
{
  const CloudRequest request({ this->writeCloud("a.csv", 30000) });
  std::vector<std::string> steps = { "reading" };
  const auto note = [&steps](const char* step, double part)
  {
    EXPECT_GE(part, 0.0);
    EXPECT_LE(part, 1.0);
    if (steps.back() != step)
    {
      steps.emplace_back(step);
    }
    return true;
  };
  LoadedCloud loaded;
  std::string message;
  ASSERT_TRUE(loadCloud(request, note, loaded, message)) << message;
  EXPECT_EQ(steps, (std::vector<std::string>{ "reading", "preparing", "measuring", "resampling" }));
}

TEST_F(CloudLoaderTest, ProgressAscendsOverAllFiles)
{
  const std::string file = this->writeCloud("a.csv", 300000);
  std::vector<double> seen;
  LoadedCloud loaded;
  std::string message;
  const auto note = [&seen](const char* step, double part)
  {
    if (step == std::string("reading"))
    {
      seen.push_back(part);
    }
    return true;
  };
  ASSERT_TRUE(loadCloud(requestOf({ file, file }), note, loaded, message)) << message;
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  EXPECT_GT(
    std::count_if(seen.begin(), seen.end(), [](double part) { return part > 0.05 && part < 0.45; }), 2);
  EXPECT_GT(
    std::count_if(seen.begin(), seen.end(), [](double part) { return part > 0.55 && part < 0.95; }), 2);
  EXPECT_DOUBLE_EQ(seen.back(), 1.0);

  CloudLoader loader;
  loader.start(requestOf({ file, file }));
  while (!loader.waitFor(0.0))
  {
    const double part = loader.step().part;
    EXPECT_GE(part, 0.0);
    EXPECT_LE(part, 1.0);
  }
}

TEST_F(CloudLoaderTest, StopsAtTheReportThatIsAnsweredByNo)
{
  const std::string file = this->writeCloud("a.csv", 300000);
  int asked = 0;
  LoadedCloud loaded;
  loaded.title = "the former";
  std::string message;
  EXPECT_FALSE(loadCloud(
    requestOf({ file, file }), [&asked](const char*, double) { return ++asked < 3; }, loaded, message));
  EXPECT_EQ(asked, 3);
  EXPECT_NE(message.find("stopped on request"), std::string::npos) << message;
  EXPECT_EQ(loaded.title, "the former");
  EXPECT_FALSE(loaded.cloud);
}

TEST_F(CloudLoaderTest, CancelLeavesNothing)
{
  const std::string file = this->writeCloud("a.csv", 300000);
  CloudLoader loader;
  LoadedCloud loaded;
  std::string message;
  loader.start(requestOf({ file }));
  while (loader.step().part == 0.0)
  {
    std::this_thread::yield();
  }
  loader.cancel();
  EXPECT_FALSE(loader.busy());
  EXPECT_FALSE(loader.waitFor(0.05));
  EXPECT_EQ(loader.step().part, 0.0);
  EXPECT_FALSE(loader.take(loaded, message));
  EXPECT_FALSE(loaded.cloud);

  // Nor what was finished before the cancel.
  const std::string small = this->writeCloud("small.csv", 30);
  loader.start(requestOf({ small }));
  ASSERT_TRUE(loader.waitFor(kLong));
  loader.cancel();
  EXPECT_FALSE(loader.take(loaded, message));
}

TEST_F(CloudLoaderTest, TheNewestOfSeveralIsTheOneThatCounts)
{
  const std::string file = this->writeCloud("a.csv", 300000);
  const std::string small = this->writeCloud("small.csv", 30);
  CloudLoader loader;
  for (int i = 0; i < 20; ++i)
  {
    loader.start(requestOf({ file }));
  }
  loader.start(requestOf({ small }));
  ASSERT_TRUE(loader.waitFor(kLong));
  LoadedCloud loaded;
  std::string message;
  ASSERT_TRUE(loader.take(loaded, message));
  EXPECT_EQ(message, "");
  EXPECT_EQ(loaded.title, "small.csv");
  EXPECT_EQ(loaded.cloud->GetNumberOfPoints(), 30);
}

TEST_F(CloudLoaderTest, SaysWhyAFileCannotBeShown)
{
  CloudLoader loader;
  LoadedCloud loaded;
  loaded.title = "the former";
  const auto complaint = [&](const CloudRequest& request)
  {
    std::string message;
    loader.start(request);
    EXPECT_TRUE(loader.waitFor(kLong));
    EXPECT_TRUE(loader.take(loaded, message));
    return message;
  };
  const std::string missing = (folder_ / "missing.ply").string();
  EXPECT_EQ(complaint(requestOf({ missing })).rfind(missing + ": ", 0), 0U);

  const std::string nowhere = (folder_ / "nowhere.csv").string();
  std::ofstream(nowhere) << "x,y,z\nnan,0,0\n";
  EXPECT_NE(complaint(requestOf({ nowhere })).find("no point is finite"), std::string::npos);

  CloudRequest warm = requestOf({ this->writeCloud("a.csv", 10) });
  warm.options.colorBy = "Warmth";
  EXPECT_NE(complaint(warm).find("no such array; it has"), std::string::npos);
  EXPECT_EQ(loaded.title, "the former");
}

TEST_F(CloudLoaderTest, FindsAnArrayInUpperOrLowerCaseWhereOnlyOneCanBeMeant)
{
  const std::string file = (folder_ / "arrays.csv").string();
  std::ofstream(file) << "x,y,z,Intensity,GpsTime,gpstime,HEIGHT,nx,ny,nz\n"
                         "0,0,0,5,1,2,3,0,0,1\n1,0,1,6,2,3,4,0,1,0\n0,1,1,7,3,4,5,1,0,0\n";
  std::string message;
  const auto nameFor = [&](const std::string& colorBy)
  {
    CloudRequest request = requestOf({ file });
    request.options.colorBy = colorBy;
    LoadedCloud loaded;
    message.clear();
    return loadCloud(
             request, [](const char*, double) { return true; }, loaded, message)
      ? loaded.colorBy
      : "refused";
  };
  EXPECT_EQ(nameFor("intensity"), "Intensity") << message;
  EXPECT_EQ(nameFor("INTENSITY"), "Intensity") << message;
  EXPECT_EQ(nameFor("density"), "Density") << message;
  EXPECT_EQ(nameFor("normals"), "Normals") << message;
  EXPECT_EQ(nameFor("normals:Z"), "Normals:z") << message;
  EXPECT_EQ(nameFor("NORMALS:1"), "Normals:y") << message;
  EXPECT_EQ(nameFor("normals:Magnitude"), "Normals:magnitude") << message;
  // Written exactly, a name has no rival.
  for (const char* exact : { "GpsTime", "gpstime", "HEIGHT", "Height" })
  {
    EXPECT_EQ(nameFor(exact), exact) << message;
  }
  EXPECT_EQ(nameFor("GPStime"), "refused");
  EXPECT_NE(message.find("colorBy GPStime: means any of GpsTime, gpstime; give one"), std::string::npos)
    << message;
  EXPECT_EQ(nameFor("height"), "refused"); // the file's, or its coordinate upwards
  EXPECT_NE(message.find("HEIGHT, Height"), std::string::npos) << message;
  EXPECT_EQ(nameFor("warmth"), "refused");
  EXPECT_NE(message.find("no such array; it has Normals (:x, :y, :z, :magnitude), Intensity, GpsTime"),
    std::string::npos)
    << message;
  EXPECT_EQ(nameFor("normals:up"), "refused");
  EXPECT_NE(message.find("no such component; give one of Normals (:x"), std::string::npos) << message;
}

TEST_F(CloudLoaderTest, MayGoWhileItReads)
{
  const std::string file = this->writeCloud("a.csv", 300000);
  for (const bool hasBegun : { false, true })
  {
    CloudLoader loader;
    loader.start(requestOf({ file }));
    while (hasBegun && loader.step().part == 0.0)
    {
      std::this_thread::yield();
    }
  }
}

TEST_F(CloudLoaderTest, ChoosesAFinerLatticeWhereTheUsualOneLosesMostOfTheCloud)
{
  // A scanner's sweep: 40,000 points within half a metre of it, and more than one in twenty 80 m away:
  // fewer would be left out.
  const std::string sweep = (folder_ / "sweep.csv").string();
  {
    std::ofstream file(sweep);
    file << "x,y,z\n";
    for (int i = 0; i < 40000; ++i)
    {
      file << 0.0025 * (i % 200) << ',' << 0.0025 * (i / 200) << ",0.5\n";
    }
    for (int i = 1; i <= 2500; ++i)
    {
      file << 80.0 + 0.00001 * i << ",0,0.5\n";
    }
  }
  const auto dimensionOf = [&](const std::string& path, bool chooses)
  {
    CloudRequest request = chooses ? CloudRequest({ path }, HapticViewerOptions()) : requestOf({ path });
    LoadedCloud loaded;
    std::string message;
    EXPECT_TRUE(loadCloud(
      request, [](const char*, double) { return true; }, loaded, message))
      << message;
    return loaded.latticeDimension;
  };
  EXPECT_EQ(dimensionOf(sweep, true), 1200);
  EXPECT_EQ(dimensionOf(sweep, false), 0);
  // Every point has its voxel: finer ones would show no more.
  EXPECT_EQ(dimensionOf(writeCloud("even.csv", 9000), true), 300);
  EXPECT_EQ(dimensionOf(writeCloud("point.csv", 1), true), 300);
}

} // namespace
