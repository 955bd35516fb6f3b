/// @file
/// The writers behind vtkPointCloudWriter that are our own. Each writes a whole file, reports progress up to
/// 1, and throws FileProblem or StoppedOnRequest.
#pragma once

#include "WriteTask.h"

#include <string>
#include <vector>

class vtkFieldData;

namespace pointhaptics::io
{

/// Binary PLY in this machine's byte order; points as float or double; one scalar property per component.
void writePly(const std::vector<OutputArray>& arrays, WriteTask& task);

/// Binary PCD; @p fieldData may hold Viewpoint (7) and OrganizedDimensions (width, height).
void writePcd(const std::vector<OutputArray>& arrays, vtkFieldData* fieldData, WriteTask& task);

/// Text with a column per component and a line of their names; each number with the fewest digits that give
/// it back exactly. @p separator is ',' or ' ': between spaces the names are a comment ("//x y z ..."), which
/// programs that take bare numbers leave out, and white space inside a name becomes '_'. A unit stands in a
/// comment before them, and in brackets after x, y and z between commas.
void writeTable(const std::vector<OutputArray>& arrays, WriteTask& task, char separator);

/// LAS 1.2, or 1.4 where the arrays or well-known text need it. Arrays that the reader makes of LAS fields
/// become these again, others extra bytes; @p fieldData may hold LasScale, LasOffset, LasGlobalEncoding and
/// CoordinateSystem. With @p isPacked it is a LAZ file of the same records.
void writeLas(
  const std::vector<OutputArray>& arrays, vtkFieldData* fieldData, WriteTask& task, bool isPacked);

/// The comment that says the unit, after its @p mark, with the end of its line; nothing where none is known.
std::string unitLine(const std::string& mark, const WriteTask& task);

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
