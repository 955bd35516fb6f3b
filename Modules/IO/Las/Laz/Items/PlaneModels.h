/// @file
/// LAZ's coding of x and y: the difference from the point before, predicted by the median of earlier ones in
/// the same context, which returns tell. Source: LASzip's published format (M. Isenburg, 2013), also of the
/// tables, which say what holds for files whose returns are counted wrongly.
#pragma once

#include "IO/Las/Laz/IntegerModels.h"

#include <algorithm>
#include <array>
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

/// @p base + @p difference, which may wrap in damaged streams.
inline std::int32_t addWrapped(std::int32_t base, std::int32_t difference)
{
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(base) + static_cast<std::uint32_t>(difference));
}
inline std::int32_t subtractWrapped(std::int32_t value, std::int32_t base)
{
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(value) - static_cast<std::uint32_t>(base));
}

/// The median of about the last five numbers: a predictor that one outlier does not disturb. Each new number
/// pushes out the largest or the smallest, in turns that depend on where it falls.
class StreamingMedian
{
public:
  std::int32_t get() const { return sorted_[2]; }
  void add(std::int32_t value)
  {
    if (dropsLargest_)
    {
      dropsLargest_ = value < sorted_[2];
      std::size_t at = 4;
      for (const std::size_t least = dropsLargest_ ? 0 : 3; at > least && value < sorted_[at - 1]; --at)
      {
        sorted_[at] = sorted_[at - 1];
      }
      sorted_[at] = value;
    }
    else
    {
      dropsLargest_ = !(sorted_[2] < value);
      std::size_t at = 0;
      for (const std::size_t most = dropsLargest_ ? 1 : 4; at < most && sorted_[at + 1] < value; ++at)
      {
        sorted_[at] = sorted_[at + 1];
      }
      sorted_[at] = value;
    }
  }

private:
  std::array<std::int32_t, 5> sorted_{};
  bool dropsLargest_ = true;
};

/// Models of x and y, whose medians each of @p Contexts contexts has of its own.
template <std::size_t Contexts>
class PlaneModels
{
public:
  /// Codes x and y of @p point, the one before which is @p last. @return the context of z, but for its bit of
  /// single returns: the mean number of bits of the two differences.
  template <typename Coder, typename Point>
  unsigned code(Coder& coder, unsigned context, bool isSingle, const Point& last, Point& point)
  {
    StreamingMedian& xMedian = xMedians_[context];
    const std::int32_t x =
      xModels_.code(coder, xMedian.get(), subtractWrapped(point.x, last.x), isSingle ? 1 : 0);
    point.x = addWrapped(last.x, x);
    xMedian.add(x);
    StreamingMedian& yMedian = yMedians_[context];
    const unsigned xLength = xModels_.lengthOfLast();
    const std::int32_t y = yModels_.code(
      coder, yMedian.get(), subtractWrapped(point.y, last.y), lengthContext(xLength, 20, isSingle));
    point.y = addWrapped(last.y, y);
    yMedian.add(y);
    return (xLength + yModels_.lengthOfLast()) / 2;
  }

private:
  std::array<StreamingMedian, Contexts> xMedians_;
  std::array<StreamingMedian, Contexts> yMedians_;
  IntegerModels xModels_{ 32, 2 };
  IntegerModels yModels_{ 32, 22 };
};

} // namespace pointhaptics::io
