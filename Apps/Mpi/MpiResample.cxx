#include "MpiCommands.h"

#include "Job.h"
#include "MpiOutput.h"

#include "Clouds/Pipeline.h"
#include "Clouds/ResampleTask.h"
#include "Terminal/CommandLine.h"
#include "Terminal/Messages.h"

#include "vtkDistributedVoxelMeanResampler.h"

#include <CLI/CLI.hpp>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <memory>
#include <string>

namespace pointhaptics
{
namespace app
{
namespace
{

constexpr const char* kCommand = "resample";

struct MpiResampleOptions : ResampleOptions
{
  bool traffic = false;
};

int runResample(const MpiResampleOptions& options, Job& job)
{
  Piece piece;
  std::string problem;
  if (!options.voxelIndex.empty())
  {
    problem = "--voxel-index is not written by ranks; leave it out, or use pointhaptics resample";
  }
  if (!job.agree(kCommand, problem) || !openPiece(job, kCommand, options.files, piece))
  {
    return kFailed;
  }
  vtkNew<vtkDistributedVoxelMeanResampler> resampler;
  resampler->SetInputData(piece.points);
  options.configure(resampler);
  if (!updateFilter(resampler, "resampling", problem))
  {
    problem = options.files.input + ": " + problem;
  }
  if (!job.agree(kCommand, problem))
  {
    return kFailed;
  }
  const std::int64_t means = job.ranks().reduce(std::int64_t(resampler->GetOutput()->GetNumberOfPoints()),
    [](std::int64_t a, std::int64_t b) { return a + b; });
  const ResampleFigures figures{ piece.pointsOfAll, means, resampler->GetNumberOfClippedPoints(),
    resampler->GetNumberOfInvalidPoints() };
  if (job.isRoot())
  {
    showWarnings(kCommand);
  }
  if (!job.agree(kCommand, figures.out == 0 ? whyEmpty(options, figures) : std::string()))
  {
    return kFailed;
  }
  options.finish(resampler->GetOutput());
  if (!writePieces(job, kCommand, options.files.output, resampler->GetOutput()))
  {
    return kFailed;
  }
  if (job.isRoot())
  {
    print(options, figures);
  }
  sayTraffic(job, options.traffic, resampler->GetNumberOfBytesSent());
  return kSuccess;
}

} // namespace

void addMpiResample(CLI::App& program, MpiWork& work)
{
  CLI::App* command =
    program.add_subcommand("resample", "Replace the points in each voxel of a lattice by their mean");
  auto options = std::make_shared<MpiResampleOptions>();
  options->addTo(*command);
  addTraffic(*command, options->traffic);
  command->callback([options, &work] { work = [options](Job& job) { return runResample(*options, job); }; });
}

} // namespace app
} // namespace pointhaptics
