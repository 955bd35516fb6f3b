/// @file
/// LAZ's layered compression (point formats 6 to 10, version 3): each field in a stream of its own, so that
/// those that are not wanted need not be looked at. The layer of x, y, returns and channels is the first, and
/// its labels are contexts for the others. Source: LASzip's published format (M. Isenburg, 2013, and the
/// notes on its extension to LAS 1.4).
#pragma once

#include "FileProblem.h"
#include "IO/Las/Laz/Items/AttributeItems.h"
#include "IO/Las/Laz/Items/GpsTimeItem.h"
#include "IO/Las/Laz/Items/Layer.h"
#include "IO/Las/Laz/Items/PlaneModels.h"
#include "IO/Las/Laz/LazSchema.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace pointhaptics::io
{

/// Byte offsets in the record.
enum Point14Offset : std::size_t
{
  kHeightOf14 = 8,
  kIntensityOf14 = 12,
  kReturnsOf14 = 14, ///< 4 bits number, 4 of how many
  kFlagsOf14 = 15,   ///< 4 bits classification flags, 2 channel, scan direction, edge of the flight line
  kClassificationOf14 = 16,
  kUserDataOf14 = 17,
  kScanAngleOf14 = 18,
  kSourceOf14 = 20,
  kGpsTimeOf14 = 22,
};

/// x, y, number of the return and of how many, scanner channel, and which of time, scan angle and source
/// change.
class PositionLayer
{
public:
  explicit PositionLayer(const char* record)
    : channels_(channelOf14(record), Last::load(record))
  {
  }
  /// Codes x, y, returns and channel of @p record, and gives the point its label.
  template <typename Coder>
  void code(Coder& coder, PointLabel& label, char* record)
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
      const unsigned step = coder.symbol(channel->steps, (channelOf14(record) - current - 1) & 3);
      channel = &channels_.select((current + step + 1) & 3);
    }
    if constexpr (!Coder::kEncodes)
    {
      point = channel->last;
    }
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
  }
  /// This layer is always there.
  static bool hasChanges() { return true; }

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
    PlaneModels<12> plane;
    ModelBank changed{ 8, 128 };
    SymbolModel steps{ 3 };
    ModelBank ofNumbers{ 16, 16 };
    ModelBank numbers{ 16, 16 };
    SymbolModel numbersOfSameTime{ 13 };

    explicit Channel(const Last& first)
      : last(first)
    {
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
      const unsigned further = coder.symbol(channel.numbersOfSameTime, (point.number - last.number - 2) & 15);
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
    const bool isSingle = point.ofNumber == 1;
    label.level = static_cast<std::uint8_t>(returnLevel(point.number, point.ofNumber));
    label.placeInPulse =
      static_cast<std::uint8_t>((point.number == 1 ? 1 : 0) + (point.number >= point.ofNumber ? 2 : 0));
    const unsigned context =
      kReturnContext14[point.ofNumber][point.number] * 2u + (label.hasNewTime ? 1u : 0u);
    const unsigned length = channel.plane.code(coder, context, isSingle, channel.last, point);
    label.zContext = static_cast<std::uint8_t>(lengthContext(length, 18, isSingle));
  }

  Channels<Channel> channels_;
};

class HeightItem : public NumberItem<std::int32_t>
{
public:
  void start(Value first) { heights_.fill(first); }
  template <typename Coder>
  Value code(Coder& coder, const PointLabel& label, Value, Value value)
  {
    Value& height = heights_[label.level];
    return height = models_.code(coder, height, value, label.zContext);
  }

private:
  std::array<Value, 8> heights_{};
  IntegerModels models_{ 32, 20 };
};

class IntensityItem : public NumberItem<std::uint16_t>
{
public:
  void start(Value first) { intensities_.fill(first); }
  template <typename Coder>
  Value code(Coder& coder, const PointLabel& label, Value, Value value)
  {
    Value& before = intensities_[label.placeInPulse * 2u + (label.hasNewTime ? 1u : 0u)];
    return before = static_cast<Value>(models_.code(coder, before, value, label.placeInPulse));
  }

private:
  std::array<Value, 8> intensities_{};
  IntegerModels models_{ 16, 4 };
};

/// One of @p Symbols symbols, with a model for each of 64 contexts.
template <unsigned Symbols, unsigned (*contextOf)(const PointLabel&, unsigned last)>
class SymbolItem : public NumberItem<std::uint8_t>
{
public:
  template <typename Coder>
  Value code(Coder& coder, const PointLabel& label, Value last, Value value)
  {
    return static_cast<Value>(coder.symbol(models_[contextOf(label, last)], value));
  }

private:
  ModelBank models_{ 64, Symbols };
};

inline unsigned contextOfClassification(const PointLabel& label, unsigned last)
{
  return (last & 31u) * 2 + (label.placeInPulse == 3 ? 1 : 0);
}
inline unsigned contextOfUserData(const PointLabel&, unsigned last)
{
  return last / 4u;
}
inline unsigned contextOfFlags(const PointLabel&, unsigned last)
{
  return last;
}
using ClassificationItem = SymbolItem<256, &contextOfClassification>;
using UserDataItem = SymbolItem<256, &contextOfUserData>;

/// Classification flags, scan direction and edge of the flight line, as 6 bits.
class FlagsItem : public SymbolItem<64, &contextOfFlags>
{
public:
  static Value load(const char* at) { return static_cast<Value>((*at & 15) | (byteAt(at, 0) >> 6 << 4)); }
  static void store(Value value, char* at)
  {
    *at = static_cast<char>((*at & 0x30) | (value & 15) | value >> 4 << 6);
  }
};

