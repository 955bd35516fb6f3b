#include "Commands/Commands.h"

#include "Clouds/Pipeline.h"
#include "Options/Files.h"
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
#include <utility>
#include <vector>

namespace pointhaptics::app
{
namespace
{

constexpr std::int64_t kMostPoints = 100'000'000;
/// Largest seed: JSON and most scripts hold whole numbers up to here in a double.
constexpr std::int64_t kLargestSeed = std::int64_t(1) << 53;

vtkSmartPointer<vtkDoubleArray> arrayOf(const std::vector<Vec3>& vectors)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(vectors.size()));
  std::memcpy(array->GetPointer(0), vectors.data(), vectors.size() * sizeof(Vec3));
  return array;
}

vtkSmartPointer<vtkPolyData> cloudOf(std::vector<Vec3> points, std::vector<Vec3> normals)
{
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> coordinates;
  coordinates->SetData(arrayOf(points));
  cloud->SetPoints(coordinates);
  cloud->GetPointData()->SetNormals(arrayOf(normals));
  cloud->GetPointData()->GetNormals()->SetName("Normals");
  return cloud;
}

struct GenerateCommand : Command
{
  Shape shape = Shape::Plane;
  std::int64_t count = 0;
  std::int64_t seed = 1;
  double noise = 0.0;
  std::string output;
  WriteOptions writing;
  bool json = false;

  void addTo(CLI::App& command) override
  {
    std::vector<std::pair<std::string, Shape>> shapes;
    for (int i = 0; i < kNumberOfShapes; ++i)
    {
      shapes.emplace_back(shapeName(Shape(i)), Shape(i));
    }
    addChoice(command, "SHAPE", this->shape, shapes, "Shape to sample")->required();
    addInteger(command, "-n,--points", this->count, 1, kMostPoints, "Number of points")->required();
    addInteger(command, "--seed", this->seed, 0, kLargestSeed, "Same seed, same points; default 1");
    addNumber(command, "--noise", this->noise, { 0.0, 1.0 }, "SIGMA",
      "Standard deviation of noise along the normal, metres; default 0");
    addOutput(command, "-o,--output", this->output, writableExtensions(),
      fmt::format("File to write: .{}; - is standard output", fmt::join(writableExtensions(), ", .")))
      ->required();
    this->writing.addTo(command);
    command.add_flag("--json", this->json, "Print what was made as JSON");
  }

  int run(Files& files) override
  {
    std::vector<Vec3> points, normals;
    const Status status =
      generateShape(this->shape, this->count, std::uint64_t(this->seed), this->noise, points, &normals);
    require(status == Status::Ok, message(status));
    const vtkSmartPointer<vtkPolyData> cloud = cloudOf(std::move(points), std::move(normals));
    writeCloud(cloud, this->output, files, this->writing);
    files.commit();
    printResult(this->json,
      { { "output", this->output }, { "shape", shapeName(this->shape) }, { "points", this->count },
        { "seed", this->seed }, { "noise", this->noise } },
      fmt::format("{} of {}: {}", countOfPoints(this->count), shapeName(this->shape), this->output));
    return kSuccess;
  }
};

} // namespace

Command* generateCommand()
{
  return new GenerateCommand;
}

} // namespace pointhaptics::app
