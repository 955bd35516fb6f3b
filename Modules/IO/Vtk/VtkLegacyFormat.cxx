#include "FileProblem.h"
#include "ReadTask.h"

#include "Bytes/NumericType.h"
#include "IO/Bytes/TextScan.h"
#include "IO/Columns/CloudColumns.h"

#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtksys/SystemTools.hxx"

#include <algorithm>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

namespace pointhaptics::io
{

namespace
{

constexpr const char* kSaveAsVtp = "save the file as .vtp, for example with ParaView";

/// VTK's legacy format. Not left to VTK's reader, which allocates whatever a file claims and trusts the
/// corners of cells. Functions @throw FileProblem with the byte offset, before anything is allocated that the
/// file cannot hold.
class LegacyParser
{
public:
  LegacyParser(ReadTask& task, vtkPolyData* cloud)
    : task_(task)
    , bytes_(task.bytes)
    , cloud_(cloud)
  {
  }
  void parse();

private:
  using Count = unsigned long long;
  using Array = vtkSmartPointer<vtkDataArray>;

  std::string where() const { return atByte(at_); }
  std::string_view line();
  std::string_view word();
  std::string_view peek();
  bool takeIf(const char* keyword) { return equalNoCase(peek(), keyword) && !word().empty(); }
  Count count(const char* what);
  int type();
  std::string name()
  {
    const std::string text(word());
    return text.find("%00") == std::string::npos ? vtksys::SystemTools::DecodeURL(text) : text;
  }
  double number();
  Array values(const std::string& name, int vtkType, Count tuples, Count components, bool isKept = true);

  void parseSection(std::string_view keyword);
  void parsePoints();
  void parseCells(bool areFaces);
  void parseCellTypes();
  void keepFaces(vtkDataArray* offsets, vtkDataArray* corners);
  void parseAttribute(bool areScalars, bool areNormals, Count components);
  void parseColors();
  void parseField();
  void skipMetadata();
  void add(const std::string& name, const Array& array, Count tuples);

