#include "IO/Vtk/SharedVtp.h"

#include "IO/Columns/CloudColumns.h"
#include "IO/Vtk/VtpFile.h"

#include "Core/Base/OutputFile.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string_view>
#include <vector>

namespace pointhaptics::io
{

namespace
{

/// True if a piece has numbers of points alone: it can be written apart from the others.
bool isOfNumbers(vtkPolyData* piece)
{
  const vtkIdType points = piece->GetNumberOfPoints();
  const vtkIdType vertices = piece->GetNumberOfVerts();
  bool areNumbers = piece->GetPoints() && piece->GetNumberOfCells() == vertices &&
    (vertices == 0 || vertices == points) && piece->GetCellData()->GetNumberOfArrays() == 0;
  for (int i = 0; areNumbers && i < piece->GetPointData()->GetNumberOfArrays(); ++i)
  {
    auto* array = vtkDataArray::SafeDownCast(piece->GetPointData()->GetAbstractArray(i));
    areNumbers =
      array && array->GetName() && array->GetDataType() != VTK_BIT && array->GetNumberOfTuples() == points;
  }
  return areNumbers;
}

/// The part of the file that a rank writes: its own points with a vertex each, and on rank 0 all that is not
/// of points. @p places: of the blocks.
Status writeOwn(OutputFile& file, const VtpFile& layout, const std::vector<std::uint64_t>& places,
  std::uint64_t pointsBefore, bool isRoot)
{
  Status status = isRoot ? file.writeAt(0, layout.head) : Status::Ok;
  std::size_t place = 0;
  for (const VtpBlock& block : layout.blocks)
  {
    const std::string_view number(reinterpret_cast<const char*>(&block.bytes), VtpFile::kNumber);
    status = status == Status::Ok && isRoot ? file.writeAt(block.place, number) : status;
    if (status == Status::Ok && (isRoot || block.tuple > 0))
    {
      const std::uint64_t at = block.tuple > 0 ? places[place++] + pointsBefore * block.tuple : block.place;
      status = file.writeAt(at + VtpFile::kNumber, block.content);
    }
  }
  return status == Status::Ok && isRoot ? file.writeAt(layout.tailAt(), layout.tail) : status;
}

/// Opens the file on rank 0 and joins it on the others. @return the places of the blocks of points; none
/// where that is not possible.
std::vector<std::uint64_t> openTogether(
  Ranks& ranks, const VtpFile& layout, const std::string& fileName, OutputFile& file)
{
  std::string path;
  std::vector<std::uint64_t> places;
  if (ranks.rank() == 0 && file.open(fileName) == Status::Ok && file.isReplacing())
  {
    path = file.path();
    for (const VtpBlock& block : layout.blocks)
    {
      block.tuple > 0 ? places.push_back(block.place) : void();
    }
  }
  path = ranks.gather(path).front();
  places = valuesOfBytes<std::uint64_t>(ranks.gather(bytesOfValues(places)).front());
  const bool isOpen = !path.empty() && (ranks.rank() == 0 || file.join(path) == Status::Ok);
  const bool areAll = ranks.reduce(isOpen, [](bool a, bool b) { return a && b; });
  return areAll ? places : std::vector<std::uint64_t>();
}

} // namespace

bool writeVtpTogether(Ranks& ranks, vtkPolyData* piece, const std::string& fileName, std::string& problem)
{
  const auto counts = ranks.gatherValues(piece->GetNumberOfPoints());
  const auto points = std::accumulate(counts.begin(), counts.end(), vtkIdType(0));
  const auto before = std::accumulate(counts.begin(), counts.begin() + ranks.rank(), vtkIdType(0));
  if (!ranks.reduce(isOfNumbers(piece), [](bool a, bool b) { return a && b; }) || points == 0)
  {
    return false;
  }
  const bool have64Bits = points >= std::numeric_limits<std::int32_t>::max() || // as readers and filters make
    (piece->GetNumberOfVerts() > 0 && piece->GetVerts()->IsStorage64Bit());
  vtkNew<vtkPolyData> own;
  own->ShallowCopy(piece);
  own->SetVerts(numberedVertices(
    before, piece->GetNumberOfPoints(), ranks.reduce(have64Bits, [](bool a, bool b) { return a || b; })));
  const VtpFile layout(own, points, true);
  OutputFile file;
  const std::vector<std::uint64_t> places = openTogether(ranks, layout, fileName, file);
  if (places.empty())
  {
    return false;
  }
  Status status = writeOwn(file, layout, places, static_cast<std::uint64_t>(before), ranks.rank() == 0);
  // Rank 0 gives the file its name after the others have closed it.
  status = status == Status::Ok && ranks.rank() != 0 ? file.commit() : status;
  const bool isWhole = ranks.reduce(status == Status::Ok, [](bool a, bool b) { return a && b; });
  status = isWhole && ranks.rank() == 0 ? file.commit() : status;
  if (status != Status::Ok)
  {
    problem = fileName + ": VTP: " + file.reason() + "; " + file.cure();
  }
  return true;
}

} // namespace pointhaptics::io
