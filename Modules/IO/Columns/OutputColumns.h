/// @file
/// The points and point data of a cloud as named arrays, ready to be written.
#pragma once

#include "Bytes/StridedCopy.h"
#include "IO/Columns/CloudColumns.h"
#include "IO/Info/FileComments.h"

#include "vtkDataArray.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <string>
#include <vector>

class vtkPointSet;

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

} // namespace pointhaptics::io
