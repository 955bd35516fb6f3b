/// @file
/// LAZ's layers of the first 30 bytes of point formats 6 to 10, version 3: the one of x, y, returns and
/// channels first, whose labels are contexts for the others. Source: LASzip's published format (M. Isenburg,
/// 2013, and the notes on its extension to LAS 1.4).
#pragma once

#include "IO/Las/Laz/Items/Channels.h"
#include "IO/Las/Laz/Items/GpsTimeItem.h"
#include "IO/Las/Laz/Items/Point10Item.h"

namespace pointhaptics::io
{

/// Byte offsets in the record.
enum Point14Offset : std::size_t
{
  kIntensityOf14 = 12,
  kReturnsOf14 = 14, ///< 4 bits number, 4 of how many
  kFlagsOf14 = 15,   ///< 4 bits classification flags, 2 channel, scan direction, edge of the flight line
  kClassificationOf14 = 16,
  kUserDataOf14 = 17,
  kScanAngleOf14 = 18,
  kSourceOf14 = 20,
  kGpsTimeOf14 = 22,
  kSizeOf14 = 30
};

inline unsigned channelOf14(const char* record)
{
  return byteAt(record, kFlagsOf14) >> 4 & 3u;
}

/// x, y, number of the return and of how many, scanner channel, and which of time, scan angle and source
/// change.
class PositionLayer
{
public:
  void start(const char* record) { channels_.start(channelOf14(record), Last::load(record)); }
  /// Codes x, y, returns and channel of @p record.
  template <typename Coder>
  PointLabel code(Coder& coder, char* record)
  {
    Channel* channel = &channels_.current();
    unsigned changed = 0;
    Last point;
    if constexpr (Coder::kEncodes)
    {
      point = Last::load(record);
      changed = changesOf(channels_.at(channelOf14(record)).last, point) |
        (channelOf14(record) != channels_.currentChannel() ? kChannel : 0u);
    }
    changed = coder.symbol(channel->changed[channel->context()], changed);
    if ((changed & kChannel) != 0)
    {
      const unsigned current = channels_.currentChannel();
      const unsigned step =
        coder.symbol(channel->steps.startIfForgotten(), (channelOf14(record) - current - 1) & 3);
      channel = &channels_.select((current + step + 1) & 3);
    }
    if constexpr (!Coder::kEncodes)
    {
      point = channel->last;
    }
    PointLabel label;
    label.channel = static_cast<std::uint8_t>(channels_.currentChannel());
    label.attributeChannel = (changed & kChannel) != 0 ? label.channel : std::uint8_t{ 0 };
    label.hasNewTime = (changed & kTime) != 0;
    label.hasNewScanAngle = (changed & kScanAngle) != 0;
    label.hasNewSource = (changed & kSource) != 0;
    codeReturns(coder, *channel, changed, point);
    codePosition(coder, *channel, point, label);
    channel->last = point;
    channel->hadNewTime = label.hasNewTime;
    if constexpr (!Coder::kEncodes)
    {
      point.store(record, label.channel);
    }
    return label;
  }

private:
  enum Changed : unsigned
  {
    kReturn = 3, ///< 0 the same, 1 one more, 2 one less, 3 another
    kNumberOfReturns = 4,
    kScanAngle = 8,
    kTime = 16,
    kSource = 32,
    kChannel = 64
  };
  struct Last
  {
    std::int32_t x = 0;
    std::int32_t y = 0;
    unsigned number = 0;   ///< of the return
    unsigned ofNumber = 0; ///< returns of its pulse
    std::uint16_t scanAngle = 0;
    std::uint16_t source = 0;
    std::uint64_t time = 0;

    static Last load(const char* record)
    {
      return { loadLittle<std::int32_t>(record), loadLittle<std::int32_t>(record + 4),
        byteAt(record, kReturnsOf14) & 15u, static_cast<unsigned>(byteAt(record, kReturnsOf14) >> 4),
        loadLittle<std::uint16_t>(record + kScanAngleOf14), loadLittle<std::uint16_t>(record + kSourceOf14),
        loadLittle<std::uint64_t>(record + kGpsTimeOf14) };
    }
    void store(char* record, unsigned channel) const
    {
      storeLittle(x, record);
      storeLittle(y, record + 4);
      record[kReturnsOf14] = static_cast<char>(number | ofNumber << 4);
      record[kFlagsOf14] = static_cast<char>((byteAt(record, kFlagsOf14) & 0xcf) | channel << 4);
    }
  };
  struct Channel
  {
    Last last;
    bool hadNewTime = false;
    std::array<StreamingMedian, 12> xMedians;
    std::array<StreamingMedian, 12> yMedians;
    ModelBank changed{ 8, 128 };
    SymbolModel steps{ 3 };
    ModelBank ofNumbers{ 16, 16 };
    ModelBank numbers{ 16, 16 };
    SymbolModel numbersOfSameTime{ 13 };
    IntegerModels xModels{ 32, 2 };
    IntegerModels yModels{ 32, 22 };

