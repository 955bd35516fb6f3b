/// @file
/// LAZ's coding of colours, versions 2 and 3: each byte by its difference from the point before; green and
/// blue as red changed. Source: LASzip's published format (M. Isenburg, 2013).
#pragma once

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
class ColorItem
{
public:
  using Color = std::array<std::uint16_t, 3>;

  void forget()
  {
    changed_.forget();
    differences_.forget();
  }
  /// Codes @p color, the one before which is @p last; returns the colour.
  template <typename Coder>
  Color code(Coder& coder, const Color& last, const Color& color)
  {
    unsigned changed = 0;
    if constexpr (Coder::kEncodes)
    {
      changed = changedBytes(last, color);
    }
    changed = coder.symbol(changed_.startIfForgotten(), changed);
    Color result{};
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
  static int byteOf(const Color& color, unsigned i) { return color[i >> 1] >> ((i & 1) * 8) & 0xff; }
  static std::uint16_t word(unsigned low, unsigned high)
  {
    return static_cast<std::uint16_t>(low | high << 8);
  }
  static unsigned changedBytes(const Color& last, const Color& color)
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

} // namespace pointhaptics::io
