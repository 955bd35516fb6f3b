// Bandwidths of points that lie on several ranks, against those of all points at once.
#include "Core/Distributed/SharedBandwidths.h"

#include "Core/Bandwidth/Density.h"
#include "Core/Bandwidth/LocalBandwidth.h"

#include "RandomClouds.h"
#include "ThreadRanks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>

using namespace pointhaptics;
using namespace pointhaptics::trial;

namespace
{

struct Cloud
{
  std::string name;
  std::vector<Vec3> points;
  std::vector<double> counts;
};

PointView viewOf(const std::vector<Vec3>& points)
{
  return { points.data(), std::int64_t(points.size()) };
}

/// A wavy sheet, denser on one side.
Cloud sheet(std::size_t n)
{
  Cloud cloud{ "sheet", {}, {} };
  Random random(11);
  for (std::size_t i = 0; i < n; ++i)
  {
    const double x = std::pow(random.uniform(0.0, 1.0), 3.0);
    const double y = random.uniform(0.0, 1.0);
    cloud.points.push_back({ x, y, 0.1 * std::sin(9.0 * x) });
  }
  return cloud;
}

/// Whole numbers: most distances are there several times.
Cloud grid()
{
  Cloud cloud{ "grid", {}, {} };
  for (int i = 0; i < 12 * 12 * 4; ++i)
  {
    cloud.points.push_back({ double(i % 12), double(i / 12 % 12), double(i / 144) });
    cloud.counts.push_back(1.0 + i % 7);
  }
  return cloud;
}

/// Two clusters far from each other, duplicates, one far point, and points that are not finite.
Cloud clusters()
{
  Cloud cloud{ "clusters", {}, {} };
  Random random(3);
  for (int i = 0; i < 600; ++i)
  {
    const double offset = i % 3 == 0 ? 1000.0 : 0.0;
    cloud.points.push_back(
      { offset + random.uniform(0.0, 1.0), random.uniform(0.0, 1.0), random.uniform(0.0, 0.2) });
  }
  for (int i = 0; i < 60; ++i)
  {
    cloud.points.push_back({ 5.0, 5.0, 5.0 });
  }
  cloud.points.push_back({ -30000.0, 0.0, 0.0 });
  cloud.points[17].x = NAN;
  cloud.points[500].z = INFINITY;
  return cloud;
}

/// Points of few places, the copies of each on any rank.
Cloud repeated(bool counted)
{
  const std::vector<Vec3> places = sheet(200).points;
  Cloud cloud{ counted ? "repeated means" : "repeated", {}, {} };
  for (const std::size_t i : randomOrder(4000, 5))
  {
    cloud.points.push_back(places[i % places.size()]);
    cloud.counts.push_back(double(1 + i % 9));
  }
  cloud.counts.resize(counted ? cloud.counts.size() : 0);
  return cloud;
}

std::vector<Cloud> clouds()
{
  Cloud counted = sheet(700);
  counted.name = "sheet of means";
  for (std::size_t i = 0; i < counted.points.size(); ++i)
  {
    counted.counts.push_back(double(1 + i % 40));
  }
  Cloud few{ "few", { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 2, 0 } }, {} };
  Cloud same{ "same", std::vector<Vec3>(40, { 1.0, 2.0, 3.0 }), {} };
  Cloud none{ "none", {}, {} };
  return { sheet(1200), counted, grid(), clusters(), few, same, none, repeated(false), repeated(true) };
}

/// As vtkKernelBandwidthFilter does it.
BandwidthsOfPoints expectedOf(const Cloud& cloud, const BandwidthSettings& settings)
{
  BandwidthsOfPoints result;
  NeighborQuery query;
  query.build(viewOf(cloud.points));
  EXPECT_EQ(
    localBandwidths(viewOf(cloud.points), cloud.counts, query, settings, result.bandwidths, result.radii),
    Status::Ok);
  std::vector<double> unused;
  result.ofMeans = result.bandwidths;
  if (!cloud.counts.empty())
  {
    EXPECT_EQ(localBandwidths(viewOf(cloud.points), {}, query, settings, result.ofMeans, unused), Status::Ok);
  }
  surfaceDensities(
    viewOf(cloud.points), cloud.counts, query, result.ofMeans, result.densities, {}, settings.densityKernel);
  return result;
}

/// Ends of the ranks' parts, uneven.
std::vector<std::size_t> splitOf(std::size_t n, int size)
{
  Random random(std::uint64_t(size) + n);
  std::vector<std::size_t> ends = { 0, n };
  for (int r = 1; r < size; ++r)
  {
    ends.push_back(r == 2 ? 0 : random.below(n + 1));
  }
  std::sort(ends.begin(), ends.end());
  return ends;
}

