#include "FormatReaders.h"

#include "CloudColumns.h"
#include "ErrorCollector.h"
#include "TextScan.h"

#include "vtkDataArray.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLUnstructuredDataReader.h"
#include "vtkXMLUnstructuredGridReader.h"

#include <algorithm>

namespace pointhaptics::io
{

namespace
{

/// The most points one byte of file can stand for: zlib packs at most 1032 bytes into one, and a point
/// takes 12; without compression ASCII's "0 0 0 " is the shortest.
constexpr double kMostUnpackedBytes = 1032.0;

/// The value of attribute @p name in one tag; empty when it is not there.
std::string_view attributeOf(std::string_view tag, std::string_view name)
{
  std::size_t at = tag.find(name);
  while (at != std::string_view::npos)
  {
    const std::size_t equals = at + name.size();
    const bool isWholeName = at > 0 && (isBlank(tag[at - 1]) || tag[at - 1] == '\n');
    if (isWholeName && tag.substr(equals, 1) == "=" && equals + 1 < tag.size())
    {
      const char quote = tag[equals + 1];
      const std::size_t end = tag.find(quote, equals + 2);
      return end == std::string_view::npos ? std::string_view{} : tag.substr(equals + 2, end - equals - 2);
    }
    at = tag.find(name, at + 1);
  }
  return {};
}

/// VTK's reader allocates what the XML claims, so the claims are held against the file's size first.
void checkClaims(std::string_view bytes)
{
  const std::string_view xml = bytes.substr(0, bytes.find("<AppendedData"));
  const bool packed = xml.substr(0, 4096).find("compressor=") != std::string_view::npos;
  const double mostBytes = static_cast<double>(bytes.size()) * (packed ? kMostUnpackedBytes : 1.0);
  double tuples = 1.0;
  std::size_t at = xml.find('<');
  while (at != std::string_view::npos)
  {
    const std::size_t end = std::min(xml.find('>', at), xml.size());
    const std::string_view tag = xml.substr(at, end - at);
    for (const char* name : { "NumberOfPoints", "NumberOfVerts", "NumberOfLines", "NumberOfStrips",
           "NumberOfPolys", "NumberOfCells", "NumberOfComponents" })
    {
      const std::string_view value = attributeOf(tag, name);
      unsigned long long count = 0;
      if (value.empty())
      {
        continue;
      }
      const bool isComponents = std::string_view(name) == "NumberOfComponents";
      if (!parseCount(value, count) || static_cast<double>(count) * (isComponents ? tuples : 1.0) > mostBytes)
      {
        failTruncated("byte " + std::to_string(at) + ": " + name + " is " + inQuotes(value) +
          " in a file of " + std::to_string(bytes.size()) + " bytes");
      }
      if (std::string_view(name) == "NumberOfPoints")
      {
        tuples = std::max(tuples, static_cast<double>(count));
      }
    }
    at = xml.find('<', end);
  }
}

std::string_view typeOf(std::string_view bytes)
{
  const std::size_t at = bytes.find("<VTKFile");
  const std::size_t end = std::min(bytes.find('>', at), bytes.size());
  return attributeOf(bytes.substr(at, end - at), "type");
}

/// The reader for @p type. @throws FileProblem when it holds no list of points.
vtkSmartPointer<vtkXMLUnstructuredDataReader> makeReader(std::string_view type)
{
  if (type == "PolyData")
  {
    return vtkSmartPointer<vtkXMLPolyDataReader>::New();
  }
  if (type == "UnstructuredGrid")
  {
    return vtkSmartPointer<vtkXMLUnstructuredGridReader>::New();
  }
  throw FileProblem(vtkErrorCode::UnrecognizedFileTypeError, "a VTK file of the type " + inQuotes(type),
    "save it as PolyData (.vtp), for example with ParaView's filter Extract Surface");
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

/// Arrays of a wrong length crash later filters: they are a fault of the file.
void checkArrays(vtkPointSet* read)
{
  vtkPointData* data = read->GetPointData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = data->GetAbstractArray(i);
    if (array->GetNumberOfTuples() != read->GetNumberOfPoints())
    {
      failFormat("array " + inQuotes(array->GetName() ? array->GetName() : "") + " has " +
          std::to_string(array->GetNumberOfTuples()) + " values for " +
          std::to_string(read->GetNumberOfPoints()) + " points",
        "write the file again");
    }
  }
}

} // namespace

void readVtkXml(ReadTask& task, vtkPolyData* cloud)
{
  const std::string_view type = typeOf(task.bytes);
  task.format = type == "UnstructuredGrid" ? "VTU (VTK XML UnstructuredGrid)" : "VTP (VTK XML PolyData)";
  const vtkSmartPointer<vtkXMLUnstructuredDataReader> reader = makeReader(type);
  if (task.wasPacked)
  {
    throw FileProblem(vtkErrorCode::UnrecognizedFileTypeError, "VTK's XML reader does not read gzip files",
      "unpack it first: gunzip -k FILE");
  }
  checkIsComplete(task.bytes);
  checkClaims(task.bytes);
  task.progress(0.1);
  vtkNew<ErrorCollector> errors;
  // The executive adds a message of its own to each failure of its algorithm.
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, errors);
  reader->AddObserver(vtkCommand::ErrorEvent, errors);
  reader->AddObserver(vtkCommand::WarningEvent, errors);
  reader->SetReaderErrorObserver(errors);
  reader->SetParserErrorObserver(errors);
  reader->SetFileName(task.path.c_str());
  reader->Update();
  vtkPointSet* read = vtkPointSet::SafeDownCast(reader->GetOutputDataObject(0));
  if (!errors->first().empty() || reader->GetErrorCode() != vtkErrorCode::NoError)
  {
    const std::string what = errors->first().empty() ? "VTK's XML reader failed" : errors->first();
    failFormat(what, "the file is damaged or cut short: copy or write it again");
  }
  if (read->GetNumberOfPoints() == 0)
  {
    failNoPoints();
  }
  checkArrays(read);
  cloud->SetPoints(read->GetPoints());
  cloud->GetPointData()->ShallowCopy(read->GetPointData());
  cloud->GetFieldData()->ShallowCopy(read->GetFieldData());
  if (!cloud->GetPointData()->GetScalars() || !cloud->GetPointData()->GetNormals())
  {
    setActiveAttributes(cloud);
  }
  setOneVertexPerPoint(cloud);
}

} // namespace pointhaptics::io
