#include "BenchTask.h"

#include "OptionParsing.h"
#include "Pipeline.h"

#include "Benchmark/Proxy/ProxyBenchmark.h"

#include <CLI/CLI.hpp>
#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkNew.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <filesystem>
#include <memory>

namespace pointhaptics
{
namespace app
{
namespace
{

constexpr double kMostPoints = 1e8;
constexpr double kMostStrokes = 100000;

struct ProxyOptions
{
  std::vector<double> points;
  std::vector<double> sizes;
  std::vector<std::string> shapes;
  std::vector<std::string> studies;
  std::vector<std::string> scans;
  std::int64_t strokes = 0; ///< 0: the default.
};

/// Shapes with a course; the idol has none.
std::vector<std::string> shapeWords()
{
  std::vector<std::string> words;
  for (const Shape shape : bench::proxy::ProxyBenchmarkOptions().shapes)
  {
    words.emplace_back(shapeName(shape));
  }
  return words;
}

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

/// False: @p message says why the file cannot be had.
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

BenchOutcome runProxy(
  const ProxyOptions& options, const BenchSettings& shared, const bench::Progress& progress)
{
  bench::proxy::ProxyBenchmarkOptions settings;
  if (shared.quick)
  {
    settings.makeQuick();
  }
  BenchOutcome outcome;
  for (const std::string& file : options.scans)
  {
    settings.scans.emplace_back();
    if (!readScan(file, settings.scans.back(), outcome.wrong))
    {
      return outcome;
    }
  }
  if (!options.points.empty())
  {
    settings.points.assign(options.points.begin(), options.points.end());
  }
  if (!options.sizes.empty())
  {
    settings.sizes.assign(options.sizes.begin(), options.sizes.end());
  }
  if (!options.shapes.empty())
  {
    settings.shapes.clear();
    for (const std::string& word : options.shapes)
    {
      settings.shapes.emplace_back();
      static_cast<void>(shapeFromName(word, settings.shapes.back()));
    }
  }
  settings.studies = options.studies;
  settings.strokes = options.strokes > 0 ? int(options.strokes) : settings.strokes;
  settings.repetitions = shared.repetitions > 0 ? shared.repetitions : settings.repetitions;
  outcome.report = bench::proxy::benchmarkProxy(settings, progress, outcome.wrong);
  return outcome;
}

BenchRun addProxyOptions(CLI::App& command)
{
  auto options = std::make_shared<ProxyOptions>();
  addWholeNumbers(
    command, "--points", options->points, kMostPoints, "Numbers of points; default 47516,543652");
  addWholeNumbers(command, "--sizes", options->sizes, kMostPoints,
    "Numbers of points for the study of size; default 1e4,1e5,1e6,1e7");
  addWords(command, "--shapes", options->shapes, shapeWords(), false, "Shapes to feel; default all");
  addWords(command, "--studies", options->studies, bench::proxy::studyWords(), false,
    "What to measure; default all, scans and meshes where there are some");
  command
    .add_option_function<std::string>(
      "--scans", [options](const std::string& text) { options->scans = CLI::detail::split(text, ','); },
      "Clouds of your own to feel, with or without a mesh")
    ->type_name("FILE,...");
  addInteger(command, "--strokes", options->strokes, 1, kMostStrokes, "Strokes over each scan; default 60");
  return [options](const BenchSettings& shared, const bench::Progress& progress)
  { return runProxy(*options, shared, progress); };
}

} // namespace

BenchTask proxyTask()
{
  BenchTask task;
  task.name = "proxy";
  task.description = "Compare the felt force with the exact one, and time the updates";
  task.repetitions = bench::proxy::ProxyBenchmarkOptions().repetitions;
  task.hasThreads = false;
  task.addOptions = addProxyOptions;
  return task;
}

} // namespace app
} // namespace pointhaptics
