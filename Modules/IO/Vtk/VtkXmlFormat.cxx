#include "ReadTask.h"

#include "IO/Columns/CloudColumns.h"
#include "IO/Text/TextScan.h"
#include "IO/Vtk/VtkPieces.h"
#include "IO/Vtk/VtkXmlChecks.h"

#include "vtkCellType.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLUnstructuredDataReader.h"
#include "vtkXMLUnstructuredGridReader.h"

#include <algorithm>
#include <string>

namespace pointhaptics::io
{

namespace
{

/// Observer of ErrorEvent and WarningEvent: keeps the first error's own words, prints nothing.
class ErrorCollector : public vtkCommand
{
public:
  static ErrorCollector* New() { return new ErrorCollector; }
  void Execute(vtkObject*, unsigned long event, void* callData) override
  {
    if (event != vtkCommand::ErrorEvent || !callData || !first_.empty())
    {
      return;
    }
    // VTK's text: "ERROR: In file, line n\nvtkClass (0x...): the message\n\n".
    const std::string text = static_cast<const char*>(callData);
    const std::size_t address = text.find("): ");
    std::string message = address == std::string::npos ? text : text.substr(address + 3);
    for (char& c : message)
    {
      c = c == '\n' ? ' ' : c;
    }
    first_ = std::string(trimmed(message));
    while (!first_.empty() && first_.back() == '.')
    {
      first_.pop_back();
    }
    if (first_.empty())
    {
      first_ = "VTK reported an error without words";
    }
  }
  const std::string& first() const { return first_; }

private:
  std::string first_;
};

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

void takeFaces(vtkPointSet* read, MeshFaces& faces)
{
  vtkPolyData* mesh = vtkPolyData::SafeDownCast(read);
  if (const auto grid = vtkUnstructuredGrid::SafeDownCast(read))
  {
    for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
    {
      faces.others += grid->GetCellType(i) > VTK_POLY_LINE ? 1 : 0;
    }
  }
  faces.others += mesh && mesh->GetStrips() ? std::uint64_t(mesh->GetStrips()->GetNumberOfCells()) : 0;
  if (mesh && mesh->GetPolys())
  {
    faces.count = static_cast<std::uint64_t>(mesh->GetPolys()->GetNumberOfCells());
    faces.cells = faces.isWanted() ? mesh->GetPolys() : nullptr;
  }
}

} // namespace

void readVtkXml(ReadTask& task, vtkPolyData* cloud)
{
  task.need(0, task.bytes.size());
  if (task.wasPacked)
  {
    throw FileProblem(vtkErrorCode::UnrecognizedFileTypeError, "VTK's XML reader does not read gzip files",
      "unpack it first: gunzip -k FILE");
  }
  const XmlElement root = vtkXml(task.bytes);
  const std::string_view type = root.attribute("type");
  const bool isList = type == "PPolyData";
  task.format = isList           ? "PVTP (VTK XML PolyData in pieces)"
    : type == "UnstructuredGrid" ? "VTU (VTK XML UnstructuredGrid)"
                                 : "VTP (VTK XML PolyData)";
  if (isList)
  {
    readVtkPieces(task, root, cloud);
  }
  else
  {
    task.shared = nullptr; // all of it is there
    const vtkSmartPointer<vtkPointSet> read =
      readVtkXmlFile(task, task.isStream ? "" : task.path, task.bytes, root, 0.0, 1.0);
    cloud->SetPoints(read->GetPoints());
    cloud->GetPointData()->ShallowCopy(read->GetPointData());
    cloud->GetFieldData()->ShallowCopy(read->GetFieldData());
    takeFaces(read, task.faces);
    read->ReleaseData(); // its cells would lie beside those that take their place
  }
  if (!cloud->GetPointData()->GetScalars() || !cloud->GetPointData()->GetNormals())
  {
    setActiveAttributes(cloud);
  }
}

vtkSmartPointer<vtkPointSet> readVtkXmlFile(const ReadTask& task, const std::string& path,
  std::string_view bytes, const XmlElement& root, double begin, double end)
{
  const vtkSmartPointer<vtkXMLUnstructuredDataReader> reader = makeReader(root.attribute("type"));
  checkVtkXml(bytes, root);
  constexpr double kCheckPart = 0.1;
  const double checked = begin + kCheckPart * (end - begin);
  task.progress(checked);
  vtkNew<ErrorCollector> errors;
  // The executive adds a message of its own to each failure of its algorithm.
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, errors);
  reader->AddObserver(vtkCommand::ErrorEvent, errors);
  reader->AddObserver(vtkCommand::WarningEvent, errors);
  reader->SetReaderErrorObserver(errors);
  reader->SetParserErrorObserver(errors);
  if (path.empty())
  {
    reader->ReadFromInputStringOn();
    reader->SetInputString(std::string(bytes));
  }
  else
  {
    reader->SetFileName(path.c_str());
  }
  RelayedProgress progress(reader, task.algorithm, task.overall(checked), task.overall(end));
  reader->Update();
  progress.finish();
  const vtkSmartPointer<vtkPointSet> read = vtkPointSet::SafeDownCast(reader->GetOutputDataObject(0));
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
  return read;
}

} // namespace pointhaptics::io
