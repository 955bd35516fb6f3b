/// @file
/// The points and point data of a cloud as named arrays, ready to be written.
#pragma once

#include "Bytes/StridedCopy.h"

#include "vtkDataArray.h"
#include "vtkSmartPointer.h"

#include <set>
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

/// Names that differ.
class UnusedNames
{
public:
  /// @p wanted, or with a number behind it where it was given before, in at most @p longest bytes.
  std::string unused(const std::string& wanted, std::size_t longest = std::string::npos);

private:
  std::set<std::string> used_;
};

/// One array in contiguous memory, under a name without white space, commas or quotes.
struct OutputArray
{
  ArrayRole role = ArrayRole::Other;
  std::string name;
  vtkSmartPointer<vtkDataArray> array;

  int components() const { return array->GetNumberOfComponents(); }
  int type() const { return array->GetDataType(); }
  ConstColumnView column(int component) const;
  /// "name", or "name_2" for component 2 of several.
  std::string componentName(int component) const;
};

/// Parts of a cloud that a format could not hold: one sentence each, without end mark.
struct WriterNotes
{
  std::vector<std::string> all;

  void add(const std::string& note) { all.push_back(note); }
};

/// The points first, then every array of numbers in the point data, each under its own name; arrays of
/// strings are left out. @throws FileProblem when an array is shorter than the cloud.
/// @param names what they may be called.
std::vector<OutputArray> outputArrays(
  vtkPointSet* cloud, WriterNotes& notes, NameRule names = NameRule::Words);

/// Converts arrays of 64 bit integers to doubles, for formats without such integers.
std::vector<OutputArray> withoutLongIntegers(std::vector<OutputArray> arrays, WriterNotes& notes);

/// The rows of @p points with a coordinate that is NaN or infinite, in rising order.
std::vector<vtkIdType> rowsNotFinite(const OutputArray& points);

/// @p left: rows in rising order.
std::vector<OutputArray> withoutRows(std::vector<OutputArray> arrays, const std::vector<vtkIdType>& left);

} // namespace pointhaptics::io
