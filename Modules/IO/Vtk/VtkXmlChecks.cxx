#include "IO/Vtk/VtkXmlChecks.h"

#include "FileProblem.h"
#include "IO/Bytes/TextScan.h"

#include "vtkBase64Utilities.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <string>
#include <vector>

namespace pointhaptics::io
{

namespace
{

/// zlib packs at most 1032 bytes into one; a file that claims more, of any compressor, is refused.
constexpr double kMostUnpackedBytes = 1032.0;

/// Elements that hold nothing but arrays.
constexpr std::string_view kParents[] = { "FieldData", "PointData", "CellData", "Points", "Verts", "Lines",
  "Strips", "Polys", "Cells" };

/// Where arrays that are not text keep their bytes, and how.
struct DataLayout
{
  std::string_view bytes;
  std::size_t appendedAt = 0; ///< the byte after the mark '_'; 0: there is none
  bool appendedIsBase64 = false;
  bool isPacked = false;
  bool isBigEndian = false;
  std::size_t wordSize = 4; ///< of the numbers before each array's bytes

  std::string_view from(std::size_t position) const { return bytes.substr(std::min(position, bytes.size())); }
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
    const std::string_view rest = layout.from(position);
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

bool isBase64Digit(char c)
{
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '+' || c == '/';
}

/// VTK takes memory that nobody filled for the bytes behind a character that is no base64.
void checkBase64(const DataLayout& layout, std::size_t position, std::uint64_t size)
{
  const auto digits = static_cast<std::size_t>((size * 4 + 2) / 3);
  const std::string_view text = layout.from(position).substr(0, (digits + 3) / 4 * 4);
  const auto at =
    static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), &isBase64Digit) - text.begin());
  failDamagedIf(at < std::min(digits, text.size()), position + at, "{} is no digit of base64",
    inQuotes(text.substr(at, 1)));
  failDamagedIf(text.find_first_not_of('=', at) != std::string_view::npos, position + digits,
    "base64 that does not end with '='");
}

void checkArrayBytes(const DataLayout& layout, std::size_t position, bool isBase64)
{
  const ArrayWords one(layout, position, isBase64, 1);
  const std::uint64_t first = one.values[0];
  failTruncatedIf(first > one.remaining / (layout.isPacked ? layout.wordSize : 1),
    "{}an array of {}{}, but only {} bytes follow", atByte(position), first,
    layout.isPacked ? " blocks" : " bytes", one.remaining);
  std::uint64_t most = one.remaining;
  std::uint64_t size = layout.wordSize + first;
  if (layout.isPacked)
  {
    const ArrayWords words(layout, position, isBase64, 3 + static_cast<std::size_t>(first));
    const std::uint64_t blockSize = words.values[1];
    const std::uint64_t lastSize = words.values[2];
    most = words.remaining;
    const double mostUnpacked = kMostUnpackedBytes * static_cast<double>(most);
    // VTK would take the last block's size for that of data which are there.
    failDamagedIf(
      first == 0 && lastSize > 0, position, "an array of no blocks, the last of {} bytes", lastSize);
    failDamagedIf(first > 0 &&
        (lastSize > blockSize ||
          static_cast<double>(first) * static_cast<double>(blockSize) >
            mostUnpacked + static_cast<double>(blockSize - lastSize)),
      position, "{} blocks of {} bytes are said to be packed in {}", first, blockSize, most);
    // A short array may be less than the usual block, of which nothing but the last part is there.
    failDamagedIf(first > 0 && static_cast<double>(blockSize) > std::max(mostUnpacked, 1e8), position,
      "blocks of {} bytes", blockSize);
    size = 0;
    for (std::size_t i = 3; i < words.values.size() && size <= most; ++i)
    {
      size += std::min(words.values[i], most + 1);
    }
    failTruncatedIf(size > most, "{}blocks of more than the {} bytes that follow", atByte(position), most);
    position = layout.bytes.size() - static_cast<std::size_t>(most);
  }
  isBase64 ? checkBase64(layout, position, size) : void();
}

