#include "IO/Vtk/VtpFile.h"

#include "Bytes/NumericType.h"
#include "FileProblem.h"
#include "IO/Columns/CloudColumns.h"
#include "IO/Formats/FormatLooks.h"
#include "IO/WriteTask.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <type_traits>

namespace pointhaptics::io
{

namespace
{

/// The name that XML can hold. An empty one is no name to VTK's reader.
std::string xmlName(vtkAbstractArray* array)
{
  std::string name = utf8Name(array->GetName() ? array->GetName() : "");
  std::replace_if(
    name.begin(), name.end(), [](unsigned char c) { return c < 0x20 && c != '\t' && c != '\n' && c != '\r'; },
    '_');
  for (const char* none : { "\xef\xbf\xbe", "\xef\xbf\xbf" })
  {
    for (std::size_t at = name.find(none); at != std::string::npos; at = name.find(none))
    {
      name.replace(at, 3, "_");
    }
  }
  return name.empty() ? "unnamed" : name;
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
  return " " + name + "=\"" + value + "\"";
}

std::string nameOf(vtkAbstractArray* array)
{
  return escaped(xmlName(array));
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

} // namespace

VtpFile::VtpFile(vtkPolyData* cloud, vtkIdType points, bool isShared)
  : points_(points)
{
  head = std::string("<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"") +
    (kIsLittleEndianHost ? "LittleEndian" : "BigEndian") + "\" header_type=\"UInt64\">\n<PolyData>\n";
  addFields("FieldData", cloud->GetFieldData(), false);
  const std::pair<const char*, vtkCellArray*> kCells[] = { { "Verts", cloud->GetVerts() },
    { "Lines", cloud->GetLines() }, { "Strips", cloud->GetStrips() }, { "Polys", cloud->GetPolys() } };
  head += "<Piece" + attribute("NumberOfPoints", std::to_string(points));
  for (const auto& [name, cells] : kCells)
  {
    head += attribute(std::string("NumberOf") + name,
      std::to_string(isShared && cells == cloud->GetVerts() ? points : cells->GetNumberOfCells()));
  }
  head += ">\n";
  addFields("PointData", cloud->GetPointData(), true);
  addFields("CellData", cloud->GetCellData(), false);
  head += "<Points>\n";
  addArray(cloud->GetPoints()->GetData(), "Points", 0, true);
  head += "</Points>\n";
  for (const auto& [name, cells] : kCells)
  {
    addCells(name, cells, isShared && cells == cloud->GetVerts());
  }
  head += "</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
  for (VtpBlock& block : blocks)
  {
    block.place += head.size();
  }
  end_ += head.size();
}

void VtpFile::addFields(const char* element, vtkFieldData* data, bool areOfPoints)
{
  head += std::string("<") + element;
  auto* attributes = vtkDataSetAttributes::SafeDownCast(data);
  for (int type = 0; attributes && type < vtkDataSetAttributes::NUM_ATTRIBUTES; ++type)
  {
    vtkAbstractArray* active = attributes->GetAbstractAttribute(type);
    head += active ? attribute(vtkDataSetAttributes::GetAttributeTypeAsString(type), nameOf(active)) : "";
  }
  head += ">\n";
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    addArray(data->GetAbstractArray(i), nameOf(data->GetAbstractArray(i)), 0, areOfPoints, !attributes);
  }
  head += std::string("</") + element + ">\n";
}

/// VTK's files have no 0 before the ends of the cells.
void VtpFile::addCells(const char* element, vtkCellArray* cells, bool areOfPoints)
{
  if (cells->GetNumberOfCells() > 0 || areOfPoints)
  {
    head += std::string("<") + element + ">\n";
    addArray(cells->GetConnectivityArray(), "connectivity", 0, areOfPoints);
    addArray(cells->GetOffsetsArray(), "offsets", 1, areOfPoints);
    head += std::string("</") + element + ">\n";
  }
}

void VtpFile::addArray(
  vtkAbstractArray* array, const std::string& name, vtkIdType firstTuple, bool isOfPoints, bool saysTuples)
{
  const int type = array->GetDataType();
  const int plain = fixedSizeType(type);
  const auto components = array->GetNumberOfComponents();
  VtpBlock block;
  block.place = end_;
  if (auto* texts = vtkStringArray::SafeDownCast(array))
  {
    std::string& joined = texts_.emplace_back();
    for (vtkIdType i = 0; i < texts->GetNumberOfValues(); ++i)
    {
      joined += texts->GetValue(i) + '\0';
    }
    block.content = joined;
  }
  else if (plain != VTK_VOID || type == VTK_BIT)
  {
    if (!array->HasStandardMemoryLayout())
    {
      copies_.push_back(vtkSmartPointer<vtkAbstractArray>::Take(vtkDataArray::CreateDataArray(type)));
      copies_.back()->DeepCopy(array);
      array = copies_.back();
    }
    const std::size_t tuple = static_cast<std::size_t>(sizeOfType(type) * components);
    const std::size_t values = static_cast<std::size_t>(array->GetNumberOfValues());
    block.tuple = isOfPoints ? tuple : 0;
    block.content = { static_cast<const char*>(array->GetVoidPointer(firstTuple * components)),
      type == VTK_BIT ? (values + 7) / 8
                      : tuple * static_cast<std::size_t>(array->GetNumberOfTuples() - firstTuple) };
  }
  else
  {
    leftOut.push_back(name);
    return;
  }
  block.bytes = block.tuple > 0 ? block.tuple * static_cast<std::uint64_t>(points_) : block.content.size();
  head += "<" + std::string(plain == VTK_VOID && type != VTK_BIT ? "Array" : "DataArray") +
    attribute("type", typeName(type)) + (type == VTK_ID_TYPE ? attribute("IdType", "1") : "") +
    attribute("Name", name) + attribute("NumberOfComponents", std::to_string(components));
  for (int i = 0; i < components && array->HasAComponentName(); ++i)
  {
    const char* component = array->GetComponentName(i);
    head += component ? attribute("ComponentName" + std::to_string(i), escaped(component)) : "";
  }
  head += saysTuples ? attribute("NumberOfTuples", std::to_string(array->GetNumberOfTuples())) : "";
  head += attribute("format", "appended") + attribute("offset", std::to_string(end_)) + "/>\n";
  end_ += kNumber + block.bytes;
  blocks.push_back(block);
}

/// Writes points, arrays and cells; a cloud without cells gets a vertex for each point.
void writeVtp(WriteTask& task)
{
  vtkNew<vtkPolyData> written;
  if (vtkPolyData* polyData = vtkPolyData::SafeDownCast(task.cloud))
  {
    written->ShallowCopy(polyData);
  }
  else
  {
    written->SetPoints(task.cloud->GetPoints());
    written->GetPointData()->ShallowCopy(task.cloud->GetPointData());
    written->GetFieldData()->ShallowCopy(task.cloud->GetFieldData());
  }
  if (written->GetNumberOfCells() == 0)
  {
    setOneVertexPerPoint(written);
  }
  vtkPointData* data = written->GetPointData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    const std::string given = utf8Name(data->GetArrayName(i) ? data->GetArrayName(i) : "");
    vtkAbstractArray* array = data->GetAbstractArray(i);
    const std::string name = xmlName(array);
    const vtkIdType points = written->GetNumberOfPoints();
    if (array->GetNumberOfTuples() < points)
    {
      failFormat("array " + inQuotes(given) + " has " + std::to_string(array->GetNumberOfTuples()) +
          " values for " + std::to_string(points) + " points",
        "give every array one value per point");
    }
    if (array->GetNumberOfTuples() > points)
    {
      const auto part = vtkSmartPointer<vtkAbstractArray>::Take(array->NewInstance());
      part->DeepCopy(array);
      part->SetNumberOfTuples(points);
      data->AddArray(part);
    }
    name == given ? void() : task.notes.add("array " + inQuotes(given) + " is called " + name);
  }
  const VtpFile file(written, written->GetNumberOfPoints());
  for (const std::string& name : file.leftOut)
  {
    task.notes.add("array " + inQuotes(name) + " holds neither numbers nor texts and is left out");
  }
  task.out.write(file.head);
  for (const VtpBlock& block : file.blocks)
  {
    constexpr std::size_t kAtOnce = std::size_t{ 1 } << 22;
    task.out.write(reinterpret_cast<const char*>(&block.bytes), VtpFile::kNumber);
    for (std::size_t at = 0; at < block.content.size(); at += kAtOnce)
    {
      task.progress(static_cast<double>(block.place + at) / static_cast<double>(file.tailAt()));
      task.out.write(block.content.substr(at, kAtOnce));
    }
  }
  task.out.write(file.tail);
  task.progress(1.0);
}

} // namespace pointhaptics::io
