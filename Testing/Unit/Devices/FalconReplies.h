/// @file
/// The Falcon's side of its messages, which no driver needs.
#pragma once

#include "Devices/Falcon/FalconFrame.h"
#include "Devices/Falcon/FalconKinematics.h"

#include <array>
#include <cstdint>

namespace pointhaptics
{
namespace trial
{

constexpr std::size_t kFlagsByte = 13;

/// Words lie in replies as in commands; the byte of the flags has more of them.
inline FalconFrame encode(const FalconReply& reply)
{
  FalconFrame frame = pointhaptics::encode(FalconCommand{ reply.encoders });
  frame[kFlagsByte] = std::uint8_t('A' + ((reply.buttons & 15) | ((reply.homed & 7) << 4)));
  return frame;
}

inline bool decode(const FalconFrame& frame, FalconCommand& command)
{
  FalconReply words;
  const std::uint8_t leds = std::uint8_t(frame[kFlagsByte] - 'A');
  const bool isCommand = pointhaptics::decode(frame, words) && leds <= 15;
  command = isCommand ? FalconCommand{ words.encoders, leds } : command;
  return isCommand;
}

inline double countOf(double angle)
{
  return (angle - falcon::anglesFromCounts({ 0.0, 0.0, 0.0 })[0]) * falcon::countsPerRadian();
}

} // namespace trial
} // namespace pointhaptics
