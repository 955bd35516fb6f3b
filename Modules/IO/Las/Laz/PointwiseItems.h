/// @file
/// LAZ's pointwise compression (point formats 0 to 5): the items of a point one after the other, in one
/// stream. The first 20 bytes are of version 2, and items of version 1, which LASzip wrote in 2010 and 2011,
/// are read and never written. Source: LASzip's published format (M. Isenburg, 2013).
#pragma once

#include "IO/Las/Laz/Items/AttributeItems.h"
#include "IO/Las/Laz/Items/GpsTimeItem.h"
#include "IO/Las/Laz/Items/Layer.h"
#include "IO/Las/Laz/Items/PlaneModels.h"
#include "IO/Las/Laz/LazSchema.h"

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

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

/// One item of the record, in one of the two forms that files have it in.
template <typename Item, typename FirstItem>
class PointwiseItem
{
public:
  /// @p record: the first one of the chunk. Version 1 is as FirstItem has it.
  PointwiseItem(const LazSchema::Item& place, const char* record)
    : offset_(place.offset)
    , first_(place.version == 1 ? std::make_unique<FirstItem>() : nullptr)
    , last_(Item::load(record + offset_))
  {
    item_.start(last_);
  }
  template <typename Coder>
  void code(Coder& coder, char* record)
  {
    char* at = record + offset_;
    const Value value = Coder::kEncodes ? Item::load(at) : Value{};
    last_ = first_ ? first_->code(coder, PointLabel(), last_, value)
                   : item_.code(coder, PointLabel(), last_, value);
    Item::store(last_, at);
  }

private:
  using Value = typename Item::Value;

  std::size_t offset_;
  Item item_;
  std::unique_ptr<FirstItem> first_; ///< Of files of 2010 and 2011 only.
  Value last_;
};

/// The items of one chunk. Coder is ArithmeticDecoder or ArithmeticEncoder.
template <typename Coder>
class PointwiseItems
{
public:
  /// Begins a chunk whose first point is @p record.
  PointwiseItems(const LazSchema& schema, const char* record)
    : schema_(schema)
    , point_(schema.point, record)
    , firstBytes_(schema.extraBytes.version == 1
          ? std::make_unique<IntegerModels>(8, static_cast<unsigned>(schema.numberOfExtraBytes()))
          : nullptr)
    , bytes_(schema.numberOfExtraBytes())
    , lastBytes_(record + schema.recordLength - bytes_.size(), record + schema.recordLength)
  {
    const auto add = [record](auto& item, const LazSchema::Item& place)
    { place.offset != 0 ? void(item.emplace(place, record)) : void(); };
    add(gpsTime_, schema.gpsTime);
    add(color_, schema.color);
    add(wavePacket_, schema.wavePacket);
  }
  /// For a decoder: begins to read the chunk whose content behind its first point is @p bytes.
  void begin(std::string_view bytes, bool) { coder_ = Coder(bytes); }
  /// Codes @p count records of schema.recordLength bytes.
  void code(char* records, std::size_t count);
  bool isDamaged() const { return coder_.isDamaged(); }
  /// Bytes of the stream that a decoder has read.
  std::size_t position() const { return coder_.position(); }
  /// For an encoder: ends the chunk of @p count points, and adds it to @p chunk.
  void finish(std::string& chunk, std::size_t) { chunk += coder_.finish(); }

private:
  const LazSchema& schema_;
  Coder coder_;
  PointwiseItem<Point10Item, FirstPoint10Item> point_;
  std::optional<PointwiseItem<GpsTimeItem<true>, FirstGpsTimeItem>> gpsTime_;
  std::optional<PointwiseItem<ColorItem, FirstColorItem>> color_;
  std::optional<PointwiseItem<WavePacketItem, WavePacketItem>> wavePacket_; ///< There is one version.
  std::unique_ptr<IntegerModels> firstBytes_; ///< Of version 1, in the place of bytes_.
  std::vector<ByteItem> bytes_;
  std::vector<std::uint8_t> lastBytes_;
};

} // namespace pointhaptics::io
