/// Rounds towards a foot that moves end sooner where what was learned is used.
#include "Haptics/Contact/FootSearch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace pointhaptics
{
namespace
{

using Way = FootSearch::Way;

/// Remaining way at a place: the part of the way to the end that a fit on a bent surface sees, turned a
/// little.
Way left(const Way& place, const Way& end)
{
  const double a = end.a - place.a;
  const double b = end.b - place.b;
  return { 0.8 * a - 0.2 * b, 0.2 * a + 1.4 * b };
}

/// Rounds until less than 1e-9 is left.
int rounds(FootSearch& search, Way place, const Way& end)
{
  Way last;
  Way went;
  for (int round = 0; round < 100; ++round)
  {
    const Way now = left(place, end);
    if (round > 0)
    {
      search.learn(went, { last.a - now.a, last.b - now.b });
    }
    if (std::hypot(now.a, now.b) < 1e-9)
    {
      return round;
    }
    went = search.wayFor(now);
    place = { place.a + went.a, place.b + went.b };
    last = now;
  }
  return 100;
}

TEST(FootSearch, EndsInFewRoundsAndInFewerWhereItHasBeenBefore)
{
  FootSearch search;
  EXPECT_LE(rounds(search, { 0.0, 0.0 }, { 1.0, 0.3 }), 6); // 20 rounds if nothing is learned
  EXPECT_LE(rounds(search, { 1.0, 0.3 }, { 1.5, -0.2 }), 3);
  search.reset();
  EXPECT_GE(rounds(search, { 1.0, 0.3 }, { 1.5, -0.2 }), 4);
}

TEST(FootSearch, GoesToTheFootWhereWhatItLearnedLeadsAside)
{
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Way& less :
    { Way{ -1.0, 0.0 }, Way{ 0.0, 1.0 }, Way{ 1e-9, 0.0 }, Way{ infinity, 0.0 }, Way{ 0.0, NAN } })
  {
    FootSearch search;
    search.learn({ 1.0, 0.0 }, less);
    const Way way = search.wayFor({ 0.5, 0.0 });
    EXPECT_EQ(way.a, 0.5);
    EXPECT_EQ(way.b, 0.0);
  }
}

TEST(FootSearch, StaysWhereNothingIsLeft)
{
  FootSearch search;
  search.learn({ 0.0, 0.0 }, { 0.0, 0.0 });
  const Way way = search.wayFor({ 0.0, 0.0 });
  EXPECT_EQ(way.a, 0.0);
  EXPECT_EQ(way.b, 0.0);
}

} // namespace
} // namespace pointhaptics
