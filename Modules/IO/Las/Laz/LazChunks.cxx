#include "IO/Las/Laz/LazChunks.h"

#include "FileProblem.h"
#include "IO/Las/LasHeader.h"
#include "IO/Las/Laz/ArithmeticCoder.h"
#include "IO/Las/Laz/IntegerModels.h"
#include "IO/Las/Laz/LazSchema.h"
#include "ReadTask.h"

namespace pointhaptics::io
{

namespace
{

constexpr std::uint64_t kTableAtTheEnd = 0xffffffffffffffff;
constexpr std::uint64_t kMostPoints = 0xfffffffe; ///< of a chunk
constexpr std::size_t kTableHeader = 8;           ///< bytes: version and number of chunks

/// Finds the chunks of one file; one object per file.
class ChunkFinder
{
public:
  ChunkFinder(ReadTask& task, const LasHeader& header, const LazSchema& schema)
    : bytes_(task.bytes)
    , header_(header)
    , schema_(schema)
    , chunkSize_(schema.chunkSize)
    , task_(task)
    , isSalvaged_(task.salvage && !task.shared)
    , first_(header.pointsOffset + sizeof(std::uint64_t))
  {
  }
  LazChunks find();

private:
  bool hasVariableChunks() const { return chunkSize_ == LazSchema::kVariableChunks; }
  /// 0 where the writer was interrupted before it.
  std::size_t tableOffset() const;
  LazChunks readTable(std::size_t table) const;
  LazChunks readUntoldTable(std::size_t table);
  LazChunks walkLayers() const;
  LazChunks countOnly() const;
  bool add(LazChunks& chunks, std::size_t offset, std::size_t size, std::uint64_t count) const;
  void checkSum(const LazChunks& chunks, std::size_t at) const;

