/// @file
/// Encodes records as the chunks of a LAZ file.
#pragma once

#include "IO/Las/Laz/ArithmeticEncoder.h"
#include "IO/Las/Laz/LayeredItems.h"
#include "IO/Las/Laz/PointwiseItems.h"

#include <optional>
#include <string>

namespace pointhaptics::io
{

/// One chunk after the other; keeps its memory, up to a few MB, from chunk to chunk. One thread.
class ChunkEncoder
{
public:
  /// @p schema must be one of makeLazSchema() and outlive this object.
  explicit ChunkEncoder(const LazSchema& schema)
    : length_(schema.recordLength)
  {
    schema.compressor == LazSchema::Compressor::Layered ? void(layered_.emplace(schema))
                                                        : void(pointwise_.emplace(schema));
  }
  /// The chunk of the @p count records at @p records, at least one, each of schema.recordLength bytes. The
  /// records are as before when this returns.
  std::string encode(char* records, std::size_t count)
  {
    return layered_ ? encodeAs(*layered_, records, count) : encodeAs(*pointwise_, records, count);
  }

private:
  template <typename Items>
  std::string encodeAs(Items& items, char* records, std::size_t count) const
  {
    constexpr std::size_t kBlock = 4096; // goes through all layers before the next does: stays in the cache
    std::string chunk(records, length_);
    items.start(records);
    for (std::size_t at = 1; at < count; at += kBlock)
    {
      items.code(records + at * length_, std::min(kBlock, count - at));
    }
    items.finish(chunk, count);
    return chunk;
  }

  std::size_t length_;
  std::optional<PointwiseItems<ArithmeticEncoder>> pointwise_; ///< One of the two is there.
  std::optional<LayeredItems<ArithmeticEncoder>> layered_;
};

} // namespace pointhaptics::io
