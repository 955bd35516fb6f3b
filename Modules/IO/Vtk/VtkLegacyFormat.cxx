#include "ReadTask.h"

#include "Bytes/NumericType.h"
#include "IO/Columns/CloudColumns.h"
#include "IO/Text/TextScan.h"

#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

namespace pointhaptics::io
{

namespace
{

/// Functions @throw FileProblem with the byte offset, before anything is allocated that the file cannot hold.
class VtkLegacyCursor
{
public:
  using Count = unsigned long long;

  explicit VtkLegacyCursor(const ReadTask& task)
    : task_(task)
    , bytes_(task.bytes)
  {
  }
  bool isAtEnd() const { return at_ >= bytes_.size(); }
  bool isBinary() const { return isBinary_; }
  void setBinary(bool isBinary) { isBinary_ = isBinary; }
  std::string where() const { return "byte " + std::to_string(at_) + ": "; }

  /// The rest of the line, without white space at both ends.
  std::string_view line()
  {
    const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
    const std::string_view text = bytes_.substr(at_, end - at_);
    at_ = std::min(end + 1, bytes_.size());
    return trimmed(text);
  }
  /// The next word, on whatever line; empty at the end.
  std::string_view word()
  {
    while (at_ < bytes_.size() && isSpace(bytes_[at_]))
    {
      ++at_;
    }
    const std::size_t begin = at_;
    while (at_ < bytes_.size() && !isSpace(bytes_[at_]))
    {
      ++at_;
    }
    return bytes_.substr(begin, at_ - begin);
  }
  std::string_view peek()
  {
    const std::size_t before = at_;
    const std::string_view next = word();
    at_ = before;
    return next;
  }
  Count count(const char* what)
  {
    const std::string_view text = word();
    Count value = 0;
    if (!parseCount(text, value))
    {
      failFormat(where() + inQuotes(text) + " stands where " + what + " was expected",
        "the file is damaged: write it again, or save it as .vtp with ParaView");
    }
    return value;
  }
  /// VTK type of a name such as "unsigned_char".
  int type(std::string_view name) const
  {
    struct Known
    {
      std::string_view name;
      int type;
    };
    constexpr Known kTypes[] = { { "float", VTK_FLOAT }, { "double", VTK_DOUBLE },
      { "unsigned_char", VTK_TYPE_UINT8 }, { "char", VTK_TYPE_INT8 }, { "signed_char", VTK_TYPE_INT8 },
      { "unsigned_short", VTK_TYPE_UINT16 }, { "short", VTK_TYPE_INT16 }, { "unsigned_int", VTK_TYPE_UINT32 },
      { "int", VTK_TYPE_INT32 }, { "vtkIdType", VTK_TYPE_INT32 }, { "unsigned_long", VTK_TYPE_UINT64 },
      { "long", VTK_TYPE_INT64 }, { "vtktypeuint64", VTK_TYPE_UINT64 }, { "vtktypeint64", VTK_TYPE_INT64 } };
    for (const Known& known : kTypes)
    {
      if (equalNoCase(known.name, name))
      {
        return known.type;
      }
    }
    failFormat(where() + "values of the type " + inQuotes(name) + " are not read here",
      "save the file as .vtp, for example with ParaView");
  }

