#include "IO/Las/Laz/PointwiseItems.h"

#include "IO/Las/Laz/ArithmeticDecoder.h"
#include "IO/Las/Laz/ArithmeticEncoder.h"

namespace pointhaptics::io
{

template <typename Coder>
void PointwiseItems<Coder>::code(char* records, std::size_t count)
{
  const char* end = records + count * schema_.recordLength;
  for (char* record = records; record != end; record += schema_.recordLength)
  {
    point_.code(coder_, record);
    gpsTime_ ? gpsTime_->code(coder_, record) : void();
    color_ ? color_->code(coder_, record) : void();
    wavePacket_ ? wavePacket_->code(coder_, record) : void();
    char* const at = record + schema_.extraBytes.offset;
    for (std::size_t i = 0; i < bytes_.size(); ++i)
    {
      std::uint8_t& last = lastBytes_[i];
      const std::uint8_t value = byteAt(at, i);
      last = firstBytes_
        ? static_cast<std::uint8_t>(firstBytes_->code(coder_, last, value, static_cast<unsigned>(i)))
        : bytes_[i].code(coder_, PointLabel(), last, value);
      at[i] = static_cast<char>(last);
    }
  }
}

template void PointwiseItems<ArithmeticDecoder>::code(char*, std::size_t);
template void PointwiseItems<ArithmeticEncoder>::code(char*, std::size_t);

} // namespace pointhaptics::io
