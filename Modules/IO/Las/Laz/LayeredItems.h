/// @file
/// LAZ's layered compression (point formats 6 to 10): each field in a stream of its own, so that those that
/// are not wanted need not be looked at.
#pragma once

#include "Bytes/Checks.h"
#include "IO/Las/Laz/Items/AttributeItems.h"
#include "IO/Las/Laz/Items/Point14Items.h"
#include "IO/Las/Laz/Items/WavePacketItem.h"
#include "IO/Las/Laz/LazSchema.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace pointhaptics::io
{

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
