/// @file
/// Recognises formats by the first bytes of a file.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <string_view>

namespace pointhaptics::io
{

/// The start of a file.
struct FormatStart
{
  std::string_view bytes; ///< Bytes without a byte order mark; UTF-16 as UTF-8.
  std::size_t size = 0;   ///< Size of the whole file; 0: not known.
  std::string extension;  ///< Lower case, no dot.
  std::string_view line;  ///< The first one of a text with something on it that is no comment.
  bool isText = false;
};

/// @p converted holds what the result looks at where @p bytes are UTF-16.
FormatStart lookAt(
  std::string_view bytes, std::size_t size, const std::string& extension, std::string& converted);

using Look = bool(const FormatStart&);
Look looksLikePly, looksLikePcd, looksLikeVtkXml, looksLikeOff, looksLikeStl, looksLikeObj, looksLikeColumns;
/// True if the first line is that of an Esri grid, "ncols 300", in any case.
Look looksLikeEsriGrid;
/// True if two counts, for columns and rows, and twelve numbers for the scanner's place stand first.
Look looksLikePtx;
/// Float32 x y z intensity (KITTI), and the same with a ring (nuScenes): by size and values, as there is no
/// mark.
Look looksLikeKitti, looksLikeNuScenes;
/// NumPy's .npy, and Gaussian splats of 32 bytes: place, size, colour, rotation.
Look looksLikeNumpy, looksLikeSplat;

/// Refuses formats that people take for point clouds and this program does not read, and names tools that
/// convert them. @throws FileProblem where @p start is that of such a file.
void refuseForeign(const FormatStart& start);
/// As refuseForeign() by @p extension (lower case, no dot), for those that nobody knows by their first bytes.
void refuseForeignName(const std::string& extension);

/// True if ASCII STL starts like @p bytes: "solid", then "facet" or "endsolid".
bool looksLikeStlText(std::string_view bytes);

/// Whether nothing in @p bytes but blanks and line ends is a control character.
bool isText(std::string_view bytes);

/// @p bytes without the UTF-8 byte order mark some editors put in front.
std::string_view withoutByteOrderMark(std::string_view bytes);

/// True if @p bytes begin with the byte order mark of UTF-16, or as Latin text of UTF-16 without it.
bool isUtf16(std::string_view bytes);

/// The text of @p bytes, which are such, in UTF-8; what is no UTF-16 becomes '?'.
std::string utf8Of(std::string_view bytes);

/// @p name as it is where it is UTF-8, else what it is in Latin-1, in UTF-8.
std::string utf8Name(const std::string& name);

/// @p wanted, or with a number behind it where it is @p used, in at most @p longest bytes.
std::string unusedName(
  std::set<std::string>& used, const std::string& wanted, std::size_t longest = std::string::npos);

} // namespace pointhaptics::io
