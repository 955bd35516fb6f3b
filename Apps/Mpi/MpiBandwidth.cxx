#include "MpiCommands.h"

#include "Job.h"
#include "MpiOutput.h"

#include "Clouds/CloudCommands.h"

#include "vtkDistributedKernelBandwidthFilter.h"

#include <vtkNew.h>
#include <vtkPolyData.h>

#include <memory>

namespace pointhaptics::app
{
namespace
{

void runBandwidth(const BandwidthCommand& options, Traffic& traffic, Job& job, Files& files)
{
  const Piece piece = openPiece(job, options, traffic);
  vtkNew<vtkDistributedKernelBandwidthFilter> filter;
  filter->SetSettings(options.bandwidth.settings);
  job.attempt(
    [&]
    {
      filter->SetInputData(options.prepared(piece.points));
      updateFilter(filter, "bandwidth", options.input);
    });
  if (job.isRoot())
  {
    for (const std::string& note : options.lengthNotes(piece.points))
    {
      warn(note);
    }
    showWarnings();
  }
  const BandwidthFigures figures = job.ranks().reduce(bandwidthFigures(filter->GetOutput()), together);
  CloudResult result;
  job.attempt([&] { result = options.result(figures); });
  writePieces(job, options, filter->GetOutput(), files);
  commitTogether(job, files);
  if (job.isRoot())
  {
    options.print(result);
  }
  traffic.show(job, filter->GetNumberOfBytesSent());
}

} // namespace

void addMpiBandwidth(CLI::App& program, int ranks, MpiWork& work)
{
  auto options = std::make_shared<BandwidthCommand>();
  auto traffic = std::make_shared<Traffic>();
  addRankCommand(program, "bandwidth", "Add kernel bandwidth, proxy radius and density to every point", ranks,
    work, options, traffic,
    [options, traffic](Job& job, Files& files) { runBandwidth(*options, *traffic, job, files); });
}

} // namespace pointhaptics::app
