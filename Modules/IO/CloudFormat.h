/// @file
/// Detection of file formats by content.
#pragma once

#include <string>
#include <string_view>

namespace pointhaptics::io
{

enum class CloudFormat
{
  Ply,
  Pcd,
  VtkXml,
  VtkLegacy,
  Obj,
  Off,
  Stl,
  Las,
  E57,
  Text,
};

/// Looks at the first bytes of a file; @p extension (lower case, no dot) decides only between OBJ and columns
/// of text, and where binary STL, which begins with anything, was not recognised by the file's size. @p size:
/// of the whole file, 0 when it is not known.
/// @throws FileProblem for what is recognised but not read here (glTF, zip, ...), naming a converter, and for
/// what is not recognised at all.
CloudFormat identifyFormat(std::string_view start, std::size_t size, const std::string& extension);

/// Whether ASCII STL starts like @p bytes: "solid", then "facet" or "endsolid".
bool looksLikeStlText(std::string_view bytes);

/// "PLY" and so on: the format's short name.
const char* nameOf(CloudFormat format);

/// @p bytes without the UTF-8 byte order mark some editors put in front.
std::string_view withoutByteOrderMark(std::string_view bytes);

} // namespace pointhaptics::io