/// VTK's reader makes an array of each child of @p parent, and goes on with none where it knows no such type,
/// or where points have not three coordinates.
void checkAreArrays(const XmlElement& parent)
{
  constexpr std::string_view kTypes[] = { "Float32", "Float64", "Int8", "UInt8", "Int16", "UInt16", "Int32",
    "UInt32", "Int64", "UInt64", "String", "Bit" };
  for (const XmlElement& child : parent.children)
  {
    const std::string_view type = child.attribute("type");
    failDamagedIf(parent.name == "Points" && child.attribute("NumberOfComponents") != "3", child.begin,
      "points of {} components", inQuotes(child.attribute("NumberOfComponents")));
    failDamagedIf(child.name != "DataArray" && child.name != "Array", child.begin,
      "{} in the place of an array", inQuotes(child.name));
    failDamagedIf(
      indexOf(kTypes, type) == std::size(kTypes), child.begin, "an array of the type {}", inQuotes(type));
  }
}

void checkArray(const DataLayout& layout, const XmlElement& array)
{
  const std::string_view format = array.attribute("format");
  if (format == "appended" || !array.attribute("offset").empty()) // VTK asks for the offset alone
  {
    const std::string_view text = array.attribute("offset");
    unsigned long long offset = 0;
    failTruncatedIf(layout.appendedAt == 0 || !parseCount(text, offset) ||
        offset >= layout.bytes.size() - layout.appendedAt,
      "{}an array at offset {} of the appended data, which is not there", atByte(array.begin),
      inQuotes(text));
    checkArrayBytes(layout, layout.appendedAt + static_cast<std::size_t>(offset), layout.appendedIsBase64);
    return;
  }
  if (format == "binary")
  {
    const std::size_t start =
      std::min(layout.bytes.find_first_not_of(" \t\r\n\v\f", array.end), layout.bytes.size());
    const bool isEmpty = layout.bytes[array.end - 2] == '/' || layout.bytes.substr(start, 1) == "<";
    isEmpty ? void() : checkArrayBytes(layout, start, true);
    return;
  }
  failDamagedIf(format != "ascii", array.begin, "an array of the format {}", inQuotes(format));
}

/// Counts in the attributes of tags.
struct CountCheck
{
  std::size_t fileSize = 0;
  bool isPacked = false;
  double tuples = 1.0; ///< Most that a tag said so far.

  void check(const XmlElement& element)
  {
    const double most = static_cast<double>(fileSize) * (isPacked ? kMostUnpackedBytes : 1.0);
    for (const char* name : { "NumberOfPoints", "NumberOfVerts", "NumberOfLines", "NumberOfStrips",
           "NumberOfPolys", "NumberOfCells", "NumberOfTuples", "NumberOfComponents" })
    {
      const std::string_view value = element.attribute(name);
      unsigned long long count = 0;
      const bool isOfTuples = std::string_view(name) == "NumberOfComponents";
      failTruncatedIf(!value.empty() &&
          (!parseCount(value, count) || static_cast<double>(count) * (isOfTuples ? tuples : 1.0) > most),
        "{}{} is {} in a file of {} bytes", atByte(element.begin), name, inQuotes(value), fileSize);
      tuples = isOfTuples ? tuples : std::max(tuples, static_cast<double>(count));
    }
  }
};

DataLayout layoutOf(std::string_view bytes, const XmlElement& root)
{
  DataLayout layout;
  layout.bytes = bytes;
  layout.isPacked = !root.attribute("compressor").empty();
  layout.isBigEndian = root.attribute("byte_order") == "BigEndian";
  layout.wordSize = root.attribute("header_type") == "UInt64" ? 8 : 4;
  if (const XmlElement* appended = root.child("AppendedData"))
  {
    layout.appendedIsBase64 = appended->attribute("encoding") != "raw";
    const std::size_t mark = bytes.find('_', appended->end);
    layout.appendedAt = mark == std::string_view::npos ? 0 : mark + 1;
  }
  return layout;
}

