#include "ReadTask.h"

#include "FileProblem.h"
#include "IO/Info/FieldText.h"
#include "IO/Info/LengthUnit.h"
#include "IO/Las/LasHeader.h"
#include "IO/Las/LasRecords.h"
#include "IO/Las/Laz/ChunkCoding.h"
#include "IO/Las/Laz/LazChunks.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkType.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <optional>
#include <thread>
#include <vector>

namespace pointhaptics::io
{

namespace
{

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
  const LazChunks& chunks() const { return chunks_; }
  /// Fills @p records with the points in the file's order. Uses as many threads as vtkSMPTools has; progress
  /// is reported from the calling one, which decodes too. @throws FileProblem, StoppedOnRequest.
  void read(LasRecords& records);

private:
  void readChunk(ChunkDecoder& decoder, const LazChunk& chunk, std::uint64_t atOnce, std::uint64_t& there,
    LasRecords& records);
  void readAlone(std::size_t chunk, LasRecords& records) noexcept;
  void readInOrder(LasRecords& records);

  ReadTask& task_;
  const LazSchema schema_;
  const LazChunks chunks_;
  const RowRange rows_; ///< of the points of all chunks
  const std::thread::id caller_ = std::this_thread::get_id();
  std::atomic<std::uint64_t> done_{ 0 };   ///< points
  std::atomic<bool> isStopped_{ false };   ///< on request: no other chunk is begun
  std::vector<std::exception_ptr> faults_; ///< of each chunk
};

LazChunks chunksOf(ReadTask& task, const LasHeader& header, const LazSchema& schema)
{
  if (!task.load || !task.wanted.isPart())
  {
    return findLazChunks(task, header, schema);
  }
  checkLazCount(task.bytes, header);
  LazChunks part = findCopcChunks(task, header);
  failFormatIf(part.all.empty(), "choose a box that meets the bounds of the cloud",
    "no node of the octree touches the box");
  return part;
}

RowRange rowsOf(ReadTask& task, const LazChunks& chunks)
{
  const RowRange rows = task.rowsOf(chunks.points());
  for (std::size_t i = 0; task.load && i < chunks.all.size(); ++i)
  {
    const LazChunk& chunk = chunks.all[i];
    // Where it is not known where they lie, all was loaded to find them.
    if (chunks.arePlaced && rows.meets(chunk.first, chunk.first + chunk.count))
    {
      task.need(chunk.offset, chunk.size);
    }
    task.readingProgress(static_cast<double>(i + 1) / static_cast<double>(chunks.all.size()));
  }
  return rows;
}

LazReader::LazReader(ReadTask& task, const LasHeader& header)
  : task_(task)
  , schema_(parseLazSchema(task.bytes, header))
  , chunks_(chunksOf(task, header, schema_))
  , rows_(rowsOf(task, chunks_))
  , faults_(chunks_.all.size())
{
}

/// Decodes the chunk as far as points of it are wanted, @p atOnce of them at a time; @p there counts all that
/// were decoded.
void LazReader::readChunk(ChunkDecoder& decoder, const LazChunk& chunk, std::uint64_t atOnce,
  std::uint64_t& there, LasRecords& records)
{
  std::vector<char> block(atOnce * schema_.recordLength);
  decoder.start(task_.bytes, chunk);
  const std::uint64_t end = std::min(chunk.first + chunk.count, rows_.last);
  for (std::uint64_t at = chunk.first; at < end; there = at - chunk.first)
  {
    const std::uint64_t next = std::min(at + atOnce, end);
    decoder.next(block.data(), static_cast<std::size_t>(next - at));
    const std::uint64_t first = std::max(at, rows_.first);
    if (first < next)
    {
      records.fill({ block.data() + static_cast<std::size_t>(first - at) * schema_.recordLength,
        static_cast<vtkIdType>(first - rows_.first), static_cast<vtkIdType>(next - first) });
      done_ += next - first;
    }
    at = next;
    if (std::this_thread::get_id() == caller_ && rows_.count() > 0)
    {
      task_.progress(static_cast<double>(done_) / static_cast<double>(rows_.count()));
    }
  }
}

void LazReader::readAlone(std::size_t chunk, LasRecords& records) noexcept
{
  try
  {
    const LazChunk& wanted = chunks_.all[chunk];
    ChunkDecoder decoder(schema_, task_.wanted.onlyPositions);
    std::uint64_t there = 0;
    rows_.meets(wanted.first, wanted.first + wanted.count) && !isStopped_
      ? readChunk(decoder, wanted, kLasBlockRows, there, records)
      : void();
  }
  catch (const StoppedOnRequest&)
  {
    isStopped_ = true;
    faults_[chunk] = std::current_exception();
  }
  catch (...)
  {
    faults_[chunk] = std::current_exception();
  }
}

/// Each chunk tells where the next one begins, where it is not known. A salvaged file ends at the first
/// fault, and the points before it are there.
void LazReader::readInOrder(LasRecords& records)
{
  ChunkDecoder decoder(schema_);
  std::size_t offset = chunks_.all.front().offset;
  done_ = 0;
  for (LazChunk chunk : chunks_.all)
  {
    if (chunk.first >= rows_.last)
    {
      break;
    }
    if (!chunks_.arePlaced)
    {
      chunk.offset = offset;
      chunk.size = task_.bytes.size() - offset;
    }
    std::uint64_t there = 0;
    try
    {
      readChunk(decoder, chunk, kLasBlockRows, there, records);
      offset += chunks_.arePlaced ? 0 : decoder.chunkSize();
    }
    catch (const FileProblem& problem)
    {
      task_.salvage ? void() : throw;
      try
      {
        readChunk(decoder, chunk, 1, there = 0, records);
      }
      catch (const FileProblem&)
      {
        // The points before it are there.
      }
      task_.endAt(chunk.first + there, rows_.count(), problem.what());
      return;
    }
  }
}

void LazReader::read(LasRecords& records)
try
{
  const std::size_t wave =
    8 * static_cast<std::size_t>(std::max(vtkSMPTools::GetEstimatedNumberOfThreads(), 1));
  const std::size_t all = chunks_.arePlaced ? chunks_.all.size() : 0;
  all == 0 ? readInOrder(records) : void();
  for (std::size_t begin = 0; begin < all; begin += wave)
  {
    const std::size_t end = std::min(begin + wave, all);
    vtkSMPTools::For(static_cast<vtkIdType>(begin), static_cast<vtkIdType>(end), 1,
      [&](vtkIdType from, vtkIdType to)
      {
        for (; from < to; ++from)
        {
          readAlone(static_cast<std::size_t>(from), records);
        }
      });
    for (std::size_t i = begin; i < end; ++i)
    {
      faults_[i] ? std::rethrow_exception(faults_[i]) : void();
    }
    rows_.count() > 0 ? task_.progress(static_cast<double>(done_) / static_cast<double>(rows_.count()))
                      : void();
  }
}
catch (const FileProblem&)
{
  task_.salvage&& chunks_.arePlaced ? readInOrder(records) : throw;
}

/// The records from number @p begin on, as many as @p header counts.
void readPlain(ReadTask& task, const LasHeader& header, std::uint64_t begin, LasRecords& records)
{
  const vtkIdType rows = static_cast<vtkIdType>(header.count);
  const std::size_t offset = header.pointsOffset + static_cast<std::size_t>(begin) * header.recordLength;
  const std::size_t size = static_cast<std::size_t>(header.count) * header.recordLength;
  task.need(offset, size);
  const char* first = task.bytes.data() + offset;
  task.fillRows(rows,
    [&](vtkIdType row, vtkIdType end) {
      records.fill({ first + static_cast<std::size_t>(row) * header.recordLength, row, end - row });
    });
  constexpr int kHasWaves = 2;
  const bool endsWithPoints = header.origin.farRecords.empty() && (header.globalEncoding & kHasWaves) == 0;
  endsWithPoints ? task.noteUncounted(offset + size, header.recordLength) : void();
}

void addBytes(vtkPolyData* cloud, const char* name, const std::string& bytes)
{
  if (!bytes.empty())
  {
    vtkNew<vtkUnsignedCharArray> array;
    array->SetName(name);
    array->SetNumberOfValues(static_cast<vtkIdType>(bytes.size()));
    std::copy(bytes.begin(), bytes.end(), array->GetPointer(0));
    cloud->GetFieldData()->AddArray(array);
  }
}

std::string bytesOf(vtkFieldData* fieldData, const char* name)
{
  auto* array = vtkUnsignedCharArray::SafeDownCast(fieldData->GetArray(name));
  return array ? std::string(array->GetPointer(0), array->GetPointer(0) + array->GetNumberOfValues())
               : std::string();
}

/// Runs @p work on packed points; a fault of these is one that salvaging may pass.
template <typename Work>
void withPacked(const ReadTask& task, Work&& work)
{
  try
  {
    work();
  }
  catch (const FileProblem& problem)
  {
    throw task.salvage ? problem : FileProblem(problem.code, std::string(problem.what()) + kSalvageCure);
  }
}

} // namespace

