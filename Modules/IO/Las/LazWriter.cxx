#include "IO/Las/LasDescription.h"

#include "IO/Las/LasHeader.h"
#include "IO/Las/Laz/ChunkEncoder.h"
#include "IO/Las/Laz/LazChunks.h"

#include "vtkSMPTools.h"

#include <algorithm>

namespace pointhaptics::io
{

namespace
{

LasHeader headerOf(int pointFormat, std::size_t recordLength)
{
  LasHeader header;
  header.pointFormat = pointFormat;
  header.recordLength = recordLength;
  return header;
}

/// Encodes the chunks of one wave, each thread with an encoder and a block of its own.
void encodeChunks(const std::vector<RecordField>& fields, const LazSchema& schema, vtkIdType rows,
  vtkIdType firstChunk, std::vector<std::string>& chunks)
{
  const vtkIdType chunkRows = static_cast<vtkIdType>(schema.chunkSize);
  vtkSMPTools::For(0, static_cast<vtkIdType>(chunks.size()), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      ChunkEncoder encoder(schema);
      std::vector<char> block;
      for (vtkIdType i = begin; i < end; ++i)
      {
        const vtkIdType row = (firstChunk + i) * chunkRows;
        const vtkIdType count = std::min(chunkRows, rows - row);
        block.assign(schema.recordLength * static_cast<std::size_t>(count), '\0');
        packRecords(fields, schema.recordLength, row, count, block.data());
        chunks[static_cast<std::size_t>(i)] = encoder.encode(block.data(), static_cast<std::size_t>(count));
      }
    });
}

} // namespace

std::string lazDescription(int pointFormat, std::size_t recordLength)
{
  const LasHeader header = headerOf(pointFormat, recordLength);
  const std::string content = lazRecord(makeLazSchema(header), header);
  return lasRecordHeader(std::string(kLaszipUser), kLaszipRecord, content.size()) + content;
}

void writeLazRecords(const std::vector<RecordField>& fields, int pointFormat, std::size_t recordLength,
  std::size_t pointsOffset, vtkIdType rows, WriteTask& task, double begin)
{
  const LazSchema schema = makeLazSchema(headerOf(pointFormat, recordLength));
  const vtkIdType chunkRows = static_cast<vtkIdType>(schema.chunkSize);
  const vtkIdType total = (rows + chunkRows - 1) / chunkRows;
  const vtkIdType wave = 2 * std::max(vtkSMPTools::GetEstimatedNumberOfThreads(), 1);
  std::vector<std::string> encoded;
  std::vector<LazChunk> table;
  std::uint64_t size = 0;
  for (vtkIdType first = 0; first < total; first += wave)
  {
    task.progress(begin + (1.0 - begin) * static_cast<double>(first) / static_cast<double>(total));
    std::vector<std::string> chunks(static_cast<std::size_t>(std::min(wave, total - first)));
    encodeChunks(fields, schema, rows, first, chunks);
    for (std::string& chunk : chunks)
    {
      LazChunk entry;
      entry.size = chunk.size();
      table.push_back(entry);
      size += chunk.size();
      encoded.push_back(std::move(chunk));
    }
  }
  std::string offset(sizeof(std::uint64_t), '\0');
  putLittle(offset, 0, static_cast<std::uint64_t>(pointsOffset + offset.size() + size));
  task.out.write(offset);
  for (const std::string& chunk : encoded)
  {
    task.out.write(chunk);
  }
  task.out.write(lazChunkTable(table, schema));
  task.progress(1.0);
}

} // namespace pointhaptics::io
