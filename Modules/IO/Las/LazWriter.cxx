#include "IO/Las/LasDescription.h"

#include "IO/Las/LasHeader.h"
#include "IO/Las/Laz/ChunkCoding.h"
#include "IO/Las/Laz/LazChunks.h"

#include "vtkSMPTools.h"

#include <algorithm>

namespace pointhaptics::io
{

namespace
{

/// Encodes the chunks from @p begin to @p end, each thread with a block of its own.
void encodeChunks(const std::vector<RecordField>& fields, const LazSchema& schema, vtkIdType rows,
  vtkIdType begin, vtkIdType end, std::vector<std::string>& chunks)
{
  const vtkIdType chunkRows = static_cast<vtkIdType>(schema.chunkSize);
  vtkSMPTools::For(begin, end, 1,
    [&](vtkIdType first, vtkIdType last)
    {
      std::vector<char> block;
      for (; first < last; ++first)
      {
        const vtkIdType row = first * chunkRows;
        const vtkIdType count = std::min(chunkRows, rows - row);
        block.assign(schema.recordLength * static_cast<std::size_t>(count), '\0');
        packRecords(fields, schema.recordLength, row, count, block.data());
        chunks[static_cast<std::size_t>(first)] =
          encodeChunk(schema, block.data(), static_cast<std::size_t>(count));
      }
    });
}

} // namespace

std::string lazDescription(int pointFormat, std::size_t recordLength)
{
  const std::string content = lazRecord(makeLazSchema(pointFormat, recordLength));
  return lasRecordHeader(kLaszipUser, kLaszipRecord, content.size()) + content;
}

void writeLazRecords(const std::vector<RecordField>& fields, int pointFormat, std::size_t recordLength,
  std::size_t pointsOffset, vtkIdType rows, WriteTask& task, double begin)
{
  const LazSchema schema = makeLazSchema(pointFormat, recordLength);
  const vtkIdType chunkRows = static_cast<vtkIdType>(schema.chunkSize);
  const vtkIdType total = (rows + chunkRows - 1) / chunkRows;
  const vtkIdType wave = 2 * std::max(vtkSMPTools::GetEstimatedNumberOfThreads(), 1);
  std::vector<std::string> chunks(static_cast<std::size_t>(total));
  for (vtkIdType first = 0; first < total; first += wave)
  {
    task.progress(begin + (1.0 - begin) * static_cast<double>(first) / static_cast<double>(total));
    encodeChunks(fields, schema, rows, first, std::min(first + wave, total), chunks);
  }
  std::vector<LazChunk> table(chunks.size());
  std::uint64_t size = 0;
  for (std::size_t i = 0; i < chunks.size(); ++i)
  {
    table[i].size = chunks[i].size();
    size += chunks[i].size();
  }
  std::string offset(sizeof(std::uint64_t), '\0');
  putLittle(offset, 0, static_cast<std::uint64_t>(pointsOffset + offset.size() + size));
  task.out.write(offset);
  for (const std::string& chunk : chunks)
  {
    task.out.write(chunk);
  }
  task.out.write(lazChunkTable(table, schema));
  task.progress(1.0);
}

} // namespace pointhaptics::io
