#include "Benchmark/Harness/Race.h"

#include <algorithm>
#include <numeric>
#include <random>

namespace pointhaptics::bench
{
namespace
{

double runOnce(const Contestant& contestant, const std::function<double()>& clock)
{
  if (contestant.before)
  {
    contestant.before();
  }
  const double begin = clock();
  contestant.run();
  return clock() - begin;
}

} // namespace

std::vector<Lap> race(const std::vector<Contestant>& contestants, const RaceSettings& settings)
{
  const std::function<double()> clock = settings.clock ? settings.clock : secondsNow;
  std::vector<Lap> laps;
  std::vector<std::size_t> order;
  for (const Contestant& contestant : contestants)
  {
    Lap lap;
    lap.name = contestant.name;
    lap.firstSeconds = runOnce(contestant, clock);
    lap.checked = !contestant.check || contestant.check();
    if (lap.checked)
    {
      order.push_back(laps.size());
    }
    laps.push_back(std::move(lap));
  }
  std::vector<double> spent(laps.size(), 0.0);
  std::mt19937_64 random(settings.seed);
  for (int round = -settings.warmUps; round < settings.rounds; ++round)
  {
    const auto isSpent = [&](std::size_t who) { return spent[who] > settings.longestSeconds; };
    if (round + settings.warmUps >= kLeastRounds)
    {
      order.erase(std::remove_if(order.begin(), order.end(), isSpent), order.end());
    }
    std::shuffle(order.begin(), order.end(), random);
    for (const std::size_t who : order)
    {
      for (int call = 1; call <= settings.inARow; ++call)
      {
        const double seconds = runOnce(contestants[who], clock);
        spent[who] += seconds;
        if (round >= 0 && call == settings.inARow)
        {
          laps[who].seconds.push_back(seconds);
        }
      }
    }
  }
  return laps;
}

Json timesOf(const std::vector<Lap>& laps, std::size_t which)
{
  const Lap& lap = laps[which];
  const Quartiles seconds = quartiles(lap.seconds);
  const Quartiles ratio = pairedRatios(lap.seconds, laps.front().seconds);
  return { { "contestant", lap.name }, { "repetitions", seconds.count }, { "median_seconds", seconds.median },
    { "lower_quartile_seconds", seconds.lower }, { "upper_quartile_seconds", seconds.upper },
    { "fastest_seconds", seconds.minimum }, { "first_seconds", lap.firstSeconds },
    { "times_ours", ratio.median }, { "times_ours_lower", ratio.lower },
    { "times_ours_upper", ratio.upper } };
}

} // namespace pointhaptics::bench
