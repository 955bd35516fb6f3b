/// @file
/// Writers behind vtkPointCloudWriter: each writes the whole of task.cloud (Formats/FormatList.h).
#pragma once

#include "WriteTask.h"

#include <string>
#include <vector>

namespace pointhaptics::io
{

/// The fewest digits that give @p value back.
std::string shortestDecimal(double value);

/// One field of a binary record.
struct RecordField
{
  ConstColumnView source;
  std::size_t offset = 0; ///< inside the record
  int type = 0;           ///< VTK type in the record
};

/// Copies the fields of the rows from @p row on into @p count records; bytes between the fields stay.
void packRecords(const std::vector<RecordField>& fields, std::size_t recordSize, vtkIdType row,
  vtkIdType count, char* records) noexcept;

/// Writes @p rows records of @p recordSize bytes, block by block, with progress from @p begin to 1.
void writeRecords(const std::vector<RecordField>& fields, std::size_t recordSize, vtkIdType rows,
  WriteTask& task, double begin = 0.0);

} // namespace pointhaptics::io