  /// An array whose values begin here or, in binary files, on the next line.
  vtkSmartPointer<vtkDataArray> values(const std::string& name, int vtkType, Count tuples, Count components)
  {
    if (components < 1 || components > kMostColumns)
    {
      failFormat(where() + "an array of " + std::to_string(components) + " components",
        "write the file again with another program");
    }
    if (tuples > bytes_.size())
    {
      failTruncated(where() + std::to_string(tuples) + " tuples announced in a file of " +
        std::to_string(bytes_.size()) + " bytes");
    }
    const Count count = tuples * components;
    if (isBinary_)
    {
      line(); // the rest of the line of words; the values start on the next
    }
    checkSize(vtkType, count);
    vtkSmartPointer<vtkDataArray> array;
    array.TakeReference(vtkDataArray::CreateDataArray(vtkType));
    array->SetName(name.c_str());
    array->SetNumberOfComponents(static_cast<int>(components));
    array->SetNumberOfTuples(static_cast<vtkIdType>(tuples));
    if (!isBinary_)
    {
      readText(array, count);
      return array;
    }
    const std::ptrdiff_t size = sizeOfType(vtkType);
    copyStrided({ bytes_.data() + at_, size, vtkType },
      { static_cast<char*>(array->GetVoidPointer(0)), size, vtkType }, static_cast<vtkIdType>(count),
      kIsLittleEndianHost);
    at_ += static_cast<std::size_t>(count) * static_cast<std::size_t>(size);
    task_.progress(static_cast<double>(at_) / static_cast<double>(bytes_.size()));
    return array;
  }
  void skipValues(int vtkType, Count count)
  {
    if (isBinary_)
    {
      line();
    }
    checkSize(vtkType, count);
    if (isBinary_)
    {
      at_ += static_cast<std::size_t>(count) * static_cast<std::size_t>(sizeOfType(vtkType));
    }
    for (Count i = 0; i < count && !isBinary_; ++i)
    {
      number();
    }
  }

private:
  void checkSize(int vtkType, Count count)
  {
    const Count available = bytes_.size() - at_;
    const Count least = isBinary_ ? static_cast<Count>(sizeOfType(vtkType)) : 2;
    if (count > (available + 1) / least)
    {
      failTruncated(where() + std::to_string(count) + " values announced, but only " +
        std::to_string(available) + " bytes follow");
    }
    if (isBinary_ && count * least > available)
    {
      failTruncated(where() + "the file ends inside " + std::to_string(count) + " values");
    }
  }
  void readText(vtkDataArray* array, Count count)
  {
    const int type = array->GetDataType();
    const ColumnView target{ static_cast<char*>(array->GetVoidPointer(0)), array->GetDataTypeSize(), type };
    for (Count i = 0; i < count; ++i)
    {
      if (!storeNumber(target, static_cast<vtkIdType>(i), number()))
      {
        failFormat(
          where() + "a number that its integer type cannot hold", "write the array as float or double");
      }
      if (i % static_cast<Count>(kProgressRows) == 0)
      {
        task_.progress(static_cast<double>(at_) / static_cast<double>(bytes_.size()));
      }
    }
  }
  double number()
  {
    const std::string_view text = word();
    double value = 0.0;
    if (text.empty())
    {
      failTruncated(where() + "the file ends where a number was expected");
    }
    if (!parseNumber(text, value))
    {
      failFormat(where() + inQuotes(text) + " is not a number", "write the file again with another program");
    }
    return value;
  }

  const ReadTask& task_;
  std::string_view bytes_;
  std::size_t at_ = 0;
  bool isBinary_ = false;
};

/// Not left to VTK's reader, which allocates whatever a file claims.
class LegacyParser : private VtkLegacyCursor
{
public:
  LegacyParser(ReadTask& task, vtkPolyData* cloud)
    : VtkLegacyCursor(task)
    , faces_(task.faces)
    , cloud_(cloud)
  {
  }
  void parse();

private:
  void parseHeader();
  void parseSection(std::string_view keyword);
  void parsePoints();
  void parseCells(bool areFaces, bool areStrips);
  void parseCellTypes();
  void parseData(bool isOfPoints);
  void keepFaces(vtkDataArray* offsets, vtkDataArray* corners);
  void parseAttribute(std::string_view keyword, Count components);
  void parseColors();
  void parseField();
  void skipMetadata();
  void add(const std::string& name, vtkDataArray* array, Count tuples);

