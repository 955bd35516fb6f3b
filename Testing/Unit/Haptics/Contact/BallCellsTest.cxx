#include "Haptics/Contact/BallCells.h"

#include "BallFixtures.h"

using namespace pointhaptics;
using trial::LongVec;
using trial::Real;

namespace
{

/// The field of points that keep nothing away, and of points whose radius is the unit of a scale.
constexpr double kNoRadius = 0x1p-60;
constexpr double kUnitRadius = 1.0;
constexpr double kBall = 0.0;

CellPyramid pyramidOf(const std::vector<Vec3>& points, double voxelSize)
{
  std::vector<Cell> cells;
  for (const Vec3& p : points)
  {
    Cell cell;
    cell.mean = p;
    cells.push_back(cell);
  }
  CellPyramid pyramid;
  EXPECT_EQ(pyramid.build(cells, voxelSize), Status::Ok);
  return pyramid;
}

ContactField fieldOf(const CellPyramid& pyramid, double radius = kNoRadius)
{
  ContactField field;
  field.build(pyramid, { radius, radius }, Bounds(), Executor());
  return field;
}

std::vector<Vec3> randomPoints(trial::Random& random, std::size_t n, double size)
{
  const std::size_t kind = random.below(4);
  const Vec3 normal = random.direction();
  const Vec3 at = random.inBox({ -0.05, -0.05, -0.05 }, { 0.05, 0.05, 0.05 });
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < n; ++i)
  {
    const Vec3 p = random.inBox({ -size, -size, -size }, { size, size, size });
    points.push_back(kind == 0 ? at + p
        : kind == 1            ? at + p - dot(p, normal) * normal
        : kind == 2            ? at + size * random.direction()
                               : at + dot(p, normal) * normal);
  }
  return points;
}

/// How near @p cells have a point to @p p.
double gapTo(const BallCells& cells, const Vec3& p)
{
  double nearest = HUGE_VAL;
  cells.visitBall(p, 1.0, [&](const Vec3&, double d2) { nearest = std::min(nearest, std::sqrt(d2)); });
  return nearest;
}

/// Largest distance from a point of @p points within @p radius of @p center to the nearest one gathered.
double worstGap(const std::vector<Vec3>& points, const BallCells& cells, const Vec3& center, double radius)
{
  double worst = 0.0;
  for (const Vec3& p : points)
  {
    if (norm(p - center) <= radius)
    {
      worst = std::max(worst, gapTo(cells, p));
    }
  }
  return worst;
}

/// Where a ball on its way meets points, of all those given.
struct Meeting
{
  Real way = 0.0L;   ///< The exact answer.
  Real depth = 0.0L; ///< How much deeper than at the start it covers a point somewhere on the way given.
  Real touch = 0.0L; ///< How far it is at the end of that way from touching a point ahead.
};

Meeting exactMeeting(const std::vector<Vec3>& points, const Vec3& from, const Vec3& direction, double length,
  double radius, double answer)
{
  const LongVec d(direction);
  const Real r = radius;
  const Real asked = answer;
  Meeting meeting;
  meeting.way = length;
  meeting.touch = HUGE_VALL;
  for (const Vec3& point : points)
  {
    const LongVec to = LongVec(point) - LongVec(from);
    const Real ahead = dot(to, d);
    const Real start = norm(to);
    const Real passed = norm(to - std::clamp(ahead, 0.0L, asked) * d);
    meeting.depth = std::max(meeting.depth, std::min(start, r) - passed);
    if (ahead > asked - 1e-12L * r)
    {
      meeting.touch = std::min(meeting.touch, norm(to - asked * d) - r);
    }
    const Real c = dot(to, to) - r * r;
    const Real discriminant = ahead * ahead - c * dot(d, d);
    if (ahead > 0.0L && (c <= 0.0L || discriminant > 0.0L))
    {
      meeting.way = std::min(meeting.way, c <= 0.0L ? 0.0L : c / (ahead + std::sqrt(discriminant)));
    }
  }
  return meeting;
}

} // namespace

