/// @file
/// LAZ's layered compression (point formats 6 to 10): each field in a stream of its own, so that those that
/// are not wanted need not be looked at.
#pragma once

#include "IO/Las/Laz/Items/AttributeLayers.h"
#include "IO/Las/Laz/Items/Point14Layers.h"
#include "IO/Las/Laz/LazSchema.h"

#include <optional>
#include <vector>

namespace pointhaptics::io
{

/// The layers of one chunk. Coder is ArithmeticDecoder or ArithmeticEncoder.
template <typename Coder>
class LayeredItems
{
public:
  explicit LayeredItems(const LazSchema& schema);
  /// Begins a chunk whose first point is @p record.
  void start(const char* record);
  /// Codes @p count records of schema.recordLength bytes: those layers that are in use.
  void code(char* records, std::size_t count);

  std::size_t numberOfLayers() const { return layers_.size(); }
  /// Layer @p i, 0 for x, y, returns and channels, 1 for z: the others in the order of the record.
  Coder& coder(std::size_t i) { return layers_[i].coder; }
  /// A layer that is not in use has in all records what the first one has. All are in use at first.
  void setUsed(std::size_t i, bool isUsed) { layers_[i].isUsed = isUsed; }
  bool isUsed(std::size_t i) const { return layers_[i].isUsed; }
  /// For an encoder: true if layer @p i has any value that differs from the one before.
  bool hasChanges(std::size_t i) const;

private:
  struct Layer
  {
    Coder coder;
    bool isUsed = true;
  };
  /// Calls @p visit(layer) for each but the first, in their order.
  template <typename Self, typename Visit>
  static void forEachLayer(Self& self, Visit visit);

  const LazSchema& schema_;
  std::vector<Layer> layers_;
  std::vector<PointLabel> labels_;
  std::vector<char> first_; ///< record
  PositionLayer positions_;
  FieldLayer<ZField> z_;
  FieldLayer<ClassificationField> classification_;
  FieldLayer<FlagsField> flags_;
  FieldLayer<IntensityField> intensity_;
  FieldLayer<ScanAngleField> scanAngle_;
  FieldLayer<UserDataField> userData_;
  FieldLayer<SourceField> source_;
  FieldLayer<GpsTimeField> gpsTime_;
  std::optional<AttributeLayer<ColorAttribute>> color_;
  std::optional<AttributeLayer<NearInfraredAttribute>> nearInfrared_;
  std::optional<AttributeLayer<WavePacketAttribute>> wavePacket_;
  std::vector<AttributeLayer<ByteAttribute>> bytes_;
};

} // namespace pointhaptics::io
