/// `pointhaptics bench touch`: its options, and the scans that it reads.
#include "Benchmark/Tasks.h"
#include "Benchmark/Touch/Hard/HardScenes.h"
#include "Benchmark/Touch/Methods/TouchMethod.h"
#include "Benchmark/Touch/Studies.h"
#include "Clouds/Pipeline.h"
#include "Options/OptionParsing.h"
#include "Terminal/Messages.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkNew.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <filesystem>

namespace pointhaptics::bench::touch
{
namespace
{

using namespace app;

constexpr double kMostPoints = 1e8;
constexpr std::int64_t kMostStrokes = 100000;
constexpr std::int64_t kMostLate = 10000;
constexpr const char* kHard = "hard";

struct Study
{
  const char* word;
  void (*run)(StudyContext&);
};

/// In their order; hard runs only where it is named.
constexpr Study kStudies[] = { { "scans", studyScans }, { kHard, studyHard } };

struct Options
{
  std::vector<std::string> scans;
  std::vector<std::string> meshes;
  std::vector<double> points;
  TouchBenchmarkOptions given; ///< Numbers of 0 were not given.
  int strokeSet = 0;
  int instructions = int(InstructionSet::Automatic);
  bool whole = false;
  CLI::Option* meshesOption = nullptr;
};

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

/// A cloud with its file's name and, of PLY files that have some, its triangles. False: @p message says why
/// the file cannot be had.
bool readScan(const std::string& fileName, TouchMesh& scan, std::string& message)
{
  Cloud cloud;
  try
  {
    cloud = readCloud(fileName);
  }
  catch (const Failure& failure)
  {
    message = failure.what();
    return false;
  }
  scan.name = std::filesystem::path(fileName).filename().string();
  scan.isScan = true;
  for (vtkIdType i = 0; i < cloud.points->GetNumberOfPoints(); ++i)
  {
    Vec3 p;
    cloud.points->GetPoint(i, &p.x);
    scan.points.push_back(p);
  }
  scan.triangles = trianglesOf(fileName, scan.points.size());
  return true;
}

void measure(const Options& options, Run& run)
{
  TouchBenchmarkOptions settings = options.given;
  const TouchBenchmarkOptions full;
  TouchBenchmarkOptions few;
  few.makeQuick();
  settings.quick = run.quick;
  settings.sizes = run.chosen(options.points, { double(full.points) }, { double(few.points) });
  settings.points = std::int64_t(settings.sizes.back());
  settings.strokes = run.chosen(settings.strokes, full.strokes, few.strokes);
  settings.meshes = options.meshesOption->count() > 0 ? options.meshes : run.quick ? few.meshes : full.meshes;
  settings.strokeSet = StrokeSet(options.strokeSet);
  settings.instructions = InstructionSet(options.instructions);
  settings.local = !options.whole;
  for (const std::string& file : options.scans)
  {
    std::string message;
    if (!readScan(file, settings.scans.emplace_back(), message))
    {
      run.fault(message);
      return;
    }
  }
  StudyContext context{ settings, run };
  for (const Study& study : kStudies)
  {
    if (run.studies.empty() ? study.word != kHard : run.wants(study.word))
    {
      study.run(context);
    }
  }
}

TaskRun addOptions(CLI::App& command)
{
  auto options = std::make_shared<Options>();
  TouchBenchmarkOptions& given = options->given;
  given.strokes = 0;
  addFiles(command, "--scans", options->scans,
    "Scans to touch: with a mesh (PLY), and for the study hard any cloud");
  std::vector<std::string> meshes = generatedMeshNames();
  for (const std::string& name : smoothMeshNames())
  {
    meshes.push_back(name);
  }
  options->meshesOption = addWords(command, "--meshes", options->meshes, meshes, true,
    "Generated meshes to touch, or none; default all but the smooth ones, sphere and ellipsoid");
  addWholeNumbers(command, "--points", options->points, kMostPoints,
    "Samples of each mesh, for the study of scans also several numbers; default 543652");
  addInteger(command, "--strokes", given.strokes, 1, kMostStrokes, "Strokes on each mesh; default 60");
  addChoice(command, "--stroke-set", options->strokeSet,
    { { "a", int(StrokeSet::A) }, { "b", int(StrokeSet::B) } },
    "Which strokes: two sets that share no place; default a");
  command.add_flag("--raw", given.raw, "Touch the points themselves, no voxels");
  command.add_flag("--whole", options->whole, "One scene of the whole cloud, no finer ones near the hand");
  addInteger(command, "--late", given.lateTicks, 0, kMostLate,
    fmt::format(
      "Milliseconds from the look at where the hand is until the finer scene there is felt; default {}",
      given.lateTicks));
  addInstructions(command, options->instructions);
  addWords(command, "--methods", given.methods, contestantNames(), false, "Methods to judge; default all");
  addWords(command, "--scenes", given.families, hard::hardFamilies(), false,
    "Families of scenes of the study hard; default all");
  return [options](Run& run) { measure(*options, run); };
}

} // namespace
} // namespace pointhaptics::bench::touch

namespace pointhaptics::bench
{

Task touchTask()
{
  return { "touch", "Judge the touch of edges, scans and hard scenes by a god object on their meshes", 2, 1,
    false, { "scans", "hard" }, {}, touch::addOptions };
}

} // namespace pointhaptics::bench
