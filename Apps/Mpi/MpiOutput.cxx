#include "MpiOutput.h"

#include "Job.h"
#include "PieceOfCloud.h"
#include "PiecesFile.h"

#include "IO/Vtk/SharedVtp.h"

#include "Clouds/Pipeline.h"

#include <CLI/CLI.hpp>
#include <vtkPolyData.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <vector>

namespace pointhaptics
{
namespace app
{
namespace
{

bool canWritePieces(const std::string& fileName, std::string& problem)
{
  const bool canWrite = isPiecesFile(fileName) || canWriteCloud(fileName, problem);
  problem += canWrite ? "" : ", or .pvtp for a file per rank";
  return canWrite;
}

/// Ranks without points have no file.
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

void describeOutput(CLI::App& command)
{
  command.get_option("--output")
    ->description("File to write: .vtp, .ply, .pcd, .las, .laz or .csv; .pvtp writes a file per rank");
}

bool openPiece(
  Job& job, const std::string& command, const CloudToCloudOptions& files, Traffic& traffic, Piece& piece)
{
  useThreads(std::max<std::int64_t>(files.threads, 1));
  std::string problem;
  if (files.input == kStandardStream)
  {
    problem = "standard input has no parts that ranks could read; give the name of a file";
  }
  else
  {
    canWritePieces(files.output, problem);
  }
  if (!job.agree(command, problem))
  {
    return false;
  }
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

bool writePieces(Job& job, const std::string& command, const std::string& fileName, vtkPolyData* piece)
{
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
    writeCloud(all, fileName, command, problem);
  }
  return job.agree(command, problem);
}

} // namespace app
} // namespace pointhaptics
