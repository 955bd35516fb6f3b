#include "IO/Las/Laz/ChunkDecoder.h"

#include "FileProblem.h"

namespace pointhaptics::io
{

ChunkDecoder::ChunkDecoder(const LazSchema& schema, LazFields fields)
  : schema_(schema)
  , fields_(fields)
{
  schema.compressor == LazSchema::Compressor::Layered ? void(layered_.emplace(schema))
                                                      : void(pointwise_.emplace(schema));
}

void ChunkDecoder::start(std::string_view bytes, const LazChunk& chunk)
{
  const std::size_t length = schema_.recordLength;
  const std::string_view content = bytes.substr(chunk.offset, chunk.size);
  if (content.size() < length + (layered_ ? sizeof(std::uint32_t) : 0))
  {
    failTruncated(atByte(chunk.offset) + "a chunk of " + std::to_string(content.size()) +
      " bytes does not hold its first point");
  }
  chunk_ = chunk;
  done_ = 0;
  first_ = content.data();
  const auto begin = [&](auto& items)
  {
    items.begin(content.substr(length), fields_ == LazFields::Positions);
    items.start(first_);
  };
  layered_ ? begin(*layered_) : begin(*pointwise_);
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
  if (layered_ ? layered_->isDamaged() : pointwise_->isDamaged())
  {
    failTruncated("point " + std::to_string(chunk_.first + done_) +
      " and those behind it: the chunk at byte " + std::to_string(chunk_.offset) + " ends before its " +
      std::to_string(chunk_.count) + " points");
  }
  done_ += count;
}

} // namespace pointhaptics::io
