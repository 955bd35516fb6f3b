/// @file
/// Decodes the chunks of a LAZ file into the records that an uncompressed file would hold.
#pragma once

#include "IO/Las/Laz/ArithmeticDecoder.h"
#include "IO/Las/Laz/LayeredItems.h"
#include "IO/Las/Laz/LazChunks.h"
#include "IO/Las/Laz/PointwiseItems.h"

#include <optional>

namespace pointhaptics::io
{

/// Which fields of the records are decoded; the others hold anything.
enum class LazFields
{
  All,
  Positions, ///< x, y and z. Saves the work of the others in layered files only.
};

/// One chunk after the other; keeps its memory, up to a few MB, from chunk to chunk. One thread.
class ChunkDecoder
{
public:
  /// @p schema must outlive this object.
  ChunkDecoder(const LazSchema& schema, LazFields fields);

  /// Begins @p chunk of the file @p bytes. @throws FileProblem where its layers do not lie inside it.
  void start(std::string_view bytes, const LazChunk& chunk);
  /// The next @p count records of the chunk, written to @p records. @throws FileProblem where the compressed
  /// data end too early or are damaged: found after the block, not at the point.
  void next(char* records, std::size_t count);
  /// Bytes of a chunk of a pointwise file whose points have all been decoded.
  std::size_t chunkSize() const { return schema_.recordLength + pointwise_->position(); }

private:
  const LazSchema& schema_;
  LazFields fields_;
  LazChunk chunk_;
  std::uint64_t done_ = 0;
  const char* first_ = nullptr;
  std::optional<PointwiseItems<ArithmeticDecoder>> pointwise_; ///< One of the two is there.
  std::optional<LayeredItems<ArithmeticDecoder>> layered_;
};

} // namespace pointhaptics::io
