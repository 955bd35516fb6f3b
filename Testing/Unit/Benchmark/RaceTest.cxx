#include "Benchmark/Harness/Race.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace pointhaptics::bench;
using RaceContestant = pointhaptics::bench::Contestant;

namespace
{

/// A clock that goes only while a contestant runs.
struct RaceCourse
{
  double now = 0.0;
  std::vector<std::string> log;

  RaceContestant contestant(const std::string& name, double seconds)
  {
    RaceContestant result;
    result.name = name;
    result.before = [this, name] { log.push_back("before " + name); };
    result.run = [this, name, seconds]
    {
      log.push_back(name);
      now += seconds;
    };
    result.check = [this, name]
    {
      log.push_back("check " + name);
      return true;
    };
    return result;
  }
  RaceSettings settings(int rounds, int warmUps)
  {
    RaceSettings result;
    result.rounds = rounds;
    result.warmUps = warmUps;
    result.clock = [this] { return now; };
    return result;
  }
};

} // namespace

TEST(Race, ChecksTheFirstAnswerBeforeAnythingElseRuns)
{
  RaceCourse course;
  race({ course.contestant("a", 1.0), course.contestant("b", 2.0) }, course.settings(1, 0));
  const std::vector<std::string> begin(course.log.begin(), course.log.begin() + 6);
  EXPECT_EQ(begin, (std::vector<std::string>{ "before a", "a", "check a", "before b", "b", "check b" }));
}

TEST(Race, TimesEveryRoundAndTheFirstCallApart)
{
  RaceCourse course;
  int calls = 0;
  RaceContestant slowAtFirst = course.contestant("a", 1.0);
  slowAtFirst.run = [&] { course.now += ++calls == 1 ? 100.0 : 1.0; };
  const auto laps = race({ slowAtFirst, course.contestant("b", 2.0) }, course.settings(5, 2));
  ASSERT_EQ(laps.size(), 2u);
  EXPECT_EQ(laps[0].firstSeconds, 100.0);
  EXPECT_EQ(laps[0].seconds, std::vector<double>(5, 1.0));
  EXPECT_EQ(laps[1].seconds, std::vector<double>(5, 2.0));
  EXPECT_EQ(calls, 1 + 2 + 5);
}

TEST(Race, OfCallsInARowTheLastIsTimed)
{
  RaceCourse course;
  int calls = 0;
  RaceContestant contestant = course.contestant("a", 1.0);
  contestant.run = [&] { course.now += ++calls % 3 == 2 ? 7.0 : calls % 3 == 0 ? 3.0 : 1.0; };
  RaceSettings settings = course.settings(4, 1);
  settings.inARow = 3;
  const auto laps = race({ contestant }, settings);
  EXPECT_EQ(calls, 1 + 5 * 3);
  EXPECT_EQ(laps[0].seconds, std::vector<double>(4, 1.0));
}

TEST(Race, WhatIsDoneBeforeARunIsNotTimed)
{
  RaceCourse course;
  RaceContestant contestant = course.contestant("a", 1.0);
  contestant.before = [&] { course.now += 50.0; };
  EXPECT_EQ(quartiles(race({ contestant }, course.settings(3, 0)).front().seconds).maximum, 1.0);
}

TEST(Race, EveryoneRunsOncePerRoundInChangingOrder)
{
  RaceCourse course;
  std::vector<RaceContestant> contestants;
  for (const char* name : { "a", "b", "c" })
  {
    contestants.push_back(course.contestant(name, 1.0));
    contestants.back().before = nullptr;
    contestants.back().check = nullptr;
  }
  race(contestants, course.settings(20, 0));
  ASSERT_EQ(course.log.size(), 3u + 60u);
  bool changes = false;
  for (std::size_t round = 3; round < course.log.size(); round += 3)
  {
    std::vector<std::string> names(course.log.begin() + long(round), course.log.begin() + long(round) + 3);
    changes = changes || names != std::vector<std::string>{ "a", "b", "c" };
    std::sort(names.begin(), names.end());
    EXPECT_EQ(names, (std::vector<std::string>{ "a", "b", "c" }));
  }
  EXPECT_TRUE(changes);
}

TEST(Race, WhoFailsTheCheckIsNotTimed)
{
  RaceCourse course;
  RaceContestant bad = course.contestant("bad", 1.0);
  bad.check = [] { return false; };
  const auto laps = race({ bad, course.contestant("good", 1.0) }, course.settings(4, 1));
  EXPECT_FALSE(laps[0].checked);
  EXPECT_TRUE(laps[0].seconds.empty());
  EXPECT_EQ(laps[1].seconds.size(), 4u);
}

TEST(Race, ContestantsThatTakeTooLongSitOutTheRoundsLeft)
{
  RaceCourse course;
  RaceSettings settings = course.settings(10, 2);
  settings.longestSeconds = 60.0;
  const auto laps = race(
    { course.contestant("fast", 1.0), course.contestant("slow", 10.0), course.contestant("slowest", 50.0) },
    settings);
  EXPECT_EQ(laps[0].seconds, std::vector<double>(10, 1.0));
  EXPECT_EQ(laps[1].seconds, std::vector<double>(5, 10.0)) << "after seven rounds it has run for 70 seconds";
  EXPECT_EQ(laps[2].seconds, std::vector<double>(kLeastRounds - 2, 50.0));
}
