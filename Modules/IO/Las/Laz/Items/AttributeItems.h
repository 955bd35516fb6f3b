/// @file
/// LAZ's coding of colours, near infrared and extra bytes, versions 2 and 3: each byte by its difference from
/// the point before. Source: LASzip's published format (M. Isenburg, 2013).
#pragma once

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

} // namespace pointhaptics::io
