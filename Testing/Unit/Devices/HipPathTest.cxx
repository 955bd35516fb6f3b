#include "Devices/HipPath.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include <unistd.h>

using namespace pointhaptics;
namespace fs = std::filesystem;

namespace
{
class HipPathFile : public ::testing::Test
{
protected:
  void SetUp() override
  {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / ("pointhaptics-" + std::to_string(::getpid()) + "-" + info->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string name(const std::string& file) const { return (folder_ / file).string(); }
  std::string put(const std::string& text) const
  {
    std::ofstream(name("path.csv"), std::ios::binary) << text;
    return name("path.csv");
  }
  /// Reads @p text and expects a refusal whose message holds the file's name and every part.
  void expectRefused(const std::string& text, std::initializer_list<const char*> parts) const
  {
    HipPath path;
    path.points.resize(3);
    std::string message;
    EXPECT_EQ(readHipPath(put(text), path, message), Status::FileMalformed) << text;
    EXPECT_TRUE(path.points.empty());
    EXPECT_NE(message.find(name("path.csv")), std::string::npos) << message;
    for (const char* part : parts)
    {
      EXPECT_NE(message.find(part), std::string::npos) << "no '" << part << "' in: " << message;
    }
  }
  void expectRead(const std::string& text, std::size_t rows) const
  {
    HipPath path;
    std::string message;
    EXPECT_EQ(readHipPath(put(text), path, message), Status::Ok) << message;
    EXPECT_TRUE(message.empty());
    EXPECT_EQ(path.points.size(), rows);
  }

  fs::path folder_;
};

HipPath threePoints()
{
  HipPath path;
  path.points = { { 1.0, { 0.0, 0.0, 0.0 } }, { 2.0, { 0.01, 0.0, 0.0 } }, { 4.0, { 0.01, 0.02, -0.03 } } };
  return path;
}
}

TEST(HipPath, IsLinearBetweenItsPointsAndHeldOutside)
{
  const HipPath path = threePoints();
  std::size_t hint = 0;
  EXPECT_EQ(path.duration(), 3.0);
  EXPECT_EQ(path.position(0.0, hint), path.points[0].position);
  EXPECT_EQ(path.position(1.0, hint), path.points[0].position);
  EXPECT_NEAR(norm(path.position(1.5, hint) - Vec3(0.005, 0.0, 0.0)), 0.0, 1e-18);
  EXPECT_EQ(path.position(2.0, hint), path.points[1].position);
  EXPECT_NEAR(norm(path.position(3.0, hint) - Vec3(0.01, 0.01, -0.015)), 0.0, 1e-18);
  EXPECT_EQ(path.position(4.0, hint), path.points[2].position);
  EXPECT_EQ(path.position(9.0, hint), path.points[2].position);
  EXPECT_EQ(path.position(std::nan(""), hint), path.points[0].position);
}

TEST(HipPath, GivesTheSamePositionWhateverTheHint)
{
  HipPath path;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> number(0.0, 1.0);
  double time = -3.0;
  for (int i = 0; i < 500; ++i)
  {
    path.points.push_back({ time, { number(random), number(random), number(random) } });
    time += number(random) * number(random) + 1e-6;
  }
  std::size_t kept = 0;
  for (int i = 0; i < 20000; ++i)
  {
    const double t = -3.5 + number(random) * (path.duration() + 1.0);
    std::size_t fresh = 0;
    std::size_t wrong = std::size_t(number(random) * 1e6);
    const Vec3 expected = path.position(t, fresh);
    ASSERT_EQ(path.position(t, kept), expected);
    ASSERT_EQ(path.position(t, wrong), expected);
  }
}

TEST(HipPath, OfOnePointStaysThere)
{
  HipPath path;
  path.points = { { 2.0, { 1.0, 2.0, 3.0 } } };
  std::size_t hint = 0;
  for (double t : { 0.0, 2.0, 5.0 })
  {
    EXPECT_EQ(path.position(t, hint), Vec3(1.0, 2.0, 3.0));
  }
  EXPECT_EQ(path.duration(), 0.0);
}

TEST_F(HipPathFile, ReadsRowsWithSpacesCrLfAndBlankLastLines)
{
  expectRead("t,x,y,z\n0,0,0,0\n1,0.5,-1e-3,2\n", 2);
  expectRead("t,x,y,z\n0,0,0,0\n1,0.5,-1e-3,2", 2);
  expectRead("t,x,y,z\r\n0,0,0,0\r\n1,0.5,-1e-3,2\r\n", 2);
  expectRead("t,x,y,z\n0,0,0,0\n\n", 1);
  expectRead("t,x,y,z\r\n0,0,0,0\r\n  \r\n\r\n", 1);
  expectRead("t, x, y, z\n 0 ,\t0, 0,0 \n", 1);
  expectRead("\xef\xbb\xbft,x,y,z\n0,0,0,0\n", 1);
  expectRead("t,x,y,z\n-5,.5,1.,0E0\n", 1);
}

TEST_F(HipPathFile, ReadsTheHandOfATableOfFeltForces)
{
  HipPath path;
  std::string message;
  ASSERT_EQ(readHipPath(put("t,hip_x,hip_y,hip_z,proxy_x,radius,contact\n"
                            "0.5,1,2,3,7,nan,0\n0.501,4,5,6,8,,what\n"),
              path, message),
    Status::Ok)
    << message;
  ASSERT_EQ(path.points.size(), 2u);
  EXPECT_EQ(path.points[0].timeSeconds, 0.5);
  EXPECT_EQ(path.points[0].position, Vec3(1.0, 2.0, 3.0));
  EXPECT_EQ(path.points[1].position, Vec3(4.0, 5.0, 6.0));
  ASSERT_EQ(readHipPath(put("z,y,note,x,t\n3,2,slow,1,0\n"), path, message), Status::Ok) << message;
  EXPECT_EQ(path.points[0].position, Vec3(1.0, 2.0, 3.0)); // by name, not by place
  expectRefused("t,hip_x,hip_y,force_z\n0,0,0,0\n", { ":1:", "header", "hip_z" });
  expectRefused("t,x,hip_y,z\n0,0,0,0\n", { ":1:", "header" });
  expectRefused("t,hip_x,hip_y,hip_z,radius\n0,0,0,0\n", { ":2:", "4 columns instead of 5" });
  expectRefused("radius,t,hip_x,hip_y,hip_z\n1,0,0,nan,0\n", { ":2:", "column 4", "not finite" });
}

TEST_F(HipPathFile, SaysWhatIsWrongAndInWhichLine)
{
  expectRefused("", { ":1:", "header", "t,x,y,z" });
  expectRefused("0,0,0,0\n1,0,0,0\n", { ":1:", "header", "'0,0,0,0'" });
  expectRefused("time,x,y,z\n0,0,0,0\n", { ":1:", "header" });
  expectRefused("t,x,y,z\n", { "no row" });
  expectRefused("t,x,y,z\n\n\n", { "no row" });
  expectRefused("t,x,y,z\n0,0,0\n", { ":2:", "3 columns" });
  expectRefused("t,x,y,z\n0,0,0,0\n1,0,0,0,0\n", { ":3:", "5 columns" });
  expectRefused("t,x,y,z\n0,0,0,\n", { ":2:", "column 4", "''" });
  expectRefused("t,x,y,z\n0,abc,0,0\n", { ":2:", "column 2", "'abc'" });
  expectRefused("t,x,y,z\n0,0x10,0,0\n", { ":2:", "column 2" });
  expectRefused("t,x,y,z\n0,1.5mm,0,0\n", { ":2:", "'1.5mm'" });
  expectRefused("t,x,y,z\n0,0,nan,0\n", { ":2:", "column 3", "not finite" });
  expectRefused("t,x,y,z\n0,0,0,-inf\n", { ":2:", "column 4", "not finite" });
  expectRefused("t,x,y,z\n0,1e999,0,0\n", { ":2:", "too large" });
  expectRefused("t,x,y,z\n0,0,0,0\n0,1,0,0\n", { ":3:", "time 0", "not after" });
  expectRefused("t,x,y,z\n1,0,0,0\n0.5,1,0,0\n", { ":3:", "0.5", "sort" });
  expectRefused("t,x,y,z\n0,0,0,0\n\n1,0,0,0\n", { ":3:", "blank line" });
  expectRefused("t;x;y;z\n0;0;0;0\n", { ":1:", "header" });
}

TEST_F(HipPathFile, RefusesBinaryFilesWithoutReadingThemWhole)
{
  expectRefused(std::string(100000, '\0'), { ":1:", "header" });
  expectRefused("t,x,y,z\n" + std::string(100000, '7'), { ":2:", "1000 characters" });
  expectRefused(std::string("t,x,y,z\n0,\0001,0,0\n", 18), { ":2:", "column 2" });
}

TEST_F(HipPathFile, SaysWhenAFileCannotBeOpened)
{
  HipPath path;
  std::string message;
  EXPECT_EQ(readHipPath(name("absent.csv"), path, message), Status::FileNotReadable);
  EXPECT_NE(message.find("No such file"), std::string::npos) << message;
  EXPECT_EQ(readHipPath(folder_.string(), path, message), Status::FileNotReadable);
}

TEST_F(HipPathFile, ARecordingSaysWhereTheHandIsNew)
{
  const std::string text =
    "t,hip_x,hip_y,hip_z\n# tick 1: begins\n0,0,0,1\n1,0,0,2\n# tick 3: clutch on\n2,0,0,3\n"
    "# tick 4: gate off\n# tick 4: new-hand\n3,0,0,9\n# a remark: new-hand\n4,0,0,10\n# tick 6: begins\n"
    "5,0,0,20\n";
  HipPath path;
  std::string message;
  ASSERT_EQ(readHipPath(put(text), path, message), Status::Ok) << message;
  std::vector<bool> isNew;
  for (const HipPathPoint& point : path.points)
  {
    isNew.push_back(point.isNew);
  }
  EXPECT_EQ(isNew, (std::vector<bool>{ true, false, false, true, false, true }));
  std::size_t hint = 0;
  EXPECT_FALSE(path.hand(0.0, hint).isNew);
  EXPECT_EQ(path.hand(2.9, hint).position.z, 3.0);
  EXPECT_TRUE(path.hand(3.25, hint).isNew);
  EXPECT_FALSE(path.hand(3.5, hint).isNew);
  EXPECT_EQ(path.hand(3.5, hint).position.z, 9.5);
  EXPECT_EQ(path.hand(4.999, hint).position.z, 10.0);
  EXPECT_TRUE(path.hand(5.0, hint).isNew);
  EXPECT_FALSE(path.hand(6.0, hint).isNew);
}

TEST_F(HipPathFile, ALongRemarkTakesNoRowWithIt)
{
  for (const std::size_t length : { 999, 1000, 1001, 1002, 1003, 5000 })
  {
    for (const char* end : { "\n", "\r\n" })
    {
      const std::string remark = "#" + std::string(length - 1, 'x') + end;
      HipPath path;
      std::string message;
      ASSERT_EQ(
        readHipPath(put("t,x,y,z\n0,0,0,0\n" + remark + "1,0,0,0\n2,0,0,0\n"), path, message), Status::Ok)
        << length << ": " << message;
      EXPECT_EQ(path.points.size(), 3u) << length;
    }
  }
}
