/// @file
/// LAZ's items of version 1, which LASzip wrote in 2010 and 2011: read here, never written. Source: LASzip's
/// published format.
#pragma once

#include "IO/Las/Laz/Items/AttributeItems.h"
#include "IO/Las/Laz/Items/Point10Item.h"

#include <type_traits>

namespace pointhaptics::io
{

/// The first 20 bytes of point formats 0 to 5.
class FirstPoint10Item : public AnyPoint10Item
{
public:
  template <typename Decoder>
  Point10 code(Decoder& decoder, const PointLabel&, const Point10& last, const Point10&)
  {
    constexpr unsigned kMostLength = 19;
    Point10 point = last;
    const std::int32_t x = xModels_.code(decoder, medianOf(xDifferences_), 0);
    point.x = addWrapped(last.x, x);
    const unsigned xLength = xModels_.lengthOfLast();
    const std::int32_t y = yModels_.code(decoder, medianOf(yDifferences_), 0, std::min(xLength, kMostLength));
    point.y = addWrapped(last.y, y);
    const unsigned length = (xLength + yModels_.lengthOfLast()) / 2;
    point.z = zModels_.code(decoder, last.z, 0, std::min(length, kMostLength));
    codeOthers(decoder, point, length);
    xDifferences_[next_] = x;
    yDifferences_[next_] = y;
    next_ = (next_ + 1) % 3;
    return point;
  }

private:
  static std::int32_t medianOf(const std::array<std::int32_t, 3>& values)
  {
    return std::max(std::min(values[0], values[1]), std::min(std::max(values[0], values[1]), values[2]));
  }
  template <typename Decoder>
  void codeOthers(Decoder& decoder, Point10& point, unsigned length)
  {
    const unsigned changed = decoder.symbol(changed_, 0);
    const auto code = [&](IntegerModels& models, auto& value, unsigned context)
    { value = static_cast<std::decay_t<decltype(value)>>(models.code(decoder, value, 0, context)); };
    const auto codeSymbol = [&](ModelBank& models, std::uint8_t& value)
    { value = static_cast<std::uint8_t>(decoder.symbol(models[value], 0)); };
    (changed & 32) != 0 ? code(intensityModels_, point.intensity, 0) : void();
    (changed & 16) != 0 ? codeSymbol(returnsModels_, point.returns) : void();
    (changed & 8) != 0 ? codeSymbol(classificationModels_, point.classification) : void();
    (changed & 4) != 0 ? code(scanAngleModels_, point.scanAngle, length < 3 ? 1 : 0) : void();
    (changed & 2) != 0 ? codeSymbol(userDataModels_, point.userData) : void();
    (changed & 1) != 0 ? code(sourceModels_, point.source, 0) : void();
  }

  std::array<std::int32_t, 3> xDifferences_{};
  std::array<std::int32_t, 3> yDifferences_{};
  std::size_t next_ = 0;
  SymbolModel changed_{ 64 };
  ModelBank returnsModels_{ 256, 256 };
  ModelBank classificationModels_{ 256, 256 };
  ModelBank userDataModels_{ 256, 256 };
  IntegerModels intensityModels_{ 16, 1 };
  IntegerModels scanAngleModels_{ 8, 2 };
  IntegerModels sourceModels_{ 16, 1 };
  IntegerModels xModels_{ 32, 1 };
  IntegerModels yModels_{ 32, 20 };
  IntegerModels zModels_{ 32, 20 };
};

/// Times are the bits of their doubles.
class FirstGpsTimeItem : public NumberItem<std::uint64_t>
{
public:
  template <typename Decoder>
  Value code(Decoder& decoder, const PointLabel&, Value last, Value)
  {
    constexpr int kFull = 510; // 511: the time is that of the point before
    if (difference_ == 0)
    {
      const unsigned choice = decoder.symbol(zeroCases_, 0);
      difference_ = choice == 1 ? differences_.code(decoder, 0, 0, 0) : 0;
      return choice == 2 ? codeInt64(decoder, 0) : after(last, difference_);
    }
    const int multiple = static_cast<int>(decoder.symbol(multiples_, 0));
    return multiple < kFull ? after(last, codeMultiple(decoder, multiple))
      : multiple == kFull   ? codeInt64(decoder, 0)
                            : last;
  }

private:
  static Value after(Value time, std::int32_t difference)
  {
    return time + static_cast<std::uint64_t>(std::int64_t{ difference });
  }
  template <typename Decoder>
  std::int32_t codeMultiple(Decoder& decoder, int multiple)
  {
    constexpr int kMostMultiple = 509;
    const unsigned context = multiple == 1 ? 1u
      : multiple == 0                      ? 2u
      : multiple < 10                      ? 3u
      : multiple < 50                      ? 4u
                                           : 5u;
    const std::int32_t predicted = multiple == 0
      ? difference_ / 4
      : static_cast<std::int32_t>(
          static_cast<std::uint32_t>(multiple) * static_cast<std::uint32_t>(difference_));
    const std::int32_t difference = differences_.code(decoder, predicted, 0, context);
    const bool isExtreme = multiple == 0 || multiple == kMostMultiple;
    if (multiple == 1 || (isExtreme && ++extremes_ > 3))
    {
      difference_ = difference;
      extremes_ = 0;
    }
    return difference;
  }

  std::int32_t difference_ = 0;
  int extremes_ = 0;
  SymbolModel zeroCases_{ 3 };
  SymbolModel multiples_{ 512 };
  IntegerModels differences_{ 32, 6 };
};

class FirstColorItem : public AnyColorItem
{
public:
  template <typename Decoder>
  Value code(Decoder& decoder, const PointLabel&, const Value& last, const Value&)
  {
    const unsigned changed = decoder.symbol(changed_, 0);
    Value color = last;
    for (unsigned i = 0; i < 6; ++i)
    {
      if ((changed >> i & 1) != 0)
      {
        std::uint16_t& channel = color[i >> 1];
        const unsigned shift = (i & 1) * 8;
        const std::int32_t byte = bytes_.code(decoder, channel >> shift & 0xff, 0, i);
        channel = static_cast<std::uint16_t>(
          (channel & ~(0xffu << shift)) | static_cast<unsigned>(byte & 0xff) << shift);
      }
    }
    return color;
  }

private:
  SymbolModel changed_{ 64 };
  IntegerModels bytes_{ 8, 6 };
};

} // namespace pointhaptics::io
