/// The program pointhaptics-mpi: resample and bandwidth on the ranks that mpirun starts.
#include "Job.h"
#include "MpiCommands.h"

#include "Commands/Commands.h"
#include "Terminal/CommandLine.h"
#include "Terminal/Messages.h"

#include <CLI/CLI.hpp>

#include <limits>
#include <string>
#include <vector>

#include <fcntl.h>
#include <malloc.h>
#include <unistd.h>

namespace
{

using namespace pointhaptics::app;

/// Sends what is written to @p stream from here on nowhere. @return a descriptor of where it went before.
int silence(int stream)
{
  const int before = dup(stream);
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  dup2(nowhere, stream);
  close(nowhere);
  return before;
}

/// Keeps freed memory for the next allocation. Ranks send and receive their sums in large pieces one after
/// the other; the system would clear the memory for each anew, which takes longer than filling it.
void keepFreedMemory()
{
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
}

int run(Job& job, std::vector<std::string> arguments)
{
  CLI::App program("The commands of pointhaptics for point clouds on many processes.\n"
                   "Usage: mpirun -n RANKS pointhaptics-mpi COMMAND ...",
    "pointhaptics-mpi");
  MpiWork work;
  addMpiCommands(program, job.ranks().size(), work);
  addManPage(program);
  int exitCode = kSuccess;
  // Help, version and usage errors are the same on all ranks.
  const int errors = job.isRoot() ? dup(STDERR_FILENO) : silence(STDERR_FILENO);
  const int parsed = runCommands(program, std::move(arguments), exitCode);
  dup2(errors, STDERR_FILENO);
  close(errors);
  const int ofAll = job.ranks().reduce(parsed != kSuccess ? parsed
      : work                                              ? -1
                                                          : kSuccess,
    [](int a, int b) { return a > b ? a : b; });
  if (ofAll != -1)
  {
    return ofAll; // help, version, or a rank whose command line is wrong
  }
  try
  {
    work(job);
  }
  catch (const EndOfJob&)
  {
    return kFailed;
  }
  return kSuccess;
}

} // namespace

int main(int argc, char* argv[])
{
  nameProgram("pointhaptics-mpi");
  keepFreedMemory();
  Job job(&argc, &argv);
  if (!job.isRoot())
  {
    close(silence(STDOUT_FILENO)); // figures and JSON are rank 0's
  }
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  return runProgram(arguments, [&] { return job.finish(run(job, arguments)); });
}
