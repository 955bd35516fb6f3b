/// @file
/// Contexts that LAZ takes from the number of a return and the number of returns of its pulse. The tables are
/// LASzip's published ones; they also say what holds for files whose returns are counted wrongly.
#pragma once

#include <algorithm>
#include <cstdint>

namespace pointhaptics::io
{

/// One of 16 contexts of point formats 0 to 5: [number of returns][return].
constexpr std::uint8_t kReturnContext10[8][8] = {
  { 15, 14, 13, 12, 11, 10, 9, 8 },
  { 14, 0, 1, 3, 6, 10, 10, 9 },
  { 13, 1, 2, 4, 7, 11, 11, 10 },
  { 12, 3, 4, 5, 8, 12, 12, 11 },
  { 11, 6, 7, 8, 9, 13, 13, 12 },
  { 10, 10, 11, 12, 13, 14, 14, 13 },
  { 9, 10, 11, 12, 13, 14, 15, 14 },
  { 8, 9, 10, 11, 12, 13, 14, 15 },
};

/// One of 6 contexts of point formats 6 to 10: [number of returns][return].
constexpr std::uint8_t kReturnContext14[16][16] = {
  { 0, 1, 2, 3, 4, 5, 3, 4, 4, 5, 5, 5, 5, 5, 5, 5 },
  { 1, 0, 1, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3 },
  { 2, 1, 2, 4, 4, 4, 4, 4, 4, 4, 4, 3, 3, 3, 3, 3 },
  { 3, 3, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4 },
  { 4, 3, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4 },
  { 5, 3, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4 },
  { 3, 3, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4 },
  { 4, 3, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4 },
  { 4, 3, 4, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4 },
  { 5, 3, 4, 4, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4 },
  { 5, 3, 4, 4, 4, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4 },
  { 5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 4, 4, 4 },
  { 5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5, 4, 4 },
  { 5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5, 4 },
  { 5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5 },
  { 5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5 },
};

/// How many returns lie between this one and the last of its pulse, 0..7.
inline unsigned returnLevel(unsigned number, unsigned ofNumber)
{
  return std::min(number > ofNumber ? number - ofNumber : ofNumber - number, 7u);
}

/// Contexts of y and z from the lengths of the differences before them: even ones, with the lowest bit for
/// pulses of one return.
inline unsigned lengthContext(unsigned length, unsigned most, bool isSingle)
{
  return (length < most ? length & ~1u : most) + (isSingle ? 1u : 0u);
}

} // namespace pointhaptics::io
