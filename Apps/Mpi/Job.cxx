#include "Job.h"

#include "Terminal/CommandLine.h"
#include "Terminal/Messages.h"

#include <fmt/format.h>
#include <vtkMPIController.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

namespace pointhaptics::app
{

namespace
{

/// Leaves out network hardware where all ranks run on this machine: Open MPI looks 0.15 s long for it. A
/// choice of the user stays.
void useMemoryAlone()
{
  const char* all = std::getenv("OMPI_COMM_WORLD_SIZE");
  const char* here = std::getenv("OMPI_COMM_WORLD_LOCAL_SIZE");
  if (all && here && std::strcmp(all, here) == 0)
  {
    setenv("OMPI_MCA_pml", "ob1", 0);
  }
}

} // namespace

Job::Job(int* argc, char*** argv)
  : ranks_(controller_)
{
  useMemoryAlone();
  controller_->Initialize(argc, argv);
  vtkMultiProcessController::SetGlobalController(controller_);
}

Job::~Job()
{
  if (!isFinished_)
  {
    // Other ranks may wait for a message of this one.
    abortJob(kFailed);
  }
  vtkMultiProcessController::SetGlobalController(nullptr);
  controller_->Finalize();
}

void Job::attempt(const std::function<void()>& work)
{
  std::string problem;
  try
  {
    work();
  }
  catch (const Failure& failure)
  {
    problem = failure.what();
  }
  const std::vector<std::string> problems = ranks_.gather(problem);
  const auto first =
    std::find_if(problems.begin(), problems.end(), [](const std::string& text) { return !text.empty(); });
  if (first == problems.end())
  {
    return;
  }
  const bool isEverywhere =
    std::all_of(problems.begin(), problems.end(), [&](const std::string& text) { return text == *first; });
  if (this->isRoot())
  {
    fail(isEverywhere ? *first
                      : fmt::format("rank {} of {}: {}", first - problems.begin(), ranks_.size(), *first));
  }
  throw EndOfJob();
}

int Job::finish(int exitCode)
{
  const int code = ranks_.reduce(exitCode, [](int a, int b) { return std::max(a, b); });
  isFinished_ = true;
  return code;
}

} // namespace pointhaptics::app
