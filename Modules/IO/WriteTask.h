/// @file
/// Task of a format writer: where the bytes go, where to report progress, and where to note losses; and the
/// points and point data of a cloud as named arrays, ready to be written.
#pragma once

#include "Bytes/StridedCopy.h"
#include "Core/Base/OutputFile.h"
#include "FileProblem.h"
#include "IO/Columns/CloudColumns.h"
#include "IO/Info/FileComments.h"
#include "Progress.h"

#include "vtkDataArray.h"
#include "vtkPointSet.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

class vtkAlgorithm;

namespace pointhaptics::io
{

enum class ArrayRole
{
  Points,
  Colors,  ///< unsigned char, 3 or 4 components
  Normals, ///< float or double, 3 components
  Other,
};

/// Characters that a format allows in the name of an array: others become '_'.
enum class NameRule
{
  Words, ///< Without white space and control characters.
  Cells, ///< Also without what separates cells or begins a comment in columns of text.
  Any,   ///< All but control characters.
};

/// One array in contiguous memory.
struct OutputArray
{
  ArrayRole role = ArrayRole::Other;
  std::string name; ///< In the file.
  vtkSmartPointer<vtkDataArray> array;
  std::string given; ///< Its name in the cloud.

  int components() const { return array->GetNumberOfComponents(); }
  int type() const { return array->GetDataType(); }
  ConstColumnView column(int component) const;
  /// "name", or "name_2" for component 2 of several.
  std::string componentName(int component) const;
};

/// The points first, then every array of numbers in the point data, each under its own name; arrays of
/// strings are left out. @p notes gets what a format cannot hold: one sentence each, without end mark.
/// @throws FileProblem when an array is shorter than the cloud.
std::vector<OutputArray> outputArrays(vtkPointSet* cloud, std::vector<std::string>& notes);

/// What the names in a file may be.
struct NameLimits
{
  NameRule rule = NameRule::Any;
  std::size_t longest = std::string::npos; ///< Bytes of a column's name.
  FileComments* comments = nullptr; ///< Gets the names that a reader must change back; null: these are noted.
};

/// Chooses the names of @p arrays in a file. They are right when CloudColumns, which plans what a reader
/// makes of columns, gives each array its own columns back. @p columnsOf: those of an array, as the reader of
/// the file sees them.
void chooseNames(std::vector<OutputArray>& arrays,
  const std::function<std::vector<Column>(const OutputArray&)>& columnsOf, const NameLimits& limits,
  std::vector<std::string>& notes);

/// A column for each component of @p array.
std::vector<Column> columnsByComponent(const OutputArray& array);

/// Converts arrays of 64 bit integers to doubles, for formats without such integers.
std::vector<OutputArray> withoutLongIntegers(
  std::vector<OutputArray> arrays, std::vector<std::string>& notes);

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
