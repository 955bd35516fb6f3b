#include "PiecesFile.h"

#include "Core/Base/OutputFile.h"

#include <fmt/format.h>
#include <vtkAbstractArray.h>
#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <filesystem>

namespace fs = std::filesystem;

namespace pointhaptics::app
{
namespace
{

std::string escaped(const std::string& text)
{
  std::string result;
  for (const char c : text)
  {
    result += c == '&' ? "&amp;"
      : c == '<'       ? "&lt;"
      : c == '>'       ? "&gt;"
      : c == '"'       ? "&quot;"
                       : std::string(1, c);
  }
  return result;
}

/// Type of an array as VTK's XML names it.
std::string typeOf(vtkAbstractArray* array)
{
  auto* numbers = vtkDataArray::SafeDownCast(array);
  if (!numbers)
  {
    return "String";
  }
  const int bits = 8 * numbers->GetDataTypeSize();
  const bool isReal = array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE;
  return fmt::format("{}{}", isReal ? "Float" : numbers->GetDataTypeMin() < 0.0 ? "Int" : "UInt", bits);
}

std::string elementOf(vtkAbstractArray* array, const std::string& name)
{
  return fmt::format("<{} type=\"{}\"{} Name=\"{}\" NumberOfComponents=\"{}\"/>",
    vtkDataArray::SafeDownCast(array) ? "PDataArray" : "PArray", typeOf(array),
    array->GetDataType() == VTK_ID_TYPE ? " IdType=\"1\"" : "", escaped(name),
    array->GetNumberOfComponents());
}

/// Roles of arrays as attributes: ' Scalars="RGB"' and so on.
std::string rolesOf(vtkPointData* data)
{
  std::string roles;
  for (int type = 0; type < vtkDataSetAttributes::NUM_ATTRIBUTES; ++type)
  {
    vtkAbstractArray* array = data->GetAbstractAttribute(type);
    if (array && array->GetName())
    {
      roles += fmt::format(
        " {}=\"{}\"", vtkDataSetAttributes::GetAttributeTypeAsString(type), escaped(array->GetName()));
    }
  }
  return roles;
}

std::string listOf(const std::string& fileName, vtkPolyData* like, const std::vector<int>& ranks)
{
  std::string list =
    fmt::format("<?xml version=\"1.0\"?>\n<VTKFile type=\"PPolyData\" version=\"1.0\" "
                "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n  <PPolyData GhostLevel=\"0\">\n"
                "    <PPointData{}>\n",
      rolesOf(like->GetPointData()));
  for (int i = 0; i < like->GetPointData()->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = like->GetPointData()->GetAbstractArray(i);
    list += "      " + elementOf(array, array->GetName() ? array->GetName() : "") + "\n";
  }
  list += "    </PPointData>\n    <PPoints>\n      " + elementOf(like->GetPoints()->GetData(), "Points") +
    "\n    </PPoints>\n";
  for (const int rank : ranks)
  {
    const std::string piece = fs::path(pieceFileOf(fileName, rank)).filename().string();
    list += "    <Piece Source=\"" + escaped(piece) + "\"/>\n";
  }
  return list + "  </PPolyData>\n</VTKFile>\n";
}

} // namespace

bool isPiecesFile(const std::string& fileName)
{
  return fs::path(fileName).extension() == ".pvtp";
}

std::string pieceFileOf(const std::string& fileName, int rank)
{
  fs::path path(fileName);
  return path.replace_filename(fmt::format("{}_{}.vtp", path.stem().string(), rank)).string();
}

bool writePiecesFile(const std::string& path, const std::string& fileName, vtkPolyData* like,
  const std::vector<int>& ranks, std::string& message)
{
  OutputFile file;
  if (file.open(path) != Status::Ok || file.write(listOf(fileName, like, ranks)) != Status::Ok ||
    file.commit() != Status::Ok)
  {
    message = fmt::format("{}: {}; {}", fileName, file.reason(), file.cure());
    return false;
  }
  return true;
}

} // namespace pointhaptics::app
