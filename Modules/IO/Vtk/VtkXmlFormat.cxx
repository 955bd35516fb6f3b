#include "FileProblem.h"
#include "ReadTask.h"

#include "Core/Base/Host/InterpreterLock.h"
#include "IO/Bytes/FileBytes.h"
#include "IO/Bytes/TextScan.h"
#include "IO/Columns/CloudColumns.h"
#include "IO/Vtk/VtkXmlChecks.h"

#include "vtkAlgorithm.h"
#include "vtkCellType.h"
#include "vtkCommand.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLDataElement.h"
#include "vtkXMLDataParser.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLUnstructuredDataReader.h"
#include "vtkXMLUnstructuredGridReader.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>

namespace fs = std::filesystem;

namespace pointhaptics::io
{

namespace
{

/// Observes one of VTK's readers: keeps the first error's own words, prints nothing, and makes its progress
/// that of the task from one part to another, never falling. A task that is to stop stops it.
class ReaderObserver : public vtkCommand
{
public:
  static ReaderObserver* New() { return new ReaderObserver; }
  void Execute(vtkObject* reader, unsigned long event, void* data) override
  {
    if (event == vtkCommand::ProgressEvent && data)
    {
      const double now = begin + (end - begin) * std::clamp(*static_cast<double*>(data), 0.0, 1.0);
      now > reached ? task->UpdateProgress(now) : void();
      reached = std::max(reached, now);
      runSignalHandlers();
      // An exception must not pass through VTK: reportProgress() throws it behind.
      task->GetAbortExecute() ? vtkAlgorithm::SafeDownCast(reader)->SetAbortExecute(1) : void();
    }
    if (event == vtkCommand::ErrorEvent && first.empty())
    {
      // VTK's text: "ERROR: In file, line n\nvtkClass (0x...): the message\n\n".
      first = data ? static_cast<const char*>(data) : "";
      const std::size_t address = first.find("): ");
      first.erase(0, address == std::string::npos ? 0 : address + 3);
      std::replace(first.begin(), first.end(), '\n', ' ');
      first.erase(first.find_last_not_of(" .") + 1);
      first = first.empty() ? kFailed : first;
    }
  }

