#include "IO/Las/Laz/ChunkDecoder.h"

#include "FileProblem.h"
#include "IO/Las/Laz/ArithmeticDecoder.h"
#include "IO/Las/Laz/LayeredItems.h"
#include "IO/Las/Laz/PointwiseItems.h"

namespace pointhaptics::io
{

struct ChunkDecoder::Pointwise
{
  explicit Pointwise(const LazSchema& schema)
    : items(schema)
  {
  }
  bool isDamaged() const { return decoder.isDamaged(); }

  ArithmeticDecoder decoder;
  PointwiseItems<ArithmeticDecoder> items;
};

struct ChunkDecoder::Layered
{
  explicit Layered(const LazSchema& schema)
    : items(schema)
  {
  }
  bool isDamaged()
  {
    bool result = false;
    for (std::size_t i = 0; i < items.numberOfLayers(); ++i)
    {
      result = result || (items.isUsed(i) && items.coder(i).isDamaged());
    }
    return result;
  }
  void start(std::string_view chunk, std::size_t at, LazFields fields);

  LayeredItems<ArithmeticDecoder> items;
};

/// @p chunk: its bytes; @p at: where the sizes of the layers begin in it.
void ChunkDecoder::Layered::start(std::string_view chunk, std::size_t at, LazFields fields)
{
  constexpr std::size_t kSizeOfSize = sizeof(std::uint32_t);
  constexpr std::size_t kLayersOfPositions = 2;
  std::size_t begin = at + kSizeOfSize * items.numberOfLayers();
  for (std::size_t i = 0; i < items.numberOfLayers() && begin <= chunk.size(); ++i)
  {
    const std::size_t size = loadLittle<std::uint32_t>(chunk.data() + at + kSizeOfSize * i);
    if (size > chunk.size() - begin)
    {
      begin = chunk.size() + 1;
      break;
    }
    const bool isWanted = fields == LazFields::All || i < kLayersOfPositions;
    items.setUsed(i, i == 0 || (isWanted && size > 0));
    if (items.isUsed(i))
    {
      items.coder(i).start(chunk.substr(begin, size));
    }
    begin += size;
  }
  if (begin > chunk.size())
  {
    failTruncated("the layers of a chunk take more than its " + std::to_string(chunk.size()) + " bytes");
  }
}

ChunkDecoder::ChunkDecoder(const LazSchema& schema, LazFields fields)
  : schema_(schema)
  , fields_(fields)
{
  if (schema.compressor == LazSchema::Compressor::Layered)
  {
    layered_ = std::make_unique<Layered>(schema);
  }
  else
  {
    pointwise_ = std::make_unique<Pointwise>(schema);
  }
}

ChunkDecoder::~ChunkDecoder() = default;

void ChunkDecoder::start(std::string_view bytes, const LazChunk& chunk)
{
  const std::size_t length = schema_.recordLength;
  const std::size_t headSize = length + (layered_ ? sizeof(std::uint32_t) : 0);
  const std::string_view content = bytes.substr(chunk.offset, chunk.size);
  if (content.size() < headSize)
  {
    failTruncated("byte " + std::to_string(chunk.offset) + ": a chunk of " + std::to_string(content.size()) +
      " bytes does not hold its first point");
  }
  chunk_ = chunk;
  done_ = 0;
  first_ = content.data();
  if (layered_)
  {
    layered_->start(content, headSize, fields_);
    layered_->items.start(first_);
  }
  else
  {
    pointwise_->decoder.start(content.substr(headSize));
    pointwise_->items.start(first_);
  }
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
  layered_ ? layered_->items.code(records, count)
           : pointwise_->items.code(pointwise_->decoder, records, count);
  if (layered_ ? layered_->isDamaged() : pointwise_->isDamaged())
  {
    failTruncated("point " + std::to_string(chunk_.first + done_) +
      " and those behind it: the chunk at byte " + std::to_string(chunk_.offset) + " ends before its " +
      std::to_string(chunk_.count) + " points");
  }
  done_ += count;
}

std::size_t ChunkDecoder::chunkSize() const
{
  return schema_.recordLength + pointwise_->decoder.position();
}

} // namespace pointhaptics::io
