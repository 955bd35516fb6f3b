// Against pcl::VoxelGrid itself. Leaves are powers of two, whose multiples floats divide exactly: which voxel
// a point is in is then the same in float and in double.
#include "PCL/VoxelMean.h"

// Other headers of the project are to be of use in the same file.
#include "Core/Resample/VoxelMeanSettings.h"

#include "vtkSMPTools.h"

#include <gtest/gtest.h>
#include <pcl/console/print.h>
#include <pcl/conversions.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <random>
#include <utility>
#include <vector>

namespace
{

using pointhaptics::PclVoxelMean;
using Fields = ::pcl::PCLPointCloud2;

constexpr float kLeaf = 0.125f;

void fill(pcl::PointXYZ&, std::mt19937&) {}
void fill(pcl::PointXYZI& p, std::mt19937& random)
{
  p.intensity = std::uniform_real_distribution<float>(0.0f, 255.0f)(random);
}
void fill(pcl::PointXYZL& p, std::mt19937& random)
{
  p.label = random() % 4;
}
void fill(pcl::PointXYZRGB& p, std::mt19937& random)
{
  p.rgba = std::uint32_t(random());
}
void fill(pcl::PointXYZRGBNormal& p, std::mt19937& random)
{
  std::normal_distribution<float> normal;
  p.rgba = std::uint32_t(random());
  p.getNormalVector3fMap() = Eigen::Vector3f(normal(random), normal(random), normal(random)).normalized();
  p.curvature = std::abs(normal(random));
}

template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr cloudOf(std::size_t size, unsigned seed = 1)
{
  auto cloud = pcl::make_shared<pcl::PointCloud<PointT>>();
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(-1.0f, 1.0f);
  for (std::size_t i = 0; i < size; ++i)
  {
    PointT p;
    p.getVector3fMap() = Eigen::Vector3f(place(random), place(random), 0.3f * place(random));
    fill(p, random);
    cloud->push_back(p);
  }
  return cloud;
}

/// Runs @p grid with the settings that both filters get.
template <typename Grid, typename Cloud>
Cloud filtered(Grid& grid, const typename Cloud::ConstPtr& cloud, float leaf = kLeaf)
{
  Cloud result;
  grid.setInputCloud(cloud);
  grid.setLeafSize(leaf, leaf, leaf);
  grid.filter(result);
  return result;
}

template <typename PointT>
struct Both
{
  pcl::VoxelGrid<PointT> theirs;
  PclVoxelMean<PointT> ours;

  /// Calls set(grid) for both and compares the results field by field.
  template <typename Set>
  void compare(const typename pcl::PointCloud<PointT>::ConstPtr& cloud, Set&& set)
  {
    set(theirs);
    set(ours);
    const auto expected = filtered<pcl::VoxelGrid<PointT>, pcl::PointCloud<PointT>>(theirs, cloud);
    const auto means = filtered<PclVoxelMean<PointT>, pcl::PointCloud<PointT>>(ours, cloud);
    ASSERT_GT(expected.size(), 50u);
    ASSERT_EQ(means.size(), expected.size());
    EXPECT_EQ(means.width, expected.width);
    EXPECT_EQ(means.height, 1u);
    for (std::size_t i = 0; i < means.size(); ++i)
    {
      ASSERT_LT((means[i].getVector3fMap() - expected[i].getVector3fMap()).norm(), 2e-6f) << i;
      compareFields(means[i], expected[i]);
    }
  }

