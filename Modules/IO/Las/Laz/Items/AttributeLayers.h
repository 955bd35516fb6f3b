/// @file
/// LAZ's layers behind the first 30 bytes of point formats 6 to 10, version 3: colours, near infrared,
/// waveforms and extra bytes. Source: LASzip's published format.
///
/// Version 3 has two peculiarities, which readers and writers share. A point counts for its scanner channel
/// only where it begins a chunk or its channel differs from that of the point before; all others count for
/// channel 0. And the first point after a change to a channel that was there before is predicted from the
/// last point of the channel that is left, and becomes the last point of that one.
#pragma once

#include "IO/Las/Laz/Items/Channels.h"
#include "IO/Las/Laz/Items/ColorItem.h"
#include "IO/Las/Laz/Items/WavePacketItem.h"

namespace pointhaptics::io
{

/// One attribute at @p offset of the record. Item has Value, last, start(), load(), store() and code().
template <typename Item>
class AttributeLayer
{
public:
  explicit AttributeLayer(std::size_t offset)
    : offset_(offset)
  {
  }
  void start(const char* record, unsigned channel)
  {
    channels_.start(channel, Item::load(record + offset_));
    hasChanges_ = false;
  }
  template <typename Coder>
  void code(Coder& coder, const PointLabel& label, char* record)
  {
    Item* before = &channels_.current();
    Item* item = before;
    if (label.attributeChannel != channels_.currentChannel())
    {
      const bool isNew = !channels_.isStarted(label.attributeChannel);
      item = &channels_.select(label.attributeChannel);
      before = isNew ? item : before;
    }
    char* at = record + offset_;
    const typename Item::Value value =
      item->code(coder, before->last, Coder::kEncodes ? Item::load(at) : typename Item::Value{});
    hasChanges_ = hasChanges_ || (Coder::kEncodes && value != before->last);
    before->last = value;
    if constexpr (!Coder::kEncodes)
    {
      Item::store(value, at);
    }
  }
  /// For an encoder: true if any value differs from the one before. Layers without changes are left out.
  bool hasChanges() const { return hasChanges_; }
  std::size_t offset() const { return offset_; }
  static constexpr std::size_t kSize = Item::kSize;

private:
  std::size_t offset_;
  Channels<Item> channels_;
  bool hasChanges_ = false;
};

struct ColorAttribute
{
  using Value = ColorItem::Color;
  static constexpr std::size_t kSize = 6;
  Value last{};
  ColorItem item;

  static Value load(const char* at)
  {
    return { loadLittle<std::uint16_t>(at), loadLittle<std::uint16_t>(at + 2),
      loadLittle<std::uint16_t>(at + 4) };
  }
  static void store(const Value& value, char* at)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      storeLittle(value[i], at + 2 * i);
    }
  }
  void start(const Value& first)
  {
    last = first;
    item.forget();
  }
  template <typename Coder>
  Value code(Coder& coder, const Value& before, const Value& value)
  {
    return item.code(coder, before, value);
  }
};

struct NearInfraredAttribute
{
  using Value = std::uint16_t;
  static constexpr std::size_t kSize = 2;
  Value last = 0;
  SymbolModel changed{ 4 };
  ModelBank differences{ 2, 256 };

  static Value load(const char* at) { return loadLittle<Value>(at); }
  static void store(Value value, char* at) { storeLittle(value, at); }
  void start(Value first)
  {
    last = first;
    changed.forget();
    differences.forget();
  }
  template <typename Coder>
  Value code(Coder& coder, Value before, Value value)
  {
    const unsigned difference = before ^ value;
    const unsigned which = coder.symbol(
      changed.startIfForgotten(), ((difference & 0xff) != 0 ? 1u : 0u) | (difference > 0xff ? 2u : 0u));
    unsigned bytes[2] = { before & 0xffu, static_cast<unsigned>(before >> 8) };
    for (unsigned half = 0; half < 2; ++half)
    {
      if ((which >> half & 1) != 0)
      {
        const unsigned step = static_cast<std::uint8_t>((value >> 8 * half) - static_cast<int>(bytes[half]));
        bytes[half] = addToByte(bytes[half], coder.symbol(differences[half], step));
      }
    }
    return static_cast<Value>(bytes[0] | bytes[1] << 8);
  }
};

struct WavePacketAttribute
{
  using Value = WavePacketItem::Bytes;
  static constexpr std::size_t kSize = WavePacketItem::kSize;
  Value last{};
  WavePacketItem item;

  static Value load(const char* at)
  {
    Value value;
    std::copy_n(at, kSize, value.data());
    return value;
  }
  static void store(const Value& value, char* at) { std::copy_n(value.data(), kSize, at); }
  void start(const Value& first)
  {
    last = first;
    item.forget();
  }
  template <typename Coder>
  Value code(Coder& coder, const Value& before, Value value)
  {
    Value previous = before;
    item.code(coder, previous, value.data());
    return value;
  }
};

struct ByteAttribute
{
  using Value = std::uint8_t;
  static constexpr std::size_t kSize = 1;
  Value last = 0;
  SymbolModel differences{ 256 };

  static Value load(const char* at) { return byteAt(at, 0); }
  static void store(Value value, char* at) { *at = static_cast<char>(value); }
  void start(Value first)
  {
    last = first;
    differences.forget();
  }
  template <typename Coder>
  Value code(Coder& coder, Value before, Value value)
  {
    const unsigned step = static_cast<std::uint8_t>(value - before);
    return addToByte(before, coder.symbol(differences.startIfForgotten(), step));
  }
};

} // namespace pointhaptics::io