BandwidthsOfPoints sharedOf(const Cloud& cloud, const BandwidthSettings& settings, int size)
{
  const std::vector<std::size_t> ends = splitOf(cloud.points.size(), size);
  std::vector<BandwidthsOfPoints> ofRanks(static_cast<std::size_t>(size));
  ThreadJob job(size);
  job.run(
    [&](Ranks& ranks)
    {
      const auto rank = std::size_t(ranks.rank());
      const auto first = std::ptrdiff_t(ends[rank]);
      const auto last = std::ptrdiff_t(ends[rank + 1]);
      const std::vector<Vec3> points(cloud.points.begin() + first, cloud.points.begin() + last);
      std::vector<double> counts;
      if (!cloud.counts.empty())
      {
        counts.assign(cloud.counts.begin() + first, cloud.counts.begin() + last);
      }
      EXPECT_EQ(sharedBandwidths(ranks, viewOf(points), counts, settings, ofRanks[rank]), Status::Ok);
    });
  BandwidthsOfPoints all;
  for (const BandwidthsOfPoints& part : ofRanks)
  {
    all.bandwidths.insert(all.bandwidths.end(), part.bandwidths.begin(), part.bandwidths.end());
    all.radii.insert(all.radii.end(), part.radii.begin(), part.radii.end());
    all.ofMeans.insert(all.ofMeans.end(), part.ofMeans.begin(), part.ofMeans.end());
    all.densities.insert(all.densities.end(), part.densities.begin(), part.densities.end());
  }
  return all;
}

void expectSame(const std::vector<double>& a, const std::vector<double>& b, const std::string& what)
{
  ASSERT_EQ(a.size(), b.size()) << what;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    ASSERT_EQ(std::memcmp(&a[i], &b[i], sizeof(double)), 0)
      << what << ", point " << i << ": " << a[i] << ", " << b[i];
  }
}

std::vector<std::pair<std::string, BandwidthSettings>> variants()
{
  BandwidthSettings usual;
  usual.computeDensity = true;
  usual.computeMeanBandwidth = true;
  BandwidthSettings many = usual;
  many.numberOfNeighbors = 30;
  many.rule = BandwidthRule::SilvermanRobust;
  many.densityKernel = DensityKernel::Epanechnikov;
  BandwidthSettings ball = usual;
  ball.fixedRadius = true;
  ball.radius = 0.05;
  return { { "usual", usual }, { "100 neighbours", many }, { "ball", ball } };
}

}

TEST(SharedBandwidths, AreThoseOfOneRankHoweverPointsAndRanksAreSplit)
{
  for (const Cloud& cloud : clouds())
  {
    for (const auto& variant : variants())
    {
      const BandwidthsOfPoints expected = expectedOf(cloud, variant.second);
      for (const int size : { 1, 2, 3, 4, 8 })
      {
        const BandwidthsOfPoints found = sharedOf(cloud, variant.second, size);
        const std::string what = cloud.name + ", " + variant.first + ", ranks " + std::to_string(size) + ", ";
        expectSame(found.bandwidths, expected.bandwidths, what + "bandwidths");
        expectSame(found.radii, expected.radii, what + "radii");
        expectSame(found.ofMeans, expected.ofMeans, what + "bandwidths of means");
        expectSame(found.densities, expected.densities, what + "densities");
      }
    }
  }
}

TEST(SharedBandwidths, SendLittleMoreThanThePointsAndTheirValues)
{
  const Cloud cloud = sheet(40000);
  BandwidthSettings settings;
  settings.computeDensity = true;
  std::int64_t sent = 0;
  const std::int64_t share = 10000;
  ThreadJob job(4);
  job.run(
    [&](Ranks& ranks)
    {
      BandwidthsOfPoints result;
      EXPECT_EQ(sharedBandwidths(
                  ranks, PointView(cloud.points.data() + share * ranks.rank(), share), {}, settings, result),
        Status::Ok);
    });
  sent = job.bytesSent();
  // Three quarters of the points go to another rank, 48 bytes each, and four values of 16 bytes come back;
  // the rest are ghosts.
  EXPECT_GT(sent, 3 * share * 112);
  EXPECT_LT(sent, 2 * 3 * share * 88);
}

TEST(SharedBandwidths, RefuseBadSettingsAndCountsOnAllRanks)
{
  ThreadJob job(3);
  job.run(
    [&](Ranks& ranks)
    {
      const std::vector<Vec3> points(5, { double(ranks.rank()), 0.0, 0.0 });
      BandwidthsOfPoints result;
      BandwidthSettings settings;
      const std::vector<double> counts(ranks.rank() == 1 ? 4 : 5, 1.0);
      EXPECT_EQ(sharedBandwidths(ranks, viewOf(points), counts, settings, result), Status::InvalidParameter);
      settings.numberOfNeighbors = 0;
      EXPECT_EQ(sharedBandwidths(ranks, viewOf(points), {}, settings, result), Status::InvalidNeighborhood);
    });
}