void LasOrigin::addTo(vtkPolyData* cloud) const
{
  addBytes(cloud, "LasHeader", header);
  addBytes(cloud, "LasRecords", records);
  addBytes(cloud, "LasFarRecords", farRecords);
}

LasOrigin LasOrigin::of(vtkFieldData* fieldData)
{
  return { bytesOf(fieldData, "LasHeader"), bytesOf(fieldData, "LasRecords"),
    bytesOf(fieldData, "LasFarRecords") };
}

void readLas(ReadTask& task, vtkPolyData* cloud)
{
  task.need(0, kLasHeaderOf14);
  const std::string version =
    task.bytes.size() > 25 ? " 1." + std::to_string(byteAt(task.bytes.data(), 25)) : std::string();
  task.format = "LAS" + version;
  LasHeader header = parseLasHeader(task);
  task.format = (header.packing.empty() ? "LAS" : header.packing) + version + " (point format " +
    std::to_string(header.pointFormat) + ")";
  std::optional<LazReader> packed;
  const RowRange rows = header.packing.empty() ? task.rowsOf(header.count) : RowRange();
  if (header.packing.empty())
  {
    header.count = rows.count();
  }
  else
  {
    withPacked(task, [&] { packed.emplace(task, header); });
    header.count = packed->count();
    task.isCoarse = packed->chunks().isCoarse;
  }
  LasRecords records(header, task.wanted.onlyPositions);
  if (packed)
  {
    withPacked(task, [&] { packed->read(records); });
  }
  else
  {
    readPlain(task, header, rows.first, records);
  }
  records.moveTo(cloud, task);
  header.origin.addTo(cloud);
  addFieldNumbers<vtkDoubleArray>(cloud, "LasScale", header.scale);
  addFieldNumbers<vtkDoubleArray>(cloud, "LasOffset", header.offset);
  addFieldNumbers<vtkIntArray>(cloud, "LasGlobalEncoding", std::array{ header.globalEncoding });
  if (packed)
  {
    addFieldNumbers<vtkTypeInt64Array>(
      cloud, "Chunks", std::array<vtkTypeInt64, 1>{ vtkTypeInt64(packed->chunks().all.size()) });
  }
  addFieldText(cloud, "Generator", header.generator);
  addFieldText(cloud, "CoordinateSystem", header.coordinateSystem);
  addFieldText(cloud, "LengthUnit", header.lengthUnit);
  addFieldText(cloud, kHeightUnit, header.heightUnit);
}

} // namespace pointhaptics::io
