#include "IO/Formats/FormatLooks.h"

#include "Bytes/LittleEndian.h"
#include "FileProblem.h"
#include "IO/Text/TextCells.h"
#include "IO/Text/TextTable.h"

#include "vtk_utf8.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <string>

namespace pointhaptics::io
{

namespace
{

constexpr std::size_t kLookedAt = 4096;

bool startsWith(std::string_view text, std::string_view start)
{
  return text.substr(0, start.size()) == start;
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

/// Binary STL has no mark, but its length is that of the triangles it counts.
bool looksLikeBinaryStl(std::string_view bytes, std::size_t size)
{
  constexpr std::size_t kHeader = 84;
  return bytes.size() >= kHeader && size > kHeader &&
    size == kHeader + std::size_t{ 50 } * numberAt<std::uint32_t>(bytes, kHeader - sizeof(std::uint32_t));
}

/// True for extensions of text with columns, whatever is in it.
bool isColumnExtension(const std::string& extension)
{
  const std::string_view known[] = { "xyz", "txt", "csv", "pts", "asc", "tsv", "dat", "xyzn", "xyzrgb" };
  return std::find(std::begin(known), std::end(known), extension) != std::end(known);
}

bool hasUtf16Mark(std::string_view bytes)
{
  return startsWith(bytes, "\xff\xfe") || startsWith(bytes, "\xfe\xff");
}

/// True if each second byte from @p first on is zero in the first ones, as it is in Latin text of UTF-16.
bool hasZeros(std::string_view bytes, std::size_t first)
{
  constexpr std::size_t kShown = 64;
  const std::size_t size = std::min(bytes.size(), kShown);
  bool result = size >= 8;
  for (std::size_t i = 0; i < size; ++i)
  {
    result = result && (bytes[i] == '\0') == (i % 2 == first);
  }
  return result;
}

} // namespace

bool isText(std::string_view head)
{
  return std::none_of(head.begin(), head.end(),
    [](char c)
    {
      const unsigned char byte = static_cast<unsigned char>(c);
      return (byte < 0x20 && !isBlank(c) && c != '\n') || byte == 0x7f;
    });
}

std::string_view withoutByteOrderMark(std::string_view bytes)
{
  return startsWith(bytes, "\xef\xbb\xbf") ? bytes.substr(3) : bytes;
}

bool isUtf16(std::string_view bytes)
{
  return hasUtf16Mark(bytes) || hasZeros(bytes, 1) || hasZeros(bytes, 0);
}

std::string utf8Of(std::string_view bytes)
{
  const std::size_t low = bytes[0] == '\xfe' || bytes[0] == '\0' ? 1 : 0; // of the two bytes of a unit
  const auto unit = [&](std::size_t i)
  {
    return std::uint32_t{ static_cast<unsigned char>(bytes[i + low]) } |
      std::uint32_t{ static_cast<unsigned char>(bytes[i + 1 - low]) } << 8;
  };
  std::string text;
  text.reserve(bytes.size() / 2);
  for (std::size_t i = hasUtf16Mark(bytes) ? 2 : 0; i + 1 < bytes.size(); i += 2)
  {
    std::uint32_t code = unit(i);
    if (code >= 0xd800 && code < 0xe000)
    {
      const std::uint32_t next = i + 3 < bytes.size() ? unit(i + 2) : 0;
      const bool isPair = code < 0xdc00 && next >= 0xdc00 && next < 0xe000;
      code = isPair ? 0x10000 + ((code - 0xd800) << 10) + (next - 0xdc00) : '?';
      i += isPair ? 2 : 0;
    }
    utf8::append(code, std::back_inserter(text));
  }
  return text;
}

std::string utf8Name(const std::string& name)
{
  std::string latin;
  for (const char c : name)
  {
    utf8::append(static_cast<unsigned char>(c), std::back_inserter(latin));
  }
  return utf8::is_valid(name.begin(), name.end()) ? name : latin;
}

std::string unusedName(std::set<std::string>& used, const std::string& wanted, std::size_t longest)
{
  const auto cut = [&](std::size_t size)
  {
    std::size_t end = std::min(size, wanted.size());
    while (end < wanted.size() && end > 0 && (static_cast<unsigned char>(wanted[end]) & 0xc0) == 0x80)
    {
      --end; // within a character of UTF-8
    }
    return wanted.substr(0, end);
  };
  std::string name = cut(longest);
  for (int number = 2; !used.insert(name).second; ++number)
  {
    const std::string suffix = "_" + std::to_string(number);
    name = cut(longest == std::string::npos ? longest : longest - suffix.size()) + suffix;
  }
  return name;
}

FormatStart lookAt(
  std::string_view bytes, std::size_t size, const std::string& extension, std::string& converted)
{
  FormatStart start;
  converted = isUtf16(bytes) ? utf8Of(bytes) : std::string();
  start.bytes = converted.empty() ? withoutByteOrderMark(bytes) : converted;
  start.size = size;
  start.extension = extension;
  std::string_view head = start.bytes.substr(0, kLookedAt);
  head = head.substr(0, head.find_last_not_of('\x1a') + 1);
  const std::string_view lines = head.substr(0, head.find('\0')); // where a power cut left zero bytes
  start.isText = isText(isColumnExtension(extension) && lines.find('\n') < lines.size() ? lines : head);
  start.line = firstSignificantLine(start.bytes);
  return start;
}

bool looksLikePly(const FormatStart& start)
{
  std::string_view line = start.line;
  return equalNoCase(takeWord(line), "ply");
}

bool looksLikePcd(const FormatStart& start)
{
  std::string_view line = start.line;
  const std::string_view word = takeWord(line);
  return startsWith(start.bytes, "# .PCD") || word == "VERSION" || word == "FIELDS" || word == "COLUMNS";
}

bool looksLikeVtkXml(const FormatStart& start)
{
  const std::string_view text = trimmed(start.bytes.substr(0, kLookedAt));
  return startsWith(text, "<") && text.find("<VTKFile") != std::string_view::npos;
}

/// OFF with letters in front for normals, colours and so on.
bool looksLikeOff(const FormatStart& start)
{
  std::string_view line = start.line;
  std::string_view word = takeWord(line);
  word = word.substr(
    0, word.find_first_of("0123456789", word.find("OFF"))); // a count may stick to it: "OFF8 12 0"
  return word.size() >= 3 && word.size() <= 8 && word.substr(word.size() - 3) == "OFF" &&
    word.find_first_not_of("STCN4nOF") == std::string_view::npos;
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

bool looksLikeStl(const FormatStart& start)
{
  return looksLikeStlText(start.bytes) || looksLikeBinaryStl(start.bytes, start.size) ||
    (start.extension == "stl" && !(start.isText && looksLikeColumns(start)));
}

bool looksLikeObj(const FormatStart& start)
{
  std::string_view line = start.line;
  const std::string_view keyword = takeWord(line);
  double number = 0.0;
  if (!start.isText || (keyword == "v" && parseNumber(takeWord(line), number)))
  {
    return start.isText;
  }
  const std::string_view keywords[] = { "v", "vn", "vt", "vp", "o", "g", "s", "f", "l", "p", "mtllib",
    "usemtl" };
  const bool known = std::find(std::begin(keywords), std::end(keywords), keyword) != std::end(keywords);
  return (known && !isColumnExtension(start.extension)) || (keyword.empty() && start.extension == "obj");
}

/// Numbers first, a header that names x, y and z, or columns below titles.
bool looksLikeColumns(const FormatStart& start)
{
  double number = 0.0;
  return start.isText &&
    (isColumnExtension(start.extension) ||
      parseNumber(start.line.data(), start.line.data() + start.line.size(), number) ||
      inspectText(start.bytes).columns >= 3);
}

} // namespace pointhaptics::io