  std::string_view bytes_;
  const LasHeader& header_;
  const LazSchema& schema_;
  std::uint32_t chunkSize_; ///< points
  ReadTask& task_;
  const bool isSalvaged_;
  std::size_t first_; ///< byte of the first chunk
};

std::size_t ChunkFinder::tableOffset() const
{
  failTruncatedIf(first_ > bytes_.size(), "the file ends at byte {} before its first chunk", bytes_.size());
  std::uint64_t table = numberAt<std::uint64_t>(bytes_, header_.pointsOffset);
  if (table == header_.pointsOffset)
  {
    return 0;
  }
  table = table == kTableAtTheEnd ? numberAt<std::uint64_t>(bytes_, bytes_.size() - 8) : table;
  if (isSalvaged_ && (table < first_ || table > bytes_.size() - kTableHeader))
  {
    return 0; // it is cut off
  }
  failTruncatedIf(table < first_ || table > bytes_.size() - kTableHeader,
    "byte {}: the table of chunks is at byte {} of a file of {} bytes", header_.pointsOffset, table,
    bytes_.size());
  return static_cast<std::size_t>(table);
}

/// Adds a chunk with as many of its @p count points as the header counts. @return false when it has them all.
bool ChunkFinder::add(LazChunks& chunks, std::size_t offset, std::size_t size, std::uint64_t count) const
{
  const std::uint64_t done = chunks.points();
  count = std::min(count, header_.count - done);
  if (count > 0)
  {
    chunks.all.push_back({ offset, size, done, count });
  }
  return done + count < header_.count;
}

void ChunkFinder::checkSum(const LazChunks& chunks, std::size_t at) const
{
  if (const std::uint64_t sum = chunks.points(); sum < header_.count)
  {
    const std::string what =
      fmt::format("the header counts {} points, but the chunks hold {}", header_.count, sum);
    isSalvaged_ ? void(task_.endAt(sum, header_.count, atByte(at) + what)) : failDamaged(at, what);
  }
}

LazChunks ChunkFinder::readTable(std::size_t table) const
{
  // Each chunk begins with a whole point.
  const std::size_t count = numberAt<std::uint32_t>(bytes_, table + 4);
  failDamagedIf(
    numberAt<std::uint32_t>(bytes_, table) != 0 || count > (table - first_) / header_.recordLength, table,
    "a table of {} chunks, which {} compressed bytes cannot be", count, table - first_);
  ArithmeticDecoder decoder(bytes_.substr(table + kTableHeader));
  IntegerModels numbers(32, 2);
  LazChunks chunks;
  std::uint32_t points = hasVariableChunks() ? 0 : chunkSize_;
  std::uint32_t size = 0;
  std::size_t offset = first_;
  bool goesOn = true;
  for (std::size_t i = 0; i < count && goesOn; ++i)
  {
    if (hasVariableChunks())
    {
      points = static_cast<std::uint32_t>(numbers.code(decoder, static_cast<std::int32_t>(points), 0, 0));
    }
    size = static_cast<std::uint32_t>(numbers.code(decoder, static_cast<std::int32_t>(size), 0, 1));
    failDamagedIf(decoder.isDamaged() || size > table - offset || (points > 0 && size < header_.recordLength),
      table, "chunk {} of {} has {} bytes at byte {}, which {} points cannot be", i, count, size, offset,
      points);
    goesOn = add(chunks, offset, size, points);
    offset += size;
  }
  checkSum(chunks, table);
  return chunks;
}

/// A layered chunk says itself how many points and bytes it has.
LazChunks ChunkFinder::walkLayers() const
{
  const std::size_t layers = schema_.numberOfLayers();
  const std::size_t sizesAt = header_.recordLength + sizeof(std::uint32_t);
  const std::size_t headSize = sizesAt + layers * sizeof(std::uint32_t);
  LazChunks chunks;
  std::size_t offset = first_;
  for (bool goesOn = true; goesOn;)
  {
    const std::size_t left = bytes_.size() - offset;
    std::uint64_t size = headSize;
    for (std::size_t i = 0; i < layers && left >= headSize; ++i)
    {
      size += numberAt<std::uint32_t>(bytes_, offset + sizesAt + i * sizeof(std::uint32_t));
    }
    const std::uint32_t points =
      left < headSize ? 0 : numberAt<std::uint32_t>(bytes_, offset + header_.recordLength);
    if (left < headSize || (isSalvaged_ && (size > left || points == 0)))
    {
      checkSum(chunks, offset);
      break;
    }
    failDamagedIf(size > left || points == 0, offset,
      "a chunk of {} points in {} bytes, of which {} are there", points, size, left);
    goesOn = add(chunks, offset, static_cast<std::size_t>(size), points);
    offset += static_cast<std::size_t>(size);
  }
  return chunks;
}

/// For a file that does not say how large its chunks are: the table has their numbers of points, as it
/// should, or it was written as that of the usual size, which layered chunks do not need.
LazChunks ChunkFinder::readUntoldTable(std::size_t table)
{
  try
  {
    LazChunks chunks = readTable(table);
    if (chunks.all.back().offset + chunks.all.back().size == table)
    {
      return chunks;
    }
  }
  catch (const FileProblem&)
  {
    // It has no numbers of points.
  }
  if (schema_.isLayered())
  {
    return walkLayers();
  }
  const bool isOne = numberAt<std::uint32_t>(bytes_, table + 4) == 1;
  chunkSize_ = isOne ? static_cast<std::uint32_t>(std::min<std::uint64_t>(header_.count, kMostPoints))
                     : LazSchema().chunkSize;
  return readTable(table);
}

LazChunks ChunkFinder::countOnly() const
{
  failFormatIf(hasVariableChunks(), "the file was not completely written: write it again",
    "byte {}: there is no table of chunks, whose numbers of points vary", header_.pointsOffset);
  const std::size_t available = bytes_.size() - first_;
  failTruncatedIf((header_.count - 1) / chunkSize_ >= available / header_.recordLength + 1,
    "chunks of {} points for the {} that the header counts are more than {} bytes can be", chunkSize_,
    header_.count, available);
  LazChunks chunks;
  chunks.arePlaced = false;
  while (add(chunks, first_, available, chunkSize_))
  {
  }
  return chunks;
}

LazChunks ChunkFinder::find()
{
  checkLazCount(bytes_, header_);
  if (schema_.compressor == LazSchema::Compressor::Pointwise)
  {
    LazChunks chunks;
    add(chunks, header_.pointsOffset, bytes_.size() - header_.pointsOffset, header_.count);
    return chunks;
  }
  task_.need(header_.pointsOffset, sizeof(std::uint64_t));
  task_.need(bytes_.size() - sizeof(std::uint64_t), sizeof(std::uint64_t));
  const std::size_t table = tableOffset();
  task_.need(table != 0 ? table : first_, bytes_.size());
  if (table != 0)
  {
    return schema_.isChunkSizeTold ? readTable(table) : readUntoldTable(table);
  }
  chunkSize_ = schema_.isChunkSizeTold ? chunkSize_ : LazSchema().chunkSize;
  return schema_.isLayered() ? walkLayers() : countOnly();
}

} // namespace

void checkLazCount(std::string_view bytes, const LasHeader& header)
{
  const std::size_t most = std::max(kLazFloor, kMostLazRatio * bytes.size()) / header.recordLength;
  failFormatIf(header.count > most, "if this is no attack, unpack it first: laszip -i in.laz -o out.las",
    "the header counts {} points, but a file of {} bytes is not expected to hold more than {}", header.count,
    bytes.size(), most);
}

LazChunks findLazChunks(ReadTask& task, const LasHeader& header, const LazSchema& schema)
{
  return ChunkFinder(task, header, schema).find();
}

std::string lazChunkTable(const std::vector<LazChunk>& chunks, const LazSchema& schema)
{
  std::string table(kTableHeader, '\0');
  storeLittle(static_cast<std::uint32_t>(chunks.size()), &table[4]);
  ArithmeticEncoder encoder;
  IntegerModels numbers(32, 2);
  LazChunk before;
  for (const LazChunk& chunk : chunks)
  {
    if (schema.chunkSize == LazSchema::kVariableChunks)
    {
      numbers.code(
        encoder, static_cast<std::int32_t>(before.count), static_cast<std::int32_t>(chunk.count), 0);
    }
    numbers.code(encoder, static_cast<std::int32_t>(before.size), static_cast<std::int32_t>(chunk.size), 1);
    before = chunk;
  }
  return table + encoder.finish();
}

} // namespace pointhaptics::io
