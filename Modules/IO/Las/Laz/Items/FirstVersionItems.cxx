#include "IO/Las/Laz/Items/FirstVersionItems.h"

namespace pointhaptics::io
{

namespace
{

std::int32_t medianOf(const std::array<std::int32_t, 3>& values)
{
  return std::max(std::min(values[0], values[1]), std::min(std::max(values[0], values[1]), values[2]));
}

} // namespace

void FirstPoint10Item::start(const char* record)
{
  last_ = Point10::load(record);
  xDifferences_ = yDifferences_ = {};
  next_ = 0;
  changed_.start();
  for (ModelBank* bank : { &returnsModels_, &classificationModels_, &userDataModels_ })
  {
    bank->forget();
  }
  for (IntegerModels* models :
    { &intensityModels_, &scanAngleModels_, &sourceModels_, &xModels_, &yModels_, &zModels_ })
  {
    models->forget();
  }
}

void FirstPoint10Item::code(ArithmeticDecoder& decoder, char* record)
{
  constexpr unsigned kMostLength = 19;
  Point10 point = last_;
  const std::int32_t x = xModels_.code(decoder, medianOf(xDifferences_), 0);
  point.x = addWrapped(last_.x, x);
  const unsigned xLength = xModels_.lengthOfLast();
  const std::int32_t y = yModels_.code(decoder, medianOf(yDifferences_), 0, std::min(xLength, kMostLength));
  point.y = addWrapped(last_.y, y);
  const unsigned length = (xLength + yModels_.lengthOfLast()) / 2;
  point.z = zModels_.code(decoder, last_.z, 0, std::min(length, kMostLength));
  codeOthers(decoder, point, length);
  xDifferences_[next_] = x;
  yDifferences_[next_] = y;
  next_ = (next_ + 1) % 3;
  last_ = point;
  point.store(record);
}

void FirstPoint10Item::codeOthers(ArithmeticDecoder& decoder, Point10& point, unsigned length)
{
  const unsigned changed = decoder.symbol(changed_);
  if ((changed & 32) != 0)
  {
    point.intensity = static_cast<std::uint16_t>(intensityModels_.code(decoder, last_.intensity, 0));
  }
  if ((changed & 16) != 0)
  {
    point.returns = static_cast<std::uint8_t>(decoder.symbol(returnsModels_[last_.returns]));
  }
  if ((changed & 8) != 0)
  {
    point.classification =
      static_cast<std::uint8_t>(decoder.symbol(classificationModels_[last_.classification]));
  }
  if ((changed & 4) != 0)
  {
    point.scanAngle =
      static_cast<std::uint8_t>(scanAngleModels_.code(decoder, last_.scanAngle, 0, length < 3 ? 1 : 0));
  }
  if ((changed & 2) != 0)
  {
    point.userData = static_cast<std::uint8_t>(decoder.symbol(userDataModels_[last_.userData]));
  }
  if ((changed & 1) != 0)
  {
    point.source = static_cast<std::uint16_t>(sourceModels_.code(decoder, last_.source, 0));
  }
}

void FirstGpsTimeItem::start(std::uint64_t first)
{
  time_ = first;
  difference_ = 0;
  extremes_ = 0;
  zeroCases_.start();
  multiples_.start();
  differences_.forget();
}

std::uint64_t FirstGpsTimeItem::code(ArithmeticDecoder& decoder)
{
  constexpr int kFull = 510; // 511: the time is that of the point before
  if (difference_ == 0)
  {
    const unsigned choice = decoder.symbol(zeroCases_);
    if (choice == 1)
    {
      difference_ = differences_.code(decoder, 0, 0, 0);
      time_ += static_cast<std::uint64_t>(std::int64_t{ difference_ });
    }
    time_ = choice == 2 ? decoder.int64() : time_;
    return time_;
  }
  const int multiple = static_cast<int>(decoder.symbol(multiples_));
  if (multiple < kFull)
  {
    codeMultiple(decoder, multiple);
  }
  else if (multiple == kFull)
  {
    time_ = decoder.int64();
  }
  return time_;
}

void FirstGpsTimeItem::codeMultiple(ArithmeticDecoder& decoder, int multiple)
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
  time_ += static_cast<std::uint64_t>(std::int64_t{ difference });
  if (multiple == 1)
  {
    difference_ = difference;
    extremes_ = 0;
  }
  else if ((multiple == 0 || multiple == kMostMultiple) && ++extremes_ > 3)
  {
    difference_ = difference;
    extremes_ = 0;
  }
}

ColorItem::Color FirstColorItem::code(ArithmeticDecoder& decoder, const ColorItem::Color& last)
{
  const unsigned changed = decoder.symbol(changed_.startIfForgotten());
  ColorItem::Color color = last;
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

} // namespace pointhaptics::io
