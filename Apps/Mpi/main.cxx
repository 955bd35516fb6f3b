/// The program pointhaptics-mpi: resample and bandwidth on the ranks that mpirun starts.
#include "Job.h"
#include "MpiCommands.h"

#include "Commands/Commands.h"
#include "Terminal/CommandLine.h"
#include "Terminal/Messages.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include <fcntl.h>
#include <malloc.h>
#include <sys/mman.h>
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

/// The last line of @p file, which is closed, without the name of the program.
std::string lastMessageOf(int file)
{
  std::string text(std::size_t(lseek(file, 0, SEEK_END)), ' ');
  text.resize(std::size_t(std::max<ssize_t>(0, pread(file, text.data(), text.size(), 0))));
  close(file);
  text.erase(text.find_last_not_of('\n') + 1);
  text.erase(0, text.rfind('\n') + 1);
  return text.substr(std::min(text.size(), text.find(": ") + 2));
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
  // Help, version and most usage errors are the same on all ranks; rank 0 says what another one refuses
  // alone.
  const int errors = dup(STDERR_FILENO);
  const int kept = memfd_create("errors", MFD_CLOEXEC);
  dup2(job.isRoot() ? errors : kept, STDERR_FILENO);
  const int parsed = runCommands(program, std::move(arguments), exitCode);
  dup2(errors, STDERR_FILENO);
  close(errors);
  const std::string message = lastMessageOf(kept);
  const std::string problem = firstMessage(job.ranks(), parsed == kSuccess ? std::string() : message);
  if (job.isRoot() && parsed == kSuccess && !problem.empty())
  {
    fail(problem);
  }
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
