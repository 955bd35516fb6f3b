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

LazChunks chunksOf(const ReadTask& task, const LasHeader& header, const LazSchema& schema)
{
  if (!task.load)
  {
    return findLazChunks(task.bytes, header, schema);
  }
  checkLazCount(task.bytes, header);
  LazChunks part = findCopcChunks(task, header);
  if (part.all.empty())
  {
    failFormat("no node of the octree touches the box", "choose a box that meets the bounds of the cloud");
  }
  for (std::size_t i = 0; i < part.all.size(); ++i)
  {
    task.need(part.all[i].offset, part.all[i].size);
    task.readingProgress(static_cast<double>(i + 1) / static_cast<double>(part.all.size()));
  }
  return part;
}

} // namespace

LazReader::LazReader(const ReadTask& task, const LasHeader& header)
  : task_(task)
  , schema_(parseLazSchema(task.bytes, header))
  , chunks_(chunksOf(task, header, schema_))
  , count_(chunks_.all.back().first + chunks_.all.back().count)
  , faults_(chunks_.all.size())
{
}

void LazReader::readChunk(
  ChunkDecoder& decoder, std::vector<char>& block, const LazChunk& chunk, LasRecords& records)
{
  decoder.start(task_.bytes, chunk);
  for (std::uint64_t at = 0; at < chunk.count && !isStopped_;)
  {
    const vtkIdType count =
      static_cast<vtkIdType>(std::min(static_cast<std::uint64_t>(kLasBlockRows), chunk.count - at));
    decoder.next(block.data(), static_cast<std::size_t>(count));
    records.fill({ block.data(), static_cast<vtkIdType>(chunk.first + at), count });
    at += static_cast<std::uint64_t>(count);
    done_ += static_cast<std::uint64_t>(count);
    if (isCallingThread())
    {
      task_.progress(static_cast<double>(done_) / static_cast<double>(count_));
    }
  }
}

/// What each thread does: the next chunk, until there is none or one is faulty.
void LazReader::work(LasRecords& records) noexcept
{
  std::size_t chunk = chunks_.all.size();
  try
  {
    ChunkDecoder decoder(schema_, task_.wanted.onlyPositions ? LazFields::Positions : LazFields::All);
    std::vector<char> block(static_cast<std::size_t>(kLasBlockRows) * schema_.recordLength);
    while (!isStopped_ && (chunk = next_++) < chunks_.all.size())
    {
      readChunk(decoder, block, chunks_.all[chunk], records);
    }
  }
  catch (...)
  {
    faults_[std::min(chunk, chunks_.all.size() - 1)] = std::current_exception();
    isStopped_ = true;
  }
}

/// Each chunk tells where the next one begins.
void LazReader::readInOrder(LasRecords& records)
{
  ChunkDecoder decoder(schema_, LazFields::All);
  std::vector<char> block(static_cast<std::size_t>(kLasBlockRows) * schema_.recordLength);
  std::size_t offset = chunks_.all.front().offset;
  for (LazChunk chunk : chunks_.all)
  {
    chunk.offset = offset;
    chunk.size = task_.bytes.size() - offset;
    readChunk(decoder, block, chunk, records);
    offset += decoder.chunkSize();
  }
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
    if (fault)
    {
      std::rethrow_exception(fault);
    }
  }
}

} // namespace pointhaptics::io
