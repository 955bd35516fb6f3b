/// The commands, and the frame of both: options, this rank's points, the output of all ranks.
#include "MpiCommands.h"

#include "Job.h"
#include "PieceOfCloud.h"
#include "PiecesFile.h"

#include "Clouds/CloudCommands.h"
#include "Options/OptionParsing.h"
#include "Terminal/Messages.h"

#include "CsvWriter.h"
#include "vtkDistributedKernelBandwidthFilter.h"
#include "vtkDistributedVoxelMeanResampler.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace pointhaptics::app
{
namespace
{

/// Writes a file for each rank with points, and the list of them.
void writePerRank(Job& job, const std::string& fileName, vtkPolyData* piece, Files& files)
{
  const int rank = job.ranks().rank();
  const bool hasPoints = piece->GetNumberOfPoints() > 0;
  std::vector<int> withPoints = job.ranks().gatherValues(hasPoints ? rank : -1);
  withPoints.erase(std::remove(withPoints.begin(), withPoints.end(), -1), withPoints.end());
  job.attempt(
    [&]
    {
      if (hasPoints)
      {
        writeCloud(piece, pieceFileOf(fileName, rank), files);
      }
      std::string problem;
      require(!job.isRoot() || writePiecesFile(files.output(fileName), fileName, piece, withPoints, problem),
        problem);
    });
}

/// Writes the pieces of all ranks: as one file by rank 0, or for a .pvtp a file of each rank beside it and
/// the list of these.
void writePieces(Job& job, const CloudCommand& options, vtkPolyData* piece, Files& files)
{
  const std::string& fileName = options.output;
  if (isPiecesFile(fileName))
  {
    writePerRank(job, fileName, piece, files);
    return;
  }
  const vtkSmartPointer<vtkPolyData> all = gatherPieces(job.ranks(), piece);
  job.attempt(
    [&]
    {
      if (all)
      {
        writeCloud(all, fileName, files, options.writing);
      }
    });
}

/// Gives the outputs of all ranks their names, or none of them.
void commitTogether(Job& job, Files& files)
{
  // Rank 0 has the list of the pieces, and comes last.
  for (const bool isTurnOfRoot : { false, true })
  {
    try
    {
      job.attempt(
        [&]
        {
          if (job.isRoot() == isTurnOfRoot)
          {
            files.commit();
          }
        });
    }
    catch (const EndOfJob&)
    {
      files.revert();
      throw;
    }
  }
}

/// One run of a command on this rank.
template <class Options>
struct RankRun
{
  const Options& options;
  bool showsTraffic; ///< --traffic
  Job& job;
  Files& files;
  std::int64_t bytesRead = 0;

  /// Sets the threads, one per rank unless the options say more, and reads this rank's points of the input:
  /// contiguous ones, as many on each rank.
  vtkSmartPointer<vtkPolyData> readPiece()
  {
    useThreads(std::max<std::int64_t>(options.threads, 1));
    Cloud cloud;
    ReadOptions reading = options.reading;
    reading.ranks = &job.ranks();
    job.attempt([&] { cloud = readCloud(options.input, reading); });
    if (job.isRoot())
    {
      showNotes(cloud);
    }
    bytesRead = cloud.bytesRead;
    return cloud.points;
  }

  /// Writes @p piece of each rank, then what @p writeMore adds, and prints the result of @p figures, the same
  /// on all ranks.
  /// @param bytesSent to other ranks, for the computation.
  template <class Figures, class WriteMore>
  void finish(vtkPolyData* piece, const Figures& figures, std::int64_t bytesSent, const WriteMore& writeMore)
  {
    CloudResult result;
    job.attempt([&] { result = options.result(figures); });
    if (job.isRoot())
    {
      showWarnings();
    }
    writePieces(job, options, piece, files);
    writeMore();
    commitTogether(job, files);
    if (job.isRoot())
    {
      options.print(result);
    }
    if (!showsTraffic)
    {
      return;
    }
    const std::int64_t sentByAll = job.ranks().sum(bytesSent);
    const std::int64_t mostRead =
      job.ranks().reduce(bytesRead, [](std::int64_t a, std::int64_t b) { return std::max(a, b); });
    if (job.isRoot())
    {
      fmt::print(stderr, "{} bytes read by a rank at most\n{} bytes sent between {} ranks\n", mostRead,
        sentByAll, job.ranks().size());
    }
  }
};

/// Writes the index by rank 0, which gathers the rows: pieces of IN are in its order.
void writeIndex(Job& job, CsvWriter& file, vtkVoxelMeanResampler* resampler)
{
  std::vector<std::vector<std::int64_t>> rows(std::size_t(job.ranks().size()));
  rows.front() = voxelIndexOf(resampler);
  const std::vector<std::int64_t> all = job.ranks().exchangeValues(rows); // none but on rank 0
  job.attempt(
    [&]
    {
      addVoxelIndex(all, file);
      std::string problem;
      require(!job.isRoot() || file.commit(problem), problem);
    });
}

void runResample(RankRun<ResampleCommand>& run)
{
  const ResampleCommand& options = run.options;
  Job& job = run.job;
  CsvWriter index;
  const std::string indexFile = expandedName(options.voxelIndex, options.input);
  job.attempt(
    [&]
    {
      std::string problem;
      require(indexFile.empty() || !job.isRoot() ||
          index.open(run.files.output(indexFile), kVoxelIndexHeader, problem),
        problem);
    });
  const vtkSmartPointer<vtkPolyData> piece = run.readPiece();
  vtkNew<vtkDistributedVoxelMeanResampler> resampler;
  job.attempt([&] { options.update(resampler, piece); });
  vtkPolyData* means = resampler->GetOutput();
  for (const std::string& note : options.notes(piece, means, job.ranks()))
  {
    warn(job.isRoot() ? note : "");
  }
  const ResampleFigures figures{ job.ranks().sum(piece->GetNumberOfPoints()),
    job.ranks().sum(means->GetNumberOfPoints()), resampler->GetNumberOfClippedPoints(),
    resampler->GetNumberOfInvalidPoints() };
  options.finish(means);
  run.finish(means, figures, resampler->GetNumberOfBytesSent(),
    [&]
    {
      if (!indexFile.empty())
      {
        writeIndex(job, index, resampler);
      }
    });
}

void runBandwidth(RankRun<BandwidthCommand>& run)
{
  const vtkSmartPointer<vtkPolyData> piece = run.readPiece();
  vtkNew<vtkDistributedKernelBandwidthFilter> filter;
  filter->SetSettings(run.options.bandwidth.settings);
  run.job.attempt(
    [&]
    {
      filter->SetInputData(run.options.prepared(piece));
      updateFilter(filter, "bandwidth", run.options.input);
    });
  warn(run.job.isRoot() ? run.options.unitNote(piece) : "");
  const BandwidthFigures figures = run.job.ranks().reduce(bandwidthFigures(filter->GetOutput()), together);
  run.finish(filter->GetOutput(), figures, filter->GetNumberOfBytesSent(), [] {});
}

/// Checks the files of the parsed @p command. False: there is nothing to do (--dry-run).
bool takeFiles(CLI::App& command, CloudCommand& options, int ranks, Files& files)
{
  requireUsage(options.inputs.size() == 1, options.inputs.back(), "",
    "ranks read one cloud together; leave out the others");
  options.input = options.inputs.front();
  options.output = expandedName(options.output, options.input);
  files.take(command);
  requireUsage(!files.isStream(options.input), options.input, "",
    "standard input and pipes have no parts that ranks could read; give the name of a file");
  for (int rank = 0; isPiecesFile(options.output) && rank < ranks; ++rank)
  {
    files.addOutput(pieceFileOf(options.output, rank));
  }
  const bool isTrial = isGiven(command, "--dry-run");
  if (isTrial)
  {
    files.printPlan(options.json);
  }
  return !isTrial;
}

/// Adds a command with the options of Options beside those of ranks. Its callback checks the files, those of
/// @p ranks processes among them, and stores @p run in @p work.
template <class Options>
void addRankCommand(CLI::App& program, const char* name, const char* description, int ranks, MpiWork& work,
  void (*run)(RankRun<Options>&))
{
  CLI::App* command = program.add_subcommand(name, description);
  auto options = std::make_shared<Options>();
  auto showsTraffic = std::make_shared<bool>(false);
  options->addTo(*command);
  command->add_flag("--traffic", *showsTraffic,
    "Say on stderr how many bytes the ranks read of IN, and sent each other for the computation");
  command->get_option("--output")
    ->description("File to write: .vtp, .ply, .pcd, .las, .laz, .csv or .xyz; .pvtp writes a file per rank");
  allowExtension(*command->get_option("--output"), "pvtp");
  addCommonOptions(*command, true);
  command->callback(
    [=, &work]
    {
      nameCommand(name);
      auto files = std::make_shared<Files>();
      options->complete(*command, *files);
      if (takeFiles(*command, *options, ranks, *files))
      {
        work = [=](Job& job)
        {
          RankRun<Options> ofRank{ *options, *showsTraffic, job, *files };
          run(ofRank);
        };
      }
    });
}

} // namespace

void addMpiCommands(CLI::App& program, int ranks, MpiWork& work)
{
  addRankCommand<ResampleCommand>(program, "resample",
    "Replace the points in each voxel of a lattice by their mean", ranks, work, runResample);
  addRankCommand<BandwidthCommand>(program, "bandwidth",
    "Add kernel bandwidth, proxy radius and density to every point", ranks, work, runBandwidth);
}

} // namespace pointhaptics::app
