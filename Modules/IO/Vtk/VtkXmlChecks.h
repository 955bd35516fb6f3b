/// @file
/// The sizes that a VTK XML file claims, checked against its length before VTK's reader, which trusts them,
/// opens the file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace pointhaptics::io
{

/// The value of attribute @p name in one tag; empty when it is not there.
std::string_view xmlAttribute(std::string_view tag, std::string_view name);

/// The tag <VTKFile ...>, without its closing mark. @throws FileProblem where it is not the first one.
std::string_view vtkFileTag(std::string_view bytes);

/// Number of points in the pieces of a VTK XML file of @p fileSize bytes, from its @p start: all up to the
/// appended data, or the whole file where there are none. @throws FileProblem where the file cannot hold as
/// many.
std::uint64_t pointsOfVtkXml(std::string_view start, std::size_t fileSize);

/// @throws FileProblem with the byte offset of a count, an offset or a block of data that the file cannot
/// hold, of XML entities and elements nested too deeply (XmlTags.h), and when the file's end is missing.
void checkVtkXml(std::string_view bytes);

} // namespace pointhaptics::io
