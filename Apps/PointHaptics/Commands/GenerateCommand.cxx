#include "Commands/Commands.h"

#include "Clouds/Pipeline.h"
#include "Options/OptionParsing.h"
#include "Terminal/Messages.h"

#include "Shapes/Shapes.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <cstring>
#include <memory>

namespace pointhaptics::app
{
namespace
{

constexpr const char* kGenerateCommand = "generate";
constexpr std::int64_t kMostPoints = 100'000'000;
/// Largest seed: JSON and most scripts hold whole numbers up to here in a double.
constexpr std::int64_t kLargestSeed = std::int64_t(1) << 53;

struct GenerateOptions
{
  int shape = 0;
  std::int64_t count = 0;
  std::int64_t seed = 1;
  double noise = 0.0;
  std::string output;
  WriteOptions writing;
  bool json = false;
};

vtkSmartPointer<vtkDoubleArray> arrayOf(const std::vector<Vec3>& vectors)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(vectors.size()));
  std::memcpy(array->GetPointer(0), vectors.data(), vectors.size() * sizeof(Vec3));
  return array;
}

int runGenerate(const GenerateOptions& options, Files& files)
{
  std::string message;
  const Shape shape = static_cast<Shape>(options.shape);
  vtkNew<vtkPolyData> cloud;
  {
    std::vector<Vec3> points, normals;
    const Status status = generateShape(
      shape, options.count, static_cast<std::uint64_t>(options.seed), options.noise, points, &normals);
    require(status == Status::Ok, pointhaptics::message(status));
    vtkNew<vtkPoints> coordinates;
    coordinates->SetData(arrayOf(points));
    cloud->SetPoints(coordinates);
    const vtkSmartPointer<vtkDoubleArray> normalArray = arrayOf(normals);
    normalArray->SetName("Normals");
    cloud->GetPointData()->SetNormals(normalArray);
  }
  require(writeCloud(cloud, options.output, files, kGenerateCommand, message, options.writing) &&
      files.commit(message),
    message);
  if (options.json)
  {
    const nlohmann::ordered_json result = { { "output", options.output }, { "shape", shapeName(shape) },
      { "points", options.count }, { "seed", options.seed }, { "noise", options.noise } };
    printJson(result);
  }
  else
  {
    printSummary(fmt::format("{} of {}: {}", countOfPoints(options.count), shapeName(shape), options.output));
  }
  return kSuccess;
}

std::vector<std::pair<std::string, int>> shapeChoices()
{
  std::vector<std::pair<std::string, int>> choices;
  for (int shape = 0; shape < kNumberOfShapes; ++shape)
  {
    choices.emplace_back(shapeName(static_cast<Shape>(shape)), shape);
  }
  return choices;
}

} // namespace

void addGenerateCommand(CLI::App& program, int& exitCode)
{
  CLI::App* command = program.add_subcommand("generate", "Make a point cloud of a shape with exact answers");
  auto options = std::make_shared<GenerateOptions>();
  addChoice(*command, "SHAPE", options->shape, shapeChoices(), "Shape to sample")->required();
  addInteger(*command, "-n,--points", options->count, 1, kMostPoints, "Number of points")->required();
  addInteger(*command, "--seed", options->seed, 0, kLargestSeed, "Same seed, same points; default 1");
  addNumber(*command, "--noise", options->noise, { 0.0, 1.0 }, "SIGMA",
    "Standard deviation of noise along the normal, metres; default 0");
  addOutput(*command, "-o,--output", options->output, writableExtensions(),
    fmt::format("File to write: .{}; - is standard output", fmt::join(writableExtensions(), ", .")))
    ->required();
  options->writing.addTo(*command);
  command->add_flag("--json", options->json, "Print what was made as JSON");
  runAs(*command, exitCode, { [options](Files& files) { return runGenerate(*options, files); } });
}

} // namespace pointhaptics::app
