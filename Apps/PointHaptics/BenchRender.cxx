#include "BenchModelMover.h"
#include "BenchTask.h"

#include "OptionParsing.h"
#include "ViewDisplay.h"
#include "ViewScene.h"

#include "Benchmark/Render/RenderBenchmark.h"

#include <CLI/CLI.hpp>
#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <chrono>
#include <memory>
#include <thread>

namespace pointhaptics
{
namespace app
{
namespace
{

constexpr double kMostPoints = 1e8;

/// The viewer's scene in a window of its own.
class SceneTurntable : public bench::render::Turntable
{
public:
  bool open(const std::string& file, int width, int height, std::string& message)
  {
    ViewOptions options;
    options.files = { file };
    if (!scene_.open(options.files, options, message) || !scene_.build(options, message))
    {
      return false;
    }
    window_->SetOffScreenRendering(1);
    window_->SetMultiSamples(0);
    window_->SetSize(width, height);
    window_->AddRenderer(scene_.renderer());
    scene_.placeCamera();
    this->render();
    return true;
  }

  ~SceneTurntable() override { window_->RemoveRenderer(scene_.renderer()); }

  void setDetail(bool on) override { scene_.detail().setEnabled(on); }

  void turn(double degrees) override
  {
    scene_.renderer()->GetActiveCamera()->Azimuth(degrees);
    this->render();
  }

  int rest() override
  {
    int frames = 0;
    std::this_thread::sleep_for(std::chrono::duration<double>(CloudDetail::kRestSeconds));
    for (; !scene_.detail().showsAll() && frames < 100; ++frames)
    {
      this->render();
    }
    return frames;
  }

  std::int64_t allPoints() const override { return scene_.detail().allPoints(); }
  std::int64_t drawnPoints() const override { return scene_.detail().drawnPoints(); }

private:
  void render()
  {
    scene_.renderer()->ResetCameraClippingRange();
    window_->Render();
    window_->WaitForCompletion();
  }

  ViewScene scene_;
  vtkNew<vtkRenderWindow> window_;
};

struct RenderOptions
{
  std::vector<double> points;
  bool noF3d = false;
};

BenchOutcome runRender(
  const RenderOptions& options, const BenchSettings& shared, const bench::Progress& progress)
{
  BenchOutcome outcome;
  if (!displayIsAvailable(outcome.wrong))
  {
    return outcome;
  }
  bench::render::RenderBenchmarkOptions settings;
  if (shared.quick)
  {
    settings.makeQuick();
  }
  if (!options.points.empty())
  {
    settings.points.assign(options.points.begin(), options.points.end());
  }
  settings.repetitions = shared.repetitions > 0 ? shared.repetitions : settings.repetitions;
  settings.withF3d = !options.noF3d;
  settings.makeTurntable = [](const std::string& file, int width, int height, std::string& message)
  {
    auto table = std::make_unique<SceneTurntable>();
    const bool opened = table->open(file, width, height, message);
    return std::unique_ptr<bench::render::Turntable>(opened ? std::move(table) : nullptr);
  };
  settings.makeModelMover = makeModelMover;
  outcome.report = bench::render::benchmarkRender(settings, progress, outcome.wrong);
  return outcome;
}

BenchRun addRenderOptions(CLI::App& command)
{
  auto options = std::make_shared<RenderOptions>();
  addWholeNumbers(command, "--points", options->points, kMostPoints,
    "Points of the clouds that are drawn; default 543652,5000000");
  command.add_flag("--no-f3d", options->noF3d, "Leave out f3d, which runs beside ours where it is installed");
  return [options](const BenchSettings& shared, const bench::Progress& progress)
  { return runRender(*options, shared, progress); };
}

} // namespace

BenchTask renderTask()
{
  BenchTask task;
  task.name = "render";
  task.description = "Time the viewer's picture: turning with and without level of detail, the first picture";
  task.repetitions = 5;
  task.hasThreads = false;
  task.addOptions = addRenderOptions;
  return task;
}

} // namespace app
} // namespace pointhaptics
