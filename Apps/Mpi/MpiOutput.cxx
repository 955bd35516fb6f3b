#include "MpiOutput.h"

#include "Job.h"
#include "PieceOfCloud.h"
#include "PiecesFile.h"

#include "Clouds/Pipeline.h"
#include "Options/OptionParsing.h"
#include "Terminal/CommandLine.h"
#include "Terminal/Messages.h"

#include <CLI/CLI.hpp>
#include <vtkPolyData.h>

#include <algorithm>
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

void addOutputOptions(CLI::App& command)
{
  command.get_option("--output")
    ->description("File to write: .vtp, .ply, .pcd, .las, .laz, .csv or .xyz; .pvtp writes a file per rank");
  allowExtension(*command.get_option("--output"), "pvtp");
  addCommonOptions(command, true);
}

/// Checks the files of the parsed @p command. False: there is nothing to do (--dry-run).
bool takeFiles(CLI::App& command, CloudCommand& options, int ranks, Files& files)
{
  requireUsage(options.inputs.size() == 1, options.inputs.back(), "",
    "ranks read one cloud together; leave out the others");
  options.input = options.inputs.front();
  options.output = expandedName(options.output, options.input);
  requireUsage(options.input != kStandardStream, "-", "",
    "standard input has no parts that ranks could read; give the name of a file");
  files.take(command);
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

} // namespace

void addRankCommand(CLI::App& program, const char* name, const char* description, int ranks, MpiWork& work,
  std::shared_ptr<CloudCommand> shared, std::shared_ptr<Traffic> traffic,
  std::function<void(Job&, Files&)> run)
{
  CLI::App* command = program.add_subcommand(name, description);
  shared->addTo(*command);
  traffic->addTo(*command);
  addOutputOptions(*command);
  command->callback(
    [=, &work]
    {
      nameCommand(name);
      shared->complete(*command);
      auto files = std::make_shared<Files>();
      if (takeFiles(*command, *shared, ranks, *files))
      {
        work = [run, files](Job& job) { run(job, *files); };
      }
    });
}

Piece openPiece(Job& job, const CloudCommand& options, Traffic& traffic)
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
  traffic.read = cloud.bytesRead;
  const vtkIdType all =
    job.ranks().reduce(cloud.points->GetNumberOfPoints(), [](vtkIdType a, vtkIdType b) { return a + b; });
  return { cloud.points, all };
}

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

} // namespace pointhaptics::app
