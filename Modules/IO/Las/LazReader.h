/// @file
/// Reads the points of LAZ and COPC files: chunks are decoded in parallel, straight into the arrays.
#pragma once

#include "IO/Las/Laz/ChunkDecoder.h"

#include "SharedReading.h"

#include "vtkType.h"

#include <atomic>
#include <exception>
#include <thread>
#include <vector>

namespace pointhaptics::io
{

class LasRecords;
struct LasHeader;
struct ReadTask;

/// Records of a block stay in the cache while their columns are filled one after the other.
constexpr vtkIdType kLasBlockRows = 4096;

/// Reads the points of one file; one object per file.
class LazReader
{
public:
  /// Finds the chunks of the file, and where not all is loaded has those read that hold wanted points: of a
  /// part of a cloud optimised one, and where ranks read together of this one. @throws FileProblem where what
  /// the file says of them cannot be true.
  /// @p task must outlive this object.
  LazReader(ReadTask& task, const LasHeader& header);
  /// The points that read() gives: those of the header, or of the wanted part; where ranks read together,
  /// this one's of them.
  std::uint64_t count() const { return rows_.count(); }
  /// True if WantedPart::mostPoints left out points.
  bool isCoarse() const { return chunks_.isCoarse; }
  /// Parts that are packed one by one, of those points.
  std::int64_t numberOfChunks() const { return std::int64_t(chunks_.all.size()); }
  /// Fills @p records with the points in the file's order. Uses as many threads as vtkSMPTools has; progress
  /// is reported from the calling one, which decodes too. @throws FileProblem, StoppedOnRequest.
  void read(LasRecords& records);

private:
  bool isCallingThread() const { return std::this_thread::get_id() == caller_; }
  void work(LasRecords& records) noexcept;
  void readChunk(ChunkDecoder& decoder, std::vector<char>& block, const LazChunk& chunk, LasRecords& records);
  void readInOrder(LasRecords& records);
  std::uint64_t salvageChunk(
    ChunkDecoder& decoder, std::vector<char>& block, const LazChunk& chunk, LasRecords& records);

  ReadTask& task_;
  const LazSchema schema_;
  const LazChunks chunks_;
  const RowRange rows_; ///< of the points of all chunks
  const std::thread::id caller_ = std::this_thread::get_id();
  std::atomic<std::size_t> next_{ 0 };
  std::atomic<std::uint64_t> done_{ 0 }; ///< points
  std::atomic<bool> isStopped_{ false };
  std::vector<std::exception_ptr> faults_; ///< of each chunk
};

} // namespace pointhaptics::io
