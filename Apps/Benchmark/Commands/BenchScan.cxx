#include "Benchmark/Commands/BenchScan.h"

#include "Clouds/Pipeline.h"

#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkNew.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <filesystem>

namespace pointhaptics
{
namespace app
{
namespace
{

/// The triangles of a PLY file, in the order of its points; none where there are none.
std::vector<std::uint32_t> trianglesOf(const std::string& fileName, std::size_t points)
{
  std::vector<std::uint32_t> triangles;
  if (!vtkPLYReader::CanReadFile(fileName.c_str()))
  {
    return triangles;
  }
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(fileName.c_str());
  reader->Update();
  vtkPolyData* mesh = reader->GetOutput();
  auto cell = vtk::TakeSmartPointer(mesh->GetPolys()->NewIterator());
  for (cell->GoToFirstCell(); !cell->IsDoneWithTraversal(); cell->GoToNextCell())
  {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    cell->GetCurrentCell(count, ids);
    if (count == 3)
    {
      triangles.insert(
        triangles.end(), { std::uint32_t(ids[0]), std::uint32_t(ids[1]), std::uint32_t(ids[2]) });
    }
  }
  return std::size_t(mesh->GetNumberOfPoints()) == points ? triangles : std::vector<std::uint32_t>();
}

} // namespace

bool readScan(const std::string& fileName, bench::proxy::Scan& scan, std::string& message)
{
  Cloud cloud;
  if (!readCloud(fileName, cloud, message))
  {
    return false;
  }
  scan.name = std::filesystem::path(fileName).filename().string();
  for (vtkIdType i = 0; i < cloud.points->GetNumberOfPoints(); ++i)
  {
    Vec3 p;
    cloud.points->GetPoint(i, &p.x);
    scan.points.push_back(p);
  }
  scan.triangles = trianglesOf(fileName, scan.points.size());
  return true;
}

} // namespace app
} // namespace pointhaptics