  static void compareFields(const pcl::PointXYZ&, const pcl::PointXYZ&) {}
  static void compareFields(const pcl::PointXYZI& a, const pcl::PointXYZI& b)
  {
    ASSERT_NEAR(a.intensity, b.intensity, 1e-3);
  }
  static void compareFields(const pcl::PointXYZL& a, const pcl::PointXYZL& b) { ASSERT_EQ(a.label, b.label); }
  template <typename Colored>
  static void compareColors(const Colored& a, const Colored& b)
  {
    ASSERT_NEAR(a.r, b.r, 1); // ours are rounded, theirs cut off
    ASSERT_NEAR(a.g, b.g, 1);
    ASSERT_NEAR(a.b, b.b, 1);
    ASSERT_NEAR(a.a, b.a, 1);
  }
  static void compareFields(const pcl::PointXYZRGB& a, const pcl::PointXYZRGB& b) { compareColors(a, b); }
  static void compareFields(const pcl::PointXYZRGBNormal& a, const pcl::PointXYZRGBNormal& b)
  {
    compareColors(a, b);
    ASSERT_LT((a.getNormalVector3fMap() - b.getNormalVector3fMap()).norm(), 1e-4f);
    ASSERT_NEAR(a.curvature, b.curvature, 1e-5);
  }
};

template <typename PointT>
class PclVoxelMeanOf : public testing::Test
{
};
using PointTypes =
  testing::Types<pcl::PointXYZ, pcl::PointXYZI, pcl::PointXYZL, pcl::PointXYZRGB, pcl::PointXYZRGBNormal>;
TYPED_TEST_SUITE(PclVoxelMeanOf, PointTypes);

TYPED_TEST(PclVoxelMeanOf, IsVoxelGrid)
{
  Both<TypeParam>().compare(cloudOf<TypeParam>(20000), [](auto&) {});
}

TYPED_TEST(PclVoxelMeanOf, AveragesCoordinatesAlone)
{
  Both<TypeParam>().compare(cloudOf<TypeParam>(20000), [](auto& grid) { grid.setDownsampleAllData(false); });
}

TYPED_TEST(PclVoxelMeanOf, LeavesOutVoxelsOfFewPoints)
{
  Both<TypeParam>().compare(
    cloudOf<TypeParam>(20000), [](auto& grid) { grid.setMinimumPointsNumberPerVoxel(15); });
}

TYPED_TEST(PclVoxelMeanOf, TakesTheLimitsOfAField)
{
  for (const bool negative : { false, true })
  {
    Both<TypeParam>().compare(cloudOf<TypeParam>(20000),
      [&](auto& grid)
      {
        grid.setFilterFieldName("x");
        grid.setFilterLimits(-0.4, 0.3);
        grid.setFilterLimitsNegative(negative);
      });
  }
}

TYPED_TEST(PclVoxelMeanOf, TakesIndices)
{
  auto indices = pcl::make_shared<pcl::Indices>();
  for (int i = 0; i < 20000; i += 3)
  {
    indices->push_back(i);
  }
  Both<TypeParam>().compare(cloudOf<TypeParam>(20000), [&](auto& grid) { grid.setIndices(indices); });
}

TYPED_TEST(PclVoxelMeanOf, IsTheSameForEveryOrderAndNumberOfThreads)
{
  const auto cloud = cloudOf<TypeParam>(50000);
  auto shuffled = pcl::make_shared<pcl::PointCloud<TypeParam>>(*cloud);
  std::shuffle(shuffled->begin(), shuffled->end(), std::mt19937(7));
  std::vector<pcl::PointCloud<TypeParam>> results;
  for (const auto& input : { cloud, shuffled })
  {
    for (const unsigned threads : { 0u, 1u, 2u, 5u })
    {
      PclVoxelMean<TypeParam> grid;
      grid.setNumberOfThreads(threads);
      results.push_back(filtered<PclVoxelMean<TypeParam>, pcl::PointCloud<TypeParam>>(grid, input));
      ASSERT_EQ(results.back().size(), results.front().size());
      for (std::size_t i = 0; i < results.back().size(); ++i)
      {
        for (const pcl::PCLPointField& field : pcl::getFields<TypeParam>())
        {
          const auto bytes = [&](const pcl::PointCloud<TypeParam>& means)
          { return reinterpret_cast<const char*>(&means[i]) + field.offset; };
          ASSERT_EQ(std::memcmp(bytes(results.back()), bytes(results.front()), 4), 0)
            << field.name << " of " << i;
        }
      }
    }
  }
}

TEST(PclVoxelMean, TellsWhichVoxelHoldsWhichPoint)
{
  const auto cloud = cloudOf<pcl::PointXYZ>(3000);
  Both<pcl::PointXYZ> both;
  both.compare(cloud, [](auto& grid) { grid.setSaveLeafLayout(true); });
  EXPECT_EQ(both.ours.getMinBoxCoordinates(), both.theirs.getMinBoxCoordinates());
  EXPECT_EQ(both.ours.getMaxBoxCoordinates(), both.theirs.getMaxBoxCoordinates());
  EXPECT_EQ(both.ours.getNrDivisions(), both.theirs.getNrDivisions());
  EXPECT_EQ(both.ours.getDivisionMultiplier(), both.theirs.getDivisionMultiplier());
  const Eigen::MatrixXi around = (Eigen::MatrixXi(3, 4) << 0, 1, -1, 0, 0, 0, 0, 1, 0, 0, 0, -2).finished();
  for (const pcl::PointXYZ& p : *cloud)
  {
    ASSERT_EQ(both.ours.getCentroidIndex(p), both.theirs.getCentroidIndex(p));
    ASSERT_EQ(both.ours.getGridCoordinates(p.x, p.y, p.z), both.theirs.getGridCoordinates(p.x, p.y, p.z));
    ASSERT_EQ(
      both.ours.getNeighborCentroidIndices(p, around), both.theirs.getNeighborCentroidIndices(p, around));
  }
  EXPECT_EQ(both.ours.getCentroidIndexAt({ 1000, 0, 0 }), -1);
}

TEST(PclVoxelMean, IsMoved)
{
  const auto cloud = cloudOf<pcl::PointXYZ>(3000);
  PclVoxelMean<pcl::PointXYZ> first;
  first.setLeafSize(0.1f, 0.1f, 0.1f);
  first.setSaveLeafLayout(true);
  first.setInputCloud(cloud);
  pcl::PointCloud<pcl::PointXYZ> expected;
  first.filter(expected);
  const int index = first.getCentroidIndex(cloud->front());
  EXPECT_GE(index, 0);

  PclVoxelMean<pcl::PointXYZ> second = std::move(first);
  EXPECT_EQ(second.getCentroidIndex(cloud->front()), index);
  std::vector<PclVoxelMean<pcl::PointXYZ>> all;
  all.push_back(std::move(second));
  all.emplace_back();
  pcl::PointCloud<pcl::PointXYZ> means;
  all.front().filter(means);
  ASSERT_EQ(means.size(), expected.size());
  for (std::size_t i = 0; i < means.size(); ++i)
  {
    EXPECT_EQ(means[i].getVector3fMap(), expected[i].getVector3fMap());
  }
  EXPECT_EQ(first.getCentroidIndex(cloud->front()), -1); // NOLINT: as new
}

/// Where pcl::VoxelGrid says "Leaf size is too small" and returns the cloud as it is.
TEST(PclVoxelMean, LeavesTheThreadsOfVtkAlone)
{
  // VTK 9.1 goes on counting one thread, although it has all of them again.
  vtkSMPTools::Initialize(1);
  vtkSMPTools::Initialize(0);
  const int threads = vtkSMPTools::GetEstimatedNumberOfThreads();
  PclVoxelMean<pcl::PointXYZ> grid;
  grid.setInputCloud(cloudOf<pcl::PointXYZ>(100000));
  grid.setLeafSize(kLeaf, kLeaf, kLeaf);
  grid.setNumberOfThreads(2);
  pcl::PointCloud<pcl::PointXYZ> means;
  grid.filter(means);
  EXPECT_GT(means.size(), 0u);
  EXPECT_EQ(vtkSMPTools::GetEstimatedNumberOfThreads(), threads);
}

TEST(PclVoxelMean, WorksWhereVoxelGridOverflows)
{
  auto cloud = cloudOf<pcl::PointXYZ>(5000);
  for (std::size_t i = 0; i < 5000; ++i)
  {
    pcl::PointXYZ twin = (*cloud)[i];
    twin.x = std::nextafter(twin.x, 0.0f);
    cloud->push_back(twin);
  }
  const float leaf = 1.0f / 65536;
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  pcl::VoxelGrid<pcl::PointXYZ> theirs;
  const auto unfiltered =
    filtered<pcl::VoxelGrid<pcl::PointXYZ>, pcl::PointCloud<pcl::PointXYZ>>(theirs, cloud, leaf);
  ASSERT_EQ(unfiltered.size(), cloud->size());
  std::map<std::array<double, 3>, int> voxels;
  for (const pcl::PointXYZ& p : *cloud)
  {
    ++voxels[{
      std::floor(double(p.z) / leaf), std::floor(double(p.y) / leaf), std::floor(double(p.x) / leaf) }];
  }
  PclVoxelMean<pcl::PointXYZ> ours;
  const auto means = filtered<PclVoxelMean<pcl::PointXYZ>, pcl::PointCloud<pcl::PointXYZ>>(ours, cloud, leaf);
  ASSERT_EQ(means.size(), voxels.size());
  ASSERT_LT(means.size(), 6000u);
  std::size_t i = 0;
  for (const auto& voxel : voxels)
  {
    ASSERT_EQ(std::floor(double(means[i].x) / leaf), voxel.first[2]);
    ASSERT_EQ(std::floor(double(means[i].y) / leaf), voxel.first[1]);
    ASSERT_EQ(std::floor(double(means[i].z) / leaf), voxel.first[0]);
    ++i;
  }
}

TEST(PclVoxelMean, LeavesOutWhatIsNotFinite)
{
  auto cloud = cloudOf<pcl::PointXYZ>(1000);
  const auto expected = [&]
  {
    PclVoxelMean<pcl::PointXYZ> grid;
    return filtered<PclVoxelMean<pcl::PointXYZ>, pcl::PointCloud<pcl::PointXYZ>>(grid, cloud);
  }();
  auto holed = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>(*cloud);
  holed->push_back({ NAN, 0.0f, 0.0f });
  holed->push_back({ 0.0f, 0.0f, INFINITY });
  holed->is_dense = true; // it is not
  PclVoxelMean<pcl::PointXYZ> grid;
  const auto means = filtered<PclVoxelMean<pcl::PointXYZ>, pcl::PointCloud<pcl::PointXYZ>>(grid, holed);
  ASSERT_EQ(means.size(), expected.size());
  EXPECT_EQ(means[7].x, expected[7].x);
}

TEST(PclVoxelMean, MayWriteOverItsInput)
{
  auto cloud = cloudOf<pcl::PointXYZI>(5000);
  PclVoxelMean<pcl::PointXYZI> grid;
  const auto expected = filtered<PclVoxelMean<pcl::PointXYZI>, pcl::PointCloud<pcl::PointXYZI>>(grid, cloud);
  grid.filter(*cloud);
  ASSERT_EQ(cloud->size(), expected.size());
  EXPECT_EQ((*cloud)[3].intensity, expected[3].intensity);
}

TEST(PclVoxelMean, GivesAnEmptyCloudForBadInput)
{
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  const auto cloud = cloudOf<pcl::PointXYZ>(100);
  pcl::PointCloud<pcl::PointXYZ> out;
  const auto sizeFor = [&](auto&& set)
  {
    PclVoxelMean<pcl::PointXYZ> grid;
    grid.setInputCloud(cloud);
    grid.setLeafSize(kLeaf, kLeaf, kLeaf);
    set(grid);
    out = *cloud;
    grid.filter(out);
    return out.size();
  };
  EXPECT_GT(sizeFor([](auto&) {}), 50u);
  EXPECT_EQ(sizeFor([](auto& grid) { grid.setLeafSize(0.0f, 1.0f, 1.0f); }), 0u);
  EXPECT_EQ(sizeFor([](auto& grid) { grid.setLeafSize(1.0f, -1.0f, 1.0f); }), 0u);
  EXPECT_EQ(sizeFor([](auto& grid) { grid.setLeafSize(1.0f, 1.0f, NAN); }), 0u);
  EXPECT_EQ(sizeFor([](auto& grid) { grid.setLeafSize(1e-30f, 1.0f, 1.0f); }), 0u);
  EXPECT_EQ(sizeFor([](auto& grid) { grid.setFilterFieldName("nothing"); }), 0u);
  EXPECT_EQ(sizeFor([](auto& grid) { grid.setIndices(pcl::make_shared<pcl::Indices>(1, 100)); }), 0u);
  EXPECT_EQ(sizeFor([](auto& grid) { grid.setIndices(pcl::make_shared<pcl::Indices>(1, -1)); }), 0u);
  EXPECT_EQ(sizeFor([](auto& grid) { grid.setIndices(pcl::make_shared<pcl::Indices>()); }), 0u);
  EXPECT_EQ(
    sizeFor([](auto& grid) { grid.setInputCloud(pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>()); }), 0u);
  const auto nothing = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>(3, 1, pcl::PointXYZ(NAN, NAN, NAN));
  EXPECT_EQ(sizeFor([&](auto& grid) { grid.setInputCloud(nothing); }), 0u);
}

Fields fieldsOf(const pcl::PointCloud<pcl::PointXYZRGBNormal>& cloud)
{
  Fields fields;
  pcl::toPCLPointCloud2(cloud, fields);
  return fields;
}

TEST(PclVoxelMeanOfFields, IsThatOfPoints)
{
  const auto cloud = cloudOf<pcl::PointXYZRGBNormal>(20000);
  PclVoxelMean<pcl::PointXYZRGBNormal> grid;
  const auto expected =
    filtered<PclVoxelMean<pcl::PointXYZRGBNormal>, pcl::PointCloud<pcl::PointXYZRGBNormal>>(grid, cloud);
  PclVoxelMean<Fields> ofFields;
  const auto result =
    filtered<PclVoxelMean<Fields>, Fields>(ofFields, pcl::make_shared<Fields>(fieldsOf(*cloud)));
  pcl::PointCloud<pcl::PointXYZRGBNormal> means;
  pcl::fromPCLPointCloud2(result, means);
  ASSERT_EQ(means.size(), expected.size());
  for (std::size_t i = 0; i < means.size(); ++i)
  {
    ASSERT_EQ(means[i].x, expected[i].x);
    ASSERT_EQ(means[i].rgba, expected[i].rgba);
    ASSERT_EQ(means[i].normal_z, expected[i].normal_z);
    ASSERT_EQ(means[i].curvature, expected[i].curvature);
  }
}

constexpr std::uint64_t kFirstTime = (1ull << 60) + 7;

/// Double coordinates, at odd offsets; a time of 64 bits, a flag and three channels. Three points to a voxel
/// of 0.25.
Fields cloudOfManyTypes(unsigned points)
{
  Fields cloud;
  const auto add = [&](const char* name, std::uint8_t type, unsigned count, unsigned bytes)
  {
    pcl::PCLPointField field;
    field.name = name;
    field.datatype = type;
    field.count = count;
    field.offset = cloud.point_step;
    cloud.fields.push_back(field);
    cloud.point_step += count * bytes;
  };
  using Type = pcl::PCLPointField;
  add("flag", Type::BOOL, 1, 1);
  add("z", Type::FLOAT64, 1, 8);
  add("x", Type::FLOAT64, 1, 8);
  add("y", Type::FLOAT64, 1, 8);
  add("time", Type::UINT64, 1, 8);
  add("channels", Type::INT16, 3, 2);
  cloud.width = points;
  cloud.height = 1;
  cloud.row_step = cloud.width * cloud.point_step;
  cloud.data.resize(cloud.row_step);
  for (unsigned i = 0; i < points; ++i)
  {
    std::uint8_t* p = cloud.data.data() + cloud.point_step * i;
    const double xyz[3] = { 1e6 + 0.25 * (i / 3) + 0.1, 2.0, 3.0 };
    const std::uint64_t time = kFirstTime + i;
    const std::int16_t channels[3] = { std::int16_t(i), std::int16_t(-int(i)), 7 };
    p[0] = i % 3 > 0;
    std::memcpy(p + 1, &xyz[2], 8);
    std::memcpy(p + 9, &xyz[0], 8);
    std::memcpy(p + 17, &xyz[1], 8);
    std::memcpy(p + 25, &time, 8);
    std::memcpy(p + 33, channels, 6);
  }
  return cloud;
}

TEST(PclVoxelMeanOfFields, KeepsEveryFieldOfEveryType)
{
  constexpr unsigned kPoints = 300;
  const Fields cloud = cloudOfManyTypes(kPoints);
  PclVoxelMean<Fields> grid;
  const auto means = filtered<PclVoxelMean<Fields>, Fields>(grid, pcl::make_shared<Fields>(cloud), 0.25f);
  ASSERT_EQ(means.width, kPoints / 3);
  ASSERT_EQ(means.point_step, cloud.point_step);
  ASSERT_EQ(means.fields.size(), cloud.fields.size());
  for (unsigned v = 0; v < means.width; ++v)
  {
    const std::uint8_t* p = means.data.data() + means.point_step * v;
    double x = 0.0;
    std::uint64_t time = 0;
    std::int16_t channels[3];
    std::memcpy(&x, p + 9, 8);
    std::memcpy(&time, p + 25, 8);
    std::memcpy(channels, p + 33, 6);
    ASSERT_EQ(p[0], 1);
    ASSERT_NEAR(x, 1e6 + 0.25 * v + 0.1, 1e-9);
    ASSERT_EQ(time, kFirstTime + 3 * v + 1);
    ASSERT_EQ(channels[0], 3 * int(v) + 1);
    ASSERT_EQ(channels[1], -3 * int(v) - 1);
    ASSERT_EQ(channels[2], 7);
  }
  grid.setDownsampleAllData(false);
  Fields alone;
  grid.filter(alone);
  ASSERT_EQ(alone.fields.size(), 3u);
  EXPECT_EQ(alone.width, means.width);
  double x = 0.0;
  std::memcpy(&x, alone.data.data() + alone.fields[0].offset, 8);
  EXPECT_NEAR(x, 1e6 + 0.1, 1e-9);
}

TEST(PclVoxelMeanOfFields, GivesAnEmptyCloudForBadInput)
{
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  const Fields good = fieldsOf(*cloudOf<pcl::PointXYZRGBNormal>(100));
  const auto widthFor = [&](auto&& spoil)
  {
    auto bad = pcl::make_shared<Fields>(good);
    spoil(*bad);
    PclVoxelMean<Fields> grid;
    return filtered<PclVoxelMean<Fields>, Fields>(grid, bad).width;
  };
  EXPECT_GT(widthFor([](Fields&) {}), 50u);
  EXPECT_EQ(widthFor([](Fields& cloud) { cloud.data.resize(100); }), 0u);
  EXPECT_EQ(widthFor([](Fields& cloud) { cloud.width = 0; }), 0u);
  EXPECT_EQ(widthFor([](Fields& cloud) { cloud.is_bigendian = !cloud.is_bigendian; }), 0u);
  EXPECT_EQ(widthFor([](Fields& cloud) { cloud.fields[0].name = "not x"; }), 0u);
  EXPECT_EQ(widthFor([](Fields& cloud) { cloud.fields[0].datatype = pcl::PCLPointField::FLOAT64; }), 0u);
  EXPECT_EQ(widthFor([](Fields& cloud) { cloud.fields.back().datatype = 77; }), 0u);
  EXPECT_EQ(widthFor([](Fields& cloud) { cloud.fields.back().offset = 4000000000u; }), 0u);
  EXPECT_EQ(widthFor([](Fields& cloud) { cloud.fields.back().count = 4000000000u; }), 0u);
  EXPECT_EQ(widthFor([](Fields& cloud) { cloud.point_step = 0; }), 0u);
}

}
