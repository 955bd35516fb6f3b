/// @file
/// LAZ's coding of the first 20 bytes of point formats 0 to 5, version 2. Source: LASzip's published format
/// (M. Isenburg, 2013).
#pragma once

#include "IO/Las/Laz/Items/Layer.h"
#include "IO/Las/Laz/Items/PlaneModels.h"

#include <array>

namespace pointhaptics::io
{

/// The fields of the 20 bytes.
struct Point10
{
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::int32_t z = 0;
  std::uint16_t intensity = 0;
  std::uint8_t returns = 0; ///< 3 bits number, 3 of how many, scan direction, edge of the flight line
  std::uint8_t classification = 0;
  std::uint8_t scanAngle = 0;
  std::uint8_t userData = 0;
  std::uint16_t source = 0;

  unsigned returnNumber() const { return returns & 7u; }
  unsigned numberOfReturns() const { return returns >> 3 & 7u; }
  unsigned scanDirection() const { return returns >> 6 & 1u; }
};

/// The items of such points.
struct AnyPoint10Item
{
  using Value = Point10;

  void start(const Point10&) {}
  static Point10 load(const char* record)
  {
    return { loadLittle<std::int32_t>(record), loadLittle<std::int32_t>(record + 4),
      loadLittle<std::int32_t>(record + 8), loadLittle<std::uint16_t>(record + 12), byteAt(record, 14),
      byteAt(record, 15), byteAt(record, 16), byteAt(record, 17), loadLittle<std::uint16_t>(record + 18) };
  }
  static void store(const Point10& point, char* record)
  {
    storeLittle(point.x, record);
    storeLittle(point.y, record + 4);
    storeLittle(point.z, record + 8);
    storeLittle(point.intensity, record + 12);
    record[14] = static_cast<char>(point.returns);
    record[15] = static_cast<char>(point.classification);
    record[16] = static_cast<char>(point.scanAngle);
    record[17] = static_cast<char>(point.userData);
    storeLittle(point.source, record + 18);
  }
};

class Point10Item : public AnyPoint10Item
{
public:
  template <typename Coder>
  Point10 code(Coder& coder, const PointLabel&, const Point10& last, const Point10& value)
  {
    Point10 point = Coder::kEncodes ? value : last;
    const unsigned context = codeOthers(coder, last, point);
    const bool isSingle = point.numberOfReturns() == 1;
    const unsigned length = plane_.code(coder, context, isSingle, last, point);
    std::int32_t& height = heights_[returnLevel(point.returnNumber(), point.numberOfReturns())];
    height = point.z = zModels_.code(coder, height, point.z, lengthContext(length, 18, isSingle));
    return point;
  }

private:
  enum Changed : unsigned
  {
    kSource = 1,
    kUserData = 2,
    kScanAngle = 4,
    kClassification = 8,
    kIntensity = 16,
    kReturns = 32
  };

  static unsigned contextOf(const Point10& point)
  {
    return kReturnContext10[point.numberOfReturns()][point.returnNumber()];
  }
  unsigned changesOf(const Point10& last, const Point10& point) const
  {
    return (point.source != last.source ? kSource : 0u) | (point.userData != last.userData ? kUserData : 0u) |
      (point.scanAngle != last.scanAngle ? kScanAngle : 0u) |
      (point.classification != last.classification ? kClassification : 0u) |
      (point.intensity != intensities_[contextOf(point)] ? kIntensity : 0u) |
      (point.returns != last.returns ? kReturns : 0u);
  }

  /// All but the position. @return the context of the returns.
  template <typename Coder>
  unsigned codeOthers(Coder& coder, const Point10& last, Point10& point)
  {
    const unsigned changed = coder.symbol(changed_, Coder::kEncodes ? changesOf(last, point) : 0);
    const auto codeSymbol = [&](Changed which, ModelBank& models, std::uint8_t before, std::uint8_t& value)
    { value = (changed & which) != 0 ? std::uint8_t(coder.symbol(models[before], value)) : value; };
    codeSymbol(kReturns, returnsModels_, last.returns, point.returns);
    const unsigned context = contextOf(point);
    if ((changed & kIntensity) != 0)
    {
      intensities_[context] = static_cast<std::uint16_t>(
        intensityModels_.code(coder, intensities_[context], point.intensity, std::min(context, 3u)));
    }
    point.intensity = intensities_[context];
    codeSymbol(kClassification, classificationModels_, last.classification, point.classification);
    if ((changed & kScanAngle) != 0)
    {
      point.scanAngle =
        codeByte(coder, scanAngleModels_[point.scanDirection()], last.scanAngle, point.scanAngle);
    }
    codeSymbol(kUserData, userDataModels_, last.userData, point.userData);
    if ((changed & kSource) != 0)
    {
      point.source = static_cast<std::uint16_t>(sourceModels_.code(coder, last.source, point.source));
    }
    return context;
  }

  PlaneModels<16> plane_;
  std::array<std::uint16_t, 16> intensities_{};
  std::array<std::int32_t, 8> heights_{};
  SymbolModel changed_{ 64 };
  ModelBank returnsModels_{ 256, 256 };
  ModelBank classificationModels_{ 256, 256 };
  ModelBank scanAngleModels_{ 2, 256 };
  ModelBank userDataModels_{ 256, 256 };
  IntegerModels intensityModels_{ 16, 4 };
  IntegerModels sourceModels_{ 16, 1 };
  IntegerModels zModels_{ 32, 20 };
};

} // namespace pointhaptics::io
