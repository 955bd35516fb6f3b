/// @file
/// Writes the points of a LAZ file: chunks are encoded in parallel.
#pragma once

#include "FormatWriters.h"

#include <cstddef>
#include <string>
#include <vector>

namespace pointhaptics::io
{

/// The variable length record, with its header, that a LAZ file of this point format and record length needs.
std::string lazDescription(int pointFormat, std::size_t recordLength);

/// Writes @p rows records of @p recordLength bytes in chunks of 50,000 behind the offset of their table, and
/// the table behind them, with progress from @p begin to 1. @p pointsOffset: where they begin in the file.
/// Costs the size of the compressed points in memory: a pipe, too, gets the offset of the table before the
/// points.
void writeLazRecords(const std::vector<RecordField>& fields, int pointFormat, std::size_t recordLength,
  std::size_t pointsOffset, vtkIdType rows, WriteTask& task, double begin);

} // namespace pointhaptics::io