/// A number that is coded where its label says that it changes.
template <typename T, bool PointLabel::*changes, unsigned Contexts>
class RareItem : public NumberItem<T>
{
public:
  template <typename Coder>
  T code(Coder& coder, const PointLabel& label, T last, T value)
  {
    const unsigned context = Contexts > 1 && label.hasNewTime ? 1 : 0;
    return label.*changes ? static_cast<T>(models_.code(coder, last, value, context)) : last;
  }

private:
  IntegerModels models_{ 16, Contexts };
};
using ScanAngleItem = RareItem<std::int16_t, &PointLabel::hasNewScanAngle, 2>;
using SourceItem = RareItem<std::uint16_t, &PointLabel::hasNewSource, 1>;

/// The layers of one chunk. Coder is ArithmeticDecoder or ArithmeticEncoder. A chunk is its number of points,
/// the sizes of the layers, and these.
template <typename Coder>
class LayeredItems
{
public:
  /// Begins a chunk whose first point is @p record.
  LayeredItems(const LazSchema& schema, const char* record)
    : first_(record, record + schema.recordLength)
  {
    layers_.reserve(schema.numberOfLayers());
    layers_.push_back({ PositionLayer(record) });
    add<HeightItem>(kHeightOf14);
    add<ClassificationItem>(kClassificationOf14);
    add<FlagsItem>(kFlagsOf14);
    add<IntensityItem>(kIntensityOf14);
    add<ScanAngleItem>(kScanAngleOf14);
    add<UserDataItem>(kUserDataOf14);
    add<SourceItem>(kSourceOf14);
    add<GpsTimeItem<false>>(kGpsTimeOf14);
    add<ColorItem>(schema.color.offset);
    add<NearInfraredItem>(schema.nearInfrared.offset);
    add<WavePacketItem>(schema.wavePacket.offset);
    for (std::size_t i = 0; i < schema.numberOfExtraBytes(); ++i)
    {
      add<ByteItem>(schema.extraBytes.offset + i);
    }
  }
  /// For a decoder: begins to read the chunk whose content behind its first point is @p bytes. A layer that
  /// is not wanted or left out has in all records what the first one has. @throws FileProblem.
  void begin(std::string_view bytes, bool onlyPositions)
  {
    constexpr std::size_t kLayersOfPositions = 2;
    std::size_t begin = kNumber * (1 + layers_.size());
    for (std::size_t i = 0; i < layers_.size() && begin <= bytes.size(); ++i)
    {
      const std::size_t size = loadLittle<std::uint32_t>(bytes.data() + kNumber * (1 + i));
      const bool isWanted = !onlyPositions || i < kLayersOfPositions;
      layers_[i].isUsed = i == 0 || (isWanted && size > 0);
      begin += size;
      if (layers_[i].isUsed && begin <= bytes.size())
      {
        layers_[i].coder = Coder(bytes.substr(begin - size, size));
      }
    }
    failTruncatedIf(begin > bytes.size(), "the layers of a chunk take more than its {} bytes",
      first_.size() + bytes.size());
  }
  /// Codes @p count records of schema.recordLength bytes: those layers that are in use.
  void code(char* records, std::size_t count);
  bool isDamaged() const
  {
    return std::any_of(layers_.begin(), layers_.end(),
      [](const CodedLayer& each) { return each.isUsed && each.coder.isDamaged(); });
  }
  /// For an encoder: ends the chunk of @p count points, and adds it to @p chunk. Layers without changes have
  /// no bytes.
  void finish(std::string& chunk, std::size_t count)
  {
    std::string sizes(kNumber * (1 + layers_.size()), '\0');
    storeLittle(static_cast<std::uint32_t>(count), &sizes[0]);
    std::string content;
    for (std::size_t i = 0; i < layers_.size(); ++i)
    {
      const bool hasChanges =
        std::visit([](const auto& layer) { return layer.hasChanges(); }, layers_[i].layer);
      const std::string bytes = layers_[i].coder.finish();
      content += hasChanges ? bytes : "";
      storeLittle(static_cast<std::uint32_t>(hasChanges ? bytes.size() : 0), &sizes[kNumber * (1 + i)]);
    }
    chunk += sizes + content;
  }

private:
  static constexpr std::size_t kNumber = sizeof(std::uint32_t);
  using AnyLayer = std::variant<PositionLayer, Layer<HeightItem>, Layer<ClassificationItem>, Layer<FlagsItem>,
    Layer<IntensityItem>, Layer<ScanAngleItem>, Layer<UserDataItem>, Layer<SourceItem>,
    Layer<GpsTimeItem<false>>, Layer<ColorItem>, Layer<NearInfraredItem>, Layer<WavePacketItem>,
    Layer<ByteItem>>;
  struct CodedLayer
  {
    AnyLayer layer;
    Coder coder{};
    bool isUsed = true;
  };

  /// @p offset 0: the records have no such item.
  template <typename Item>
  void add(std::size_t offset)
  {
    offset != 0 ? layers_.push_back({ Layer<Item>(offset, first_.data()) }) : void();
  }
  template <typename OneLayer>
  void codeLayer(OneLayer& layer, Coder& stored, char* records, std::size_t count);

  std::vector<CodedLayer> layers_;
  std::vector<PointLabel> labels_;
  std::vector<char> first_; ///< record
};

} // namespace pointhaptics::io
