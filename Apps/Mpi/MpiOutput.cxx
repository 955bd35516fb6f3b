#include "MpiOutput.h"

#include "Job.h"
#include "PieceOfCloud.h"

#include "Clouds/Pipeline.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <vtkPolyData.h>

#include <algorithm>

namespace pointhaptics
{
namespace app
{

bool openPiece(Job& job, const std::string& command, const CloudToCloudOptions& files, Piece& piece)
{
  useThreads(std::max<std::int64_t>(files.threads, 1));
  std::string problem;
  Cloud cloud;
  if (files.input == kStandardStream)
  {
    problem = "standard input has no parts that ranks could read; give the name of a file";
  }
  else if (canWriteCloud(files.output, problem))
  {
    ReadOptions reading;
    reading.resolution = files.resolution;
    readCloud(files.input, cloud, problem, reading);
  }
  if (!job.agree(command, problem))
  {
    return false;
  }
  if (job.isRoot())
  {
    showNotes(command, files.input, cloud);
  }
  const vtkIdType all = cloud.points->GetNumberOfPoints();
  const vtkIdType rank = job.ranks().rank();
  const vtkIdType size = job.ranks().size();
  piece.pointsOfAll = all;
  piece.points = pieceOfCloud(cloud.points, all * rank / size, all * (rank + 1) / size);
  return true;
}

bool writePieces(Job& job, const std::string& command, const std::string& fileName, vtkPolyData* piece)
{
  const vtkSmartPointer<vtkPolyData> all = gatherPieces(job.ranks(), piece);
  std::string problem;
  if (all)
  {
    writeCloud(all, fileName, command, problem);
  }
  return job.agree(command, problem);
}

void addTraffic(CLI::App& command, bool& isWanted)
{
  command.add_flag(
    "--traffic", isWanted, "Say on stderr how many bytes the ranks sent each other for the computation");
}

void sayTraffic(Job& job, bool isWanted, std::int64_t own)
{
  if (!isWanted)
  {
    return;
  }
  const std::int64_t sent = job.ranks().reduce(own, [](std::int64_t a, std::int64_t b) { return a + b; });
  if (job.isRoot())
  {
    fmt::print(stderr, "{} bytes sent between {} ranks\n", sent, job.ranks().size());
  }
}

} // namespace app
} // namespace pointhaptics
