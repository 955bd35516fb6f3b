#include "Job.h"

#include "Terminal/CommandLine.h"
#include "Terminal/Messages.h"

#include <vtkMPIController.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <string>

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
  problem = firstMessage(ranks_, problem);
  if (problem.empty())
  {
    return;
  }
  if (this->isRoot())
  {
    fail(problem);
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
