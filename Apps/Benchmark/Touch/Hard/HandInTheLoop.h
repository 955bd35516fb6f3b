/// @file
/// A simulated hand that presses, slides and leaves, with the servo's delay and its force guard. Does it
/// tremble where it would be still on an ideal plane, and who gives it energy?
#pragma once

#include "Benchmark/Touch/Hard/HardScenes.h"

#include <functional>

namespace pointhaptics::bench::touch::hard
{

/// A mass on a spring to where the person wants the hand.
struct LoopHand
{
  double mass = 0.1;          ///< kg.
  double grip = 300.0;        ///< N/m, of the spring.
  double dampingRatio = 0.4;  ///< Damping ratio of mass and spring alone.
  double deviceDamping = 2.5; ///< N s/m.
  double stiffness = 800.0;   ///< K, N/m.
  int delay = 1;              ///< Ticks from a position to its force.
};

/// Each mass, spring, stiffness and delay with each other.
std::vector<LoopHand> loopHands(bool quick);

struct LoopFigures
{
  double oscillation = 0.0; ///< Largest way from the mean of 0.1 s in the last half of a hold, metres.
  double energyJoule = 0.0; ///< Energy that the forces gave to the hand.
};

/// Presses to 3 mm in 0.4 s, holds 1 s, slides 5 mm, holds 1 s, leaves by 20 mm.
/// @param force of the contact at a position of the hand, called once a tick.
LoopFigures runLoop(
  const LoopHand& hand, const TouchPlace& place, const std::function<Vec3(const Vec3&)>& force);
/// Runs the hand on the ideal plane through @p place.
LoopFigures runOnPlane(const LoopHand& hand, const TouchPlace& place);

} // namespace pointhaptics::bench::touch::hard
