#include "Benchmark/Harness/PeakMemory.h"

#include <chrono>
#include <cstdlib>
#include <exception>
#include <fstream>

#include <malloc.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

namespace pointhaptics
{
namespace bench
{
namespace
{

/// A line such as "VmHWM:   123 kB" of /proc/self/status; -1 where there is none.
std::int64_t statusValue(const std::string& key)
{
  std::ifstream stream("/proc/self/status");
  for (std::string line; std::getline(stream, line);)
  {
    if (line.rfind(key + ":", 0) == 0)
    {
      return std::strtoll(line.c_str() + key.size() + 1, nullptr, 10);
    }
  }
  return -1;
}

bool resetHighWaterMark()
{
  std::ofstream stream("/proc/self/clear_refs");
  stream << "5" << std::flush;
  return bool(stream);
}

/// Maps every page that comes from a file. A child begins without those of its program and libraries, and the
/// ones it happens to use would be counted as the work's. Before Linux 5.14 they are: some 10 MB.
void mapFilePages()
{
#ifdef MADV_POPULATE_READ
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);)
  {
    char* rest = nullptr;
    const std::uintptr_t begin = std::strtoull(line.c_str(), &rest, 16);
    const std::uintptr_t end = *rest == '-' ? std::strtoull(rest + 1, &rest, 16) : begin;
    if (line.find('/') != std::string::npos && end > begin)
    {
      (void)madvise(reinterpret_cast<void*>(begin), end - begin, MADV_POPULATE_READ);
    }
  }
#endif
}

/// In the child. False: no counters.
bool measureHere(const std::function<std::int64_t()>& work, PeakMemory& result)
{
  mapFilePages();
#ifdef __GLIBC__
  malloc_trim(0); // or the work would be served from pages that were freed before it
#endif
  const std::int64_t before = statusValue("VmRSS");
  if (before < 0 || !resetHighWaterMark())
  {
    return false;
  }
  const auto begin = std::chrono::steady_clock::now();
  result.result = work();
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  result.peakBytes = 1024 * (statusValue("VmHWM") - before);
  result.keptBytes = 1024 * (statusValue("VmRSS") - before);
  return true;
}

[[noreturn]] void beTheChild(const std::function<std::int64_t()>& work, int channel)
{
  PeakMemory result;
  bool sent = false;
  try
  {
    sent = measureHere(work, result) && write(channel, &result, sizeof result) == ssize_t(sizeof result);
  }
  catch (const std::exception&)
  {
    sent = false;
  }
  _exit(sent ? 0 : 1);
}

} // namespace

bool measurePeakMemory(const std::function<std::int64_t()>& work, PeakMemory& result, std::string& message)
{
  if (statusValue("Threads") != 1)
  {
    message = "memory cannot be measured here: this process runs more than one thread";
    return false;
  }
  int channel[2];
  if (pipe(channel) != 0)
  {
    message = "memory cannot be measured here: no pipe can be opened";
    return false;
  }
  const pid_t child = fork();
  if (child == 0)
  {
    close(channel[0]);
    beTheChild(work, channel[1]);
  }
  close(channel[1]);
  const bool received = child > 0 && read(channel[0], &result, sizeof result) == ssize_t(sizeof result);
  close(channel[0]);
  if (child > 0)
  {
    waitpid(child, nullptr, 0);
  }
  if (!received)
  {
    message = "memory cannot be measured here: the kernel has no counters, or the memory did not suffice";
  }
  return received;
}

} // namespace bench
} // namespace pointhaptics
