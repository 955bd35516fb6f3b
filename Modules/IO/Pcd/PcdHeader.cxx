#include "IO/Pcd/PcdHeader.h"

#include "Bytes/LittleEndian.h"
#include "Bytes/NumericType.h"
#include "FileProblem.h"
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
    failFormatIf(words.size() == kMostColumns, "use COUNT for fields of many numbers",
      "{}more than {} entries", atLine(lines_.lineNumber()), kMostColumns);
    words.emplace_back(word);
  }
  failFormatIf(!names_.empty() && words.size() != names_.size(), "write one entry per field",
    "{}{} entries for {} fields", atLine(lines_.lineNumber()), words.size(), names_.size());
  return words;
}

void HeaderParser::parseEntry(const std::string& keyword, std::string_view rest)
{
  const std::map<std::string, std::vector<std::string>*> lists = { { "FIELDS", &names_ }, { "SIZE", &sizes_ },
    { "TYPE", &types_ }, { "COUNT", &counts_ } };
  const std::map<std::string, unsigned long long*> counts = { { "WIDTH", &header_.width },
    { "HEIGHT", &header_.height }, { "POINTS", &header_.points } };
  const std::string where = atLine(lines_.lineNumber());
  if (const auto list = lists.find(keyword); list != lists.end())
  {
    *list->second = wordsPerField(rest);
  }
  else if (const auto count = counts.find(keyword); count != counts.end())
  {
    failFormatIf(!parseCount(trimmed(rest), *count->second), "write a whole number, 0 or more",
      "{}{} is not a count", where, inQuotes(trimmed(rest)));
  }
  else if (keyword == "DATA")
  {
    const std::string_view word = takeWord(rest);
    const std::size_t found = indexOf(kPcdEncodings, word);
    failFormatIf(found == std::size(kPcdEncodings), "PCD has ascii, binary and binary_compressed",
      "{}unknown DATA {}", where, inQuotes(word));
    header_.encoding = static_cast<PcdEncoding>(found);
  }
  else if (keyword == "VIEWPOINT")
  {
    for (double& value : header_.viewpoint)
    {
      const std::string_view word = takeWord(rest);
      failFormatIf(!parseNumber(word, value), "write 7 numbers: tx ty tz qw qx qy qz",
        "{}VIEWPOINT has {} where a number was expected", where, inQuotes(word));
    }
  }
  else
  {
    failFormatIf(keyword != "VERSION", kRewriteCure, "{}unknown entry {}", where, inQuotes(keyword));
  }
}

void HeaderParser::buildFields()
{
  for (const std::vector<std::string>* entries : { &sizes_, &types_, &counts_ })
  {
    failFormatIf(names_.empty() || (!entries->empty() && entries->size() != names_.size()),
      "write one entry per field in FIELDS, SIZE, TYPE and COUNT",
      "FIELDS has {} names, another entry has {}", names_.size(), entries->size());
  }
  std::size_t columns = 0;
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
    failFormatIf(!sized || field.type == VTK_VOID || !counted || count < 1 || count > 65536,
      "use TYPE F with SIZE 4 or 8, or I or U with SIZE 1, 2, 4 or 8, and a COUNT from 1 to 65536",
      "field {} has SIZE {}, TYPE {} and COUNT {}", inQuotes(field.name),
      inQuotes(sizes_.empty() ? "4" : sizes_[i]), inQuotes(types_.empty() ? "F" : types_[i]),
      inQuotes(counts_.empty() ? "1" : counts_[i]));
    field.count = static_cast<int>(count);
    field.offset = header_.recordSize;
    field.index = columns;
    columns += field.isPadding() ? 0 : 1;
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
    failFormatIf(!seen_.insert(keyword).second, "keep one of the two", "{}a second entry {}",
      atLine(lines_.lineNumber()), inQuotes(keyword));
    parseEntry(keyword, line);
    complete = keyword == "DATA";
  }
  failTruncatedIf(!complete, "the header has no entry DATA");
  for (const char* needed : { "FIELDS", "WIDTH" })
  {
    failFormatIf(seen_.count(needed) == 0, "write FIELDS, SIZE, TYPE, COUNT, WIDTH, HEIGHT",
      "the header has no entry {}", needed);
  }
  header_.points = seen_.count("POINTS") == 0 ? header_.width * header_.height : header_.points;
  header_.bodyOffset = lines_.position();
  header_.bodyLine = lines_.lineNumber() + 1;
  buildFields();
  return header_;
}

void checkCompressedSize(std::string_view bytes, PcdHeader& header, unsigned long long unpacked)
{
  const std::size_t available = bytes.size() - header.bodyOffset;
  failTruncatedIf(available < 8,
    "the file ends at byte {} before its compressed points, which are stored field after field: a part holds "
    "no whole point",
    bytes.size());
  const unsigned long long packed = numberAt<std::uint32_t>(bytes, header.bodyOffset);
  const unsigned long long claimed = numberAt<std::uint32_t>(bytes, header.bodyOffset + 4);
  if (claimed != unpacked && claimed == header.points * header.recordSize)
  {
    header.compressedRecordSize = header.recordSize; // with the padding, as some programs write it
    unpacked = claimed;
  }
  failTruncatedIf(packed > available - 8,
    "{}{} compressed bytes announced, but only {} follow, and as fields are stored one after the other these "
    "hold no whole point",
    atByte(header.bodyOffset), packed, available - 8);
  failFormatIf(claimed != unpacked || unpacked > kMostLzfRatio * packed,
    "the file is damaged or its header is wrong: copy it again",
    "{}{} compressed bytes are said to hold {} where the header needs {}", atByte(header.bodyOffset + 4),
    packed, claimed, unpacked);
  header.compressedSize = static_cast<std::size_t>(packed);
}

void checkSizes(ReadTask& task, PcdHeader& header)
{
  // Division, because the product of two claims may overflow.
  const bool matches = header.width == 0 || header.height == 0
    ? header.points == 0
    : header.points / header.width == header.height && header.points % header.width == 0;
  failFormatIf(!matches, "make POINTS the product of WIDTH and HEIGHT",
    "POINTS is {}, but WIDTH is {} and HEIGHT is {}", header.points, header.width, header.height);
  header.points == 0 ? failNoPoints() : void();
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
    failTruncatedIf(isCompressed, "{}", what);
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

} // namespace pointhaptics::io
