/// @file
/// LAZ's items of version 1, which LASzip wrote in 2010 and 2011: read here, never written. Source: LASzip's
/// published format.
#pragma once

#include "IO/Las/Laz/ArithmeticDecoder.h"
#include "IO/Las/Laz/Items/ColorItem.h"
#include "IO/Las/Laz/Items/Point10Item.h"

#include <vector>

namespace pointhaptics::io
{

/// The first 20 bytes of point formats 0 to 5.
class FirstPoint10Item
{
public:
  static constexpr std::size_t kSize = Point10::kSize;

  void start(const char* record);
  void code(ArithmeticDecoder& decoder, char* record);

private:
  void codeOthers(ArithmeticDecoder& decoder, Point10& point, unsigned length);

  Point10 last_;
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
class FirstGpsTimeItem
{
public:
  void start(std::uint64_t first);
  std::uint64_t code(ArithmeticDecoder& decoder);

private:
  void codeMultiple(ArithmeticDecoder& decoder, int multiple);

  std::uint64_t time_ = 0;
  std::int32_t difference_ = 0;
  int extremes_ = 0;
  SymbolModel zeroCases_{ 3 };
  SymbolModel multiples_{ 512 };
  IntegerModels differences_{ 32, 6 };
};

class FirstColorItem
{
public:
  void forget()
  {
    changed_.forget();
    bytes_.forget();
  }
  ColorItem::Color code(ArithmeticDecoder& decoder, const ColorItem::Color& last);

private:
  SymbolModel changed_{ 64 };
  IntegerModels bytes_{ 8, 6 };
};

} // namespace pointhaptics::io