TEST(BallCells, GathersEveryPointInReachOfALargeCloudWhereNotTooManyAre)
{
  trial::Random random(12);
  BallCells cells;
  int exact = 0;
  for (int cloud = 0; cloud < 8; ++cloud)
  {
    const std::vector<Vec3> points = randomPoints(random, 20000, 0.01);
    const CellPyramid pyramid = pyramidOf(points, random.uniform(1e-4, 1e-3));
    for (int query = 0; query < 50; ++query)
    {
      const Vec3 center =
        points[random.below(points.size())] + random.uniform(0.0, 1e-3) * random.direction();
      const double radius = random.uniform(1e-4, 2e-3);
      cells.invalidate();
      const bool whole = cells.gather(fieldOf(pyramid), center, radius, kBall);
      // More than is asked for is gathered; that counts, too.
      std::size_t inReach = 0;
      for (const Vec3& p : points)
      {
        inReach += norm(p - center) <= 1.4 * radius;
      }
      ASSERT_LE(cells.size(), int(BallCells::kCapacity));
      if (inReach <= std::size_t(BallCells::kCapacity))
      {
        ++exact;
        ASSERT_TRUE(whole);
        ASSERT_LE(worstGap(points, cells, center, radius), 1e-16) << cloud << ' ' << query;
      }
    }
  }
  EXPECT_GT(exact, 120);
}

TEST(BallCells, GathersFurtherThanAskedWhereThereIsRoom)
{
  trial::Random random(18);
  const std::vector<Vec3> few = randomPoints(random, BallCells::kCapacity, 0.01);
  const CellPyramid sparse = pyramidOf(few, 1e-3);
  BallCells cells;
  ASSERT_TRUE(cells.gather(fieldOf(sparse), few[0], 1e-3, kBall));
  ASSERT_TRUE(cells.gather(fieldOf(sparse), few[0], 1.5e-3, kBall));
  EXPECT_EQ(cells.passes(), 1);
  std::vector<Vec3> many;
  for (int i = 0; i < 20000; ++i)
  {
    many.push_back(random.inBox({ -0.01, -0.01, 0.0 }, { 0.01, 0.01, 0.0 }));
  }
  const CellPyramid dense = pyramidOf(many, 3e-4);
  BallCells crowded;
  EXPECT_TRUE(crowded.gather(fieldOf(dense), Vec3(), 1e-3, kBall)) << "no more than that has room";
  EXPECT_LE(worstGap(many, crowded, Vec3(), 1e-3), 1e-16);
}

TEST(BallCells, TakesOnePointOfEachVoxelWhereThereAreTooMany)
{
  trial::Random random(13);
  for (int cloud = 0; cloud < 8; ++cloud)
  {
    std::vector<Vec3> points;
    for (int i = 0; i < 20000; ++i)
    {
      points.push_back(random.inBox({ -2e-3, -2e-3, -1e-5 }, { 2e-3, 2e-3, 1e-5 }));
    }
    const double voxel = random.uniform(3e-4, 5e-4);
    const CellPyramid pyramid = pyramidOf(points, voxel);
    BallCells cells;
    ASSERT_FALSE(cells.gather(fieldOf(pyramid), Vec3(), 1e-3, kBall)) << "points are left out";
    EXPECT_LE(cells.size(), int(BallCells::kCapacity));
    EXPECT_LE(worstGap(points, cells, Vec3(), 1e-3), std::sqrt(3.0) * voxel * (1 + 1e-9));
    for (int i = 0; i < cells.size(); ++i)
    {
      ASSERT_LE(std::abs(cells.point(i).z), 1e-5) << "it is one of the points, or a mean of some";
    }
  }
}

