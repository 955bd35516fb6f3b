/// The program pointhaptics-mpi: resample and bandwidth on the ranks that mpirun starts.
#include "Job.h"
#include "MpiCommands.h"

#include "Commands/Commands.h"
#include "Terminal/CommandLine.h"
#include "Terminal/Messages.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include <fcntl.h>
#include <malloc.h>
#include <unistd.h>

namespace
{

using namespace pointhaptics::app;

/// Silences all ranks but one: help, version and usage errors are the same on all.
class Silence
{
public:
  explicit Silence(bool isWanted)
  {
    const int nowhere = isWanted ? open("/dev/null", O_WRONLY | O_CLOEXEC) : -1;
    for (int stream = 0; stream < 2 && nowhere >= 0; ++stream)
    {
      std::fflush(stream == 0 ? stdout : stderr);
      kept_[stream] = dup(stream + 1);
      dup2(nowhere, stream + 1);
    }
    if (nowhere >= 0)
    {
      close(nowhere);
    }
  }
  ~Silence()
  {
    for (int stream = 0; stream < 2; ++stream)
    {
      std::fflush(stream == 0 ? stdout : stderr);
      if (kept_[stream] >= 0)
      {
        dup2(kept_[stream], stream + 1);
        close(kept_[stream]);
      }
    }
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

private:
  int kept_[2] = { -1, -1 };
};

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
  int parsed = kSuccess;
  {
    const Silence silence(!job.isRoot());
    parsed = runCommands(program, std::move(arguments), exitCode);
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
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  return runProgram(arguments, [&] { return job.finish(run(job, arguments)); });
}