  MeshFaces& faces_;
  vtkPolyData* cloud_;
  bool inPointData_ = false;
  Count tuples_ = 0; ///< of the section
};

void LegacyParser::parseHeader()
{
  line();
  line(); // a title
  const std::string_view kind = line();
  setBinary(equalNoCase(kind, "BINARY"));
  if (!isBinary() && !equalNoCase(kind, "ASCII"))
  {
    failFormat("line 3: " + inQuotes(kind) + " where ASCII or BINARY was expected", "write the file again");
  }
}

/// VTK writes blanks and the like in names as %20.
std::string decodedName(std::string_view text)
{
  const auto digit = [](char c) { return c >= 'a' ? c - 'a' + 10 : c >= 'A' ? c - 'A' + 10 : c - '0'; };
  std::string name;
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    const bool isCode = text[i] == '%' && i + 2 < text.size() &&
      text.substr(i + 1, 2).find_first_not_of("0123456789abcdefABCDEF") == std::string_view::npos;
    name += isCode ? static_cast<char>(16 * digit(text[i + 1]) + digit(text[i + 2])) : text[i];
    i += isCode ? 2 : 0;
  }
  return name;
}

void LegacyParser::parsePoints()
{
  const Count points = count("the number of points");
  const int vtkType = type(word());
  if (points == 0)
  {
    failNoPoints();
  }
  if (cloud_->GetPoints())
  {
    failFormat(where() + "a second section POINTS", "keep one of the two");
  }
  const vtkSmartPointer<vtkDataArray> array = values("Points", vtkType, points, 3);
  vtkNew<vtkPoints> made;
  if (isFloatingType(vtkType))
  {
    made->SetData(array);
  }
  else
  {
    const auto wide = vtkSmartPointer<vtkDataArray>::Take(
      vtkDataArray::CreateDataArray(needsDouble(vtkType) ? VTK_DOUBLE : VTK_FLOAT));
    wide->DeepCopy(array);
    made->SetData(wide);
  }
  cloud_->SetPoints(made);
}

/// Those of one dimension or none are no faces.
void LegacyParser::parseCellTypes()
{
  const vtkSmartPointer<vtkDataArray> types =
    values("types", VTK_TYPE_INT32, count("the number of cells"), 1);
  for (vtkIdType i = 0; i < types->GetNumberOfTuples(); ++i)
  {
    faces_.others += types->GetComponent(i, 0) > VTK_POLY_LINE ? 1 : 0;
  }
}

void LegacyParser::parseData(bool isOfPoints)
{
  inPointData_ = isOfPoints;
  tuples_ = count("a number of tuples");
}

void LegacyParser::parseCells(bool areFaces, bool areStrips)
{
  const Count first = count("a number of cells");
  const Count second = count("the size of the cells");
  // Since version 5.1: offsets and connectivity, each with its type.
  const bool hasOffsets = equalNoCase(peek(), "OFFSETS");
  const bool isKept = areFaces && faces_.isWanted();
  const auto cells = [&](Count size)
  {
    const int vtkType = hasOffsets ? (word(), type(word())) : VTK_TYPE_INT32;
    isKept ? void() : skipValues(vtkType, size);
    return isKept ? values("cells", vtkType, size, 1) : nullptr;
  };
  const Count number = hasOffsets && first > 0 ? first - 1 : first;
  faces_.count += areFaces ? number : 0;
  faces_.others += areStrips ? number : 0;
  const auto offsets = hasOffsets ? cells(first) : nullptr;
  const auto corners = cells(second);
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
    faces_.keep(face);
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

void LegacyParser::add(const std::string& name, vtkDataArray* array, Count tuples)
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
  const std::string name = decodedName(word());
  const Count components = count("the number of components");
  vtkSmartPointer<vtkDataArray> colors =
    values(name, isBinary() ? VTK_TYPE_UINT8 : VTK_FLOAT, tuples_, components);
  if (!isBinary())
  {
    vtkNew<vtkUnsignedCharArray> bytes;
    bytes->SetNumberOfComponents(colors->GetNumberOfComponents());
    bytes->SetNumberOfTuples(colors->GetNumberOfTuples());
    const float* from = static_cast<const float*>(colors->GetVoidPointer(0));
    for (vtkIdType i = 0; i < bytes->GetNumberOfValues(); ++i)
    {
      const float scaled =
        std::isfinite(from[i]) ? std::clamp(std::round(255.0f * from[i]), 0.0f, 255.0f) : 0.0f;
      bytes->SetValue(i, static_cast<unsigned char>(scaled));
    }
    colors = bytes;
  }
  add(name, colors, tuples_);
}

void LegacyParser::parseField()
{
  word(); // the field's name
  const Count arrays = count("the number of arrays");
  for (Count i = 0; i < arrays; ++i)
  {
    if (equalNoCase(peek(), "METADATA"))
    {
      word();
      skipMetadata();
    }
    const std::string name = decodedName(word());
    const Count components = count("the number of components");
    const Count tuples = count("the number of tuples");
    const int vtkType = type(word());
    if (tuples == 0)
    {
      continue;
    }
    add(name, values(name, vtkType, tuples, components), tuples);
  }
}

/// Ends with an empty line.
void LegacyParser::skipMetadata()
{
  line();
  while (!isAtEnd() && !line().empty())
  {
  }
}

/// @param components 0: they are said before the type, or for SCALARS perhaps behind it.
void LegacyParser::parseAttribute(std::string_view keyword, Count components)
{
  const bool areScalars = equalNoCase(keyword, "SCALARS");
  const std::string name = decodedName(word());
  components = components > 0 || areScalars ? components : count("the number of components");
  const int vtkType = type(word());
  if (areScalars && !parseCount(peek(), components))
  {
    components = 1;
  }
  else if (areScalars)
  {
    word();
  }
  if (areScalars && equalNoCase(peek(), "LOOKUP_TABLE"))
  {
    word();
    word();
  }
  add(
    equalNoCase(keyword, "NORMALS") ? "Normals" : name, values(name, vtkType, tuples_, components), tuples_);
}

void LegacyParser::parseSection(std::string_view keyword)
{
  const std::pair<const char*, std::function<void()>> kSections[] = {
    { "POINTS", [&] { parsePoints(); } },
    { "DIMENSIONS", [&] { line(); } },
    { "VERTICES", [&] { parseCells(false, false); } },
    { "LINES", [&] { parseCells(false, false); } },
    { "POLYGONS", [&] { parseCells(true, false); } },
    { "TRIANGLE_STRIPS", [&] { parseCells(false, true); } },
    { "CELLS", [&] { parseCells(false, false); } },
    { "CELL_TYPES", [&] { parseCellTypes(); } },
    { "POINT_DATA", [&] { parseData(true); } },
    { "CELL_DATA", [&] { parseData(false); } },
    { "COLOR_SCALARS", [&] { parseColors(); } },
    { "LOOKUP_TABLE",
      [&]
      {
        word();
        values("table", isBinary() ? VTK_TYPE_UINT8 : VTK_FLOAT, count("the size of the table"), 4);
      } },
    { "FIELD", [&] { parseField(); } },
    { "METADATA", [&] { skipMetadata(); } },
    { "SCALARS", [&] { parseAttribute(keyword, 0); } },
    { "TEXTURE_COORDINATES", [&] { parseAttribute(keyword, 0); } },
    { "VECTORS", [&] { parseAttribute(keyword, 3); } },
    { "NORMALS", [&] { parseAttribute(keyword, 3); } },
    { "TENSORS", [&] { parseAttribute(keyword, 9); } },
    { "TENSORS6", [&] { parseAttribute(keyword, 6); } },
    { "GLOBAL_IDS", [&] { parseAttribute(keyword, 1); } },
    { "PEDIGREE_IDS", [&] { parseAttribute(keyword, 1); } },
  };
  const auto* const section = std::find_if(std::begin(kSections), std::end(kSections),
    [&](const auto& known) { return equalNoCase(keyword, known.first); });
  if (section == std::end(kSections))
  {
    failFormat(
      where() + "unknown keyword " + inQuotes(keyword), "save the file as .vtp, for example with ParaView");
  }
  section->second();
}

void LegacyParser::parse()
{
  parseHeader();
  for (std::string_view keyword = word(); !keyword.empty(); keyword = word())
  {
    if (!equalNoCase(keyword, "DATASET"))
    {
      parseSection(keyword);
      continue;
    }
    const std::string_view kind = word();
    if (!equalNoCase(kind, "POLYDATA") && !equalNoCase(kind, "UNSTRUCTURED_GRID") &&
      !equalNoCase(kind, "STRUCTURED_GRID"))
    {
      failFormat(where() + inQuotes(kind) + " holds no list of points",
        "save it as PolyData (.vtp), for example with ParaView");
    }
  }
  if (!cloud_->GetPoints())
  {
    failTruncated("the file has no section POINTS");
  }
}

} // namespace

void readVtkLegacy(ReadTask& task, vtkPolyData* cloud)
{
  task.format = "VTK (legacy)";
  LegacyParser(task, cloud).parse();
  setActiveAttributes(cloud);
}

} // namespace pointhaptics::io
