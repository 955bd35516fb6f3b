/// @file
/// LAZ's layers (point formats 6 to 10) learn the points of each scanner channel apart.
#pragma once

#include "Bytes/LittleEndian.h"

#include <array>
#include <cstdint>
#include <memory>

namespace pointhaptics::io
{

/// Properties of a point that the layer of x and y passes to the layers behind it.
struct PointLabel
{
  std::uint8_t channel = 0;          ///< scanner channel, 0..3
  std::uint8_t attributeChannel = 0; ///< the one that counts for attributes: see AttributeLayers.h
  std::uint8_t placeInPulse = 0;     ///< 1 first, 2 last, 3 single, 0 between
  std::uint8_t level = 0;            ///< returnLevel()
  std::uint8_t zContext = 0;
  bool hasNewTime = false;
  bool hasNewScanAngle = false;
  bool hasNewSource = false;
};

/// One State for each of the four channels, made when the first of its points comes. State has a member
/// `last` and start(last): a new channel goes on from the last value of the one before.
template <typename State>
class Channels
{
public:
  template <typename Value>
  void start(unsigned channel, const Value& first)
  {
    isStarted_ = {};
    current_ = channel;
    begin(channel, first);
  }
  State& current() { return *states_[current_]; }
  unsigned currentChannel() const { return current_; }
  /// The state of @p channel, whether it is the current one or not.
  State& at(unsigned channel)
  {
    if (!isStarted_[channel])
    {
      begin(channel, current().last);
    }
    return *states_[channel];
  }
  State& select(unsigned channel)
  {
    State& state = at(channel);
    current_ = channel;
    return state;
  }
  bool isStarted(unsigned channel) const { return isStarted_[channel]; }

private:
  template <typename Value>
  void begin(unsigned channel, const Value& first)
  {
    if (!states_[channel])
    {
      states_[channel] = std::make_unique<State>();
    }
    states_[channel]->start(first);
    isStarted_[channel] = true;
  }

  std::array<std::unique_ptr<State>, 4> states_;
  std::array<bool, 4> isStarted_{};
  unsigned current_ = 0;
};

} // namespace pointhaptics::io
