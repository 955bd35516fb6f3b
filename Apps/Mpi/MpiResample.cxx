#include "MpiCommands.h"

#include "Job.h"
#include "MpiOutput.h"

#include "Clouds/Pipeline.h"
#include "Clouds/ResampleTask.h"
#include "Terminal/CommandLine.h"
#include "Terminal/Messages.h"

#include "CsvWriter.h"
#include "vtkDistributedVoxelMeanResampler.h"

#include <CLI/CLI.hpp>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace pointhaptics::app
{
namespace
{

constexpr const char* kResampleCommand = "resample";

struct MpiResampleOptions : ResampleOptions
{
  Traffic traffic;
};

/// Writes the index by rank 0, which gathers the rows: pieces of IN are in its order.
bool writeIndex(Job& job, CsvWriter& file, vtkVoxelMeanResampler* resampler)
{
  std::vector<std::string> messages(std::size_t(job.ranks().size()));
  messages.front() = bytesOfValues(voxelIndexOf(resampler));
  std::string problem;
  messages = job.ranks().exchange(std::move(messages));
  if (job.isRoot())
  {
    for (const std::string& bytes : messages)
    {
      addVoxelIndex(valuesOfBytes<std::int64_t>(bytes), file);
    }
    file.commit(problem);
  }
  return job.agree(kResampleCommand, problem);
}

int runResample(MpiResampleOptions& options, Job& job, Files& files)
{
  Piece piece;
  CsvWriter index;
  std::string problem;
  const bool wantsIndex = !options.voxelIndex.empty();
  if (wantsIndex && job.isRoot())
  {
    index.open(files.output(options.voxelIndex), kVoxelIndexHeader, problem);
  }
  if (!job.agree(kResampleCommand, problem) ||
    !openPiece(job, kResampleCommand, options.files, options.traffic, piece))
  {
    return kFailed;
  }
  vtkNew<vtkDistributedVoxelMeanResampler> resampler;
  resampler->SetInputData(piece.points);
  options.configure(resampler);
  resampler->SetComputeVoxelIndex(wantsIndex);
  updateResampler(options, piece.points, resampler, problem);
  if (!job.agree(kResampleCommand, problem))
  {
    return kFailed;
  }
  for (const std::string& note : { noReturnsNote(options, piece.points, resampler->GetOutput(), job.ranks()),
         voxelUnitNote(options, piece.points) })
  {
    if (job.isRoot() && !note.empty())
    {
      warn(kResampleCommand, note);
    }
  }
  const std::int64_t means = job.ranks().reduce(std::int64_t(resampler->GetOutput()->GetNumberOfPoints()),
    [](std::int64_t a, std::int64_t b) { return a + b; });
  const ResampleFigures figures{ piece.pointsOfAll, means, resampler->GetNumberOfClippedPoints(),
    resampler->GetNumberOfInvalidPoints() };
  if (job.isRoot())
  {
    showWarnings(kResampleCommand);
  }
  if (!job.agree(kResampleCommand, figures.out == 0 ? whyEmpty(options, figures) : std::string()))
  {
    return kFailed;
  }
  options.finish(resampler->GetOutput());
  if (!writePieces(job, kResampleCommand, options.files, resampler->GetOutput(), files) ||
    (wantsIndex && !writeIndex(job, index, resampler)) || !commitTogether(job, kResampleCommand, files))
  {
    return kFailed;
  }
  if (job.isRoot())
  {
    print(resultOf(options, figures), options.files.json);
  }
  options.traffic.show(job, resampler->GetNumberOfBytesSent());
  return kSuccess;
}

} // namespace

void addMpiResample(CLI::App& program, int ranks, MpiWork& work)
{
  CLI::App* command =
    program.add_subcommand("resample", "Replace the points in each voxel of a lattice by their mean");
  auto options = std::make_shared<MpiResampleOptions>();
  options->addTo(*command);
  options->traffic.addTo(*command);
  addOutputOptions(*command);
  command->callback(
    [command, options, ranks, &work]
    {
      options->check();
      auto files = std::make_shared<Files>();
      if (takeFiles(*command, options->files, ranks, *files))
      {
        options->voxelIndex = expandedName(options->voxelIndex, options->files.input);
        work = [options, files](Job& job) { return runResample(*options, job, *files); };
      }
    });
}

} // namespace pointhaptics::app
