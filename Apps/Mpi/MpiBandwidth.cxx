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

int runBandwidth(MpiBandwidthOptions& options, Job& job, Files& files)
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
    !writePieces(job, kBandwidthCommand, options.files, filter->GetOutput(), files) ||
    !commitTogether(job, kBandwidthCommand, files))
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

void addMpiBandwidth(CLI::App& program, int ranks, MpiWork& work)
{
  CLI::App* command =
    program.add_subcommand("bandwidth", "Add kernel bandwidth, proxy radius and density to every point");
  auto options = std::make_shared<MpiBandwidthOptions>();
  options->addTo(*command);
  options->traffic.addTo(*command);
  addOutputOptions(*command);
  command->callback(
    [command, options, ranks, &work]
    {
      auto files = std::make_shared<Files>();
      if (takeFiles(*command, options->files, ranks, *files))
      {
        work = [options, files](Job& job) { return runBandwidth(*options, job, *files); };
      }
    });
}

} // namespace pointhaptics::app
