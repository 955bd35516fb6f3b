/// @file
/// Comments that the writers of PLY, PCD and XYZ leave in a file for its reader.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

class vtkPolyData;

namespace pointhaptics::io
{

/// True if @p unit may stand in a line of a header, also in brackets: letters, and spaces as in "US survey
/// foot".
bool isUnitWord(std::string_view unit);

/// The unit of the coordinates, and the names of arrays that a file calls otherwise, as it allows no blanks
/// in names or gives some names a meaning.
struct FileComments
{
  std::string unit;                                       ///< Empty: none is known.
  std::vector<std::pair<std::string, std::string>> names; ///< In the file, and of the array.

  /// Reads one without its mark. @return false where it is no such comment.
  bool add(std::string_view comment);
  /// The lines that say all, each after @p mark.
  std::string lines(const std::string& mark) const;
  /// Gives @p cloud the unit and its arrays their names.
  void moveTo(vtkPolyData* cloud) const;
};

} // namespace pointhaptics::io
