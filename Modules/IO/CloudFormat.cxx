#include "CloudFormat.h"

#include "FileProblem.h"
#include "IO/Text/TextScan.h"

#include <algorithm>

namespace pointhaptics::io
{

namespace
{

constexpr std::size_t kLookedAt = 4096;

bool startsWith(std::string_view text, std::string_view start)
{
  return text.substr(0, start.size()) == start;
}

/// Formats known by their first bytes that this program does not read.
struct Foreign
{
  std::string_view magic;
  const char* what;
  const char* cure;
};

constexpr std::string_view operator""_bytes(const char* text, std::size_t size)
{
  return { text, size };
}

const Foreign kForeign[] = {
  { "\x1f\x8b"_bytes, "this is a gzip file inside a gzip file", "unpack it once: gunzip -k FILE" },
  { "PK\x03\x04", "this is a zip archive", "unpack it first: unzip FILE" },
  { "BZh", "this file is bzip2-compressed", "unpack it first: bunzip2 -k FILE" },
  { "\xfd"
    "7zXZ",
    "this file is xz-compressed", "unpack it first: unxz -k FILE" },
  { "\xff\xfe"_bytes, "this is text in UTF-16", "save it as UTF-8: iconv -f UTF-16 -t UTF-8 FILE" },
  { "\xfe\xff"_bytes, "this is text in UTF-16", "save it as UTF-8: iconv -f UTF-16 -t UTF-8 FILE" },
  { "ncols", "this is a grid of heights (Esri ASCII), which is not read here",
    "make points of it: gdal2xyz.py FILE points.xyz" },
  { "glTF", "this is a glTF file, which is not read here",
    "convert it to PLY, for example with meshio or Blender" },
};

void refuseForeign(std::string_view bytes)
{
  for (const Foreign& foreign : kForeign)
  {
    if (startsWith(bytes, foreign.magic))
    {
      throw FileProblem(vtkErrorCode::UnrecognizedFileTypeError, foreign.what, foreign.cure);
    }
  }
}

bool isComment(std::string_view line)
{
  return startsWith(line, "#") || startsWith(line, "//");
}

/// The first line with something on it that is not a comment; empty when there is none.
std::string_view firstSignificantLine(std::string_view bytes)
{
  LineReader lines(bytes);
  std::string_view line;
  while (lines.next(line))
  {
    line = trimmed(line);
    if (!line.empty() && !isComment(line))
    {
      return line;
    }
  }
  return {};
}

bool looksLikePcd(std::string_view bytes)
{
  std::string_view line = firstSignificantLine(bytes);
  const std::string_view word = takeWord(line);
  return startsWith(bytes, "# .PCD") || word == "VERSION" || word == "FIELDS" || word == "COLUMNS";
}

bool looksLikeXml(std::string_view bytes)
{
  const std::string_view text = trimmed(bytes.substr(0, kLookedAt));
  return startsWith(text, "<") && text.find("<VTKFile") != std::string_view::npos;
}

bool looksLikeText(std::string_view bytes)
{
  const std::string_view head = bytes.substr(0, kLookedAt);
  return std::none_of(head.begin(), head.end(),
    [](char c)
    {
      const unsigned char byte = static_cast<unsigned char>(c);
      return (byte < 0x20 && !isBlank(c) && c != '\n') || byte == 0x7f;
    });
}

/// OFF with letters in front for normals, colours and so on.
bool looksLikeOff(std::string_view bytes)
{
  std::string_view line = firstSignificantLine(bytes.substr(0, kLookedAt));
  const std::string_view word = takeWord(line);
  return word.size() >= 3 && word.size() <= 8 && word.substr(word.size() - 3) == "OFF" &&
    word.find_first_not_of("STCN4nOF") == std::string_view::npos;
}

/// It has no mark, but its length is that of the triangles it counts.
bool looksLikeBinaryStl(std::string_view bytes, std::size_t size)
{
  constexpr std::size_t kHeader = 84;
  if (bytes.size() < kHeader || size <= kHeader)
  {
    return false;
  }
  std::size_t count = 0;
  for (std::size_t i = 4; i > 0; --i)
  {
    count = count << 8 | static_cast<unsigned char>(bytes[79 + i]);
  }
  return size == kHeader + 50 * count;
}

bool isColumnExtension(const std::string& extension)
{
  const std::string_view known[] = { "xyz", "txt", "csv", "pts", "asc", "tsv", "dat" };
  return std::find(std::begin(known), std::end(known), extension) != std::end(known);
}

bool looksLikeObj(std::string_view line, const std::string& extension)
{
  const std::string_view keyword = takeWord(line);
  double number = 0.0;
  if (keyword == "v" && parseNumber(takeWord(line), number))
  {
    return true;
  }
  const std::string_view keywords[] = { "v", "vn", "vt", "vp", "o", "g", "s", "f", "l", "p", "mtllib",
    "usemtl" };
  const bool known = std::find(std::begin(keywords), std::end(keywords), keyword) != std::end(keywords);
  return known && !isColumnExtension(extension);
}

/// Numbers first, or a header that names x, y and z.
bool looksLikeColumns(std::string_view line)
{
  double number = 0.0;
  if (parseNumber(line.data(), line.data() + line.size(), number))
  {
    return true;
  }
  bool named[3] = { false, false, false };
  std::size_t begin = 0;
  while (begin < line.size())
  {
    const std::size_t end = std::min(line.find_first_of(" \t,;\"", begin), line.size());
    const std::string_view word = line.substr(begin, end - begin);
    for (int axis = 0; axis < 3; ++axis)
    {
      const char name[] = { static_cast<char>('x' + axis), '\0' };
      const std::string pointsName = "Points:" + std::to_string(axis);
      named[axis] = named[axis] || equalNoCase(word, name) || equalNoCase(word, pointsName);
    }
    begin = end + 1;
  }
  return named[0] && named[1] && named[2];
}

} // namespace

std::string_view withoutByteOrderMark(std::string_view bytes)
{
  return startsWith(bytes, "\xef\xbb\xbf") ? bytes.substr(3) : bytes;
}

bool looksLikeStlText(std::string_view bytes)
{
  bytes = bytes.substr(0, kLookedAt);
  LineReader lines(bytes);
  std::string_view line;
  if (!lines.next(line) || !equalNoCase(takeWord(line), "solid"))
  {
    return false;
  }
  while (lines.next(line))
  {
    const std::string_view word = takeWord(line);
    if (!word.empty())
    {
      return equalNoCase(word, "facet") || equalNoCase(word, "endsolid");
    }
  }
  return false;
}

CloudFormat identifyFormat(std::string_view bytes, std::size_t size, const std::string& extension)
{
  bytes = withoutByteOrderMark(bytes);
  refuseForeign(bytes);
  if (startsWith(bytes, "ply\n") || startsWith(bytes, "ply\r") || bytes == "ply")
  {
    return CloudFormat::Ply;
  }
  if (startsWith(bytes, "LASF"))
  {
    return CloudFormat::Las;
  }
  if (startsWith(bytes, "ASTM-E57"))
  {
    return CloudFormat::E57;
  }
  if (startsWith(bytes, "# vtk DataFile"))
  {
    return CloudFormat::VtkLegacy;
  }
  if (looksLikeXml(bytes))
  {
    return CloudFormat::VtkXml;
  }
  if (looksLikePcd(bytes))
  {
    return CloudFormat::Pcd;
  }
  if (looksLikeOff(bytes))
  {
    return CloudFormat::Off;
  }
  if (looksLikeStlText(bytes) || looksLikeBinaryStl(bytes, size))
  {
    return CloudFormat::Stl;
  }
  if (looksLikeText(bytes))
  {
    const std::string_view line = firstSignificantLine(bytes);
    if ((extension == "obj" && line.empty()) || looksLikeObj(line, extension))
    {
      return CloudFormat::Obj;
    }
    if (looksLikeColumns(line) || isColumnExtension(extension))
    {
      return CloudFormat::Text;
    }
  }
  if (extension == "stl")
  {
    return CloudFormat::Stl;
  }
  throw FileProblem(vtkErrorCode::UnrecognizedFileTypeError,
    "unknown format: starts with " + inQuotes(bytes.substr(0, 16)),
    "use PLY, PCD, VTP, VTU, VTK, OBJ, OFF, STL, LAS, LAZ, E57, or text with columns x y z");
}

const char* nameOf(CloudFormat format)
{
  switch (format)
  {
    case CloudFormat::Ply:
      return "PLY";
    case CloudFormat::Pcd:
      return "PCD";
    case CloudFormat::VtkXml:
      return "VTK XML";
    case CloudFormat::VtkLegacy:
      return "VTK (legacy)";
    case CloudFormat::Obj:
      return "OBJ";
    case CloudFormat::Off:
      return "OFF";
    case CloudFormat::Stl:
      return "STL";
    case CloudFormat::Las:
      return "LAS";
    case CloudFormat::E57:
      return "E57";
    case CloudFormat::Text:
      return "text";
  }
  return "unknown format";
}

} // namespace pointhaptics::io
