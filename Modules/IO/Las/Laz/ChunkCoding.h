/// @file
/// Decodes the chunks of a LAZ file into the records that an uncompressed file would hold, and encodes these.
#pragma once

#include "IO/Las/Laz/ArithmeticCoder.h"
#include "IO/Las/Laz/LayeredItems.h"
#include "IO/Las/Laz/LazChunks.h"
#include "IO/Las/Laz/PointwiseItems.h"

#include <optional>
#include <string>

namespace pointhaptics::io
{

/// One chunk after the other. One thread.
class ChunkDecoder
{
public:
  /// @p schema must outlive this object. @p onlyPositions: fields but x, y and z may hold anything, which
  /// saves their work in layered files.
  explicit ChunkDecoder(const LazSchema& schema, bool onlyPositions = false)
    : schema_(schema)
    , onlyPositions_(onlyPositions)
  {
  }

  /// Begins @p chunk of the file @p bytes. @throws FileProblem where its layers do not lie inside it.
  void start(std::string_view bytes, const LazChunk& chunk);
  /// The next @p count records of the chunk, written to @p records. @throws FileProblem where the compressed
  /// data end too early or are damaged: found after the block, not at the point.
  void next(char* records, std::size_t count);
  /// Bytes of a chunk of a pointwise file whose points have all been decoded.
  std::size_t chunkSize() const { return schema_.recordLength + pointwise_->position(); }

private:
  const LazSchema& schema_;
  const bool onlyPositions_;
  LazChunk chunk_;
  std::uint64_t done_ = 0;
  const char* first_ = nullptr;
  std::optional<PointwiseItems<ArithmeticDecoder>> pointwise_; ///< One of the two is in use.
  std::optional<LayeredItems<ArithmeticDecoder>> layered_;
};

/// The chunk of the @p count records at @p records, at least one, each of schema.recordLength bytes. The
/// records are as before when this returns. @p schema: one of makeLazSchema(). Any thread.
std::string encodeChunk(const LazSchema& schema, char* records, std::size_t count);

} // namespace pointhaptics::io