    void start(const Last& first)
    {
      last = first;
      hadNewTime = false;
      xMedians = yMedians = {};
      steps.forget();
      numbersOfSameTime.forget();
      for (ModelBank* bank : { &changed, &ofNumbers, &numbers })
      {
        bank->forget();
      }
      xModels.forget();
      yModels.forget();
    }
    unsigned context() const
    {
      return (last.number == 1 ? 1u : 0u) + (last.number >= last.ofNumber ? 2u : 0u) + (hadNewTime ? 4u : 0u);
    }
  };

  static unsigned changesOf(const Last& last, const Last& point)
  {
    const unsigned step = (point.number - last.number) & 15;
    return (step == 0       ? 0u
               : step == 1  ? 1u
               : step == 15 ? 2u
                            : 3u) |
      (point.ofNumber != last.ofNumber ? kNumberOfReturns : 0u) |
      (point.scanAngle != last.scanAngle ? kScanAngle : 0u) | (point.time != last.time ? kTime : 0u) |
      (point.source != last.source ? kSource : 0u);
  }
  template <typename Coder>
  static void codeReturns(Coder& coder, Channel& channel, unsigned changed, Last& point)
  {
    const Last& last = channel.last;
    if ((changed & kNumberOfReturns) != 0)
    {
      point.ofNumber = coder.symbol(channel.ofNumbers[last.ofNumber], point.ofNumber);
    }
    const unsigned step = changed & kReturn;
    if (step == 3 && (changed & kTime) != 0)
    {
      point.number = coder.symbol(channel.numbers[last.number], point.number);
    }
    else if (step == 3)
    {
      const unsigned further =
        coder.symbol(channel.numbersOfSameTime.startIfForgotten(), (point.number - last.number - 2) & 15);
      point.number = (last.number + further + 2) & 15;
    }
    else
    {
      point.number = (last.number + (step == 2 ? 15 : step)) & 15;
    }
  }
  template <typename Coder>
  static void codePosition(Coder& coder, Channel& channel, Last& point, PointLabel& label)
  {
    const Last& last = channel.last;
    const bool isSingle = point.ofNumber == 1;
    label.level = static_cast<std::uint8_t>(returnLevel(point.number, point.ofNumber));
    label.placeInPulse =
      static_cast<std::uint8_t>((point.number == 1 ? 1 : 0) + (point.number >= point.ofNumber ? 2 : 0));
    const unsigned context =
      kReturnContext14[point.ofNumber][point.number] * 2u + (label.hasNewTime ? 1u : 0u);
    StreamingMedian& xMedian = channel.xMedians[context];
    const std::int32_t x =
      channel.xModels.code(coder, xMedian.get(), subtractWrapped(point.x, last.x), isSingle ? 1 : 0);
    point.x = addWrapped(last.x, x);
    xMedian.add(x);
    StreamingMedian& yMedian = channel.yMedians[context];
    const unsigned xLength = channel.xModels.lengthOfLast();
    const std::int32_t y = channel.yModels.code(
      coder, yMedian.get(), subtractWrapped(point.y, last.y), lengthContext(xLength, 20, isSingle));
    point.y = addWrapped(last.y, y);
    yMedian.add(y);
    const unsigned length = (xLength + channel.yModels.lengthOfLast()) / 2;
    label.zContext = static_cast<std::uint8_t>(lengthContext(length, 18, isSingle));
  }

  Channels<Channel> channels_;
};

/// One field of a record in a layer of its own. Field has Value, last, start(), load(), store() and code().
template <typename Field>
class FieldLayer
{
public:
  void start(const char* record)
  {
    channels_.start(channelOf14(record), Field::load(record));
    hasChanges_ = false;
  }
  template <typename Coder>
  void code(Coder& coder, const PointLabel& label, char* record)
  {
    Field& field = channels_.select(label.channel);
    const typename Field::Value value =
      field.code(coder, label, Coder::kEncodes ? Field::load(record) : typename Field::Value{});
    hasChanges_ = hasChanges_ || (Coder::kEncodes && value != field.last);
    field.last = value;
    if constexpr (!Coder::kEncodes)
    {
      Field::store(value, record);
    }
  }
  /// For an encoder: true if any value differs from the one before. Layers without changes are left out.
  bool hasChanges() const { return hasChanges_; }

private:
  Channels<Field> channels_;
  bool hasChanges_ = false;
};

struct ZField
{
  using Value = std::int32_t;
  Value last = 0;
  std::array<Value, 8> heights{};
  IntegerModels models{ 32, 20 };

