/// @file
/// Task of a format writer: where the bytes go, where to report progress, and where to note losses.
#pragma once

#include "Core/Base/OutputFile.h"
#include "FileProblem.h"
#include "IO/Columns/OutputColumns.h"
#include "IO/Info/FileComments.h"
#include "Progress.h"

#include "vtkPointSet.h"
#include "vtkType.h"

#include <string>
#include <string_view>
#include <vector>

class vtkAlgorithm;

namespace pointhaptics::io
{

/// A file that appears under its name only when it is complete. Each function @throws FileProblem.
class OutputStream
{
public:
  explicit OutputStream(const std::string& target) { check(file_.open(target)); }

  void write(const char* data, std::size_t size) { check(file_.write({ data, size })); }
  void write(std::string_view text) { check(file_.write(text)); }
  void commit() { check(file_.commit()); }

private:
  void check(Status status) const
  {
    if (status != Status::Ok)
    {
      throw FileProblem(
        file_.isDiskFull() ? vtkErrorCode::OutOfDiskSpaceError : vtkErrorCode::CannotOpenFileError,
        file_.reason(), file_.cure());
    }
  }

  OutputFile file_;
};

/// Lives during one write, in one thread.
struct WriteTask
{
  WriteTask(const std::string& target, vtkAlgorithm* writer)
    : out(target)
    , algorithm(writer)
  {
  }

  OutputStream out;
  vtkPointSet* cloud = nullptr;   ///< with at least one point
  std::vector<std::string> notes; ///< Parts of the cloud that the format could not hold: a sentence each.
  vtkIdType points = 0;           ///< in and out: how many are written
  FileComments comments;          ///< unit and names, for headers that can say them
  double lasScale = 0.0;          ///< step of the coordinates in LAS; 0: the writer chooses
  bool keepsDoubles = false; ///< types and names of PCD as they are, which PCL's point types may not read
  vtkAlgorithm* algorithm;

  vtkFieldData* fieldData() const { return cloud->GetFieldData(); }
  /// Reports how much of the writing is done, 0..1. @throws StoppedOnRequest when an observer asked to stop:
  /// then the unfinished file goes with this object.
  void progress(double fraction) const { reportProgress(algorithm, fraction); }
};

/// The fewest digits that give @p value back.
std::string shortestDecimal(double value);

/// One field of a binary record.
struct RecordField
{
  ConstColumnView source;
  std::size_t offset = 0; ///< inside the record
  int type = 0;           ///< VTK type in the record
};

/// Adds the components of @p array as fields of @p type, one behind the other. @return the byte behind them.
std::size_t addRecordFields(
  std::vector<RecordField>& fields, std::size_t offset, const OutputArray& array, int type);

/// Copies the fields of the rows from @p row on into @p count records; bytes between the fields stay.
void packRecords(const std::vector<RecordField>& fields, std::size_t recordSize, vtkIdType row,
  vtkIdType count, char* records) noexcept;

/// Writes @p rows records of @p recordSize bytes, block by block, with progress from @p begin to 1.
void writeRecords(const std::vector<RecordField>& fields, std::size_t recordSize, vtkIdType rows,
  WriteTask& task, double begin = 0.0);

} // namespace pointhaptics::io
