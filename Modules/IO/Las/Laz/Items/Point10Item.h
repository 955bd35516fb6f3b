/// @file
/// LAZ's coding of the first 20 bytes of point formats 0 to 5, version 2. Source: LASzip's published format
/// (M. Isenburg, 2013).
#pragma once

#include "Bytes/LittleEndian.h"
#include "IO/Las/Laz/IntegerModels.h"
#include "IO/Las/Laz/Items/ReturnContexts.h"
#include "IO/Las/Laz/Items/StreamingMedian.h"

#include <array>

namespace pointhaptics::io
{

/// The fields of the 20 bytes.
struct Point10
{
  static constexpr std::size_t kSize = 20;

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

  static Point10 load(const char* record)
  {
    return { loadLittle<std::int32_t>(record), loadLittle<std::int32_t>(record + 4),
      loadLittle<std::int32_t>(record + 8), loadLittle<std::uint16_t>(record + 12), byteAt(record, 14),
      byteAt(record, 15), byteAt(record, 16), byteAt(record, 17), loadLittle<std::uint16_t>(record + 18) };
  }
  void store(char* record) const
  {
    storeLittle(x, record);
    storeLittle(y, record + 4);
    storeLittle(z, record + 8);
    storeLittle(intensity, record + 12);
    record[14] = static_cast<char>(returns);
    record[15] = static_cast<char>(classification);
    record[16] = static_cast<char>(scanAngle);
    record[17] = static_cast<char>(userData);
    storeLittle(source, record + 18);
  }
};

/// @p base + @p difference, which may wrap in damaged streams.
inline std::int32_t addWrapped(std::int32_t base, std::int32_t difference)
{
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(base) + static_cast<std::uint32_t>(difference));
}
inline std::int32_t subtractWrapped(std::int32_t value, std::int32_t base)
{
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(value) - static_cast<std::uint32_t>(base));
}

class Point10Item
{
public:
  static constexpr std::size_t kSize = Point10::kSize;

  void start(const char* record)
  {
    last_ = Point10::load(record);
    xMedians_ = {};
    yMedians_ = {};
    intensities_ = {};
    heights_ = {};
    changed_.start();
    forgetModels();
  }
  template <typename Coder>
  void code(Coder& coder, char* record)
  {
    Point10 point = Coder::kEncodes ? Point10::load(record) : last_;
    const unsigned context = codeOthers(coder, point);
    codePosition(coder, point, context);
    last_ = point;
    point.store(record);
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

  void forgetModels()
  {
    for (ModelBank* bank : { &returnsModels_, &classificationModels_, &scanAngleModels_, &userDataModels_ })
    {
      bank->forget();
    }
    for (IntegerModels* models : { &intensityModels_, &sourceModels_, &xModels_, &yModels_, &zModels_ })
    {
      models->forget();
    }
  }
  static unsigned contextOf(const Point10& point)
  {
    return kReturnContext10[point.numberOfReturns()][point.returnNumber()];
  }
  unsigned changesOf(const Point10& point) const
  {
    return (point.source != last_.source ? kSource : 0u) |
      (point.userData != last_.userData ? kUserData : 0u) |
      (point.scanAngle != last_.scanAngle ? kScanAngle : 0u) |
      (point.classification != last_.classification ? kClassification : 0u) |
      (point.intensity != intensities_[contextOf(point)] ? kIntensity : 0u) |
      (point.returns != last_.returns ? kReturns : 0u);
  }

  /// All but the position. @return the context of the returns.
  template <typename Coder>
  unsigned codeOthers(Coder& coder, Point10& point)
  {
    const unsigned changed = coder.symbol(changed_, Coder::kEncodes ? changesOf(point) : 0);
    if ((changed & kReturns) != 0)
    {
      point.returns = static_cast<std::uint8_t>(coder.symbol(returnsModels_[last_.returns], point.returns));
    }
    const unsigned context = contextOf(point);
    if ((changed & kIntensity) != 0)
    {
      intensities_[context] = static_cast<std::uint16_t>(
        intensityModels_.code(coder, intensities_[context], point.intensity, std::min(context, 3u)));
    }
    point.intensity = intensities_[context];
    if ((changed & kClassification) != 0)
    {
      point.classification = static_cast<std::uint8_t>(
        coder.symbol(classificationModels_[last_.classification], point.classification));
    }
    if ((changed & kScanAngle) != 0)
    {
      const unsigned difference = static_cast<std::uint8_t>(point.scanAngle - last_.scanAngle);
      point.scanAngle = static_cast<std::uint8_t>(
        last_.scanAngle + coder.symbol(scanAngleModels_[point.scanDirection()], difference));
    }
    if ((changed & kUserData) != 0)
    {
      point.userData =
        static_cast<std::uint8_t>(coder.symbol(userDataModels_[last_.userData], point.userData));
    }
    if ((changed & kSource) != 0)
    {
      point.source = static_cast<std::uint16_t>(sourceModels_.code(coder, last_.source, point.source));
    }
    return context;
  }
  template <typename Coder>
  void codePosition(Coder& coder, Point10& point, unsigned context)
  {
    const bool isSingle = point.numberOfReturns() == 1;
    StreamingMedian& xMedian = xMedians_[context];
    const std::int32_t x =
      xModels_.code(coder, xMedian.get(), subtractWrapped(point.x, last_.x), isSingle ? 1 : 0);
    point.x = addWrapped(last_.x, x);
    xMedian.add(x);
    StreamingMedian& yMedian = yMedians_[context];
    const unsigned xLength = xModels_.lengthOfLast();
    const std::int32_t y = yModels_.code(
      coder, yMedian.get(), subtractWrapped(point.y, last_.y), lengthContext(xLength, 20, isSingle));
    point.y = addWrapped(last_.y, y);
    yMedian.add(y);
    const unsigned length = (xLength + yModels_.lengthOfLast()) / 2;
    std::int32_t& height = heights_[returnLevel(point.returnNumber(), point.numberOfReturns())];
    height = point.z = zModels_.code(coder, height, point.z, lengthContext(length, 18, isSingle));
  }

  Point10 last_;
  std::array<StreamingMedian, 16> xMedians_;
  std::array<StreamingMedian, 16> yMedians_;
  std::array<std::uint16_t, 16> intensities_{};
  std::array<std::int32_t, 8> heights_{};
  SymbolModel changed_{ 64 };
  ModelBank returnsModels_{ 256, 256 };
  ModelBank classificationModels_{ 256, 256 };
  ModelBank scanAngleModels_{ 2, 256 };
  ModelBank userDataModels_{ 256, 256 };
  IntegerModels intensityModels_{ 16, 4 };
  IntegerModels sourceModels_{ 16, 1 };
  IntegerModels xModels_{ 32, 2 };
  IntegerModels yModels_{ 32, 22 };
  IntegerModels zModels_{ 32, 20 };
};

} // namespace pointhaptics::io
