/// @file
/// LAZ's pointwise compression (point formats 0 to 5): the items of a point one after the other, in one
/// stream.
#pragma once

#include "IO/Las/Laz/Items/FirstVersionItems.h"
#include "IO/Las/Laz/Items/GpsTimeItem.h"
#include "IO/Las/Laz/Items/WavePacketItem.h"
#include "IO/Las/Laz/LazSchema.h"

#include <memory>

namespace pointhaptics::io
{

/// The items of one chunk. Coder is ArithmeticDecoder or ArithmeticEncoder.
template <typename Coder>
class PointwiseItems
{
public:
  explicit PointwiseItems(const LazSchema& schema);
  /// Begins a chunk whose first point is @p record.
  void start(const char* record);
  /// Codes @p count records of schema.recordLength bytes.
  void code(Coder& coder, char* records, std::size_t count);

private:
  void codeGpsTime(Coder& coder, char* at);
  void codeColor(Coder& coder, char* at);
  void codeBytes(Coder& coder, char* at);

  const LazSchema& schema_;
  Point10Item point_;
  GpsTimeItem gpsTime_{ GpsTimeItem::Version::EachTime };
  ColorItem color_;
  ColorItem::Color lastColor_{};
  WavePacketItem wavePacket_;
  WavePacketItem::Bytes lastWavePacket_{};
  ModelBank bytes_;
  std::vector<std::uint8_t> lastBytes_;
  /// Made for files of 2010 and 2011 only.
  std::unique_ptr<FirstPoint10Item> firstPoint_;
  std::unique_ptr<FirstGpsTimeItem> firstGpsTime_;
  std::unique_ptr<FirstColorItem> firstColor_;
  std::unique_ptr<IntegerModels> firstBytes_;
};

} // namespace pointhaptics::io
