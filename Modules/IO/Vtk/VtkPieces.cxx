#include "IO/Vtk/VtkPieces.h"

#include "IO/Bytes/FileBytes.h"
#include "IO/Vtk/VtkXmlChecks.h"

#include "vtkAbstractArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

namespace fs = std::filesystem;

namespace pointhaptics::io
{

namespace
{

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

void addPiece(const ReadTask& task, const XmlElement& element, std::set<std::string>& names,
  std::vector<PieceFile>& pieces)
{
  const std::string name(element.attribute("Source"));
  if (!isBelow(name))
  {
    failFormat("byte " + std::to_string(element.begin) + ": a piece called " + inQuotes(name) +
        ", which does not lie beside or below the list",
      "put the pieces there, and their names relative to the list into it");
  }
  const fs::path path = fs::path(task.path).parent_path() / name;
  if (!names.insert(path.lexically_normal().string()).second)
  {
    failFormat("byte " + std::to_string(element.begin) + ": the piece " + inQuotes(name) + " is there twice",
      "name each piece once");
  }
  pieces.push_back({ name, path.string() });
}

std::vector<PieceFile> piecesOf(const ReadTask& task, const XmlElement& root)
{
  std::vector<PieceFile> pieces;
  std::set<std::string> names;
  forEachElement(root,
    [&](const XmlElement& element)
    {
      const std::string_view level = element.attribute("GhostLevel");
      if (element.name == "PPolyData" && !level.empty() && level != "0")
      {
        failFormat("pieces with ghost points (GhostLevel is " + inQuotes(level) + "), which are there twice",
          "write the pieces without ghost levels");
      }
      element.name == "Piece" ? addPiece(task, element, names, pieces) : void();
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
  if (type != "PolyData")
  {
    failFormat("a VTK file of the type " + inQuotes(type), "list VTP files, whose type is PolyData");
  }
  return pointsOfVtkXml(root, bytes.view().size());
}

/// Name, type and components of each array and of the points, a line each.
std::string arraysOf(vtkPointSet* cloud)
{
  std::string text = std::string("points ") + cloud->GetPoints()->GetData()->GetDataTypeAsString() + "\n";
  vtkPointData* data = cloud->GetPointData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = data->GetAbstractArray(i);
    text += inQuotes(array->GetName() ? array->GetName() : "") + " " + array->GetDataTypeAsString() + " " +
      std::to_string(array->GetNumberOfComponents()) + "\n";
  }
  return text;
}

[[noreturn]] void failOtherArrays(const std::string& text, const std::string& other)
{
  const auto at = std::mismatch(text.begin(), text.end(), other.begin(), other.end());
  const auto lineOf = [](const std::string& lines, std::size_t position)
  {
    const std::size_t begin = position == 0 ? 0 : lines.rfind('\n', position - 1) + 1;
    const std::string line = lines.substr(begin, lines.find('\n', begin) - begin);
    return line.empty() ? std::string("none") : line;
  };
  failFormat("other arrays than in the pieces before: " +
      lineOf(other, static_cast<std::size_t>(at.second - other.begin())) + " instead of " +
      lineOf(text, static_cast<std::size_t>(at.first - text.begin())),
    "write all pieces with the same arrays, in the same order");
}

/// Rows of pieces, one after the other.
class JoinedRows
{
public:
  JoinedRows(vtkPolyData* cloud, vtkIdType count)
    : cloud_(cloud)
    , count_(count)
  {
  }
  void add(vtkPointSet* piece, vtkIdType first, vtkIdType count)
  {
    if (arrays_.empty())
    {
      arrays_ = arraysOf(piece);
      points_->SetDataType(piece->GetPoints()->GetDataType());
      points_->SetNumberOfPoints(count_);
      data_->CopyAllOn();
      data_->CopyAllocate(piece->GetPointData(), count_);
      cloud_->GetFieldData()->ShallowCopy(piece->GetFieldData());
    }
    else if (arrays_ != arraysOf(piece))
    {
      failOtherArrays(arrays_, arraysOf(piece));
    }
    if (count > 0)
    {
      points_->InsertPoints(next_, count, first, piece->GetPoints());
      data_->CopyData(piece->GetPointData(), next_, count, first);
      next_ += count;
    }
  }
  void finish()
  {
    cloud_->SetPoints(points_);
    cloud_->GetPointData()->ShallowCopy(data_);
  }
  const std::string& arrays() const { return arrays_; }

private:
  vtkPolyData* cloud_;
  vtkIdType count_;
  vtkIdType next_ = 0;
  std::string arrays_;
  vtkNew<vtkPoints> points_;
  vtkNew<vtkPointData> data_;
};

/// Puts @p rows of all pieces into @p joined. Without rows the first piece shows the arrays.
void readRows(ReadTask& task, const std::vector<PieceFile>& pieces, const RowRange& rows, JoinedRows& joined)
{
  std::uint64_t begin = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    const PieceFile& piece = pieces[i];
    const RowRange own{ std::max(rows.first, begin), std::min(rows.last, begin + piece.points) };
    const bool showsArrays = rows.count() == 0 && joined.arrays().empty();
    if (piece.points > 0 && (own.first < own.last || showsArrays))
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
          if (static_cast<std::uint64_t>(read->GetNumberOfPoints()) != piece.points)
          {
            failFormat(std::to_string(read->GetNumberOfPoints()) + " points, not the " +
                std::to_string(piece.points) + " that its start says",
              "the file is damaged, or was written meanwhile: copy or write it again");
          }
          const bool hasRows = own.first < own.last;
          joined.add(read, static_cast<vtkIdType>(hasRows ? own.first - begin : 0),
            static_cast<vtkIdType>(hasRows ? own.count() : 0));
        });
    }
    begin += piece.points;
  }
}

/// A rank that does not read two pieces cannot see that they differ.
void compareArrays(SharedReading& shared, const std::string& own)
{
  const std::vector<std::string> all = shared.gather(own);
  for (const std::string& arrays : all)
  {
    if (arrays != all.front())
    {
      failOtherArrays(all.front(), arrays);
    }
  }
}

} // namespace

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
  if (all == 0)
  {
    failNoPoints();
  }
  const RowRange rows = task.rowsOf(all);
  JoinedRows joined(cloud, static_cast<vtkIdType>(rows.count()));
  readRows(task, pieces, rows, joined);
  if (task.shared)
  {
    compareArrays(*task.shared, joined.arrays());
  }
  joined.finish();
}

} // namespace pointhaptics::io
