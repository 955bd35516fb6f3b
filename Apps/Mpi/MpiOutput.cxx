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
#include <cstdio>
#include <filesystem>
#include <vector>

namespace pointhaptics::app
{
namespace
{

/// Writes a file for each rank with points.
bool writePerRank(Job& job, const std::string& command, const std::string& fileName, vtkPolyData* piece)
{
  const int rank = job.ranks().rank();
  const std::string own = pieceFileOf(fileName, rank);
  const bool hasPoints = piece->GetNumberOfPoints() > 0;
  std::string problem;
  if (hasPoints)
  {
    writeCloud(piece, own, command, problem);
  }
  std::vector<int> withPoints;
  for (const int r : job.ranks().gatherValues(hasPoints ? rank : -1))
  {
    if (r >= 0)
    {
      withPoints.push_back(r);
    }
  }
  bool isWritten = job.agree(command, problem);
  if (isWritten && job.isRoot())
  {
    writePiecesFile(fileName, piece, withPoints, problem);
  }
  isWritten = isWritten && job.agree(command, problem);
  if (!isWritten && hasPoints)
  {
    std::remove(own.c_str());
  }
  return isWritten;
}

} // namespace

void addOutputOptions(CLI::App& command)
{
  command.get_option("--output")
    ->description("File to write: .vtp, .ply, .pcd, .las, .laz, .csv or .xyz; .pvtp writes a file per rank");
  allowExtension(*command.get_option("--output"), "pvtp");
  addCommonOptions(command, true);
}

bool takeFiles(CLI::App& command, CloudToCloudOptions& options)
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
  Files files;
  files.take(command);
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

bool writePieces(Job& job, const std::string& command, const CloudToCloudOptions& files, vtkPolyData* piece)
{
  const std::string& fileName = files.output;
  if (isPiecesFile(fileName))
  {
    return writePerRank(job, command, fileName, piece);
  }
  std::string problem;
  const bool isVtp = std::filesystem::path(fileName).extension() == ".vtp";
  if (isVtp && job.ranks().size() > 1 && io::writeVtpTogether(job.ranks(), piece, fileName, problem))
  {
    return job.agree(command, problem);
  }
  const vtkSmartPointer<vtkPolyData> all = gatherPieces(job.ranks(), piece);
  if (all)
  {
    writeCloud(all, fileName, command, problem, files.writing);
  }
  return job.agree(command, problem);
}

} // namespace pointhaptics::app
