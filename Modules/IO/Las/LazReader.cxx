#include "IO/Las/LazReader.h"

#include "IO/Las/LasHeader.h"
#include "IO/Las/LasRecords.h"
#include "IO/Las/Laz/CopcHierarchy.h"
#include "ReadTask.h"

#include "vtkSMPTools.h"

#include <algorithm>
#include <system_error>

namespace pointhaptics::io
{

namespace
{

LazChunks chunksOf(ReadTask& task, const LasHeader& header, const LazSchema& schema)
{
  if (!task.load || !task.wanted.isPart())
  {
    return findLazChunks(task.bytes, header, schema, &task);
  }
  checkLazCount(task.bytes, header);
  LazChunks part = findCopcChunks(task, header);
  if (part.all.empty())
  {
    failFormat("no node of the octree touches the box", "choose a box that meets the bounds of the cloud");
  }
  return part;
}

RowRange rowsOf(ReadTask& task, const LazChunks& chunks)
{
  const LazChunk& last = chunks.all.back();
  const RowRange rows = task.rowsOf(last.first + last.count);
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

} // namespace

LazReader::LazReader(ReadTask& task, const LasHeader& header)
  : task_(task)
  , schema_(parseLazSchema(task.bytes, header))
  , chunks_(chunksOf(task, header, schema_))
  , rows_(rowsOf(task, chunks_))
  , faults_(chunks_.all.size())
{
}

/// Decodes the chunk as far as points of it are wanted.
void LazReader::readChunk(
  ChunkDecoder& decoder, std::vector<char>& block, const LazChunk& chunk, LasRecords& records)
{
  decoder.start(task_.bytes, chunk);
  const std::uint64_t end = std::min(chunk.first + chunk.count, rows_.last);
  for (std::uint64_t at = chunk.first; at < end && !isStopped_;)
  {
    const std::uint64_t next = std::min(at + static_cast<std::uint64_t>(kLasBlockRows), end);
    decoder.next(block.data(), static_cast<std::size_t>(next - at));
    const std::uint64_t first = std::max(at, rows_.first);
    if (first < next)
    {
      records.fill({ block.data() + static_cast<std::size_t>(first - at) * schema_.recordLength,
        static_cast<vtkIdType>(first - rows_.first), static_cast<vtkIdType>(next - first) });
      done_ += next - first;
    }
    at = next;
    if (isCallingThread() && rows_.count() > 0)
    {
      task_.progress(static_cast<double>(done_) / static_cast<double>(rows_.count()));
    }
  }
}

/// Work of each thread: it takes the next chunk until there is none or one is faulty.
void LazReader::work(LasRecords& records) noexcept
{
  std::size_t chunk = chunks_.all.size();
  try
  {
    ChunkDecoder decoder(schema_, task_.wanted.onlyPositions ? LazFields::Positions : LazFields::All);
    std::vector<char> block(static_cast<std::size_t>(kLasBlockRows) * schema_.recordLength);
    while (!isStopped_ && (chunk = next_++) < chunks_.all.size())
    {
      const LazChunk& next = chunks_.all[chunk];
      if (rows_.meets(next.first, next.first + next.count))
      {
        readChunk(decoder, block, next, records);
      }
    }
  }
  catch (...)
  {
    faults_[std::min(chunk, chunks_.all.size() - 1)] = std::current_exception();
    isStopped_ = true;
  }
}

/// Each chunk tells where the next one begins, where it is not known. A salvaged file ends at the first
/// fault.
void LazReader::readInOrder(LasRecords& records)
{
  ChunkDecoder decoder(schema_, LazFields::All);
  std::vector<char> block(static_cast<std::size_t>(kLasBlockRows) * schema_.recordLength);
  std::size_t offset = chunks_.all.front().offset;
  done_ = 0;
  isStopped_ = false;
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
    try
    {
      readChunk(decoder, block, chunk, records);
      offset += chunks_.arePlaced ? 0 : decoder.chunkSize();
    }
    catch (const FileProblem& problem)
    {
      if (!task_.salvage)
      {
        throw;
      }
      task_.endAt(chunk.first + salvageChunk(decoder, block, chunk, records), rows_.count(), problem.what());
      return;
    }
  }
}

/// Reads the points of a damaged chunk one by one. @return how many there are.
std::uint64_t LazReader::salvageChunk(
  ChunkDecoder& decoder, std::vector<char>& block, const LazChunk& chunk, LasRecords& records)
{
  std::uint64_t there = 0;
  try
  {
    decoder.start(task_.bytes, chunk);
    for (; there < chunk.count; ++there)
    {
      decoder.next(block.data(), 1);
      records.fill({ block.data(), static_cast<vtkIdType>(chunk.first + there), 1 });
    }
  }
  catch (const FileProblem&)
  {
    // The points before it are there.
  }
  return there;
}

void LazReader::read(LasRecords& records)
{
  if (!chunks_.arePlaced)
  {
    readInOrder(records);
    return;
  }
  const std::size_t most = static_cast<std::size_t>(std::max(vtkSMPTools::GetEstimatedNumberOfThreads(), 1));
  std::vector<std::thread> helpers;
  try
  {
    while (helpers.size() + 1 < std::min(most, chunks_.all.size()))
    {
      helpers.emplace_back([&] { work(records); });
    }
  }
  catch (const std::system_error&)
  {
    // Fewer threads do the same.
  }
  work(records);
  for (std::thread& helper : helpers)
  {
    helper.join();
  }
  for (const std::exception_ptr& fault : faults_)
  {
    try
    {
      fault ? std::rethrow_exception(fault) : void();
    }
    catch (const FileProblem&)
    {
      if (!task_.salvage)
      {
        throw;
      }
      readInOrder(records);
      return;
    }
  }
}

} // namespace pointhaptics::io
