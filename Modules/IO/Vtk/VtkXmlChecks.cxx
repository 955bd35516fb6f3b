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

bool isBase64Digit(char c)
{
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '+' || c == '/';
}

/// VTK takes memory that nobody filled for the bytes behind a character that is no base64.
void checkBase64(const DataLayout& layout, std::size_t position, std::uint64_t size)
{
  const auto digits = static_cast<std::size_t>((size * 4 + 2) / 3);
  const std::string_view text = layout.bytes.substr(std::min(position, layout.bytes.size()), digits);
  const auto wrong = std::find_if_not(text.begin(), text.end(), &isBase64Digit);
  if (wrong != text.end())
  {
    failDamaged(position + static_cast<std::size_t>(wrong - text.begin()),
      inQuotes(std::string_view(&*wrong, 1)) + " is no digit of base64");
  }
  const std::string_view padding =
    layout.bytes.substr(std::min(position + digits, layout.bytes.size()), (4 - digits % 4) % 4);
  if (!std::all_of(padding.begin(), padding.end(), [](char c) { return c == '=' || isBase64Digit(c); }))
  {
    failDamaged(position + digits, "base64 that does not end with '='");
  }
}

void checkArrayBytes(const DataLayout& layout, std::size_t position, bool isBase64)
{
  const ArrayWords one(layout, position, isBase64, 1);
  const std::uint64_t first = one.values[0];
  if (!layout.isPacked)
  {
    if (first > one.remaining)
    {
      failTruncated(atByte(position) + "an array of " + std::to_string(first) + " bytes, but only " +
        std::to_string(one.remaining) + " follow");
    }
    isBase64 ? checkBase64(layout, position, layout.wordSize + first) : void();
    return;
  }
  if (first > one.remaining / layout.wordSize)
  {
    failTruncated(atByte(position) + "an array of " + std::to_string(first) + " blocks, but only " +
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
    failTruncated(
      atByte(position) + "blocks of more than the " + std::to_string(most) + " bytes that follow");
  }
  isBase64 ? checkBase64(layout, layout.bytes.size() - static_cast<std::size_t>(most), packed) : void();
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
    if (parent.name == "Points" && child.attribute("NumberOfComponents") != "3")
    {
      failDamaged(
        child.begin, "points of " + inQuotes(child.attribute("NumberOfComponents")) + " components");
    }
    if (child.name != "DataArray" && child.name != "Array")
    {
      failDamaged(child.begin, inQuotes(child.name) + " in the place of an array");
    }
    if (std::find(std::begin(kTypes), std::end(kTypes), type) == std::end(kTypes))
    {
      failDamaged(child.begin, "an array of the type " + inQuotes(type));
    }
  }
}

void checkArray(const DataLayout& layout, const XmlElement& array)
{
  const std::string_view format = array.attribute("format");
  if (format == "appended")
  {
    const std::string_view text = array.attribute("offset");
    unsigned long long offset = 0;
    if (layout.appendedAt == 0 || !parseCount(text, offset) ||
      offset >= layout.bytes.size() - layout.appendedAt)
    {
      failTruncated(atByte(array.begin) + "an array at offset " + inQuotes(text) +
        " of the appended data, which is not there");
    }
    checkArrayBytes(layout, layout.appendedAt + static_cast<std::size_t>(offset), layout.appendedIsBase64);
    return;
  }
  if (format == "binary")
  {
    std::size_t start = array.end;
    while (start < layout.bytes.size() && isSpace(layout.bytes[start]))
    {
      ++start;
    }
    const bool isEmpty = layout.bytes[array.end - 2] == '/' || layout.bytes.substr(start, 1) == "<";
    if (!isEmpty)
    {
      checkArrayBytes(layout, start, true);
    }
    return;
  }
  if (format != "ascii")
  {
    failDamaged(array.begin, "an array of the format " + inQuotes(format));
  }
}

/// Counts in the attributes of one tag.
class CountCheck
{
public:
  CountCheck(bool isPacked, std::size_t fileSize)
    : mostBytes_(static_cast<double>(fileSize) * (isPacked ? kMostUnpackedBytes : 1.0))
    , fileSize_(fileSize)
  {
  }
  void check(const XmlElement& element)
  {
    for (const char* name : { "NumberOfPoints", "NumberOfVerts", "NumberOfLines", "NumberOfStrips",
           "NumberOfPolys", "NumberOfCells", "NumberOfTuples", "NumberOfComponents" })
    {
      const std::string_view value = element.attribute(name);
      unsigned long long count = 0;
      if (value.empty())
      {
        continue;
      }
      const bool isComponents = std::string_view(name) == "NumberOfComponents";
      if (!parseCount(value, count) ||
        static_cast<double>(count) * (isComponents ? tuples_ : 1.0) > mostBytes_)
      {
        failTruncated(atByte(element.begin) + name + " is " + inQuotes(value) + " in a file of " +
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
  if (isPart && !(last && last->begin == appended))
  {
    failDamaged(appended, inQuotes(kAppended) + " in a place where it is no tag");
  }
  if (root.name != "VTKFile")
  {
    failDamaged(0, "the first XML element is not VTKFile");
  }
  return root;
}

std::uint64_t pointsOfVtkXml(const XmlElement& root, std::size_t fileSize)
{
  CountCheck counts(!root.attribute("compressor").empty(), fileSize);
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

void checkVtkXml(std::string_view bytes, const XmlElement& root)
{
  checkIsComplete(bytes);
  const DataLayout layout = layoutOf(bytes, root);
  CountCheck counts(layout.isPacked, bytes.size());
  forEachElement(root,
    [&](const XmlElement& element)
    {
      counts.check(element);
      std::find(std::begin(kParents), std::end(kParents), element.name) != std::end(kParents)
        ? checkAreArrays(element)
        : void();
      element.name == "DataArray" || element.name == "Array" ? checkArray(layout, element) : void();
    });
}

} // namespace pointhaptics::io
