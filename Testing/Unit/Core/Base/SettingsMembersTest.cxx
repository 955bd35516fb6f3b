#include "Core/Base/SettingsMembers.h"

#include "Core/Bandwidth/BandwidthSettings.h"
#include "Core/Resample/VoxelMeanSettings.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <tuple>
#include <vector>

using namespace pointhaptics;

namespace
{

struct Inner
{
  std::set<std::string> names = { "a" };
  double size = 2.0;

  static constexpr auto members()
  {
    return std::make_tuple(settingsMember("names", &Inner::names), settingsMember("size", &Inner::size));
  }
};

struct Outer
{
  bool on = true;
  Inner inner;
  int count = 3;

  static constexpr auto members()
  {
    return std::make_tuple(settingsMember("on", &Outer::on), settingsMember("inner", &Outer::inner),
      settingsMember("count", &Outer::count));
  }
};

struct Forgetful
{
  int listed = 1;
  std::string forgotten;

  static constexpr auto members() { return std::make_tuple(settingsMember("listed", &Forgetful::listed)); }
};

struct Derived : Inner
{
  int more = 0;
  int forgotten = 0;

  static constexpr auto members()
  {
    return std::tuple_cat(Inner::members(), std::make_tuple(settingsMember("more", &Derived::more)));
  }
};

static_assert(listsEveryMember<Inner>() && listsEveryMember<Outer>());
static_assert(!listsEveryMember<Forgetful>() && !listsEveryMember<Derived, Inner>());
static_assert(isSettings<Outer> && !isSettings<std::string>);

TEST(SettingsMembers, AreVisitedInTheOrderOfTheListThroughAllLevels)
{
  std::vector<std::string> names;
  const Outer settings;
  visitSettings(settings, [&](const std::string& name, const auto&) { names.push_back(name); });
  EXPECT_EQ(names, (std::vector<std::string>{ "on", "inner.names", "inner.size", "count" }));
}

TEST(SettingsMembers, CanBeWrittenToAsTheyAreVisited)
{
  Outer settings;
  visitMembers(settings,
    [](const char* name, auto& member)
    {
      if constexpr (std::is_same_v<std::decay_t<decltype(member)>, int>)
      {
        EXPECT_STREQ(name, "count");
        member = 7;
      }
    });
  EXPECT_EQ(settings.count, 7);
}

TEST(SettingsMembers, AreEqualOnlyWhereAllAre)
{
  const Outer one;
  Outer other;
  EXPECT_TRUE(equalSettings(one, other));
  other.inner.size = 3.0;
  EXPECT_FALSE(equalSettings(one, other));
  other = one;
  other.inner.names.insert("b");
  EXPECT_FALSE(equalSettings(one, other));
}

/// Lists of members may name one twice.
template <typename Settings>
void expectNamesOnce()
{
  std::set<std::string> names;
  std::set<const void*> addresses;
  const Settings settings;
  std::size_t count = 0;
  visitSettings(settings,
    [&](const std::string& name, const auto& member)
    {
      ++count;
      names.insert(name);
      addresses.insert(&member);
    });
  EXPECT_EQ(names.size(), count);
  EXPECT_EQ(addresses.size(), count);
}

TEST(SettingsMembers, OfTheFiltersAreListedOnce)
{
  expectNamesOnce<VoxelMeanSettings>();
  expectNamesOnce<BandwidthSettings>();
}

} // namespace
