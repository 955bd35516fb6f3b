#include "IO/Las/Laz/ChunkEncoder.h"

#include "IO/Las/Laz/ArithmeticEncoder.h"
#include "IO/Las/Laz/LayeredItems.h"
#include "IO/Las/Laz/PointwiseItems.h"

#include <algorithm>

namespace pointhaptics::io
{

namespace
{

/// Records that go through all layers before the next ones do: they stay in the cache.
constexpr std::size_t kBlock = 4096;

void append32(std::string& bytes, std::size_t value)
{
  char raw[sizeof(std::uint32_t)];
  storeLittle(static_cast<std::uint32_t>(value), raw);
  bytes.append(raw, sizeof(raw));
}

} // namespace

struct ChunkEncoder::Pointwise
{
  explicit Pointwise(const LazSchema& schema)
    : items(schema)
  {
  }
  void code(char* records, std::size_t count) { items.code(encoder, records, count); }
  void finish(std::string& chunk, std::size_t) { chunk += encoder.finish(); }

  ArithmeticEncoder encoder;
  PointwiseItems<ArithmeticEncoder> items;
};

struct ChunkEncoder::Layered
{
  explicit Layered(const LazSchema& schema)
    : items(schema)
  {
  }
  void code(char* records, std::size_t count) { items.code(records, count); }
  void finish(std::string& chunk, std::size_t count);

  LayeredItems<ArithmeticEncoder> items;
};

/// Number of points, sizes of the layers, layers. Those without changes have size 0, but for the first.
void ChunkEncoder::Layered::finish(std::string& chunk, std::size_t count)
{
  append32(chunk, count);
  std::string content;
  for (std::size_t i = 0; i < items.numberOfLayers(); ++i)
  {
    const std::string layer = items.coder(i).finish();
    const std::size_t size = items.hasChanges(i) ? layer.size() : 0;
    append32(chunk, size);
    content.append(layer, 0, size);
  }
  chunk += content;
}

ChunkEncoder::ChunkEncoder(const LazSchema& schema)
  : schema_(schema)
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

ChunkEncoder::~ChunkEncoder() = default;

std::string ChunkEncoder::encode(char* records, std::size_t count)
{
  const std::size_t length = schema_.recordLength;
  std::string chunk(records, length);
  const auto encodeAll = [&](auto& coder)
  {
    coder.items.start(records);
    for (std::size_t at = 1; at < count; at += kBlock)
    {
      coder.code(records + at * length, std::min(kBlock, count - at));
    }
    coder.finish(chunk, count);
  };
  if (layered_)
  {
    encodeAll(*layered_);
  }
  else
  {
    encodeAll(*pointwise_);
  }
  return chunk;
}

} // namespace pointhaptics::io
