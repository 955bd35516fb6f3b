#include "FileProblem.h"
#include "IO/WriteTask.h"

#include "Bytes/NumericType.h"
#include "IO/Columns/CloudColumns.h"
#include "IO/Formats/FormatLooks.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <deque>
#include <map>
#include <set>
#include <type_traits>

namespace pointhaptics::io
{

namespace
{

/// @p text as XML can hold it.
std::string xmlText(const std::string& text)
{
  std::string name = utf8Name(text);
  std::replace_if(
    name.begin(), name.end(), [](unsigned char c) { return c < 0x20 && c != '\t' && c != '\n' && c != '\r'; },
    '_');
  for (std::size_t at = name.find("\xef\xbf"); at != std::string::npos; at = name.find("\xef\xbf", at + 1))
  {
    const bool isNone = name.compare(at + 2, 1, "\xbe") >= 0; // U+FFFE and U+FFFF
    isNone ? void(name.replace(at, 3, "_")) : void();
  }
  return name;
}

std::string escaped(const std::string& name)
{
  std::string result;
  for (const char c : name)
  {
    const auto byte = static_cast<unsigned char>(c);
    const bool isPlain = byte >= 0x20 && c != '&' && c != '<' && c != '>' && c != '"';
    result += isPlain ? std::string(1, c) : "&#" + std::to_string(byte) + ";";
  }
  return result;
}

std::string attribute(const std::string& name, const std::string& value)
{
  return " " + name + "=\"" + escaped(value) + "\"";
}

std::string typeName(int type)
{
  std::string name = type == VTK_BIT ? "Bit" : "String";
  withType(type,
    [&](auto zero)
    {
      using T = decltype(zero);
      name = (std::is_floating_point_v<T> ? "Float"
                 : std::is_signed_v<T>    ? "Int"
                                          : "UInt") +
        std::to_string(8 * sizeof(T));
    });
  return name;
}

/// VTK's XML format for poly data: text, and behind it the arrays as they are in memory, each after the
/// number of its bytes.
class VtpFile
{
public:
  VtpFile(vtkPolyData* cloud, std::vector<std::string>& notes);
  void write(WriteTask& task) const;

private:
  void addFields(const char* element, vtkFieldData* data, vtkIdType tuples = -1);
  void addCells(const char* element, vtkCellArray* cells);
  void addArray(vtkAbstractArray* array, const std::string& name, vtkIdType first, vtkIdType tuples,
    bool saysTuples = false);

