/// @file
/// Times contestants side by side: the first call apart, the answer checked, then rounds in which each runs
/// once, in an order shuffled anew, so that whatever the machine does meanwhile hits all of them alike.
///
/// Not Google Benchmark: its random interleaving repeats each contestant within a turn until a time is
/// reached, has no place for the first call or for a check before the timing, and keeps no round's times
/// together for paired ratios.
#pragma once

#include "Benchmark/Harness/Run.h"
#include "Benchmark/Harness/Statistics.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace pointhaptics::bench
{

struct Contestant
{
  std::string name;
  std::function<void()> run;    ///< Timed.
  std::function<void()> before; ///< Not timed, before every run; may be empty.
  /// Looks at the answer of the first run, before any other; may be empty. False: it is no use timing it.
  std::function<bool()> check;
};

/// Rounds of every contestant, however long they take.
constexpr int kLeastRounds = 5;

struct RaceSettings
{
  int rounds = 15;
  int warmUps = 2;
  /// Calls of a contestant in each round, one after the other. The last is timed: it finds the caches and the
  /// threads as its own call left them, like all calls in a program that does nothing else.
  int inARow = 1;
  /// A contestant that has run so long in all, after its first call, sits out the rounds left: kLeastRounds
  /// of them, warm-ups included, it runs in any case.
  double longestSeconds = std::numeric_limits<double>::infinity();
  std::uint64_t seed = 1;
  /// Seconds since some fixed moment. Default: std::chrono::steady_clock.
  std::function<double()> clock;
};

struct Lap
{
  std::string name;
  bool checked = false;        ///< The check held, or there was none; false: not timed.
  double firstSeconds = 0.0;   ///< The first call: memory and threads still to be had.
  std::vector<double> seconds; ///< One a round, the same round at the same place for everyone.
};

/// One lap per contestant, in their order. Exceptions of a contestant pass through.
std::vector<Lap> race(const std::vector<Contestant>& contestants, const RaceSettings& settings);

/// The times of one lap as a row has them, with their ratio to those of the first lap.
Json timesOf(const std::vector<Lap>& laps, std::size_t which);

} // namespace pointhaptics::bench
