#include "IO/Las/Laz/LayeredItems.h"

#include "IO/Las/Laz/ArithmeticDecoder.h"
#include "IO/Las/Laz/ArithmeticEncoder.h"

namespace pointhaptics::io
{

namespace
{

template <typename Field>
void startLayer(FieldLayer<Field>& layer, const char* record)
{
  layer.start(record);
}
template <typename Item>
void startLayer(AttributeLayer<Item>& layer, const char* record)
{
  layer.start(record, channelOf14(record));
}

} // namespace

template <typename Coder>
LayeredItems<Coder>::LayeredItems(const LazSchema& schema)
  : schema_(schema)
  , layers_(schema.numberOfLayers())
  , first_(schema.recordLength)
{
  if (schema.color.offset != 0)
  {
    color_.emplace(schema.color.offset);
  }
  if (schema.nearInfrared.offset != 0)
  {
    nearInfrared_.emplace(schema.nearInfrared.offset);
  }
  if (schema.wavePacket.offset != 0)
  {
    wavePacket_.emplace(schema.wavePacket.offset);
  }
  for (std::size_t i = 0; i < schema.numberOfExtraBytes(); ++i)
  {
    bytes_.emplace_back(schema.extraBytes.offset + i);
  }
}

template <typename Coder>
template <typename Self, typename Visit>
void LayeredItems<Coder>::forEachLayer(Self& self, Visit visit)
{
  visit(self.z_);
  visit(self.classification_);
  visit(self.flags_);
  visit(self.intensity_);
  visit(self.scanAngle_);
  visit(self.userData_);
  visit(self.source_);
  visit(self.gpsTime_);
  if (self.color_)
  {
    visit(*self.color_);
  }
  if (self.nearInfrared_)
  {
    visit(*self.nearInfrared_);
  }
  if (self.wavePacket_)
  {
    visit(*self.wavePacket_);
  }
  for (auto& byte : self.bytes_)
  {
    visit(byte);
  }
}

template <typename Coder>
void LayeredItems<Coder>::start(const char* record)
{
  std::copy_n(record, first_.size(), first_.data());
  positions_.start(record);
  std::size_t i = 0;
  forEachLayer(*this,
    [&](auto& layer)
    {
      if (layers_[++i].isUsed)
      {
        startLayer(layer, record);
      }
    });
}

template <typename Coder>
void LayeredItems<Coder>::code(char* records, std::size_t count)
{
  labels_.resize(std::max(labels_.size(), count));
  char* record = records;
  Coder& positions = layers_[0].coder;
  for (std::size_t point = 0; point < count; ++point, record += first_.size())
  {
    if constexpr (!Coder::kEncodes)
    {
      std::copy_n(first_.data(), first_.size(), record);
    }
    labels_[point] = positions_.code(positions, record);
  }
  std::size_t i = 0;
  forEachLayer(*this,
    [&](auto& layer)
    {
      if (!layers_[++i].isUsed)
      {
        return;
      }
      Coder coder = std::move(layers_[i].coder); // a local one stays in registers
      char* at = records;
      for (std::size_t point = 0; point < count; ++point, at += first_.size())
      {
        layer.code(coder, labels_[point], at);
      }
      layers_[i].coder = std::move(coder);
    });
}

template <typename Coder>
bool LayeredItems<Coder>::hasChanges(std::size_t i) const
{
  bool result = i == 0;
  std::size_t at = 0;
  forEachLayer(*this, [&](const auto& layer) { result = result || (++at == i && layer.hasChanges()); });
  return result;
}

template class LayeredItems<ArithmeticDecoder>;
template class LayeredItems<ArithmeticEncoder>;

} // namespace pointhaptics::io
