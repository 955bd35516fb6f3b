#include "Haptics/ContactField.h"

#include "HapticFixtures.h"

#include <algorithm>
#include <set>

using namespace pointhaptics;

namespace
{

/// A sheet whose right half is eight times as sparse, some of its points twice.
std::vector<Vec3> stepPoints()
{
  trial::Random random(12);
  std::vector<Vec3> points;
  for (int i = 0; i < 8000; ++i)
  {
    const bool isDense = i % 65 != 0;
    points.push_back(random.inBox({ isDense ? -0.02 : 0.0, -0.02, 0 }, { isDense ? 0.0 : 0.02, 0.02, 0 }));
    if (i % 100 == 0)
    {
      points.push_back(points.back());
    }
  }
  return points;
}

} // namespace

TEST(ContactField, FindsEveryPointThatABallMayTouch)
{
  const trial::Scene scene = trial::rawScene(stepPoints());
  const ContactField& field = scene->contactField();
  const auto& cells = field.pyramid().level(0).cells;
  ASSERT_GT(field.largest(), 2.0 * field.typical()) << "the step is there";
  trial::Random random(13);
  for (int query = 0; query < 300; ++query)
  {
    const Vec3 center = random.inBox({ -0.03, -0.03, -0.01 }, { 0.03, 0.03, 0.01 });
    const double way = random.uniform(0.0, 0.004);
    std::set<std::uint32_t> found;
    field.visitRuns(0, center, way,
      [&](std::uint32_t first, std::uint32_t last)
      {
        for (std::uint32_t i = first; i < last; ++i)
        {
          found.insert(i);
        }
        return true;
      });
    for (std::uint32_t i = 0; i < cells.size(); ++i)
    {
      const bool isInReach = norm(cells[i].mean - center) < double(field.radii(0)[i]) + way;
      ASSERT_TRUE(!isInReach || found.count(i) > 0) << query << ' ' << i;
    }
  }
}

TEST(ContactField, GivesCopiesOnePlaceAndMergedCellsTheLargestRadius)
{
  const trial::Scene scene = trial::rawScene(stepPoints());
  const ContactField& field = scene->contactField();
  const CellPyramid& pyramid = field.pyramid();
  const auto& cells = pyramid.level(0).cells;
  for (std::size_t i = 0; i + 1 < cells.size(); ++i)
  {
    EXPECT_TRUE(!(cells[i].mean == cells[i + 1].mean) || field.radii(0)[i] == field.radii(0)[i + 1]);
  }
  for (int level = 1; level < pyramid.numberOfCellLevels(); ++level)
  {
    ASSERT_EQ(field.radii(level).size(), pyramid.level(level).cells.size());
    const double size = pyramid.level(level).voxelSize;
    for (std::size_t i = 0; i < cells.size(); i += 37)
    {
      double distance = 0.0;
      const std::int64_t coarse = pyramid.nearest(level, cells[i].mean, 4.0 * size, distance);
      ASSERT_GE(coarse, 0);
    }
    EXPECT_EQ(
      *std::max_element(field.radii(level).begin(), field.radii(level).end()), float(field.largest()));
  }
}
