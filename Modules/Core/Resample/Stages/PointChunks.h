/// @file
/// The points to process, in chunks of pieces.
#pragma once

#include "Core/Base/PointView.h"
#include "Core/Neighbors/PointIndex.h"
#include "Core/Resample/VoxelResampler.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace pointhaptics::simd
{

/// Points of a piece: enough to make the cost of scheduling it negligible.
constexpr std::int64_t kPieceSize = 1 << 12;

/// Points between two reports; threads take the pieces of a chunk one by one. There is at least one, which
/// may be empty.
class Chunks
{
public:
  /// @p mostPoints: of a chunk; request.chunkPoints may ask for fewer.
  Chunks(const VoxelRequest& request, std::int64_t mostPoints, const Executor& executor)
  {
    const std::int64_t chunkPoints =
      request.chunkPoints > 0 ? std::min(request.chunkPoints, mostPoints) : mostPoints;
    if (request.index)
    {
      points_ = request.index->points();
      originals_ = request.index->originals();
      const Lattice& lattice = request.part ? *request.part : request.lattice;
      for (const PointRange& range : request.index->rangesInside(request.transform, lattice, executor))
      {
        append(range, chunkPoints);
      }
    }
    else
    {
      points_ = request.points;
      append({ 0, points_.size() }, chunkPoints);
    }
    if (chunks_.empty())
    {
      chunks_.push_back(0);
    }
    chunks_.push_back(pieces_.size());
  }
  const PointView& points() const { return points_; }
  /// The numbers of these in the cloud; null: they are those.
  const std::uint32_t* originals() const { return originals_; }
  std::size_t count() const { return chunks_.size() - 1; }
  const PointRange* pieces(std::size_t chunk) const { return pieces_.data() + chunks_[chunk]; }
  std::int64_t pieceCount(std::size_t chunk) const
  {
    return std::int64_t(chunks_[chunk + 1] - chunks_[chunk]);
  }
  std::int64_t pointCount(std::size_t chunk) const
  {
    std::int64_t sum = 0;
    for (std::size_t i = chunks_[chunk]; i < chunks_[chunk + 1]; ++i)
    {
      sum += pieces_[i].end - pieces_[i].begin;
    }
    return sum;
  }

private:
  void append(PointRange range, std::int64_t chunkPoints)
  {
    while (range.begin < range.end)
    {
      if (chunks_.empty() || inChunk_ == chunkPoints)
      {
        chunks_.push_back(pieces_.size());
        inChunk_ = 0;
      }
      const std::int64_t size = std::min({ range.end - range.begin, kPieceSize, chunkPoints - inChunk_ });
      pieces_.push_back({ range.begin, range.begin + size });
      range.begin += size;
      inChunk_ += size;
    }
  }

  PointView points_;
  const std::uint32_t* originals_ = nullptr;
  std::vector<PointRange> pieces_;
  std::vector<std::size_t> chunks_; ///< First pieces, and an end.
  std::int64_t inChunk_ = 0;
};

} // namespace pointhaptics::simd
