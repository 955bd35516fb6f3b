/// @file
/// LAZ's pointwise compression (point formats 0 to 5): the items of a point one after the other, in one
/// stream.
#pragma once

#include "IO/Las/Laz/Items/FirstVersionItems.h"
#include "IO/Las/Laz/Items/GpsTimeItem.h"
#include "IO/Las/Laz/Items/WavePacketItem.h"
#include "IO/Las/Laz/LazSchema.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pointhaptics::io
{

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
