/// @file
/// LAZ's coding of colours, near infrared and extra bytes, versions 2 and 3: each byte by its difference from
/// the point before. Source: LASzip's published format (M. Isenburg, 2013).
#pragma once

#include "IO/Las/Laz/Items/Layer.h"
#include "IO/Las/Laz/SymbolModel.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace pointhaptics::io
{

/// A byte as it comes to be when @p difference is added to it, modulo 256.
inline std::uint8_t addToByte(unsigned byte, unsigned difference)
{
  return static_cast<std::uint8_t>(byte + difference);
}

/// Red, green and blue of 16 bits.
struct AnyColorItem
{
  using Value = std::array<std::uint16_t, 3>;
  static constexpr bool kIsAttribute = true;

  void start(const Value&) {}
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
};

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
    const unsigned redLow = codeByte(coder, changed, 0, byteOf(last, 0), byteOf(color, 0));
    const unsigned redHigh = codeByte(coder, changed, 1, byteOf(last, 1), byteOf(color, 1));
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
      green[half] =
        codeShifted(coder, changed, 2 + half, byteOf(last, 2 + half), shift, byteOf(color, 2 + half));
      shift = (shift + static_cast<int>(green[half]) - byteOf(last, 2 + half)) / 2;
      blue[half] =
        codeShifted(coder, changed, 4 + half, byteOf(last, 4 + half), shift, byteOf(color, 4 + half));
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
  template <typename Coder>
  unsigned codeByte(Coder& coder, unsigned changed, unsigned i, int predicted, int value)
  {
    if ((changed >> i & 1) == 0)
    {
      return static_cast<unsigned>(predicted);
    }
    const unsigned difference = static_cast<std::uint8_t>(value - predicted);
    return addToByte(static_cast<unsigned>(predicted), coder.symbol(differences_[i], difference));
  }
  template <typename Coder>
  unsigned codeShifted(Coder& coder, unsigned changed, unsigned i, int last, int shift, int value)
  {
    return (changed >> i & 1) == 0 ? static_cast<unsigned>(last)
                                   : codeByte(coder, changed, i, std::clamp(last + shift, 0, 255), value);
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
        const unsigned step = static_cast<std::uint8_t>((value >> 8 * half) - static_cast<int>(bytes[half]));
        bytes[half] = addToByte(bytes[half], coder.symbol(differences_[half], step));
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
    const unsigned step = static_cast<std::uint8_t>(value - last);
    return addToByte(last, coder.symbol(differences_, step));
  }

private:
  SymbolModel differences_{ 256 };
};

} // namespace pointhaptics::io