/// Type of the points; name, type and components of each of their arrays.
std::string arraysOf(const XmlElement& piece)
{
  const XmlElement* points = piece.child("Points");
  const bool hasPoints = points && !points->children.empty();
  std::string arrays = fmt::format("points {}", hasPoints ? points->children[0].attribute("type") : "");
  const XmlElement* data = piece.child("PointData");
  for (std::size_t i = 0; data && i < data->children.size(); ++i)
  {
    const XmlElement& array = data->children[i];
    const std::string_view components = array.attribute("NumberOfComponents");
    arrays += fmt::format(", {} {} {}", inQuotes(array.attribute("Name")), array.attribute("type"),
      components.empty() ? "1" : components);
  }
  return arrays;
}

/// VTK's reader accepts a file whose last bytes are missing.
void checkIsComplete(std::string_view bytes)
{
  constexpr std::size_t kTail = 256;
  const std::string_view tail = bytes.substr(bytes.size() - std::min(bytes.size(), kTail));
  failTruncatedIf(tail.find("</VTKFile>") == std::string_view::npos,
    "the file ends at byte {} without </VTKFile>", bytes.size());
}

} // namespace

XmlElement vtkXml(std::string_view bytes)
{
  constexpr std::string_view kAppended = "<AppendedData";
  const std::size_t appended = bytes.find(kAppended);
  const bool isPart = appended != std::string_view::npos;
  isPart ? void() : checkIsComplete(bytes);
  std::string_view left = bytes.substr(0, isPart ? bytes.find('>', appended) + 1 : bytes.size());
  const XmlElement root = parseXml(
    [&]
    {
      const std::string_view piece = left.substr(0, kLongestXmlTag);
      left.remove_prefix(piece.size());
      return piece;
    },
    false, isPart ? XmlPart::Start : XmlPart::Whole);
  const XmlElement* last = root.child("AppendedData");
  failDamagedIf(isPart && !(last && last->begin == appended), appended, "{} in a place where it is no tag",
    inQuotes(kAppended));
  failDamagedIf(root.name != "VTKFile", 0, "the first XML element is not VTKFile");
  return root;
}

std::uint64_t pointsOfVtkXml(const XmlElement& root, std::size_t fileSize)
{
  CountCheck counts{ fileSize, !root.attribute("compressor").empty() };
  std::uint64_t points = 0;
  forEachElement(root,
    [&](const XmlElement& element)
    {
      unsigned long long count = 0;
      if (element.name == "Piece")
      {
        counts.check(element);
        parseCount(element.attribute("NumberOfPoints"), count);
        points += count;
      }
    });
  return points;
}

void checkSameArrays(const std::string& first, const std::string& other)
{
  failFormatIf(first != other, "write all pieces with the same arrays, in the same order",
    "other arrays than in the pieces before: {} instead of {}", other, first);
}

void checkVtkXml(std::string_view bytes, const XmlElement& root)
{
  checkIsComplete(bytes);
  const DataLayout layout = layoutOf(bytes, root);
  CountCheck counts{ bytes.size(), layout.isPacked };
  const XmlElement* firstPiece = nullptr;
  forEachElement(root,
    [&](const XmlElement& element)
    {
      counts.check(element);
      const std::size_t mark = bytes.find('>', element.begin); // where VTK looks for the values of an array
      failFormatIf(mark + 1 < element.end, "write &gt; for it, or save the file with ParaView",
        "{}a '>' within a tag", atByte(mark));
      indexOf(kParents, element.name) < std::size(kParents) ? checkAreArrays(element) : void();
      element.name == "DataArray" || element.name == "Array" ? checkArray(layout, element) : void();
      if (element.name == "Piece" && element.attribute("NumberOfPoints") != "0")
      {
        firstPiece = firstPiece ? firstPiece : &element;
        checkSameArrays(arraysOf(*firstPiece), arraysOf(element)); // VTK leaves what one lacks undefined
      }
    });
}

} // namespace pointhaptics::io
