/// @file
/// Result of one tick of the servo loop.
#pragma once

#include "Haptics/Proxy.h"

#include <cstdint>

namespace pointhaptics
{

/// Bits of ServoSample::tickFlags: what a tick was given beside the hand.
enum TickFlags : std::uint32_t
{
  kTickBegins = 1u << 0,     ///< The proxy began anew: nothing before this tick matters for it.
  kTickStepped = 1u << 1,    ///< The device was read, and the proxy stepped.
  kTickNewHand = 1u << 2,    ///< HandState::isNew, or the hand was lost for too long.
  kTickClutched = 1u << 3,   ///< ServoLoop::setClutched().
  kTickGateClosed = 1u << 4, ///< The loop was stopping, or without a heartbeat.
  kTickNonFinite = 1u << 5,  ///< The device gave a position that is not finite.
};

/// One tick, as traced and published.
struct ServoSample
{
  std::uint64_t tick =
    0; ///< 1, 2, ...; ticks of missed deadlines have their numbers too, so that a gap shows where they were.
  double timeSeconds = 0.0; ///< Deadline of the tick since the first one: (tick - 1) / rate.
  ProxyState state; ///< force is the one that was sent: after the guard, zero where the device failed.
  std::uint32_t buttons = 0;
  std::uint32_t tickFlags = 0; ///< TickFlags.
  Status device =
    Status::Ok; ///< Answer of the device; unless Ok, state is that of the tick before, without force.
  double updateSeconds = 0.0;   ///< Wall time of the tick's work, reading and writing the device included.
  std::uint64_t scenes = 0;     ///< Scenes taken since start(), this tick's included.
  std::uint64_t scene = 0;      ///< HapticScene::number() of the one in use; 0: none.
  std::uint64_t parameters = 0; ///< Number of the parameters in use: see ServoInputs.
};

} // namespace pointhaptics