  std::vector<std::string>& notes_;
  std::string head_;
  std::uint64_t end_ = 0; ///< Of the arrays so far.
  std::vector<std::string_view> blocks_;
  std::vector<vtkSmartPointer<vtkAbstractArray>> copies_;
  std::deque<std::string> texts_;
};

VtpFile::VtpFile(vtkPolyData* cloud, std::vector<std::string>& notes)
  : notes_(notes)
{
  head_ = std::string("<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"") +
    (kIsLittleEndianHost ? "LittleEndian" : "BigEndian") + "\" header_type=\"UInt64\">\n<PolyData>\n";
  addFields("FieldData", cloud->GetFieldData());
  const std::pair<const char*, vtkCellArray*> kCells[] = { { "Verts", cloud->GetVerts() },
    { "Lines", cloud->GetLines() }, { "Strips", cloud->GetStrips() }, { "Polys", cloud->GetPolys() } };
  const vtkIdType points = cloud->GetNumberOfPoints();
  head_ += "<Piece" + attribute("NumberOfPoints", std::to_string(points));
  for (const auto& [name, cells] : kCells)
  {
    head_ += attribute(std::string("NumberOf") + name, std::to_string(cells->GetNumberOfCells()));
  }
  head_ += ">\n";
  addFields("PointData", cloud->GetPointData(), points);
  addFields("CellData", cloud->GetCellData());
  head_ += "<Points>\n";
  addArray(cloud->GetPoints()->GetData(), "Points", 0, points);
  head_ += "</Points>\n";
  for (const auto& [name, cells] : kCells)
  {
    addCells(name, cells);
  }
  head_ += "</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
}

/// @param tuples that each array must have, of longer ones the first; -1: any number.
void VtpFile::addFields(const char* element, vtkFieldData* data, vtkIdType tuples)
{
  std::map<vtkAbstractArray*, std::string> names;
  std::set<std::string> used;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = data->GetAbstractArray(i);
    const std::string given = utf8Name(array->GetName() ? array->GetName() : "");
    const std::string wanted =
      given.empty() ? "unnamed" : xmlText(given); // VTK's reader takes none for no name
    const std::string name = unusedName(used, wanted);
    name == given ? void() : notes_.push_back("array " + inQuotes(given) + " is called " + name);
    failFormatIf(array->GetNumberOfTuples() < tuples, "give every array one value per point",
      "array {} has {} values for {} points", inQuotes(given), array->GetNumberOfTuples(), tuples);
    names[array] = name;
  }
  head_ += std::string("<") + element;
  auto* attributes = vtkDataSetAttributes::SafeDownCast(data);
  for (int type = 0; attributes && type < vtkDataSetAttributes::NUM_ATTRIBUTES; ++type)
  {
    vtkAbstractArray* active = attributes->GetAbstractAttribute(type);
    head_ +=
      active ? attribute(vtkDataSetAttributes::GetAttributeTypeAsString(type), names[active]) : std::string();
  }
  head_ += ">\n";
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = data->GetAbstractArray(i);
    addArray(array, names[array], 0, tuples < 0 ? array->GetNumberOfTuples() : tuples, !attributes);
  }
  head_ += std::string("</") + element + ">\n";
}

/// VTK's files have no 0 before the ends of the cells.
void VtpFile::addCells(const char* element, vtkCellArray* cells)
{
  if (cells->GetNumberOfCells() > 0)
  {
    head_ += std::string("<") + element + ">\n";
    addArray(cells->GetConnectivityArray(), "connectivity", 0, cells->GetNumberOfConnectivityIds());
    addArray(cells->GetOffsetsArray(), "offsets", 1, cells->GetNumberOfCells());
    head_ += std::string("</") + element + ">\n";
  }
}

void VtpFile::addArray(
  vtkAbstractArray* array, const std::string& name, vtkIdType first, vtkIdType tuples, bool saysTuples)
{
  const int type = array->GetDataType();
  const int plain = fixedSizeType(type);
  const auto components = array->GetNumberOfComponents();
  const auto values = static_cast<std::size_t>(tuples * components);
  const bool areNumbers = plain != VTK_VOID || type == VTK_BIT;
  if (auto* texts = vtkStringArray::SafeDownCast(array))
  {
    std::string& joined = texts_.emplace_back();
    for (std::size_t i = 0; i < values; ++i)
    {
      joined += texts->GetValue(static_cast<vtkIdType>(i)) + '\0';
    }
    blocks_.emplace_back(joined);
  }
  else if (areNumbers)
  {
    if (!array->HasStandardMemoryLayout())
    {
      copies_.push_back(vtkSmartPointer<vtkAbstractArray>::Take(vtkDataArray::CreateDataArray(type)));
      copies_.back()->DeepCopy(array);
    }
    vtkAbstractArray* memory = array->HasStandardMemoryLayout() ? array : copies_.back().Get();
    blocks_.emplace_back(static_cast<const char*>(memory->GetVoidPointer(first * components)),
      type == VTK_BIT ? (values + 7) / 8 : values * static_cast<std::size_t>(sizeOfType(type)));
  }
  else
  {
    notes_.push_back("array " + inQuotes(name) + " holds neither numbers nor texts and is left out");
    return;
  }
  head_ += "<" + std::string(areNumbers ? "DataArray" : "Array") + attribute("type", typeName(type)) +
    (type == VTK_ID_TYPE ? attribute("IdType", "1") : "") + attribute("Name", name) +
    attribute("NumberOfComponents", std::to_string(components));
  for (int i = 0; i < components && array->HasAComponentName(); ++i)
  {
    const char* component = array->GetComponentName(i);
    head_ += component ? attribute("ComponentName" + std::to_string(i), xmlText(component)) : "";
  }
  head_ += saysTuples ? attribute("NumberOfTuples", std::to_string(tuples)) : "";
  head_ += attribute("format", "appended") + attribute("offset", std::to_string(end_)) + "/>\n";
  end_ += sizeof(std::uint64_t) + blocks_.back().size();
}

void VtpFile::write(WriteTask& task) const
{
  constexpr std::size_t kAtOnce = std::size_t{ 1 } << 22;
  task.out.write(head_);
  std::uint64_t done = 0;
  for (const std::string_view block : blocks_)
  {
    const std::uint64_t size = block.size();
    task.out.write(reinterpret_cast<const char*>(&size), sizeof(size));
    for (std::size_t at = 0; at < block.size(); at += kAtOnce)
    {
      task.progress(static_cast<double>(done + at) / static_cast<double>(end_));
      task.out.write(block.substr(at, kAtOnce));
    }
    done += size;
  }
  task.out.write("\n</AppendedData>\n</VTKFile>\n");
  task.progress(1.0);
}

} // namespace

/// Writes points, arrays and cells; a cloud without cells gets a vertex for each point.
void writeVtp(WriteTask& task)
{
  vtkNew<vtkPolyData> written;
  written->ShallowCopy(task.cloud);
  vtkPolyData::SafeDownCast(task.cloud) ? void() : written->GetCellData()->Initialize(); // of other cells
  if (written->GetNumberOfCells() == 0)
  {
    setOneVertexPerPoint(written);
  }
  VtpFile(written, task.notes).write(task);
}

} // namespace pointhaptics::io
