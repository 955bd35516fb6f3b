#include "IO/Las/Laz/ChunkDecoder.h"

#include "Bytes/Checks.h"

namespace pointhaptics::io
{

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

} // namespace pointhaptics::io
