#include "IO/Vtk/VtkXmlChecks.h"

#include "FileProblem.h"
#include "IO/Text/TextScan.h"
#include "IO/Vtk/XmlTags.h"

#include "vtkBase64Utilities.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace pointhaptics::io
{

namespace
{

/// zlib packs at most 1032 bytes into one; a file that claims more, of any compressor, is refused.
constexpr double kMostUnpackedBytes = 1032.0;

bool isSpace(char c)
{
  return isBlank(c) || c == '\n';
}

std::string at(std::size_t offset)
{
  return "byte " + std::to_string(offset) + ": ";
}

[[noreturn]] void failDamaged(std::size_t offset, const std::string& what)
{
  failFormat(at(offset) + what, "the file is damaged: copy or write it again");
}

/// Where arrays that are not text keep their bytes, and how.
struct DataLayout
{
  std::string_view bytes;
  std::size_t appendedAt = 0; ///< the byte after the mark '_'; 0: there is none
  bool appendedIsBase64 = false;
  bool isPacked = false;
  bool isBigEndian = false;
  std::size_t wordSize = 4; ///< of the numbers before each array's bytes
};

/// Words in front of the bytes of an array: how many bytes there are, or in how many blocks they are packed,
/// of which size, and to which size each.
struct ArrayWords
{
  std::vector<std::uint64_t> values;
  std::uint64_t remaining = 0; ///< Most bytes that may still follow.

  /// The first @p count at @p position.
  ArrayWords(const DataLayout& layout, std::size_t position, bool isBase64, std::size_t count)
    : values(count)
  {
    const std::string_view rest = layout.bytes.substr(std::min(position, layout.bytes.size()));
    const std::size_t size = count * layout.wordSize;
    const std::string_view text = rest.substr(0, isBase64 ? (size + 2) / 3 * 4 : size);
    std::string raw(size, '\0');
    auto* to = reinterpret_cast<unsigned char*>(&raw[0]);
    const auto* from = reinterpret_cast<const unsigned char*>(text.data());
    const std::size_t there =
      isBase64 ? vtkBase64Utilities::DecodeSafely(from, text.size(), to, size) : text.copy(&raw[0], size);
    if (there < size)
    {
      isBase64&& text.size() == (size + 2) / 3 * 4
        ? failDamaged(position, "no base64 where an array starts")
        : failTruncated("the file ends at byte " + std::to_string(layout.bytes.size()) + " inside its data");
    }
    for (std::size_t i = 0; i < size; ++i)
    {
      const std::size_t word = i / layout.wordSize;
      const std::size_t byte =
        layout.isBigEndian ? i : (word + 1) * layout.wordSize - 1 - i % layout.wordSize;
      values[word] = values[word] << 8 | static_cast<unsigned char>(raw[byte]);
    }
    remaining = rest.size() - text.size();
  }
};

void checkArrayBytes(const DataLayout& layout, std::size_t position, bool isBase64)
{
  const ArrayWords one(layout, position, isBase64, 1);
  const std::uint64_t first = one.values[0];
  if (!layout.isPacked)
  {
    if (first > one.remaining)
    {
      failTruncated(at(position) + "an array of " + std::to_string(first) + " bytes, but only " +
        std::to_string(one.remaining) + " follow");
    }
    return;
  }
  if (first > one.remaining / layout.wordSize)
  {
    failTruncated(at(position) + "an array of " + std::to_string(first) + " blocks, but only " +
      std::to_string(one.remaining) + " bytes follow");
  }
  const ArrayWords words(layout, position, isBase64, 3 + static_cast<std::size_t>(first));
  const std::uint64_t blockSize = words.values[1];
  const std::uint64_t lastSize = words.values[2];
  if (first == 0)
  {
    // VTK would take the last block's size for that of data which are there.
    if (lastSize > 0)
    {
      failDamaged(position, "an array of no blocks, the last of " + std::to_string(lastSize) + " bytes");
    }
    return;
  }
  const double unpacked = static_cast<double>(first) * static_cast<double>(blockSize);
  const std::uint64_t most = words.remaining;
  if (lastSize > blockSize ||
    unpacked > kMostUnpackedBytes * static_cast<double>(most) + static_cast<double>(blockSize - lastSize))
  {
    failDamaged(position,
      std::to_string(first) + " blocks of " + std::to_string(blockSize) + " bytes are said to be packed in " +
        std::to_string(most));
  }
  // A short array may be less than the usual block, of which nothing but the last part is there.
  if (static_cast<double>(blockSize) > std::max(kMostUnpackedBytes * static_cast<double>(most), 1e8))
  {
    failDamaged(position, "blocks of " + std::to_string(blockSize) + " bytes");
  }
  std::uint64_t packed = 0;
  for (std::size_t i = 3; i < words.values.size() && packed <= most; ++i)
  {
    packed += std::min(words.values[i], most + 1);
  }
  if (packed > most)
  {
    failTruncated(at(position) + "blocks of more than the " + std::to_string(most) + " bytes that follow");
  }
}

void checkArray(const DataLayout& layout, std::string_view tag, std::size_t tagAt, std::size_t tagEnd)
{
  const std::string_view format = xmlAttribute(tag, "format");
  if (format == "appended")
  {
    const std::string_view text = xmlAttribute(tag, "offset");
    unsigned long long offset = 0;
    if (layout.appendedAt == 0 || !parseCount(text, offset) ||
      offset >= layout.bytes.size() - layout.appendedAt)
    {
      failTruncated(
        at(tagAt) + "an array at offset " + inQuotes(text) + " of the appended data, which is not there");
    }
    checkArrayBytes(layout, layout.appendedAt + static_cast<std::size_t>(offset), layout.appendedIsBase64);
    return;
  }
  if (format == "binary")
  {
    std::size_t start = tagEnd;
    while (start < layout.bytes.size() && isSpace(layout.bytes[start]))
    {
      ++start;
    }
    const bool isEmpty = tag.back() == '/' || layout.bytes.substr(start, 1) == "<";
    if (!isEmpty)
    {
      checkArrayBytes(layout, start, true);
    }
    return;
  }
  if (format != "ascii")
  {
    failDamaged(tagAt, "an array of the format " + inQuotes(format));
  }
}

/// Counts in the attributes of one tag.
class CountCheck
{
public:
  CountCheck(const DataLayout& layout, std::size_t fileSize)
    : mostBytes_(static_cast<double>(fileSize) * (layout.isPacked ? kMostUnpackedBytes : 1.0))
    , fileSize_(fileSize)
  {
  }
  void check(std::string_view tag, std::size_t tagAt)
  {
    for (const char* name : { "NumberOfPoints", "NumberOfVerts", "NumberOfLines", "NumberOfStrips",
           "NumberOfPolys", "NumberOfCells", "NumberOfTuples", "NumberOfComponents" })
    {
      const std::string_view value = xmlAttribute(tag, name);
      unsigned long long count = 0;
      if (value.empty())
      {
        continue;
      }
      const bool isComponents = std::string_view(name) == "NumberOfComponents";
      if (!parseCount(value, count) ||
        static_cast<double>(count) * (isComponents ? tuples_ : 1.0) > mostBytes_)
      {
        failTruncated(at(tagAt) + name + " is " + inQuotes(value) + " in a file of " +
          std::to_string(fileSize_) + " bytes");
      }
      if (!isComponents)
      {
        tuples_ = std::max(tuples_, static_cast<double>(count));
      }
    }
  }

private:
  double mostBytes_;
  std::size_t fileSize_;
  double tuples_ = 1.0;
};

DataLayout layoutOf(std::string_view bytes)
{
  DataLayout layout;
  layout.bytes = bytes;
  const std::string_view file = vtkFileTag(bytes);
  layout.isPacked = !xmlAttribute(file, "compressor").empty();
  layout.isBigEndian = xmlAttribute(file, "byte_order") == "BigEndian";
  layout.wordSize = xmlAttribute(file, "header_type") == "UInt64" ? 8 : 4;
  XmlTags tags(bytes);
  while (tags.next())
  {
    if (tags.tag().substr(0, 13) == "<AppendedData")
    {
      layout.appendedIsBase64 = xmlAttribute(tags.tag(), "encoding") != "raw";
      const std::size_t mark = bytes.find('_', tags.end());
      layout.appendedAt = mark == std::string_view::npos ? 0 : mark + 1;
    }
  }
  return layout;
}

/// VTK's reader accepts a file whose last bytes are missing.
void checkIsComplete(std::string_view bytes)
{
  constexpr std::size_t kTail = 256;
  const std::string_view tail = bytes.substr(bytes.size() - std::min(bytes.size(), kTail));
  if (tail.find("</VTKFile>") == std::string_view::npos)
  {
    failTruncated("the file ends at byte " + std::to_string(bytes.size()) + " without </VTKFile>");
  }
}

} // namespace

std::string_view xmlAttribute(std::string_view tag, std::string_view name)
{
  constexpr std::string_view kSpaces = " \t\r\n";
  std::size_t at = tag.find_first_of(kSpaces);
  while (at != std::string_view::npos && (at = tag.find_first_not_of(kSpaces, at)) != std::string_view::npos)
  {
    const std::size_t nameEnd = std::min(tag.find_first_of(" \t\r\n=", at), tag.size());
    const std::size_t quote = tag.find_first_of("\"'", nameEnd);
    const std::size_t end =
      quote == std::string_view::npos ? std::string_view::npos : tag.find(tag[quote], quote + 1);
    if (end == std::string_view::npos)
    {
      break;
    }
    if (tag.substr(at, nameEnd - at) == name)
    {
      return tag.substr(quote + 1, end - quote - 1);
    }
    at = end + 1;
  }
  return {};
}

std::string_view vtkFileTag(std::string_view bytes)
{
  XmlTags tags(bytes);
  if (!tags.next() || tags.tag().substr(0, 8) != "<VTKFile")
  {
    failDamaged(0, "the first XML element is not VTKFile");
  }
  return tags.tag();
}

std::uint64_t pointsOfVtkXml(std::string_view start, std::size_t fileSize)
{
  CountCheck counts(layoutOf(start), fileSize);
  std::uint64_t points = 0;
  XmlTags tags(start);
  while (tags.next())
  {
    unsigned long long count = 0;
    if (tags.tag().substr(0, 6) == "<Piece")
    {
      counts.check(tags.tag(), tags.begin());
      parseCount(xmlAttribute(tags.tag(), "NumberOfPoints"), count);
      points += count;
    }
  }
  return points;
}

void checkVtkXml(std::string_view bytes)
{
  checkIsComplete(bytes);
  const DataLayout layout = layoutOf(bytes);
  CountCheck counts(layout, bytes.size());
  XmlTags tags(bytes);
  while (tags.next())
  {
    const std::string_view tag = tags.tag();
    counts.check(tag, tags.begin());
    if (tag.substr(0, 10) == "<DataArray" || tag.substr(0, 6) == "<Array")
    {
      checkArray(layout, tag, tags.begin(), tags.end());
    }
  }
}

} // namespace pointhaptics::io
