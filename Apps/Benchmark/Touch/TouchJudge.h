/// @file
/// How far the touch of a cloud was from the god object on its mesh.
#pragma once

#include "Benchmark/Touch/Methods/TouchMethod.h"
#include "Benchmark/Touch/TouchStrokes.h"

#include <array>
#include <cstdint>
#include <vector>

namespace pointhaptics::bench::touch
{

constexpr std::size_t kStatusBits = 16;

/// Errors where the truth holds and before the god object leaps; percent of the force of the tick (RMS: of
/// the RMS force). Ticks, steps, phantom and held: before the leap too.
struct TouchFigures
{
  int strokes = 0;
  int leaps = 0;             ///< Strokes whose god object leaps.
  std::int64_t ticks = 0;    ///< Before the leaps.
  std::int64_t contacts = 0; ///< Ticks in which the god object was in contact.
  std::int64_t judged = 0;   ///< Those of them whose truth holds.
  double judgedPercent = 0.0;
  double medianPercent = 0.0;
  double p95Percent = 0.0;
  double rmsPercent = 0.0;
  double directionP95Degrees = 0.0; ///< Direction error of the ticks with a force.
  double lostPercent = 0.0;         ///< Judged ticks more than 0.05 mm deep without force.
  double phantomNewton = 0.0;       ///< Largest force where all nine god objects are free.
  int held = 0;                     ///< Strokes whose last 50 ticks, all free, all have a force above 0.05 N.
  double laterPhantomNewton = 0.0;  ///< As phantomNewton, after a leap.
  int laterHeld = 0;                ///< As held, of strokes with a leap.
  int pops = 0;                     ///< Strokes in which a judged tick has no force or one that pulls.
  int releases = 0;                 ///< Ticks in which the contact of the method ended.
  double largestStep = 0.0;         ///< |dF| over K |dH|, of ticks with a force and |dH| above 1 um.
  double stepP99 = 0.0;
  double energyJoule = 0.0; ///< Median over the strokes of what the force returned beyond the truth's.
  double p50 = 0.0;         ///< Update time of a tick in contact, microseconds.
  double p99 = 0.0;
  double firstContact = 0.0; ///< The longest update out of contact or into it: finding the surface.
  double maximum = 0.0;      ///< Longest update of all ticks, finding the surface among them.
  std::array<double, kStatusBits> statusPercent{}; ///< Ticks in which each bit of ProxyState::status was set.
  std::int64_t nonFinite = 0;                      ///< States that are not finite: beyond doubt wrong.
};

/// All states of one stroke, and the shortest update of each tick over @p repetitions walks.
struct TouchTrace
{
  std::vector<ProxyState> states;
  std::vector<double> microseconds;
};

TouchTrace walk(TouchMethod& method, const TouchScene& scene, const TouchStroke& stroke, std::size_t ticks,
  int repetitions);

/// Adds strokes up.
class TouchJudge
{
public:
  explicit TouchJudge(double stiffness)
    : stiffness_(stiffness)
  {
  }
  void add(const TouchTrace& trace, const TouchTruth& truth);
  TouchFigures figures() const;

private:
  void addForces(const TouchTrace& trace, const TouchTruth& truth);
  void addSteps(const TouchTrace& trace, const TouchTruth& truth);
  void addEnd(const TouchTrace& trace, const TouchTruth& truth);

  double stiffness_;
  TouchFigures figures_;
  std::vector<double> errors_;
  std::vector<double> angles_;
  std::vector<double> steps_;
  std::vector<double> energies_;
  std::vector<double> microseconds_;
  double longest_ = 0.0;
  double squares_ = 0.0;
  double scale_ = 0.0;
  std::int64_t lost_ = 0;
  std::array<std::int64_t, kStatusBits> status_{};
};

} // namespace pointhaptics::bench::touch
