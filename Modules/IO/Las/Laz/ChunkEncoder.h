/// @file
/// Encodes records as the chunks of a LAZ file.
#pragma once

#include "IO/Las/Laz/LazSchema.h"

#include <memory>
#include <string>

namespace pointhaptics::io
{

/// One chunk after the other; keeps its memory, up to a few MB, from chunk to chunk. One thread.
class ChunkEncoder
{
public:
  /// @p schema must be one of makeLazSchema() and outlive this object.
  explicit ChunkEncoder(const LazSchema& schema);
  ~ChunkEncoder();
  ChunkEncoder(const ChunkEncoder&) = delete;
  ChunkEncoder& operator=(const ChunkEncoder&) = delete;

  /// The chunk of the @p count records at @p records, at least one, each of schema.recordLength bytes. The
  /// records are as before when this returns.
  std::string encode(char* records, std::size_t count);

private:
  struct Pointwise;
  struct Layered;

  const LazSchema& schema_;
  std::unique_ptr<Pointwise> pointwise_;
  std::unique_ptr<Layered> layered_;
};

} // namespace pointhaptics::io