  vtkAlgorithm* task = nullptr;
  double begin = 0.0;
  double end = 0.0;
  double reached = 0.0;
  std::string first;
  static constexpr const char* kFailed = "VTK's XML reader failed";
};

/// VTK's own reading of texts writes behind the end of an array where the file has more of them, and its
/// error of one that cannot be read asks for the name as that of an array of numbers, which is not there.
template <class Reader>
class TextSafe : public Reader
{
public:
  static TextSafe* New() { VTK_STANDARD_NEW_BODY(TextSafe); }

protected:
  int ReadArrayValues(vtkXMLDataElement* element, vtkIdType first, vtkAbstractArray* array, vtkIdType start,
    vtkIdType count, vtkXMLReader::FieldType type) override
  {
    vtkStringArray* texts = vtkStringArray::SafeDownCast(array);
    if (!texts)
    {
      return Reader::ReadArrayValues(element, first, array, start, count, type);
    }
    const std::string bytes = count > 0 ? this->BytesOf(element) : std::string();
    vtkIdType there = 0;
    for (std::size_t at = 0, end = bytes.find('\0'); end != std::string::npos;
         at = end + 1, end = bytes.find('\0', at), ++there)
    {
      if (there >= start && there < start + count)
      {
        texts->SetValue(first + there - start, bytes.substr(at, end - at));
      }
    }
    // Cells are read in parts: vertices, lines, strips, polygons.
    const vtkIdType most = type == vtkXMLReader::CELL_DATA ? texts->GetNumberOfValues() : start + count;
    if (count > 0 && (there < start + count || there > most))
    {
      vtkErrorMacro(<< "Cannot read the texts of " << inQuotes(array->GetName() ? array->GetName() : "")
                    << ": " << there << " strings where its tags say " << start + count);
    }
    return 1;
  }

private:
  /// All bytes of an array, unpacked.
  std::string BytesOf(vtkXMLDataElement* element)
  {
    vtkTypeInt64 offset = 0;
    const bool isAppended = element->GetScalarAttribute("offset", offset) != 0;
    const char* format = element->GetAttribute("format");
    const int isAscii = format && std::string_view(format) == "binary" ? 0 : 1;
    std::string bytes;
    std::size_t size = 0;
    do
    {
      bytes.resize(std::max<std::size_t>(4 * bytes.size(), 1024));
      size = isAppended ? this->XMLParser->ReadAppendedData(offset, bytes.data(), 0, bytes.size())
                        : this->XMLParser->ReadInlineData(element, isAscii, bytes.data(), 0, bytes.size());
    } while (size == bytes.size());
    bytes.resize(size);
    return bytes;
  }
};

/// The reader for @p type. @throws FileProblem when it holds no list of points.
vtkSmartPointer<vtkXMLUnstructuredDataReader> makeReader(std::string_view type)
{
  if (type == "PolyData")
  {
    return vtkSmartPointer<TextSafe<vtkXMLPolyDataReader>>::New();
  }
  if (type == "UnstructuredGrid")
  {
    return vtkSmartPointer<TextSafe<vtkXMLUnstructuredGridReader>>::New();
  }
  throw FileProblem(vtkErrorCode::UnrecognizedFileTypeError, "a VTK file of the type " + inQuotes(type),
    "save it as PolyData (.vtp), for example with ParaView's filter Extract Surface");
}

void takeFaces(vtkPointSet* read, MeshFaces& faces)
{
  if (const auto grid = vtkUnstructuredGrid::SafeDownCast(read))
  {
    for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
    {
      faces.others += grid->GetCellType(i) > VTK_POLY_LINE ? 1 : 0;
    }
  }
  if (const auto mesh = vtkPolyData::SafeDownCast(read))
  {
    faces.others += static_cast<std::uint64_t>(mesh->GetStrips()->GetNumberOfCells());
    faces.count = static_cast<std::uint64_t>(mesh->GetPolys()->GetNumberOfCells());
    faces.cells = faces.isWanted() ? mesh->GetPolys() : nullptr;
  }
}

/// The points and arrays of one VTP or VTU file, @p bytes with the content @p root, which lie at @p path; an
/// empty path: nobody can read them again. Progress goes from @p begin to @p end of the parsing.
vtkSmartPointer<vtkPointSet> readVtkXmlFile(const ReadTask& task, const std::string& path,
  std::string_view bytes, const XmlElement& root, double begin, double end)
{
  const vtkSmartPointer<vtkXMLUnstructuredDataReader> reader = makeReader(root.attribute("type"));
  checkVtkXml(bytes, root);
  pointsOfVtkXml(root, bytes.size()) == 0 ? failNoPoints() : void();
  constexpr double kCheckPart = 0.1;
  const double checked = begin + kCheckPart * (end - begin);
  task.progress(checked);
  vtkNew<ReaderObserver> errors;
  errors->task = task.algorithm;
  errors->begin = errors->reached = task.overall(checked);
  errors->end = task.overall(end);
  // The executive adds a message of its own to each failure of its algorithm.
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, errors);
  reader->AddObserver(vtkCommand::ErrorEvent, errors);
  reader->AddObserver(vtkCommand::WarningEvent, errors);
  reader->SetReaderErrorObserver(errors);
  reader->SetParserErrorObserver(errors);
  path.empty() ? reader->ReadFromInputStringOn() : reader->SetFileName(path.c_str());
  path.empty() ? reader->SetInputString(std::string(bytes)) : void();
  reader->AddObserver(vtkCommand::ProgressEvent, errors);
  reader->Update();
  task.progress(end);
  const vtkSmartPointer<vtkPointSet> read = vtkPointSet::SafeDownCast(reader->GetOutputDataObject(0));
  failFormatIf(!errors->first.empty() || reader->GetErrorCode() != vtkErrorCode::NoError,
    "the file is damaged or cut short: copy or write it again", "{}",
    errors->first.empty() ? errors->kFailed : errors->first);
  read->GetNumberOfPoints() == 0 ? failNoPoints() : void();
  return read;
}

/// Bytes that show how many points a file has, if its arrays are appended.
constexpr std::size_t kPieceStart = 65536;

struct PieceFile
{
  std::string name; ///< As the list says it.
  std::string path;
  std::uint64_t points = 0;
};

/// Lists come from anywhere: none may make the reader open other files of this machine.
bool isBelow(const std::string& name)
{
  const fs::path path(name);
  return !name.empty() && name.find('\0') == std::string::npos && !path.is_absolute() &&
    std::none_of(path.begin(), path.end(), [](const fs::path& part) { return part == ".."; });
}

std::vector<PieceFile> piecesOf(const ReadTask& task, const XmlElement& root)
{
  std::vector<PieceFile> pieces;
  std::set<std::string> names;
  forEachElement(root,
    [&](const XmlElement& element)
    {
      const std::string_view level = element.attribute("GhostLevel");
      failFormatIf(element.name == "PPolyData" && !level.empty() && level != "0",
        "write the pieces without ghost levels",
        "pieces with ghost points (GhostLevel is {}), which are there twice", inQuotes(level));
      if (element.name == "Piece")
      {
        const std::string name(element.attribute("Source"));
        const std::string where = atByte(element.begin);
        failFormatIf(!isBelow(name), "put the pieces there, and their names relative to the list into it",
          "{}a piece called {}, which does not lie beside or below the list", where, inQuotes(name));
        const fs::path path = fs::path(task.path).parent_path() / name;
        failFormatIf(!names.insert(path.lexically_normal().string()).second, "name each piece once",
          "{}the piece {} is there twice", where, inQuotes(name));
        pieces.push_back({ name, path.string() });
      }
    });
  return pieces;
}

/// Does @p work with a piece, and says of faults which one it was.
template <typename Work>
void withPiece(const std::vector<PieceFile>& pieces, std::size_t index, Work&& work)
{
  try
  {
    work();
  }
  catch (const FileProblem& problem)
  {
    throw FileProblem(problem.code,
      "piece " + std::to_string(index + 1) + " of " + std::to_string(pieces.size()) + ", " +
        inQuotes(pieces[index].name) + ": " + problem.what());
  }
}

/// How many points a piece has, from as little of it as says so.
std::uint64_t pointsOf(ReadTask& task, const PieceFile& piece)
{
  FileBytes bytes(piece.path);
  bytes.load(0, std::min(bytes.view().size(), kPieceStart));
  std::string_view start = bytes.view().substr(0, kPieceStart);
  const std::size_t appended = start.find("<AppendedData");
  if (appended == std::string_view::npos || start.find('>', appended) == std::string_view::npos)
  {
    bytes.load(0, bytes.view().size());
    start = bytes.view();
  }
  task.bytesElsewhere += bytes.loaded();
  const XmlElement root = vtkXml(start);
  const std::string_view type = root.attribute("type");
  failFormatIf(type != "PolyData", "list VTP files, whose type is PolyData", "a VTK file of the type {}",
    inQuotes(type));
  return pointsOfVtkXml(root, bytes.view().size());
}

/// Name, type and components of the points and of each array.
std::string arraysOf(vtkPointSet* cloud)
{
  std::string arrays = std::string("points ") + cloud->GetPoints()->GetData()->GetDataTypeAsString();
  for (int i = 0; i < cloud->GetPointData()->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = cloud->GetPointData()->GetAbstractArray(i);
    arrays += fmt::format(", {} {} {}", inQuotes(array->GetName() ? array->GetName() : ""),
      array->GetDataTypeAsString(), array->GetNumberOfComponents());
  }
  return arrays;
}

/// Rows of pieces, one after the other.
struct JoinedRows
{
  vtkIdType count = 0; ///< All rows.
  vtkIdType next = 0;
  std::string arrays;
  vtkNew<vtkPoints> points;
  vtkNew<vtkPointData> data;

