/// @file
/// Items of LAZ's records, and their layers in point formats 6 to 10, version 3. Source: LASzip's published
/// format.
///
/// An item has a type Value, load(), store(), start(first) and code(coder, label, last, value), which gives
/// back the value. An item has learned nothing when it is made, and each chunk makes its items; the value
/// before is given.
#pragma once

#include "Bytes/LittleEndian.h"
#include "IO/Las/Laz/SymbolModel.h"

#include <array>
#include <cstdint>
#include <memory>

namespace pointhaptics::io
{

/// Properties of a point that the layer of x and y passes to the layers behind it.
struct PointLabel
{
  std::uint8_t channel = 0;          ///< scanner channel, 0..3
  std::uint8_t attributeChannel = 0; ///< the one that counts for attributes: see Layer
  std::uint8_t placeInPulse = 0;     ///< 1 first, 2 last, 3 single, 0 between
  std::uint8_t level = 0;            ///< returnLevel()
  std::uint8_t zContext = 0;
  bool hasNewTime = false;
  bool hasNewScanAngle = false;
  bool hasNewSource = false;
};

/// Loads and stores items that are one number.
template <typename T>
struct NumberItem
{
  using Value = T;
  static constexpr bool kIsAttribute = false;

  void start(T) {}
  static T load(const char* at) { return loadLittle<T>(at); }
  static void store(T value, char* at) { storeLittle(value, at); }
};

/// Loads and stores attributes of several numbers, one behind the other.
template <typename T, std::size_t Count>
struct NumbersItem
{
  using Value = std::array<T, Count>;
  static constexpr bool kIsAttribute = true;

  void start(const Value&) {}
  static Value load(const char* at)
  {
    Value value;
    for (std::size_t i = 0; i < Count; ++i)
    {
      value[i] = loadLittle<T>(at + i * sizeof(T));
    }
    return value;
  }
  static void store(const Value& value, char* at)
  {
    for (std::size_t i = 0; i < Count; ++i)
    {
      storeLittle(value[i], at + i * sizeof(T));
    }
  }
};

/// Codes a byte by its difference from @p predicted, modulo 256.
template <typename Coder>
std::uint8_t codeByte(Coder& coder, SymbolModel& differences, int predicted, int value)
{
  const auto difference = static_cast<std::uint8_t>(value - predicted);
  return static_cast<std::uint8_t>(predicted + static_cast<int>(coder.symbol(differences, difference)));
}

/// The scanner channel of a record of point formats 6 to 10.
inline unsigned channelOf14(const char* record)
{
  return byteAt(record, 15) >> 4 & 3u;
}

/// One State for each of the four channels, made when the first of its points comes. State has a member
/// `last`, from which it can be made: a new channel goes on from the last value of the one before.
template <typename State>
class Channels
{
public:
  template <typename Value>
  Channels(unsigned channel, const Value& first)
    : current_(channel)
  {
    states_[channel] = std::make_unique<State>(first);
  }
  State& current() { return *states_[current_]; }
  unsigned currentChannel() const { return current_; }
  /// The state of @p channel, whether it is the current one or not.
  State& at(unsigned channel)
  {
    if (!states_[channel])
    {
      states_[channel] = std::make_unique<State>(current().last);
    }
    return *states_[channel];
  }
  State& select(unsigned channel)
  {
    State& state = at(channel);
    current_ = channel;
    return state;
  }
  bool isStarted(unsigned channel) const { return states_[channel] != nullptr; }

private:
  std::array<std::unique_ptr<State>, 4> states_;
  unsigned current_;
};

/// One item at @p offset of the record in a layer of its own.
///
/// Version 3 has two peculiarities of attributes (Item::kIsAttribute: what lies behind the first 30 bytes),
/// which readers and writers share. A point counts for its scanner channel only where it begins a chunk or
/// its channel differs from that of the point before; all others count for channel 0. And the first point
/// after a change to a channel that was there before is predicted from the last point of the channel that is
/// left, and becomes the last point of that one.
template <typename Item>
class Layer
{
public:
  /// @p record: the first one of the chunk.
  Layer(std::size_t offset, const char* record)
    : offset_(offset)
    , channels_(channelOf14(record), Item::load(record + offset))
  {
  }
  template <typename Coder>
  void code(Coder& coder, const PointLabel& label, char* record)
  {
    const unsigned channel = Item::kIsAttribute ? label.attributeChannel : label.channel;
    const bool isNew = !channels_.isStarted(channel);
    State* before = &channels_.current();
    State& state = channels_.select(channel);
    before = isNew || !Item::kIsAttribute ? &state : before;
    char* at = record + offset_;
    const Value value =
      state.item.code(coder, label, before->last, Coder::kEncodes ? Item::load(at) : Value{});
    hasChanges_ = hasChanges_ || (Coder::kEncodes && value != before->last);
    before->last = value;
    if constexpr (!Coder::kEncodes)
    {
      Item::store(value, at);
    }
  }
  /// For an encoder: true if any value differs from the one before. Layers without changes are left out.
  bool hasChanges() const { return hasChanges_; }

private:
  using Value = typename Item::Value;
  struct State
  {
    Value last;
    Item item;

    explicit State(const Value& first)
      : last(first)
    {
      item.start(first);
    }
  };

  std::size_t offset_;
  Channels<State> channels_;
  bool hasChanges_ = false;
};

} // namespace pointhaptics::io
