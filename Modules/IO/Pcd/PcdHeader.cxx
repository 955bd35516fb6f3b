#include "IO/Pcd/PcdHeader.h"

#include "Bytes/LittleEndian.h"
#include "Bytes/NumericType.h"
#include "IO/Bytes/TextScan.h"
#include "ReadTask.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <map>
#include <set>

namespace pointhaptics::io
{

namespace
{

constexpr unsigned long long kMostLzfRatio = 90; ///< LZF packs at most 264 bytes into 3

/// In the order of PcdEncoding.
constexpr std::string_view kEncodings[] = { "ascii", "binary", "binary_compressed" };

/// Reads the header's lines one by one.
class HeaderParser
{
public:
  explicit HeaderParser(std::string_view bytes)
    : lines_(bytes)
  {
  }
  PcdHeader parse();

private:
  void parseEntry(const std::string& keyword, std::string_view rest);
  void parseViewpoint(std::string_view rest);
  void parseData(std::string_view word);
  unsigned long long parseOneCount(std::string_view rest) const;
  std::vector<std::string> wordsPerField(std::string_view rest) const;
  void buildFields();

  LineReader lines_;
  PcdHeader header_;
  std::set<std::string> seen_;
  std::vector<std::string> names_;
  std::vector<std::string> sizes_;
  std::vector<std::string> types_;
  std::vector<std::string> counts_;
};

std::vector<std::string> HeaderParser::wordsPerField(std::string_view rest) const
{
  std::vector<std::string> words;
  for (std::string_view word = takeWord(rest); !word.empty(); word = takeWord(rest))
  {
    failIf(words.size() == kMostColumns,
      { atLine(lines_.lineNumber()), "more than ", kMostColumns, " entries" },
      "use COUNT for fields of many numbers");
    words.emplace_back(word);
  }
  failIf(!names_.empty() && words.size() != names_.size(),
    { atLine(lines_.lineNumber()), words.size(), " entries for ", names_.size(), " fields" },
    "write one entry per field");
  return words;
}

unsigned long long HeaderParser::parseOneCount(std::string_view rest) const
{
  unsigned long long value = 0;
  failIf(!parseCount(trimmed(rest), value),
    { atLine(lines_.lineNumber()), inQuotes(trimmed(rest)), " is not a count" },
    "write a whole number, 0 or more");
  return value;
}

void HeaderParser::parseData(std::string_view word)
{
  const std::size_t found = indexOf(kEncodings, word);
  failIf(found == std::size(kEncodings), { atLine(lines_.lineNumber()), "unknown DATA ", inQuotes(word) },
    "PCD has ascii, binary and binary_compressed");
  header_.encoding = static_cast<PcdEncoding>(found);
}

void HeaderParser::parseViewpoint(std::string_view rest)
{
  for (double& value : header_.viewpoint)
  {
    const std::string_view word = takeWord(rest);
    failIf(!parseNumber(word, value),
      { atLine(lines_.lineNumber()), "VIEWPOINT has ", inQuotes(word), " where a number was expected" },
      "write 7 numbers: tx ty tz qw qx qy qz");
  }
}

void HeaderParser::parseEntry(const std::string& keyword, std::string_view rest)
{
  const std::map<std::string, std::vector<std::string>*> lists = { { "FIELDS", &names_ }, { "SIZE", &sizes_ },
    { "TYPE", &types_ }, { "COUNT", &counts_ } };
  const std::map<std::string, unsigned long long*> counts = { { "WIDTH", &header_.width },
    { "HEIGHT", &header_.height }, { "POINTS", &header_.points } };
  if (const auto list = lists.find(keyword); list != lists.end())
  {
    *list->second = wordsPerField(rest);
  }
  else if (const auto count = counts.find(keyword); count != counts.end())
  {
    *count->second = parseOneCount(rest);
  }
  else if (keyword == "VIEWPOINT" || keyword == "DATA")
  {
    keyword == "DATA" ? parseData(takeWord(rest)) : parseViewpoint(rest);
  }
  else if (keyword != "VERSION")
  {
    failLine(
      lines_.lineNumber(), "unknown entry " + inQuotes(keyword), "write the file again with another program");
  }
}

void HeaderParser::buildFields()
{
  for (const std::vector<std::string>* entries : { &sizes_, &types_, &counts_ })
  {
    failIf(names_.empty() || (!entries->empty() && entries->size() != names_.size()),
      { "FIELDS has ", names_.size(), " names, another entry has ", entries->size() },
      "write one entry per field in FIELDS, SIZE, TYPE and COUNT");
  }
  // Old files leave SIZE, TYPE and COUNT out: floats of 4 bytes then.
  for (std::size_t i = 0; i < names_.size(); ++i)
  {
    PcdField field;
    field.name = names_[i];
    unsigned long long size = 4;
    unsigned long long count = 1;
    const bool sized = sizes_.empty() || parseCount(sizes_[i], size);
    const bool counted = counts_.empty() || parseCount(counts_[i], count);
    const char letter = types_.empty() ? 'F' : types_[i].size() == 1 ? types_[i][0] : '?';
    field.type = letter < 'a' ? typeOfKind(static_cast<char>(letter - 'A' + 'a'), size) : VTK_VOID;
    failIf(!sized || field.type == VTK_VOID || !counted || count < 1 || count > 65536,
      { "field ", inQuotes(field.name), " has SIZE ", inQuotes(sizes_.empty() ? "4" : sizes_[i]), ", TYPE ",
        inQuotes(types_.empty() ? "F" : types_[i]), " and COUNT ",
        inQuotes(counts_.empty() ? "1" : counts_[i]) },
      "use TYPE F with SIZE 4 or 8, or I or U with SIZE 1, 2, 4 or 8, and a COUNT from 1 to 65536");
    field.count = static_cast<int>(count);
    field.offset = header_.recordSize;
    header_.recordSize += size * count;
    header_.compressedRecordSize += field.isPadding() ? 0 : size * count;
    header_.numbersPerLine += count;
    header_.fields.push_back(field);
  }
}

PcdHeader HeaderParser::parse()
{
  std::string_view line;
  bool complete = false;
  while (!complete && lines_.next(line))
  {
    std::string keyword(takeWord(line));
    if (keyword.empty() || keyword.front() == '#')
    {
      header_.comments.add(line);
      continue;
    }
    keyword = keyword == "COLUMNS" ? "FIELDS" : keyword;
    failIf(!seen_.insert(keyword).second,
      { atLine(lines_.lineNumber()), "a second entry ", inQuotes(keyword) }, "keep one of the two");
    parseEntry(keyword, line);
    complete = keyword == "DATA";
  }
  failTruncatedIf(!complete, { "the header has no entry DATA" });
  for (const char* needed : { "FIELDS", "WIDTH" })
  {
    failIf(seen_.count(needed) == 0, { "the header has no entry ", needed },
      "write FIELDS, SIZE, TYPE, COUNT, WIDTH, HEIGHT");
  }
  if (seen_.count("POINTS") == 0)
  {
    header_.points = header_.width * header_.height;
  }
  header_.bodyOffset = lines_.position();
  header_.bodyLine = lines_.lineNumber() + 1;
  buildFields();
  return header_;
}

void checkCompressedSize(std::string_view bytes, PcdHeader& header, unsigned long long unpacked)
{
  const std::size_t available = bytes.size() - header.bodyOffset;
  failTruncatedIf(available < 8,
    { "the file ends at byte ", bytes.size(),
      " before its compressed points, which are stored field after field: a part holds no whole point" });
  const unsigned long long packed = numberAt<std::uint32_t>(bytes, header.bodyOffset);
  const unsigned long long claimed = numberAt<std::uint32_t>(bytes, header.bodyOffset + 4);
  if (claimed != unpacked && claimed == header.points * header.recordSize)
  {
    header.compressedRecordSize = header.recordSize; // with the padding, as some programs write it
    unpacked = claimed;
  }
  failTruncatedIf(packed > available - 8,
    { atByte(header.bodyOffset), packed, " compressed bytes announced, but only ", available - 8,
      " follow, and as fields are stored one after the other these hold no whole point" });
  failIf(claimed != unpacked || unpacked > kMostLzfRatio * packed,
    { atByte(header.bodyOffset + 4), packed, " compressed bytes are said to hold ", claimed,
      " where the header needs ", unpacked },
    "the file is damaged or its header is wrong: copy it again");
  header.compressedSize = static_cast<std::size_t>(packed);
}

void checkSizes(ReadTask& task, PcdHeader& header)
{
  // Division, because the product of two claims may overflow.
  const bool matches = header.width == 0 || header.height == 0
    ? header.points == 0
    : header.points / header.width == header.height && header.points % header.width == 0;
  failIf(!matches,
    { "POINTS is ", header.points, ", but WIDTH is ", header.width, " and HEIGHT is ", header.height },
    "make POINTS the product of WIDTH and HEIGHT");
  if (header.points == 0)
  {
    failNoPoints();
  }
  const std::size_t available = task.bytes.size() - header.bodyOffset;
  const bool isCompressed = header.encoding == PcdEncoding::Compressed;
  const unsigned long long least = std::max<std::size_t>(1,
    header.encoding == PcdEncoding::Ascii ? 2 * header.numbersPerLine
      : isCompressed                      ? header.compressedRecordSize
                                          : header.recordSize);
  const unsigned long long ratio = isCompressed ? kMostLzfRatio : 1;
  const unsigned long long there =
    header.encoding == PcdEncoding::Binary ? available / least : ratio * (available + 1) / least;
  if (header.points > there)
  {
    const std::string what = "the header counts " + std::to_string(header.points) + " points of at least " +
      std::to_string(least) + " bytes, but only " + std::to_string(available) + " bytes follow";
    failTruncatedIf(isCompressed, { what });
    header.points = task.endAt(there, header.points, what);
    header.width = header.points;
    header.height = 1;
  }
  if (isCompressed)
  {
    checkCompressedSize(task.bytes, header, header.points * header.compressedRecordSize);
  }
}

} // namespace

bool PcdField::isPackedColor() const
{
  return count == 1 && sizeOfType(type) == 4 && (name == "rgb" || name == "rgba");
}

Column PcdField::column() const
{
  const bool hasAlpha = name == "rgba";
  return isPackedColor() ? Column{ hasAlpha ? "RGBA" : "RGB", VTK_TYPE_UINT8, hasAlpha ? 4 : 3 }
                         : Column{ name, type, count };
}

PcdHeader parsePcdHeader(ReadTask& task)
{
  PcdHeader header = HeaderParser(task.bytes).parse();
  checkSizes(task, header);
  return header;
}

std::string nameOf(PcdEncoding encoding)
{
  std::string name(kEncodings[static_cast<std::size_t>(encoding)]);
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

} // namespace pointhaptics::io
