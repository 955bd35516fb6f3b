#include "IO/Las/Laz/ChunkCoding.h"

#include "FileProblem.h"

namespace pointhaptics::io
{

template <typename Coder>
void LayeredItems<Coder>::code(char* records, std::size_t count)
{
  labels_.resize(std::max(labels_.size(), count));
  for (std::size_t point = 0; point < count && !Coder::kEncodes; ++point)
  {
    std::copy_n(first_.data(), first_.size(), records + point * first_.size());
  }
  for (CodedLayer& each : layers_)
  {
    each.isUsed ? std::visit([&](auto& layer) { codeLayer(layer, each.coder, records, count); }, each.layer)
                : void();
  }
}

template <typename Coder>
template <typename OneLayer>
void LayeredItems<Coder>::codeLayer(OneLayer& layer, Coder& stored, char* records, std::size_t count)
{
  Coder coder = std::move(stored); // a local one stays in registers
  for (std::size_t point = 0; point < count; ++point)
  {
    layer.code(coder, labels_[point], records + point * first_.size());
  }
  stored = std::move(coder);
}

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

void ChunkDecoder::start(std::string_view bytes, const LazChunk& chunk)
{
  const std::size_t length = schema_.recordLength;
  const std::string_view content = bytes.substr(chunk.offset, chunk.size);
  failTruncatedIf(content.size() < length + (schema_.isLayered() ? sizeof(std::uint32_t) : 0),
    "byte {}: a chunk of {} bytes does not hold its first point", chunk.offset, content.size());
  chunk_ = chunk;
  done_ = 0;
  first_ = content.data();
  const auto begin = [&](auto& items) { items.begin(content.substr(length), onlyPositions_); };
  schema_.isLayered() ? begin(layered_.emplace(schema_, first_)) : begin(pointwise_.emplace(schema_, first_));
}

void ChunkDecoder::next(char* records, std::size_t count)
{
  if (done_ == 0 && count > 0)
  {
    std::copy_n(first_, schema_.recordLength, records);
    records += schema_.recordLength;
    --count;
    ++done_;
  }
  if (count == 0)
  {
    return;
  }
  layered_ ? layered_->code(records, count) : pointwise_->code(records, count);
  failTruncatedIf(layered_ ? layered_->isDamaged() : pointwise_->isDamaged(),
    "point {} and those behind it: the chunk at byte {} ends before its {} points", chunk_.first + done_,
    chunk_.offset, chunk_.count);
  done_ += count;
}

std::string encodeChunk(const LazSchema& schema, char* records, std::size_t count)
{
  const auto encodeBy = [&](auto items)
  {
    constexpr std::size_t kBlock = 4096; // goes through all layers before the next does: stays in the cache
    std::string chunk(records, schema.recordLength);
    for (std::size_t at = 1; at < count; at += kBlock)
    {
      items.code(records + at * schema.recordLength, std::min(kBlock, count - at));
    }
    items.finish(chunk, count);
    return chunk;
  };
  return schema.isLayered() ? encodeBy(LayeredItems<ArithmeticEncoder>(schema, records))
                            : encodeBy(PointwiseItems<ArithmeticEncoder>(schema, records));
}

} // namespace pointhaptics::io