TEST(BallCells, TakesMeansOfCoarserVoxelsWhereVoxelsAreTooManyAndSaysWhenEvenTheyAre)
{
  trial::Random random(14);
  std::vector<Vec3> points;
  for (int i = 0; i < 100000; ++i)
  {
    points.push_back(random.inBox({ -2e-3, -2e-3, -1e-5 }, { 2e-3, 2e-3, 1e-5 }));
  }
  constexpr double kFine = 2e-5; // about 8,000 voxels within the reach, 500 of 4 times the size
  const CellPyramid pyramid = pyramidOf(points, kFine);
  BallCells cells;
  ASSERT_FALSE(cells.gather(fieldOf(pyramid), Vec3(), 1e-3, 6.6e-4));
  const double gap = worstGap(points, cells, Vec3(), 0.999e-3);
  EXPECT_LE(gap, std::sqrt(3.0) * 16 * kFine) << "means of voxels no coarser than asked";
  EXPECT_GT(gap, 0.5 * kFine) << "not all of the points";
  EXPECT_GT(cells.size(), 100) << "not coarser than need be";

  cells.invalidate();
  EXPECT_FALSE(cells.gather(fieldOf(pyramid), Vec3(), 1e-3, 4 * kFine)) << "too many";
  EXPECT_LE(cells.size(), int(BallCells::kCapacity));
  EXPECT_GT(cells.size(), 0);
  EXPECT_FALSE(cells.gather(fieldOf(pyramid), Vec3(), 1e-3, 4 * kFine)) << "and it says so each time";
}

TEST(BallCells, SweepsABallExactlyToTheFirstPointInItsWay)
{
  constexpr int kClouds = 300;
  constexpr int kRays = 500;
  trial::Random random(17);
  BallCells cells;
  int stopped = 0;
  int atOnce = 0;
  int exact = 0;
  for (int cloud = 0; cloud < kClouds; ++cloud)
  {
    const std::vector<Vec3> points = randomPoints(random, 1 + random.below(200), 1e-3);
    const CellPyramid pyramid = pyramidOf(points, 3e-4);
    const double radius = random.uniform(1e-4, 1e-3);
    cells.invalidate();
    ASSERT_TRUE(cells.gather(fieldOf(pyramid, kUnitRadius), points[0], 0.02, kBall));
    for (int ray = 0; ray < kRays; ++ray)
    {
      // Anywhere; touching a point up to rounding; covering one by a little, or by much.
      const Vec3 away = random.direction();
      const Vec3& touched = points[random.below(points.size())];
      const std::size_t start = random.below(4);
      const Vec3 from = start == 0 ? points[0] + random.uniform(0.0, 3e-3) * away
        : start == 1               ? touched + radius * away
        : start == 2               ? touched + radius * (1.0 - std::pow(10.0, random.uniform(-16, -8))) * away
                                   : touched + random.uniform(0.0, radius) * away;
      const std::size_t course = random.below(4);
      const Vec3 direction = course == 0 ? normalized(cross(away, random.direction()))
        : course == 1                    ? -1.0 * away
        : course == 2 ? normalized(cross(away, random.direction()) + 1e-8 * random.direction())
                      : random.direction();
      const double length = random.below(50) == 0 ? 0.0 : random.uniform(0.0, 4e-3);
      const double way = cells.sweep(from, direction, length, radius);
      SCOPED_TRACE(cloud * kRays + ray);
      ASSERT_GE(way, 0.0);
      ASSERT_LE(way, length);
      const Meeting meeting = exactMeeting(points, from, direction, length, radius, way);
      // It covers nothing that it did not, and nothing deeper.
      ASSERT_LE(double(meeting.depth), 1e-12 * radius);
      if (way < length)
      {
        // It stops where it touches something ahead, or covers it already.
        ASSERT_LE(double(meeting.touch), 1e-12 * radius);
        ++stopped;
        atOnce += way == 0.0;
      }
      // Where it grazes, the exact way is ill-conditioned: it may go past a point by that depth, never
      // sooner.
      ASSERT_GE(double(way - meeting.way), -1e-12 * radius);
      exact += double(way - meeting.way) <= 1e-10 * radius;
    }
  }
  EXPECT_GT(stopped, kClouds * kRays / 4);
  EXPECT_GT(atOnce, kClouds * kRays / 20);
  EXPECT_LT(atOnce, stopped);
  EXPECT_GT(exact, kClouds * kRays * 9 / 10);
}
