/// @file
/// Encodes records as the chunks of a LAZ file.
#pragma once

#include "IO/Las/Laz/ArithmeticEncoder.h"
#include "IO/Las/Laz/LayeredItems.h"
#include "IO/Las/Laz/PointwiseItems.h"

#include <string>

namespace pointhaptics::io
{

/// One chunk after the other. One thread.
class ChunkEncoder
{
public:
  /// @p schema must be one of makeLazSchema() and outlive this object.
  explicit ChunkEncoder(const LazSchema& schema)
    : schema_(schema)
  {
  }
  /// The chunk of the @p count records at @p records, at least one, each of schema.recordLength bytes. The
  /// records are as before when this returns.
  std::string encode(char* records, std::size_t count) const
  {
    using Encoder = ArithmeticEncoder;
    return schema_.isLayered() ? encodeBy(LayeredItems<Encoder>(schema_, records), records, count)
                               : encodeBy(PointwiseItems<Encoder>(schema_, records), records, count);
  }

private:
  template <typename Items>
  std::string encodeBy(Items items, char* records, std::size_t count) const
  {
    constexpr std::size_t kBlock = 4096; // goes through all layers before the next does: stays in the cache
    std::string chunk(records, schema_.recordLength);
    for (std::size_t at = 1; at < count; at += kBlock)
    {
      items.code(records + at * schema_.recordLength, std::min(kBlock, count - at));
    }
    items.finish(chunk, count);
    return chunk;
  }

  const LazSchema& schema_;
};

} // namespace pointhaptics::io
