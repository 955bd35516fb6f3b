#include "MpiCommands.h"

#include "Job.h"
#include "MpiOutput.h"

#include "Clouds/CloudCommands.h"
#include "Terminal/Messages.h"

#include "CsvWriter.h"
#include "vtkDistributedVoxelMeanResampler.h"

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

/// Writes the index by rank 0, which gathers the rows: pieces of IN are in its order.
void writeIndex(Job& job, CsvWriter& file, vtkVoxelMeanResampler* resampler)
{
  std::vector<std::string> messages(std::size_t(job.ranks().size()));
  messages.front() = bytesOfValues(voxelIndexOf(resampler));
  messages = job.ranks().exchange(std::move(messages));
  job.attempt(
    [&]
    {
      for (const std::string& bytes : job.isRoot() ? messages : std::vector<std::string>())
      {
        addVoxelIndex(valuesOfBytes<std::int64_t>(bytes), file);
      }
      std::string problem;
      require(!job.isRoot() || file.commit(problem), problem);
    });
}

void runResample(const ResampleCommand& options, Traffic& traffic, Job& job, Files& files)
{
  CsvWriter index;
  const std::string indexFile = expandedName(options.voxelIndex, options.input);
  job.attempt(
    [&]
    {
      std::string problem;
      require(
        indexFile.empty() || !job.isRoot() || index.open(files.output(indexFile), kVoxelIndexHeader, problem),
        problem);
    });
  const Piece piece = openPiece(job, options, traffic);
  vtkNew<vtkDistributedVoxelMeanResampler> resampler;
  job.attempt([&] { options.update(resampler, piece.points); });
  vtkPolyData* means = resampler->GetOutput();
  for (const std::string& note : options.notes(piece.points, means, job.ranks()))
  {
    warn(job.isRoot() ? note : "");
  }
  const std::int64_t all = job.ranks().reduce(
    std::int64_t(means->GetNumberOfPoints()), [](std::int64_t a, std::int64_t b) { return a + b; });
  const ResampleFigures figures{ piece.pointsOfAll, all, resampler->GetNumberOfClippedPoints(),
    resampler->GetNumberOfInvalidPoints() };
  if (job.isRoot())
  {
    showWarnings();
  }
  CloudResult result;
  job.attempt([&] { result = options.result(figures); });
  options.finish(means);
  writePieces(job, options, means, files);
  if (!indexFile.empty())
  {
    writeIndex(job, index, resampler);
  }
  commitTogether(job, files);
  if (job.isRoot())
  {
    options.print(result);
  }
  traffic.show(job, resampler->GetNumberOfBytesSent());
}

} // namespace

void addMpiResample(CLI::App& program, int ranks, MpiWork& work)
{
  auto options = std::make_shared<ResampleCommand>();
  auto traffic = std::make_shared<Traffic>();
  addRankCommand(program, "resample", "Replace the points in each voxel of a lattice by their mean", ranks,
    work, options, traffic,
    [options, traffic](Job& job, Files& files) { runResample(*options, *traffic, job, files); });
}

} // namespace pointhaptics::app
