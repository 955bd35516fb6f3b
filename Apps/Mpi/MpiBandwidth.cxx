#include "MpiCommands.h"

#include "Job.h"
#include "MpiOutput.h"

#include "Clouds/BandwidthTask.h"
#include "Clouds/Pipeline.h"
#include "Terminal/CommandLine.h"
#include "Terminal/Messages.h"

#include "vtkDistributedKernelBandwidthFilter.h"

#include <CLI/CLI.hpp>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <memory>
#include <string>

namespace pointhaptics::app
{
namespace
{

constexpr const char* kBandwidthCommand = "bandwidth";

struct MpiBandwidthOptions : BandwidthCommandOptions
{
  Traffic traffic;
};

int runBandwidth(MpiBandwidthOptions& options, Job& job)
{
  Piece piece;
  if (!openPiece(job, kBandwidthCommand, options.files, options.traffic, piece))
  {
    return kFailed;
  }
  std::string problem;
  vtkNew<vtkDistributedKernelBandwidthFilter> filter;
  filter->SetInputData(piece.points);
  filter->SetSettings(options.bandwidth.settings);
  if (!updateFilter(filter, "bandwidth", problem))
  {
    problem = options.files.input + ": " + problem;
  }
  if (!job.agree(kBandwidthCommand, problem))
  {
    return kFailed;
  }
  if (job.isRoot())
  {
    showWarnings(kBandwidthCommand);
  }
  const BandwidthFigures figures = job.ranks().reduce(bandwidthFigures(filter->GetOutput()), together);
  if (!job.agree(kBandwidthCommand, whyNone(options, figures)) ||
    !writePieces(job, kBandwidthCommand, options.files, filter->GetOutput()))
  {
    return kFailed;
  }
  if (job.isRoot())
  {
    print(resultOf(options, figures), options.files.json);
  }
  options.traffic.show(job, filter->GetNumberOfBytesSent());
  return kSuccess;
}

} // namespace

void addMpiBandwidth(CLI::App& program, MpiWork& work)
{
  CLI::App* command =
    program.add_subcommand("bandwidth", "Add kernel bandwidth, proxy radius and density to every point");
  auto options = std::make_shared<MpiBandwidthOptions>();
  options->addTo(*command);
  options->traffic.addTo(*command);
  addOutputOptions(*command);
  command->callback(
    [command, options, &work]
    {
      if (takeFiles(*command, options->files))
      {
        work = [options](Job& job) { return runBandwidth(*options, job); };
      }
    });
}

} // namespace pointhaptics::app
