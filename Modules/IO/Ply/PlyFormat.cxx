#include "ReadTask.h"

#include "Bytes/NumericType.h"
#include "IO/Bytes/TextScan.h"
#include "IO/Columns/CloudColumns.h"
#include "IO/Columns/TextRecords.h"
#include "IO/Ply/PlyHeader.h"

#include <algorithm>

namespace pointhaptics::io
{

namespace
{

std::string recordNumber(const char* what, unsigned long long index, unsigned long long count)
{
  return std::string(what) + " " + std::to_string(index) + " of " + std::to_string(count);
}

/// Binary records, one after the other.
class BinaryBody
{
public:
  BinaryBody(std::string_view bytes, std::size_t offset, bool swap)
    : bytes_(bytes)
    , offset_(offset)
    , swap_(swap)
  {
  }
  std::size_t offset() const { return offset_; }
  std::size_t remaining() const { return bytes_.size() - offset_; }
  bool swap() const { return swap_; }
  const char* take(std::size_t size, const PlyElement& element, unsigned long long index)
  {
    if (size > remaining())
    {
      failTruncated("the file ends at byte " + std::to_string(bytes_.size()) + " inside " +
        recordNumber(element.name.c_str(), index, element.count));
    }
    const char* data = bytes_.data() + offset_;
    offset_ += size;
    return data;
  }
  void skip(std::size_t size) { offset_ += size; }
  /// Steps over a list property, and gives its items to @p items where there are any to fill.
  void skipList(const PlyProperty& list, const PlyElement& element, unsigned long long index,
    std::vector<vtkIdType>* items = nullptr)
  {
    const std::size_t at = offset_;
    double count = 0.0;
    const char* data = take(static_cast<std::size_t>(sizeOfType(list.countType)), element, index);
    if (list.countType == VTK_UNSIGNED_CHAR)
    {
      count = double(static_cast<unsigned char>(*data)); // of nearly all faces there are
    }
    else
    {
      copyStrided({ data, 0, list.countType }, { reinterpret_cast<char*>(&count), 0, VTK_DOUBLE }, 1, swap_);
    }
    if (count < 0.0)
    {
      failFormat(atByte(at) + "a list of " + std::to_string(static_cast<long long>(count)) + " items in " +
          recordNumber(element.name.c_str(), index, element.count),
        kRewriteCure);
    }
    const std::ptrdiff_t size = sizeOfType(list.type);
    data = take(static_cast<std::size_t>(count) * static_cast<std::size_t>(size), element, index);
    if (items)
    {
      items->resize(static_cast<std::size_t>(count));
      copyStrided({ data, size, list.type },
        { reinterpret_cast<char*>(items->data()), sizeof(vtkIdType), VTK_ID_TYPE },
        static_cast<vtkIdType>(count), swap_);
    }
  }

private:
  std::string_view bytes_;
  std::size_t offset_;
  bool swap_;
};

/// Whether @p list has the vertices of the faces.
bool hasCorners(const PlyElement& element, const PlyProperty& list)
{
  return element.name == "face" && (list.name == "vertex_indices" || list.name == "vertex_index");
}

/// Keeps its faces where @p faces wants some.
void skipBinaryElement(BinaryBody& body, const PlyElement& element, MeshFaces* faces = nullptr)
{
  std::vector<vtkIdType> corners;
  const bool keepsFaces = faces && faces->isWanted();
  for (unsigned long long i = 0; i < element.count && !element.properties.empty(); ++i)
  {
    for (const PlyProperty& property : element.properties)
    {
      if (!property.isList)
      {
        body.take(static_cast<std::size_t>(sizeOfType(property.type)), element, i);
        continue;
      }
      const bool isKept = keepsFaces && hasCorners(element, property);
      body.skipList(property, element, i, isKept ? &corners : nullptr);
      isKept ? faces->keep(corners) : void();
    }
  }
}

/// Notes elements after the points that are cut, such as faces, and bytes after the last element: who made
/// the file for them wants to know. @param record least size of such bytes. @param offset tells where the
/// elements end.
template <typename Skip, typename Offset>
void noteTheRest(ReadTask& task, const PlyHeader& header, std::size_t record, Skip&& skip, Offset&& offset)
{
  if (task.shared || task.isTorn())
  {
    return; // each rank has read its own points only; a file that ends among its points was said to
  }
  try
  {
    for (std::size_t i = header.vertexElement() + 1; i < header.elements.size(); ++i)
    {
      const PlyElement& element = header.elements[i];
      if (element.name == "vertex" && element.count > 0)
      {
        task.notes.push_back(std::to_string(element.count) +
          " points of a second element vertex are left out; write all in one element to read them");
      }
      skip(element);
    }
    task.noteUncounted(offset(), record);
  }
  catch (const FileProblem& problem)
  {
    task.notes.push_back(std::string("all points are there, but ") + problem.what());
  }
}

/// The columns of the vertex element: those of its properties that are no lists.
std::vector<Column> columnsOf(const PlyElement& vertex)
{
  std::vector<Column> columns;
  for (const PlyProperty& property : vertex.properties)
  {
    property.isList ? void() : columns.push_back({ property.name, property.type });
  }
  return columns;
}

/// How many vertices to read.
unsigned long long checkedCount(
  ReadTask& task, const PlyElement& vertex, std::size_t available, std::size_t atLeastPerVertex)
{
  vertex.count == 0 ? failNoPoints() : void();
  const std::size_t there = available / std::max<std::size_t>(atLeastPerVertex, 1);
  return vertex.count > there ? task.endAt(there, vertex.count,
                                  "the header counts " + std::to_string(vertex.count) +
                                    " vertices of at least " + std::to_string(atLeastPerVertex) +
                                    " bytes, but only " + std::to_string(available) + " bytes follow")
                              : vertex.count;
}

/// Records of fixed size.
void fillFixedRecords(
  const BinaryBody& body, const PlyElement& vertex, const CloudColumns& columns, const ReadTask& task)
{
  std::vector<StoredColumn> stored;
  const char* field = task.bytes.data() + body.offset();
  for (std::size_t i = 0; i < vertex.properties.size(); ++i)
  {
    const int type = vertex.properties[i].type;
    stored.push_back(
      { { field, static_cast<std::ptrdiff_t>(vertex.minimumRecordSize()), type }, i, 0, body.swap() });
    field += sizeOfType(type);
  }
  columns.fill(stored, task);
}

void fillRecordWithLists(
  BinaryBody& body, const PlyElement& vertex, const CloudColumns& columns, std::uint64_t row)
{
  std::size_t column = 0;
  for (const PlyProperty& property : vertex.properties)
  {
    if (property.isList)
    {
      body.skipList(property, vertex, row);
      continue;
    }
    const char* data = body.take(static_cast<std::size_t>(sizeOfType(property.type)), vertex, row);
    copyStrided({ data, 0, property.type }, columns.target(column++).fromRow(static_cast<vtkIdType>(row)), 1,
      body.swap());
  }
}

/// Records that contain lists: their length is known only after reading them.
void fillRecordsWithLists(
  BinaryBody& body, const PlyElement& vertex, const CloudColumns& columns, std::uint64_t rows, ReadTask& task)
{
  for (std::uint64_t row = 0; row < rows; ++row)
  {
    try
    {
      fillRecordWithLists(body, vertex, columns, row);
    }
    catch (const FileProblem& problem)
    {
      task.endBehind(row, vertex.count, problem);
      return;
    }
    task.step(row, row, vertex.count);
  }
}

void readBinaryBody(ReadTask& task, const PlyHeader& header, vtkPolyData* cloud)
{
  const std::size_t vertexIndex = header.vertexElement();
  const PlyElement& vertex = header.elements[vertexIndex];
  if (vertexIndex > 0 || vertex.hasList())
  {
    task.takeWhole(); // where a record lies is known only after reading those before it
  }
  const bool littleEndianFile = header.encoding == PlyEncoding::LittleEndian;
  BinaryBody body(task.bytes, header.bodyOffset, littleEndianFile != kIsLittleEndianHost);
  for (std::size_t i = 0; i < vertexIndex; ++i)
  {
    skipBinaryElement(body, header.elements[i]);
  }
  const std::size_t recordSize = vertex.minimumRecordSize();
  const RowRange rows = task.rowsOf(checkedCount(task, vertex, body.remaining(), recordSize));
  CloudColumns columns(columnsOf(vertex), static_cast<vtkIdType>(rows.count()));
  if (vertex.hasList())
  {
    fillRecordsWithLists(body, vertex, columns, rows.count(), task);
  }
  else
  {
    body.skip(static_cast<std::size_t>(rows.first) * recordSize);
    task.need(body.offset(), static_cast<std::size_t>(rows.count()) * recordSize);
    fillFixedRecords(body, vertex, columns, task);
    body.skip(static_cast<std::size_t>(rows.count()) * recordSize);
  }
  noteTheRest(
    task, header, recordSize,
    [&](const PlyElement& element) { skipBinaryElement(body, element, &task.faces); },
    [&] { return body.offset(); });
  columns.moveTo(cloud, task);
}

constexpr TextRecordWords kWords = { "property", "vertex", "vertices",
  "declare the property as float or double in the header" };

/// The numbers of an element, which are stored nowhere.
std::vector<TextField> textFields(const PlyElement& element)
{
  std::vector<TextField> fields;
  for (const PlyProperty& property : element.properties)
  {
    fields.push_back({ property.name, {}, property.isList });
  }
  return fields;
}

void skipAsciiElement(LineReader& lines, const PlyElement& element)
{
  std::string_view line;
  for (unsigned long long i = 0; i < element.count && !element.properties.empty(); ++i)
  {
    if (!lines.nextFilled(line))
    {
      failTruncated("the file ends before " + recordNumber(element.name.c_str(), i, element.count));
    }
  }
}

/// As skipAsciiElement(), and the last line must have all its numbers. Keeps faces where they are wanted.
void skipWholeAsciiElement(LineReader& lines, PlyElement element, MeshFaces& faces)
{
  if (element.count == 0 || element.properties.empty())
  {
    return;
  }
  const unsigned long long count = element.count;
  element.count = faces.isWanted() && element.name == "face" ? 0 : count - 1;
  skipAsciiElement(lines, element);
  TextRecords record(lines, {}, kWords, false);
  const std::vector<TextField> fields = textFields(element);
  std::vector<vtkIdType> corners;
  for (unsigned long long i = element.count; i < count; ++i)
  {
    if (!record.next())
    {
      failTruncated("the file ends before " + recordNumber(element.name.c_str(), i, count));
    }
    try
    {
      for (std::size_t k = 0; k < fields.size(); ++k)
      {
        corners.clear();
        fields[k].isList
          ? record.takeList(fields[k], hasCorners(element, element.properties[k]) ? &corners : nullptr)
          : void(record.takeNumber(fields[k]));
        faces.keep(corners);
      }
    }
    catch (const FileProblem&)
    {
      failTruncated("the file ends at line " + std::to_string(lines.lineNumber()) + " inside " +
        recordNumber(element.name.c_str(), i, count));
    }
  }
}

void readAsciiBody(ReadTask& task, const PlyHeader& header, vtkPolyData* cloud)
{
  const std::size_t vertexIndex = header.vertexElement();
  const PlyElement& vertex = header.elements[vertexIndex];
  task.takeWhole();
  LineReader lines(task.bytes.substr(header.bodyOffset), header.bodyLine);
  for (std::size_t i = 0; i < vertexIndex; ++i)
  {
    skipAsciiElement(lines, header.elements[i]);
  }
  // Each number takes a digit and a separator; the last one may lack the separator.
  const std::size_t available = task.bytes.size() - header.bodyOffset - lines.position() + 1;
  const std::size_t least = 2 * vertex.properties.size();
  const std::uint64_t rows = checkedCount(task, vertex, available, least);
  CloudColumns columns(columnsOf(vertex), static_cast<vtkIdType>(rows));
  std::vector<TextField> fields = textFields(vertex);
  std::size_t column = 0;
  for (TextField& field : fields)
  {
    field.target = field.isList ? ColumnView{} : columns.target(column++);
  }
  const bool isLast = std::all_of(header.elements.begin() + std::ptrdiff_t(vertexIndex) + 1,
    header.elements.end(), [](const PlyElement& later) { return later.count == 0; });
  TextRecords(lines, fields, kWords, isLast).storeAll(task, rows, vertex.count);
  noteTheRest(
    task, header, least,
    [&](const PlyElement& element) { skipWholeAsciiElement(lines, element, task.faces); },
    [&] { return header.bodyOffset + lines.position(); });
  columns.moveTo(cloud, task);
}

} // namespace

void readPly(ReadTask& task, vtkPolyData* cloud)
{
  task.need(0, kStartOfText);
  if (task.bytes.substr(0, kStartOfText).find("end_header") == std::string_view::npos)
  {
    task.takeWhole();
  }
  const PlyHeader header = parsePlyHeader(task.bytes);
  task.format = "PLY (" + spaced(kPlyEncodings[static_cast<std::size_t>(header.encoding)]) + ")";
  task.notes = header.notes;
  std::string ofFaces;
  for (const PlyElement& element : header.elements)
  {
    task.faces.count += element.name == "face" ? element.count : 0;
    task.faces.others += element.name == "tristrips" ? element.count : 0;
    for (const PlyProperty& property : element.properties)
    {
      const bool isOfFaces = element.name == "face" && element.count > 0 && isColorName(property.name);
      ofFaces += isOfFaces ? (ofFaces.empty() ? "" : ", ") + inQuotes(property.name) : "";
      if (property.isList && &element == &header.elements[header.vertexElement()])
      {
        task.notes.push_back("the list " + inQuotes(property.name) +
          ", which each vertex has of its own length, is left out; arrays of points have one length");
      }
    }
  }
  if (!ofFaces.empty())
  {
    task.notes.push_back("colours of faces are left out: " + ofFaces);
  }
  header.encoding == PlyEncoding::Ascii ? readAsciiBody(task, header, cloud)
                                        : readBinaryBody(task, header, cloud);
  header.comments.moveTo(cloud, task.notes);
}

} // namespace pointhaptics::io