  static Value load(const char* record) { return loadLittle<Value>(record + 8); }
  static void store(Value value, char* record) { storeLittle(value, record + 8); }
  void start(Value first)
  {
    last = first;
    heights.fill(first);
    models.forget();
  }
  template <typename Coder>
  Value code(Coder& coder, const PointLabel& label, Value value)
  {
    Value& height = heights[label.level];
    return height = models.code(coder, height, value, label.zContext);
  }
};

struct ClassificationField
{
  using Value = std::uint8_t;
  Value last = 0;
  ModelBank models{ 64, 256 };

  static Value load(const char* record) { return byteAt(record, kClassificationOf14); }
  static void store(Value value, char* record) { record[kClassificationOf14] = static_cast<char>(value); }
  void start(Value first)
  {
    last = first;
    models.forget();
  }
  template <typename Coder>
  Value code(Coder& coder, const PointLabel& label, Value value)
  {
    const unsigned context = (last & 31u) * 2 + (label.placeInPulse == 3 ? 1 : 0);
    return static_cast<Value>(coder.symbol(models[context], value));
  }
};

/// Classification flags, scan direction and edge of the flight line, as 6 bits.
struct FlagsField
{
  using Value = std::uint8_t;
  Value last = 0;
  ModelBank models{ 64, 64 };

  static Value load(const char* record)
  {
    const unsigned byte = byteAt(record, kFlagsOf14);
    return static_cast<Value>((byte & 15) | byte >> 6 << 4);
  }
  static void store(Value value, char* record)
  {
    record[kFlagsOf14] =
      static_cast<char>((byteAt(record, kFlagsOf14) & 0x30) | (value & 15) | value >> 4 << 6);
  }
  void start(Value first)
  {
    last = first;
    models.forget();
  }
  template <typename Coder>
  Value code(Coder& coder, const PointLabel&, Value value)
  {
    return static_cast<Value>(coder.symbol(models[last], value));
  }
};

struct IntensityField
{
  using Value = std::uint16_t;
  Value last = 0;
  std::array<Value, 8> intensities{};
  IntegerModels models{ 16, 4 };

  static Value load(const char* record) { return loadLittle<Value>(record + kIntensityOf14); }
  static void store(Value value, char* record) { storeLittle(value, record + kIntensityOf14); }
  void start(Value first)
  {
    last = first;
    intensities.fill(first);
    models.forget();
  }
  template <typename Coder>
  Value code(Coder& coder, const PointLabel& label, Value value)
  {
    Value& before = intensities[label.placeInPulse * 2u + (label.hasNewTime ? 1u : 0u)];
    return before = static_cast<Value>(models.code(coder, before, value, label.placeInPulse));
  }
};

struct ScanAngleField
{
  using Value = std::int16_t;
  Value last = 0;
  IntegerModels models{ 16, 2 };

  static Value load(const char* record) { return loadLittle<Value>(record + kScanAngleOf14); }
  static void store(Value value, char* record) { storeLittle(value, record + kScanAngleOf14); }
  void start(Value first)
  {
    last = first;
    models.forget();
  }
  template <typename Coder>
  Value code(Coder& coder, const PointLabel& label, Value value)
  {
    return label.hasNewScanAngle
      ? static_cast<Value>(models.code(coder, last, value, label.hasNewTime ? 1 : 0))
      : last;
  }
};

struct UserDataField
{
  using Value = std::uint8_t;
  Value last = 0;
  ModelBank models{ 64, 256 };

  static Value load(const char* record) { return byteAt(record, kUserDataOf14); }
  static void store(Value value, char* record) { record[kUserDataOf14] = static_cast<char>(value); }
  void start(Value first)
  {
    last = first;
    models.forget();
  }
  template <typename Coder>
  Value code(Coder& coder, const PointLabel&, Value value)
  {
    return static_cast<Value>(coder.symbol(models[last / 4u], value));
  }
};

struct SourceField
{
  using Value = std::uint16_t;
  Value last = 0;
  IntegerModels models{ 16, 1 };

  static Value load(const char* record) { return loadLittle<Value>(record + kSourceOf14); }
  static void store(Value value, char* record) { storeLittle(value, record + kSourceOf14); }
  void start(Value first)
  {
    last = first;
    models.forget();
  }
  template <typename Coder>
  Value code(Coder& coder, const PointLabel& label, Value value)
  {
    return label.hasNewSource ? static_cast<Value>(models.code(coder, last, value)) : last;
  }
};

struct GpsTimeField
{
  using Value = std::uint64_t;
  Value last = 0;
  GpsTimeItem item{ GpsTimeItem::Version::ChangedOnly };

  static Value load(const char* record) { return loadLittle<Value>(record + kGpsTimeOf14); }
  static void store(Value value, char* record) { storeLittle(value, record + kGpsTimeOf14); }
  void start(Value first)
  {
    last = first;
    item.start(first);
  }
  template <typename Coder>
  Value code(Coder& coder, const PointLabel& label, Value value)
  {
    return label.hasNewTime ? item.code(coder, value) : last;
  }
};

} // namespace pointhaptics::io
