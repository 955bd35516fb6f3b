/// @file
/// The header of a PLY file.
#pragma once

#include "IO/Info/FileComments.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace pointhaptics::io
{

/// In the order of PlyEncoding.
constexpr std::string_view kPlyEncodings[] = { "ascii", "binary_little_endian", "binary_big_endian" };

enum class PlyEncoding
{
  Ascii,
  LittleEndian,
  BigEndian,
};

struct PlyProperty
{
  std::string name;
  int type = 0;      ///< VTK type of the value, or of a list's items
  int countType = 0; ///< VTK type of a list's count
  bool isList = false;
};

struct PlyElement
{
  std::string name;
  unsigned long long count = 0;
  std::vector<PlyProperty> properties;

  bool hasList() const;
  /// Bytes of one binary record when every list is empty.
  std::size_t minimumRecordSize() const;
};

struct PlyHeader
{
  PlyEncoding encoding = PlyEncoding::Ascii;
  std::vector<PlyElement> elements;
  std::vector<std::string> notes; ///< what was skipped
  FileComments comments;
  std::size_t bodyOffset = 0; ///< first byte after end_header's line
  std::size_t bodyLine = 0;   ///< its line number, for ASCII

  /// Index of the element called vertex. @throws FileProblem when there is none.
  std::size_t vertexElement() const;
};

/// @throws FileProblem with line and value.
PlyHeader parsePlyHeader(std::string_view bytes);

/// The word of the format for numbers of the VTK type @p type; "double" for what it has none for.
const char* plyTypeName(int type);

} // namespace pointhaptics::io
