/// @file
/// The sizes that a VTK XML file claims, checked against its length before VTK's reader, which trusts them,
/// opens the file.
#pragma once

#include "IO/Bytes/XmlTree.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace pointhaptics::io
{

/// The element VTKFile of @p bytes, which may end behind the tag AppendedData: VTK puts anything behind it.
/// @throws FileProblem where that is not the first one, of XML entities and elements nested too deeply
/// (XmlTree.h), and for a text "<AppendedData" that VTK would take for the tag.
XmlElement vtkXml(std::string_view bytes);

/// Number of points in the pieces of a VTK XML file of @p fileSize bytes with the content @p root.
/// @throws FileProblem where the file cannot hold as many.
std::uint64_t pointsOfVtkXml(const XmlElement& root, std::size_t fileSize);

/// @throws FileProblem where the arrays of two pieces differ, each told by name, type and components.
void checkSameArrays(const std::string& first, const std::string& other);

/// @throws FileProblem with the byte offset of a count, an offset or a block of data that the file cannot
/// hold, where a piece has other arrays than the first, and when the file's end is missing. @p root:
/// vtkXml().
void checkVtkXml(std::string_view bytes, const XmlElement& root);

} // namespace pointhaptics::io