  void add(vtkPointSet* piece, vtkIdType first, vtkIdType rows)
  {
    if (arrays.empty())
    {
      arrays = arraysOf(piece);
      points->SetDataType(piece->GetPoints()->GetDataType());
      points->SetNumberOfPoints(count);
      data->CopyAllOn();
      data->CopyAllocate(piece->GetPointData(), count);
    }
    checkSameArrays(arrays, arraysOf(piece));
    if (rows > 0)
    {
      points->InsertPoints(next, rows, first, piece->GetPoints());
      data->CopyData(piece->GetPointData(), next, rows, first);
      next += rows;
    }
  }
};

/// Puts @p rows of all pieces into @p joined. Without rows the first piece shows the arrays.
void readRows(ReadTask& task, const std::vector<PieceFile>& pieces, const RowRange& rows, vtkPolyData* cloud,
  JoinedRows& joined)
{
  std::uint64_t begin = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    const PieceFile& piece = pieces[i];
    const std::uint64_t end = begin + piece.points;
    const RowRange own{ std::clamp(rows.first, begin, end), std::clamp(rows.last, begin, end) };
    if (piece.points > 0 && (own.count() > 0 || (rows.count() == 0 && joined.arrays.empty())))
    {
      withPiece(pieces, i,
        [&]
        {
          FileBytes bytes(piece.path);
          bytes.load(0, bytes.view().size());
          task.bytesElsewhere += bytes.loaded();
          const auto size = static_cast<double>(pieces.size());
          const vtkSmartPointer<vtkPointSet> read = readVtkXmlFile(task, piece.path, bytes.view(),
            vtkXml(bytes.view()), static_cast<double>(i) / size, static_cast<double>(i + 1) / size);
          failFormatIf(static_cast<std::uint64_t>(read->GetNumberOfPoints()) != piece.points,
            "the file is damaged, or was written meanwhile: copy or write it again",
            "{} points, not the {} that its start says", read->GetNumberOfPoints(), piece.points);
          joined.arrays.empty() ? cloud->GetFieldData()->ShallowCopy(read->GetFieldData()) : void();
          joined.add(read, static_cast<vtkIdType>(own.first - begin), static_cast<vtkIdType>(own.count()));
        });
    }
    begin = end;
  }
}

/// Points and arrays of the list in task.bytes: those of all pieces in the order of the list, or this rank's.
void readVtkPieces(ReadTask& task, const XmlElement& root, vtkPolyData* cloud)
{
  checkVtkXml(task.bytes, root);
  std::vector<PieceFile> pieces = piecesOf(task, root);
  std::uint64_t all = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    withPiece(pieces, i, [&] { pieces[i].points = pointsOf(task, pieces[i]); });
    all += pieces[i].points;
  }
  all == 0 ? failNoPoints() : void();
  const RowRange rows = task.rowsOf(all);
  JoinedRows joined;
  joined.count = static_cast<vtkIdType>(rows.count());
  readRows(task, pieces, rows, cloud, joined);
  // A rank that does not read two pieces cannot see that they differ.
  for (const std::string& arrays :
    task.shared ? task.shared->gather(joined.arrays) : std::vector<std::string>())
  {
    checkSameArrays(joined.arrays, arrays);
  }
  cloud->SetPoints(joined.points);
  cloud->GetPointData()->ShallowCopy(joined.data);
}

} // namespace

void readVtkXml(ReadTask& task, vtkPolyData* cloud)
{
  task.need(0, task.bytes.size());
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

} // namespace pointhaptics::io
