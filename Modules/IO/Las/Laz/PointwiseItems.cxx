#include "IO/Las/Laz/PointwiseItems.h"

#include "IO/Las/Laz/ArithmeticEncoder.h"
#include "IO/Las/Laz/Items/AttributeLayers.h"

namespace pointhaptics::io
{

template <typename Coder>
PointwiseItems<Coder>::PointwiseItems(const LazSchema& schema)
  : schema_(schema)
  , bytes_(static_cast<unsigned>(schema.numberOfExtraBytes()), 256)
  , lastBytes_(schema.numberOfExtraBytes())
{
  if (schema.pointVersion == 1)
  {
    firstPoint_ = std::make_unique<FirstPoint10Item>();
  }
  if (schema.gpsTime.version == 1)
  {
    firstGpsTime_ = std::make_unique<FirstGpsTimeItem>();
  }
  if (schema.color.version == 1)
  {
    firstColor_ = std::make_unique<FirstColorItem>();
  }
  if (schema.extraBytes.version == 1)
  {
    firstBytes_ = std::make_unique<IntegerModels>(8, static_cast<unsigned>(lastBytes_.size()));
  }
}

template <typename Coder>
void PointwiseItems<Coder>::start(const char* record)
{
  firstPoint_ ? firstPoint_->start(record) : point_.start(record);
  if (schema_.gpsTime.offset != 0)
  {
    const std::uint64_t time = loadLittle<std::uint64_t>(record + schema_.gpsTime.offset);
    firstGpsTime_ ? firstGpsTime_->start(time) : gpsTime_.start(time);
  }
  if (schema_.color.offset != 0)
  {
    firstColor_ ? firstColor_->forget() : color_.forget();
    lastColor_ = ColorAttribute::load(record + schema_.color.offset);
  }
  if (schema_.wavePacket.offset != 0)
  {
    wavePacket_.forget();
    std::copy_n(record + schema_.wavePacket.offset, WavePacketItem::kSize, lastWavePacket_.data());
  }
  firstBytes_ ? firstBytes_->forget() : bytes_.forget();
  for (std::size_t i = 0; i < lastBytes_.size(); ++i)
  {
    lastBytes_[i] = byteAt(record, schema_.extraBytes.offset + i);
  }
}

template <typename Coder>
void PointwiseItems<Coder>::code(Coder& coder, char* records, std::size_t count)
{
  const char* end = records + count * schema_.recordLength;
  for (char* record = records; record != end; record += schema_.recordLength)
  {
    if constexpr (!Coder::kEncodes)
    {
      if (firstPoint_)
      {
        firstPoint_->code(coder, record);
      }
      else
      {
        point_.code(coder, record);
      }
    }
    else
    {
      point_.code(coder, record);
    }
    if (schema_.gpsTime.offset != 0)
    {
      codeGpsTime(coder, record + schema_.gpsTime.offset);
    }
    if (schema_.color.offset != 0)
    {
      codeColor(coder, record + schema_.color.offset);
    }
    if (schema_.wavePacket.offset != 0)
    {
      wavePacket_.code(coder, lastWavePacket_, record + schema_.wavePacket.offset);
    }
    if (!lastBytes_.empty())
    {
      codeBytes(coder, record + schema_.extraBytes.offset);
    }
  }
}

template <typename Coder>
void PointwiseItems<Coder>::codeGpsTime(Coder& coder, char* at)
{
  if constexpr (Coder::kEncodes)
  {
    gpsTime_.code(coder, loadLittle<std::uint64_t>(at));
  }
  else
  {
    storeLittle(firstGpsTime_ ? firstGpsTime_->code(coder) : gpsTime_.code(coder, 0), at);
  }
}

template <typename Coder>
void PointwiseItems<Coder>::codeColor(Coder& coder, char* at)
{
  if constexpr (Coder::kEncodes)
  {
    lastColor_ = color_.code(coder, lastColor_, ColorAttribute::load(at));
  }
  else
  {
    lastColor_ = firstColor_ ? firstColor_->code(coder, lastColor_) : color_.code(coder, lastColor_, {});
    ColorAttribute::store(lastColor_, at);
  }
}

template <typename Coder>
void PointwiseItems<Coder>::codeBytes(Coder& coder, char* at)
{
  for (std::size_t i = 0; i < lastBytes_.size(); ++i)
  {
    std::uint8_t& last = lastBytes_[i];
    const unsigned context = static_cast<unsigned>(i);
    if (firstBytes_)
    {
      last = static_cast<std::uint8_t>(firstBytes_->code(coder, last, byteAt(at, i), context));
    }
    else
    {
      const unsigned step = static_cast<std::uint8_t>(byteAt(at, i) - last);
      last = addToByte(last, coder.symbol(bytes_[context], step));
    }
    at[i] = static_cast<char>(last);
  }
}

template class PointwiseItems<ArithmeticDecoder>;
template class PointwiseItems<ArithmeticEncoder>;

} // namespace pointhaptics::io
