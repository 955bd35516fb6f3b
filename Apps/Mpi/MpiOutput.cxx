#include "MpiOutput.h"

#include "Job.h"
#include "PieceOfCloud.h"
#include "PiecesFile.h"

#include "IO/Vtk/SharedVtp.h"

#include "Clouds/Pipeline.h"
#include "Options/OptionParsing.h"
#include "Terminal/CommandLine.h"

#include <CLI/CLI.hpp>
#include <vtkPolyData.h>

#include <algorithm>
#include <filesystem>
#include <vector>

namespace pointhaptics::app
{
namespace
{

/// Writes a file for each rank with points, and the list of them.
bool writePerRank(
  Job& job, const std::string& command, const std::string& fileName, vtkPolyData* piece, Files& files)
{
  const int rank = job.ranks().rank();
  const bool hasPoints = piece->GetNumberOfPoints() > 0;
  std::string problem;
  if (hasPoints)
  {
    writeCloud(piece, pieceFileOf(fileName, rank), files, command, problem);
  }
  std::vector<int> withPoints = job.ranks().gatherValues(hasPoints ? rank : -1);
  withPoints.erase(std::remove(withPoints.begin(), withPoints.end(), -1), withPoints.end());
  if (job.isRoot() && problem.empty())
  {
    writePiecesFile(files.output(fileName), fileName, piece, withPoints, problem);
  }
  return job.agree(command, problem);
}

} // namespace

void addOutputOptions(CLI::App& command)
{
  command.get_option("--output")
    ->description("File to write: .vtp, .ply, .pcd, .las, .laz, .csv or .xyz; .pvtp writes a file per rank");
  allowExtension(*command.get_option("--output"), "pvtp");
  addCommonOptions(command, true);
}

bool takeFiles(CLI::App& command, CloudToCloudOptions& options, int ranks, Files& files)
{
  if (options.inputs.size() > 1)
  {
    throwUsage(options.inputs[1], "", "ranks read one cloud together; leave out the others");
  }
  options.input = options.inputs.front();
  options.output = expandedName(options.output, options.input);
  if (options.input == kStandardStream)
  {
    throwUsage("-", "", "standard input has no parts that ranks could read; give the name of a file");
  }
  files.take(command);
  for (int rank = 0; isPiecesFile(options.output) && rank < ranks; ++rank)
  {
    files.addOutput(pieceFileOf(options.output, rank));
  }
  const bool isTrial = command.get_option("--dry-run")->count() > 0;
  if (isTrial)
  {
    files.printPlan(options.json);
  }
  return !isTrial;
}

bool openPiece(
  Job& job, const std::string& command, const CloudToCloudOptions& files, Traffic& traffic, Piece& piece)
{
  useThreads(std::max<std::int64_t>(files.threads, 1));
  std::string problem;
  Cloud cloud;
  files.read(cloud, problem, &job.ranks());
  if (!job.agree(command, problem))
  {
    return false;
  }
  if (job.isRoot())
  {
    showNotes(command, files.input, cloud);
  }
  traffic.read = cloud.bytesRead;
  piece.points = cloud.points;
  piece.pointsOfAll =
    job.ranks().reduce(cloud.points->GetNumberOfPoints(), [](vtkIdType a, vtkIdType b) { return a + b; });
  return true;
}

bool writePieces(
  Job& job, const std::string& command, const CloudToCloudOptions& options, vtkPolyData* piece, Files& files)
{
  const std::string& fileName = options.output;
  if (isPiecesFile(fileName))
  {
    return writePerRank(job, command, fileName, piece, files);
  }
  std::string problem;
  const bool isVtp = std::filesystem::path(fileName).extension() == ".vtp";
  const std::string path = isVtp && job.isRoot() ? files.output(fileName) : std::string();
  if (isVtp && job.ranks().size() > 1 && io::writeVtpTogether(job.ranks(), piece, path, problem))
  {
    return job.agree(command, problem);
  }
  const vtkSmartPointer<vtkPolyData> all = gatherPieces(job.ranks(), piece);
  if (all)
  {
    writeCloud(all, fileName, files, command, problem, options.writing);
  }
  return job.agree(command, problem);
}

bool commitTogether(Job& job, const std::string& command, Files& files)
{
  std::string problem;
  // Rank 0 has the list of the pieces, and comes last.
  for (const bool isTurnOfRoot : { false, true })
  {
    if (job.isRoot() == isTurnOfRoot)
    {
      files.commit(problem);
    }
    if (!job.agree(command, problem))
    {
      files.revert();
      return false;
    }
  }
  return true;
}

} // namespace pointhaptics::app
