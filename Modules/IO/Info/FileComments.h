/// @file
/// Comments that the writers of PLY, PCD and XYZ leave in a file for its reader, and what others say there.
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

/// The unit of the coordinates, their system, and the names of arrays that a file calls otherwise, as it
/// allows no blanks in names or gives some names a meaning.
struct FileComments
{
  std::string unit;                                       ///< Empty: none is known.
  std::string heightUnit;                                 ///< Where x and y are degrees.
  std::vector<std::string> systems;                       ///< "EPSG:26917"; all that are named.
  std::vector<std::pair<std::string, std::string>> names; ///< In the file, and of the array.

  /// Reads one without its mark: "LengthUnit mm", "units: mm", "ArrayName a b", or a text with a code of
  /// EPSG.
  /// @return false where it is a title as well as a comment.
  bool add(std::string_view comment);
  /// The lines that say all but systems, each after @p mark.
  std::string lines(const std::string& mark) const;
  /// Gives @p cloud the units, the system and its arrays their names. Several systems are none: @p notes says
  /// so. Coordinates of a geographic system that may be degrees are.
  void moveTo(vtkPolyData* cloud, std::vector<std::string>& notes) const;
};

} // namespace pointhaptics::io
