/// @file
/// LAZ's coding of colours, near infrared and extra bytes, versions 2 and 3: each byte by its difference from
/// the point before; and of the 29 bytes that point to a waveform, versions 1 (point formats 4 and 5) and 3
/// (9 and 10). Source: LASzip's published format (M. Isenburg, 2013).
#pragma once

#include "IO/Las/Laz/IntegerModels.h"
#include "IO/Las/Laz/Items/Layer.h"
#include "IO/Las/Laz/SymbolModel.h"

#include <algorithm>
#include <cstdint>

namespace pointhaptics::io
{

/// Red, green and blue of 16 bits.
using AnyColorItem = NumbersItem<std::uint16_t, 3>;

/// Green and blue are predicted as red changed.
class ColorItem : public AnyColorItem
{
public:
  template <typename Coder>
  Value code(Coder& coder, const PointLabel&, const Value& last, const Value& color)
  {
    unsigned changed = 0;
    if constexpr (Coder::kEncodes)
    {
      changed = changedBytes(last, color);
    }
    changed = coder.symbol(changed_, changed);
    Value result{};
    const unsigned redLow = codeByteOf(coder, changed, 0, last, color);
    const unsigned redHigh = codeByteOf(coder, changed, 1, last, color);
    result[0] = word(redLow, redHigh);
    if ((changed & kIsColored) == 0)
    {
      result[1] = result[2] = result[0];
      return result;
    }
    unsigned green[2];
    unsigned blue[2];
    for (unsigned half = 0; half < 2; ++half)
    {
      const int red = static_cast<int>(half == 0 ? redLow : redHigh);
      int shift = red - byteOf(last, half);
      green[half] = codeByteOf(coder, changed, 2 + half, last, color, shift);
      shift = (shift + static_cast<int>(green[half]) - byteOf(last, 2 + half)) / 2;
      blue[half] = codeByteOf(coder, changed, 4 + half, last, color, shift);
    }
    result[1] = word(green[0], green[1]);
    result[2] = word(blue[0], blue[1]);
    return result;
  }

private:
  static constexpr unsigned kIsColored = 1u << 6;

  /// Byte @p i of red low, red high, green low and so on.
  static int byteOf(const Value& color, unsigned i) { return color[i >> 1] >> ((i & 1) * 8) & 0xff; }
  static std::uint16_t word(unsigned low, unsigned high)
  {
    return static_cast<std::uint16_t>(low | high << 8);
  }
  static unsigned changedBytes(const Value& last, const Value& color)
  {
    unsigned changed = color[0] != color[1] || color[0] != color[2] ? kIsColored : 0;
    for (unsigned i = 0; i < 6; ++i)
    {
      changed |= byteOf(last, i) != byteOf(color, i) ? 1u << i : 0u;
    }
    return changed;
  }
  /// Byte @p i, which is predicted to have changed by @p shift where it changed.
  template <typename Coder>
  unsigned codeByteOf(
    Coder& coder, unsigned changed, unsigned i, const Value& last, const Value& color, int shift = 0)
  {
    const int before = byteOf(last, i);
    return (changed >> i & 1) == 0
      ? static_cast<unsigned>(before)
      : codeByte(coder, differences_[i], std::clamp(before + shift, 0, 255), byteOf(color, i));
  }

  SymbolModel changed_{ 128 };
  ModelBank differences_{ 6, 256 };
};

class NearInfraredItem : public NumberItem<std::uint16_t>
{
public:
  static constexpr bool kIsAttribute = true;

  template <typename Coder>
  Value code(Coder& coder, const PointLabel&, Value last, Value value)
  {
    const unsigned difference = last ^ value;
    const unsigned which =
      coder.symbol(changed_, ((difference & 0xff) != 0 ? 1u : 0u) | (difference > 0xff ? 2u : 0u));
    unsigned bytes[2] = { last & 0xffu, static_cast<unsigned>(last >> 8) };
    for (unsigned half = 0; half < 2; ++half)
    {
      if ((which >> half & 1) != 0)
      {
        bytes[half] = codeByte(coder, differences_[half], static_cast<int>(bytes[half]), value >> 8 * half);
      }
    }
    return static_cast<Value>(bytes[0] | bytes[1] << 8);
  }

private:
  SymbolModel changed_{ 4 };
  ModelBank differences_{ 2, 256 };
};

class ByteItem : public NumberItem<std::uint8_t>
{
public:
  static constexpr bool kIsAttribute = true;

  template <typename Coder>
  Value code(Coder& coder, const PointLabel&, Value last, Value value)
  {
    return codeByte(coder, differences_, last, value);
  }

private:
  SymbolModel differences_{ 256 };
};

/// Index of the descriptor, offset and size of the packet, place of the return in it, direction.
class WavePacketItem : public NumbersItem<char, 29>
{
public:
  template <typename Coder>
  Value code(Coder& coder, const PointLabel&, const Value& last, Value value)
  {
    value[0] = static_cast<char>(coder.symbol(index_, byteAt(value.data(), 0)));
    storeLittle(
      codeOffset(coder, last.data(), loadLittle<std::uint64_t>(value.data() + 1)), value.data() + 1);
    codeNumber(coder, sizes_, 9, 0, last, value);
    codeNumber(coder, places_, 13, 0, last, value);
    for (unsigned axis = 0; axis < 3; ++axis)
    {
      codeNumber(coder, directions_, 17 + 4 * axis, axis, last, value);
    }
    return value;
  }

private:
  enum OffsetCase : unsigned
  {
    kSame,
    kBehind, ///< directly behind the packet before
    kNear,   ///< a difference of 32 bits
    kFar
  };

  template <typename Coder>
  std::uint64_t codeOffset(Coder& coder, const char* last, std::uint64_t wanted)
  {
    const std::uint64_t before = loadLittle<std::uint64_t>(last + 1);
    const std::uint64_t behind = before + loadLittle<std::uint32_t>(last + 9);
    const std::int32_t difference = static_cast<std::int32_t>(wanted - before);
    const bool isNear = before + static_cast<std::uint64_t>(std::int64_t{ difference }) == wanted;
    const unsigned choice = wanted == before ? kSame : wanted == behind ? kBehind : isNear ? kNear : kFar;
    lastCase_ = coder.symbol(offsetCases_[lastCase_], choice);
    switch (lastCase_)
    {
      case kSame:
        return before;
      case kBehind:
        return behind;
      case kNear:
        lastDifference_ = offsets_.code(coder, lastDifference_, difference);
        return before + static_cast<std::uint64_t>(std::int64_t{ lastDifference_ });
      default:
        return codeInt64(coder, wanted);
    }
  }
  template <typename Coder>
  static void codeNumber(
    Coder& coder, IntegerModels& models, std::size_t at, unsigned context, const Value& last, Value& value)
  {
    storeLittle(models.code(coder, loadLittle<std::int32_t>(last.data() + at),
                  loadLittle<std::int32_t>(value.data() + at), context),
      value.data() + at);
  }

  SymbolModel index_{ 256 };
  ModelBank offsetCases_{ 4, 4 };
  IntegerModels offsets_{ 32, 1 };
  IntegerModels sizes_{ 32, 1 };
  IntegerModels places_{ 32, 1 };
  IntegerModels directions_{ 32, 3 };
  unsigned lastCase_ = 0;
  std::int32_t lastDifference_ = 0;
};

} // namespace pointhaptics::io