  ReadTask& task_;
  std::string_view bytes_;
  std::size_t at_ = 0;
  bool isBinary_ = false;
  vtkPolyData* cloud_;
  bool inPointData_ = false;
  Count tuples_ = 0; ///< Tuples of the section.
};

/// The rest of the line, without white space at both ends.
std::string_view LegacyParser::line()
{
  const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
  const std::string_view text = bytes_.substr(at_, end - at_);
  at_ = std::min(end + 1, bytes_.size());
  return trimmed(text);
}

/// The next word, on whatever line; empty at the end.
std::string_view LegacyParser::word()
{
  const char* const begin = std::find_if_not(bytes_.data() + at_, bytes_.data() + bytes_.size(), &isSpace);
  const char* const end = std::find_if(begin, bytes_.data() + bytes_.size(), &isSpace);
  at_ = static_cast<std::size_t>(end - bytes_.data());
  return { begin, static_cast<std::size_t>(end - begin) };
}

std::string_view LegacyParser::peek()
{
  const std::size_t before = at_;
  const std::string_view next = word();
  at_ = before;
  return next;
}

LegacyParser::Count LegacyParser::count(const char* what)
{
  const std::string_view text = word();
  Count value = 0;
  failFormatIf(!parseCount(text, value),
    "the file is damaged: write it again, or save it as .vtp with ParaView",
    "{}{} stands where {} was expected", where(), inQuotes(text), what);
  return value;
}

/// VTK type of the next word, such as "unsigned_char".
int LegacyParser::type()
{
  constexpr std::pair<std::string_view, int> kTypes[] = { { "float", VTK_FLOAT }, { "double", VTK_DOUBLE },
    { "unsigned_char", VTK_TYPE_UINT8 }, { "char", VTK_TYPE_INT8 }, { "signed_char", VTK_TYPE_INT8 },
    { "unsigned_short", VTK_TYPE_UINT16 }, { "short", VTK_TYPE_INT16 }, { "unsigned_int", VTK_TYPE_UINT32 },
    { "int", VTK_TYPE_INT32 }, { "vtkIdType", VTK_TYPE_INT32 }, { "unsigned_long", VTK_TYPE_UINT64 },
    { "long", VTK_TYPE_INT64 }, { "vtktypeuint64", VTK_TYPE_UINT64 }, { "vtktypeint64", VTK_TYPE_INT64 } };
  const std::string_view text = word();
  const auto* const known = std::find_if(
    std::begin(kTypes), std::end(kTypes), [&](const auto& each) { return equalNoCase(each.first, text); });
  failFormatIf(known == std::end(kTypes), kSaveAsVtp, "{}values of the type {} are not read here", where(),
    inQuotes(text));
  return known->second;
}

double LegacyParser::number()
{
  const std::string_view text = word();
  double value = 0.0;
  if (!parseNumber(text, value))
  {
    failTruncatedIf(text.empty(), "{}the file ends where a number was expected", where());
    failFormat(where() + inQuotes(text) + " is not a number", kRewriteCure);
  }
  return value;
}

/// An array whose values begin here or, in binary files, on the next line; null unless it is kept.
LegacyParser::Array LegacyParser::values(
  const std::string& name, int vtkType, Count tuples, Count components, bool isKept)
{
  failFormatIf(components < 1 || components > kMostColumns, kRewriteCure, "{}an array of {} components",
    where(), components);
  failTruncatedIf(
    tuples > bytes_.size(), "{}{} tuples announced in a file of {} bytes", where(), tuples, bytes_.size());
  const Count count = tuples * components;
  isBinary_ ? void(line()) : void(); // the rest of the line of words; the values start on the next
  const std::ptrdiff_t size = sizeOfType(vtkType);
  const Count available = bytes_.size() - at_;
  failTruncatedIf(count > (isBinary_ ? available / static_cast<Count>(size) : (available + 1) / 2),
    "{}{} values announced, but only {} bytes follow", where(), count, available);
  Array array;
  ColumnView target{ nullptr, size, vtkType };
  if (isKept)
  {
    array = makeArray(vtkType, static_cast<int>(components), static_cast<vtkIdType>(tuples), name);
    target.first = static_cast<char*>(array->GetVoidPointer(0));
  }
  if (isBinary_)
  {
    isKept ? copyStrided({ bytes_.data() + at_, size, vtkType }, target, static_cast<vtkIdType>(count),
               kIsLittleEndianHost)
           : void();
    at_ += static_cast<std::size_t>(count) * static_cast<std::size_t>(size);
  }
  for (Count i = 0; !isBinary_ && i < count; ++i)
  {
    const double value = number();
    if (isKept && !storeNumber(target, static_cast<vtkIdType>(i), value))
    {
      failFormat(
        where() + "a number that its integer type cannot hold", "write the array as float or double");
    }
    task_.step(i, at_, bytes_.size());
  }
  task_.progress(static_cast<double>(at_) / static_cast<double>(bytes_.size()));
  return array;
}

void LegacyParser::parsePoints()
{
  const Count points = count("the number of points");
  const int vtkType = type();
  points == 0 ? failNoPoints() : void();
  failFormatIf(cloud_->GetPoints(), "keep one of the two", "{}a second section POINTS", where());
  const Array array = values("Points", vtkType, points, 3);
  vtkNew<vtkPoints> made;
  made->SetDataType(needsDouble(vtkType) ? VTK_DOUBLE : VTK_FLOAT);
  isFloatingType(vtkType) ? made->SetData(array) : made->GetData()->DeepCopy(array);
  cloud_->SetPoints(made);
}

/// Cells of one dimension or none are no faces.
void LegacyParser::parseCellTypes()
{
  const Array types = values("types", VTK_TYPE_INT32, count("the number of cells"), 1);
  for (vtkIdType i = 0; i < types->GetNumberOfTuples(); ++i)
  {
    task_.faces.others += types->GetComponent(i, 0) > VTK_POLY_LINE ? 1 : 0;
  }
}

/// Since version 5.1 cells are offsets and connectivity, each with its type. Leaves their number in tuples_.
void LegacyParser::parseCells(bool areFaces)
{
  const Count first = count("a number of cells");
  const Count second = count("the size of the cells");
  const bool hasOffsets = equalNoCase(peek(), "OFFSETS");
  const bool isKept = areFaces && task_.faces.isWanted();
  const auto cells = [&](Count size)
  {
    const int vtkType = hasOffsets ? (word(), type()) : VTK_TYPE_INT32;
    return values("cells", vtkType, size, 1, isKept);
  };
  tuples_ = hasOffsets && first > 0 ? first - 1 : first;
  const Array offsets = hasOffsets ? cells(first) : nullptr;
  const Array corners = cells(second);
  isKept ? keepFaces(offsets, corners) : void();
}

/// @p corners: of each face the number of its corners and these, or where there are @p offsets these alone.
void LegacyParser::keepFaces(vtkDataArray* offsets, vtkDataArray* corners)
{
  std::vector<vtkIdType> face;
  const auto keep = [&](vtkIdType begin, double end)
  {
    for (face.clear(); begin < end && begin < corners->GetNumberOfTuples() && begin >= 0; ++begin)
    {
      face.push_back(static_cast<vtkIdType>(corners->GetComponent(begin, 0)));
    }
    task_.faces.keep(face);
    return begin;
  };
  for (vtkIdType at = 0; !offsets && at < corners->GetNumberOfTuples();)
  {
    at = keep(at + 1, static_cast<double>(at) + 1.0 + corners->GetComponent(at, 0));
  }
  for (vtkIdType i = 0; offsets && i + 1 < offsets->GetNumberOfTuples(); ++i)
  {
    keep(static_cast<vtkIdType>(offsets->GetComponent(i, 0)), offsets->GetComponent(i + 1, 0));
  }
}

void LegacyParser::add(const std::string& name, const Array& array, Count tuples)
{
  if (inPointData_ && cloud_->GetPoints() && tuples == static_cast<Count>(cloud_->GetNumberOfPoints()))
  {
    array->SetName(name.c_str());
    cloud_->GetPointData()->AddArray(array);
  }
}

/// Bytes in binary files, 0..1 in texts.
void LegacyParser::parseColors()
{
  const std::string called = name();
  const Count components = count("the number of components");
  const Array colors = values(called, isBinary_ ? VTK_TYPE_UINT8 : VTK_FLOAT, tuples_, components);
  add(called, isBinary_ ? colors : bytesOfColors(colors, 1.0), tuples_);
}

void LegacyParser::parseField()
{
  word(); // the field's name
  const Count arrays = count("the number of arrays");
  for (Count i = 0; i < arrays; ++i)
  {
    takeIf("METADATA") ? skipMetadata() : void();
    const std::string called = name();
    const Count components = count("the number of components");
    const Count tuples = count("the number of tuples");
    const int vtkType = type();
    tuples > 0 ? add(called, values(called, vtkType, tuples, components), tuples) : void();
  }
}

/// Ends with an empty line.
void LegacyParser::skipMetadata()
{
  for (line(); at_ < bytes_.size() && !line().empty();)
  {
  }
}

/// @param components 0: they are said before the type, or for SCALARS perhaps behind it.
void LegacyParser::parseAttribute(bool areScalars, bool areNormals, Count components)
{
  const std::string called = name();
  components = components > 0 || areScalars ? components : count("the number of components");
  const int vtkType = type();
  if (areScalars)
  {
    const bool areSaid = parseCount(peek(), components);
    components = areSaid ? count("components") : 1;
    takeIf("LOOKUP_TABLE") ? void(word()) : void();
  }
  add(areNormals ? "Normals" : called, values(called, vtkType, tuples_, components), tuples_);
}

void LegacyParser::parseSection(std::string_view keyword)
{
  const auto parseData = [&](bool isOfPoints)
  {
    inPointData_ = isOfPoints;
    tuples_ = count("a number of tuples");
  };
  const std::pair<const char*, std::function<void()>> kSections[] = {
    { "POINTS", [&] { parsePoints(); } },
    { "DIMENSIONS", [&] { line(); } },
    { "VERTICES", [&] { parseCells(false); } },
    { "LINES", [&] { parseCells(false); } },
    { "POLYGONS", [&] { parseCells(true), task_.faces.count += tuples_; } },
    { "TRIANGLE_STRIPS", [&] { parseCells(false), task_.faces.others += tuples_; } },
    { "CELLS", [&] { parseCells(false); } },
    { "CELL_TYPES", [&] { parseCellTypes(); } },
    { "POINT_DATA", [&] { parseData(true); } },
    { "CELL_DATA", [&] { parseData(false); } },
    { "COLOR_SCALARS", [&] { parseColors(); } },
    { "LOOKUP_TABLE",
      [&]
      {
        word();
        values("table", isBinary_ ? VTK_TYPE_UINT8 : VTK_FLOAT, count("the size of the table"), 4, false);
      } },
    { "FIELD", [&] { parseField(); } },
    { "METADATA", [&] { skipMetadata(); } },
    { "SCALARS", [&] { parseAttribute(true, false, 0); } },
    { "TEXTURE_COORDINATES", [&] { parseAttribute(false, false, 0); } },
    { "VECTORS", [&] { parseAttribute(false, false, 3); } },
    { "NORMALS", [&] { parseAttribute(false, true, 3); } },
    { "TENSORS", [&] { parseAttribute(false, false, 9); } },
    { "TENSORS6", [&] { parseAttribute(false, false, 6); } },
    { "GLOBAL_IDS", [&] { parseAttribute(false, false, 1); } },
    { "PEDIGREE_IDS", [&] { parseAttribute(false, false, 1); } },
  };
  const auto* const section = std::find_if(std::begin(kSections), std::end(kSections),
    [&](const auto& known) { return equalNoCase(keyword, known.first); });
  failFormatIf(
    section == std::end(kSections), kSaveAsVtp, "{}unknown keyword {}", where(), inQuotes(keyword));
  section->second();
}

void LegacyParser::parse()
{
  line();
  line(); // a title
  const std::string_view format = line();
  isBinary_ = equalNoCase(format, "BINARY");
  failFormatIf(!isBinary_ && !equalNoCase(format, "ASCII"), "write the file again",
    "line 3: {} where ASCII or BINARY was expected", inQuotes(format));
  for (std::string_view keyword = word(); !keyword.empty(); keyword = word())
  {
    if (!equalNoCase(keyword, "DATASET"))
    {
      parseSection(keyword);
      continue;
    }
    const std::string_view kind = word();
    failFormatIf(!equalNoCase(kind, "POLYDATA") && !equalNoCase(kind, "UNSTRUCTURED_GRID") &&
        !equalNoCase(kind, "STRUCTURED_GRID"),
      "save it as PolyData (.vtp), for example with ParaView", "{}{} holds no list of points", where(),
      inQuotes(kind));
  }
  failTruncatedIf(!cloud_->GetPoints(), "the file has no section POINTS");
}

} // namespace

void readVtkLegacy(ReadTask& task, vtkPolyData* cloud)
{
  task.format = "VTK (legacy)";
  LegacyParser(task, cloud).parse();
  setActiveAttributes(cloud);
}

} // namespace pointhaptics::io
