/// @file
/// One hand on one scene with one method: how far the force was from the exact one, and how long it took.
#pragma once

#include "Benchmark/Proxy/Course.h"

#include "Haptics/Proxy.h"

#include <functional>

namespace pointhaptics::bench::proxy
{

using ExactAnswer = std::function<ExactContact(const Vec3& hip)>;

/// Figures of a run. Errors over all ticks at least 20 um deep; percent of the RMS exact force.
struct TrialFigures
{
  double rmsPercent = 0.0;
  double maximumPercent = 0.0;
  double directionRmsDegrees = 0.0;
  double directionMaximumDegrees = 0.0;
  double largestStep = 0.0; ///< Largest force step in a tick over K |dH|; ticks with |dH| above 1 um.
  double energyJoule = 0.0; ///< Returned to the hand over the closed turn; above 0: the surface is active.
  int popThroughs = 0;      ///< Ticks without contact although more than 20 um deep.
  int falseTicks = 0;       ///< Ticks with force although more than 20 um outside.
  int contactTicks = 0;
  double p50 = 0.0; ///< Median update time in contact, microseconds.
  double p99 = 0.0;
  double p999 = 0.0;
  double maximum = 0.0;
  double firstContact = 0.0; ///< The longest update out of contact or into it: finding the surface.
};

/// Runs @p course from a fresh proxy. @p repetitions: the fastest of that many runs tells the time of each
/// tick.
TrialFigures runTrial(const HapticScene& scene, const HapticParameters& parameters, const Course& course,
  const ExactAnswer& exact, int repetitions);

} // namespace pointhaptics::bench::proxy
