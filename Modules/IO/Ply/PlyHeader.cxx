#include "IO/Ply/PlyHeader.h"

#include "Bytes/NumericType.h"
#include "FileProblem.h"
#include "IO/Bytes/TextScan.h"
#include "IO/Columns/CloudColumns.h"
#include "IO/Formats/FormatLooks.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace pointhaptics::io
{

namespace
{

/// The first name of a type is written.
constexpr std::pair<std::string_view, int> kTypeNames[] = { { "char", VTK_TYPE_INT8 },
  { "int8", VTK_TYPE_INT8 }, { "uchar", VTK_TYPE_UINT8 }, { "uint8", VTK_TYPE_UINT8 },
  { "short", VTK_TYPE_INT16 }, { "int16", VTK_TYPE_INT16 }, { "ushort", VTK_TYPE_UINT16 },
  { "uint16", VTK_TYPE_UINT16 }, { "int", VTK_TYPE_INT32 }, { "int32", VTK_TYPE_INT32 },
  { "uint", VTK_TYPE_UINT32 }, { "uint32", VTK_TYPE_UINT32 }, { "bool", VTK_TYPE_UINT8 },
  { "long", VTK_TYPE_INT64 }, { "int64", VTK_TYPE_INT64 }, { "ulong", VTK_TYPE_UINT64 },
  { "uint64", VTK_TYPE_UINT64 }, { "float", VTK_FLOAT }, { "float32", VTK_FLOAT }, { "double", VTK_DOUBLE },
  { "float64", VTK_DOUBLE } };

int parseType(std::string_view word, std::size_t line)
{
  const auto* const known = std::find_if(
    std::begin(kTypeNames), std::end(kTypeNames), [&](const auto& each) { return each.first == word; });
  failFormatIf(known == std::end(kTypeNames),
    "PLY has char uchar short ushort int uint float double; int8 to uint64, float32, float64 and bool are "
    "known, too",
    "{}unknown property type {}", atLine(line), inQuotes(word));
  return known->second;
}

PlyElement parseElement(std::string_view rest, std::size_t line)
{
  PlyElement element;
  element.name = std::string(takeWord(rest));
  const std::string_view count = takeWord(rest);
  failFormatIf(element.name.empty() || !parseCount(count, element.count),
    "write: element NAME COUNT, with a count of 0 or more", "{}element {} has the count {}", atLine(line),
    inQuotes(element.name), inQuotes(count));
  return element;
}

PlyProperty parseProperty(std::string_view rest, std::size_t line)
{
  PlyProperty property;
  std::string_view word = takeWord(rest);
  if (word == "list")
  {
    property.isList = true;
    property.countType = parseType(takeWord(rest), line);
    failFormatIf(isFloatingType(property.countType), "count lists by uchar, ushort or uint",
      "{}a list counted by float numbers", atLine(line));
    word = takeWord(rest);
  }
  property.type = parseType(word, line);
  property.name = std::string(takeWord(rest));
  failFormatIf(property.name.empty(), "write: property TYPE NAME", "{}a property without name", atLine(line));
  return property;
}

/// The byte behind the end of the line that goes on at @p at.
std::size_t bodyAfter(std::string_view bytes, std::size_t at)
{
  const bool hasLineFeeds = bytes.substr(0, at).find('\n') != std::string_view::npos;
  while (at < bytes.size() &&
    (bytes[at] == ' ' || bytes[at] == '\t' || (hasLineFeeds && bytes.substr(at, 3) == "\r\r\n")))
  {
    ++at;
  }
  return std::min(at + (hasLineFeeds && bytes.substr(at, 2) == "\r\n" ? 2 : 1), bytes.size());
}

void noteUnknown(const std::vector<std::string>& unknown, PlyHeader& header)
{
  if (!unknown.empty())
  {
    const bool isOne = unknown.size() == 1;
    header.notes.push_back(std::to_string(unknown.size()) + (isOne ? " line" : " lines") +
      " of the header, beginning with " + unknown.front() + ", cannot be understood and " +
      (isOne ? "is" : "are") + " skipped; check the points");
  }
}

} // namespace

bool PlyElement::hasList() const
{
  return std::any_of(
    properties.begin(), properties.end(), [](const PlyProperty& property) { return property.isList; });
}

std::size_t PlyElement::minimumRecordSize() const
{
  std::size_t size = 0;
  for (const PlyProperty& property : properties)
  {
    size += static_cast<std::size_t>(sizeOfType(property.isList ? property.countType : property.type));
  }
  return size;
}

std::size_t PlyHeader::vertexElement() const
{
  const auto found = std::find_if(
    elements.begin(), elements.end(), [](const PlyElement& element) { return element.name == "vertex"; });
  failFormatIf(
    found == elements.end(), "a point cloud needs: element vertex COUNT", "the header has no element vertex");
  return static_cast<std::size_t>(found - elements.begin());
}

PlyHeader parsePlyHeader(std::string_view bytes)
{
  // A header of CR-only lines may stand before a body with LF bytes: cut it off before splitting lines.
  std::size_t end = bytes.find("\nend_header");
  end = std::min(end, bytes.substr(0, end).find("\rend_header")); // not in the body, which may be large
  failTruncatedIf(
    end == std::string_view::npos, "the header has no line end_header within {} bytes", bytes.size());
  ++end;
  PlyHeader header;
  bool formatSeen = false;
  LineReader lines(withoutByteOrderMark(bytes.substr(0, end)));
  std::string_view line;
  std::vector<std::string> unknown;
  while (lines.next(line))
  {
    const std::size_t number = lines.lineNumber();
    const std::string_view keyword = takeWord(line);
    if (keyword == "format")
    {
      const std::string_view word = takeWord(line);
      const std::size_t found = indexOf(kPlyEncodings, word);
      failFormatIf(found == std::size(kPlyEncodings),
        "PLY has ascii, binary_little_endian and binary_big_endian", "{}unknown encoding {}", atLine(number),
        inQuotes(word));
      header.encoding = static_cast<PlyEncoding>(found);
      formatSeen = true;
    }
    else if (keyword == "element")
    {
      header.elements.push_back(parseElement(line, number));
    }
    else if (keyword == "property")
    {
      failFormatIf(header.elements.empty(), "write the element's line first",
        "{}a property before any element", atLine(number));
      failFormatIf(header.elements.back().properties.size() == kMostColumns, "use lists",
        "{}more than {} properties", atLine(number), kMostColumns);
      header.elements.back().properties.push_back(parseProperty(line, number));
    }
    else if (keyword == "comment")
    {
      header.comments.add(line);
    }
    else if (!keyword.empty() && !equalNoCase(keyword, "ply") && keyword != "obj_info")
    {
      unknown.push_back(inQuotes(keyword) + " in line " + std::to_string(number));
    }
  }
  noteUnknown(unknown, header);
  failFormatIf(
    !formatSeen, "write: format ascii 1.0 (or binary_little_endian)", "the header has no line format");
  header.bodyLine = lines.lineNumber() + 2;
  header.bodyOffset = bodyAfter(bytes, end + std::string_view("end_header").size());
  return header;
}

const char* plyTypeName(int type)
{
  const int plain = fixedSizeType(type);
  const auto* const found = std::find_if(std::begin(kTypeNames), std::end(kTypeNames),
    [&](const auto& each) { return each.second == plain && sizeOfType(plain) < 8; });
  return found == std::end(kTypeNames) ? "double" : found->first.data();
}

} // namespace pointhaptics::io
